"""A disk without room."""

from contextlib import contextmanager

import pytest


@contextmanager
def full_disk(room=100):
    """Let no file grow beyond so many bytes, as on a full disk: the rest of a write raises `OSError`."""
    resource = pytest.importorskip("resource")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def names(folder):
    """Return the names of all files in a folder."""
    return sorted(file.name for file in folder.iterdir())
