"""The commands of `hess-explorer`, one file per subject.

Each has `add(commands)`, which declares its options and needs nothing but argparse, and a function that runs
it and imports what it needs only then: `circle-map` does not wait for the web page's libraries, nor `--help`
for the mechanics.
"""

from __future__ import annotations

__all__ = ["CommandError"]


class CommandError(Exception):
    """A request that cannot be carried out; its text is one sentence for the user: what is wrong, what to change."""
