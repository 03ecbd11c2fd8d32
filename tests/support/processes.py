"""Child processes: servers, and how to interrupt them and measure their memory and CPU time."""

import os
import signal
from contextlib import contextmanager
from pathlib import Path

from support.asynchronous import wait_until

# It gets no scene ready before somebody enters it: that takes longer than the test of one or two.
UNWARMED = (
    "-c",
    """
from hess_explorer.__main__ import main
from hess_explorer.server import serving

serving.warm = lambda first_is_ready: first_is_ready()
main()
""",
)
"""Arguments of Python that start a server for `server_process`."""


@contextmanager
def interruptible():
    """Make children started inside react to Ctrl-C, even if a shell runs the tests in the background.

    Such a shell lets its children ignore SIGINT, and they hand that on; a handler is reset to the default instead.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def below(pid):
    """Return a process and all its descendants."""
    found = [pid]
    for one in found:
        try:
            found += map(int, Path(f"/proc/{one}/task/{one}/children").read_text().split())
        except OSError:
            continue
    return found


def assert_gone(processes, seconds=20.0):
    """Assert that these processes end by then."""
    wait_until(lambda: not any(Path(f"/proc/{one}").exists() for one in processes), seconds)


def memory(pid):
    """Return the bytes of memory; pages shared between processes count once."""
    total = 0
    for one in below(pid):
        try:
            lines = Path(f"/proc/{one}/smaps_rollup").read_text().splitlines()
        except OSError:
            # It has ended, and nobody has asked for its exit code yet.
            continue
        for line in lines:
            if line.startswith("Pss:"):
                total += 1024 * int(line.split()[1])
    return total


def worked(pid):
    """Return the CPU seconds used so far."""
    ticks = 0
    for one in below(pid):
        fields = Path(f"/proc/{one}/stat").read_text().rpartition(")")[2].split()
        ticks += int(fields[11]) + int(fields[12])
    return ticks / os.sysconf("SC_CLK_TCK")
