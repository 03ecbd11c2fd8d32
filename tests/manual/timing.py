"""Times of several runs side by side, and the conditions under which they were measured."""

import os
import platform
import timeit
from datetime import UTC, datetime
from pathlib import Path


def in_turn(runs, turns=5):
    """Return the least seconds of each run, timed in turn, so that other load on the machine affects all alike."""
    timers = [timeit.Timer(run) for run in runs]
    counts = [timer.autorange()[0] for timer in timers]
    rounds = [[timer.timeit(count) / count for timer, count in zip(timers, counts, strict=True)] for _ in range(turns)]
    return [min(own) for own in zip(*rounds, strict=True)]


def conditions():
    """Return the day (UTC), the processor, the number of cores and the version of Python, as a text."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    processor = named[0] if named else platform.machine()
    return f"{datetime.now(UTC):%Y-%m-%d}, {processor}, {os.cpu_count()} cores, Python {platform.python_version()}"
