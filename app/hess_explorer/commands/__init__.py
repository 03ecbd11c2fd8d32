"""The commands of `hess-explorer`, one file per subject.

Each has `add(commands)`, which declares its options with argparse alone, and a function that runs it and imports
what it needs only then: `circle-map` does not load the web page's libraries, nor `--help` the mechanics.
"""

from __future__ import annotations

__all__ = ["CommandError"]


class CommandError(Exception):
    """A request that cannot be carried out; the message is one sentence: what is wrong and what to change."""
