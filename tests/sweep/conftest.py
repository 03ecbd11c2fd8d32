"""Sweeps of tori in pieces of chosen size, and the pieces that were computed."""

import pytest

from hess_explorer.sweep import piece as pieces
from hess_explorer.sweep import run as running
from hess_explorer.sweep import sweep
from hess_explorer.sweep import workers as working

TORI = {"h": (-1.2, 2.0, 12), "f": (0.0, 1.2, 9)}


@pytest.fixture
def tori():
    """Return a sweep over tori; the options are those of `sweep`."""
    return lambda **options: sweep(**{"computation": "circle-map", "over": TORI, "a": 0.5, **options})


@pytest.fixture
def in_pieces(monkeypatch):
    """Return a function that sets the size of pieces to at most so many cells."""
    return lambda cells: monkeypatch.setattr(running, "piece_size", lambda *_: cells)


@pytest.fixture
def computed(monkeypatch):
    """Return the list of pieces that have been computed since in this thread."""
    found = []
    monkeypatch.setattr(working, "compute", lambda piece: found.append(piece) or pieces.compute(piece))
    return found


@pytest.fixture
def interrupt():
    """Return a report of progress that interrupts the sweep after so many cells."""

    def after(cells):
        def report(now):
            if now.done >= cells:
                raise KeyboardInterrupt

        return report

    return after
