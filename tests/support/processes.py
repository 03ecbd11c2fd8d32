"""Child processes: interrupted, weighed, timed."""

import os
import signal
from contextlib import contextmanager
from pathlib import Path

__all__ = ["below", "interruptible", "memory", "worked"]


@contextmanager
def interruptible():
    """Children started inside obey Ctrl-C, even where a shell runs the tests in the background.

    Such a shell lets its children ignore SIGINT, and they hand that on; a handler is reset to the default instead.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def below(pid):
    """A process and all below it."""
    found = [pid]
    for one in found:
        try:
            found += map(int, Path(f"/proc/{one}/task/{one}/children").read_text().split())
        except OSError:
            continue
    return found


def memory(pid):
    """Bytes in memory, each page shared between processes counted once."""
    total = 0
    for one in below(pid):
        for line in Path(f"/proc/{one}/smaps_rollup").read_text().splitlines():
            if line.startswith("Pss:"):
                total += 1024 * int(line.split()[1])
    return total


def worked(pid):
    """Seconds of the processor until now."""
    ticks = 0
    for one in below(pid):
        fields = Path(f"/proc/{one}/stat").read_text().rpartition(")")[2].split()
        ticks += int(fields[11]) + int(fields[12])
    return ticks / os.sysconf("SC_CLK_TCK")
