"""Describe the conditions of a run: the day, the machine and the versions."""

import os
import platform
from datetime import UTC, datetime
from pathlib import Path


def _processor():
    """Model name of the processor, as far as the system reports it."""
    info = Path("/proc/cpuinfo")
    if info.exists():
        for line in info.read_text().splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def describe():
    """Date (UTC), processor, cores that may be used, Python."""
    return {
        "date": datetime.now(UTC).date().isoformat(),
        "processor": _processor(),
        "cores": len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1,
        "python": platform.python_version(),
    }


def conditions():
    """`describe` as a text."""
    facts = describe()
    return f"{facts['date']}, {facts['processor']}, {facts['cores']} cores, Python {facts['python']}"
