"""What the scripts share: times of several runs side by side, a server that has come to rest, tables."""

import os
import platform
import time
import timeit
from datetime import UTC, datetime
from pathlib import Path
from statistics import median

from support.measured import table, write_measured
from support.processes import worked


def in_turn(runs, turns=5):
    """Return the least seconds of each run, timed in turn, so that other load on the machine affects all alike."""
    timers = [timeit.Timer(run) for run in runs]
    counts = [timer.autorange()[0] for timer in timers]
    rounds = [[timer.timeit(count) / count for timer, count in zip(timers, counts, strict=True)] for _ in range(turns)]
    return [min(own) for own in zip(*rounds, strict=True)]


def wait_idle(pid):
    """Wait until a server has prepared its scenes and rests."""
    before = -1.0
    while (now := worked(pid)) > before + 0.05:
        before = now
        time.sleep(2.0)


def milliseconds(times):
    """Return median and 95th percentile of some seconds, as a text."""
    if not times:
        return "–"
    return f"{1e3 * median(times):.0f}, {1e3 * sorted(times)[int(0.95 * (len(times) - 1))]:.0f} ms"


def conditions():
    """Return the day (UTC), the processor, the number of cores and the version of Python, as a text."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    processor = named[0] if named else platform.machine()
    return f"{datetime.now(UTC):%Y-%m-%d}, {processor}, {os.cpu_count()} cores, Python {platform.python_version()}"


def report(head, rows, *readmes):
    """Print a table and the conditions, and write them to these files."""
    text = f"{conditions()}.\n\n{table(head, rows)}"
    print(text)
    for readme in readmes:
        write_measured(readme, text)
