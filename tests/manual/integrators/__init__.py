"""The benchmark: the same works done by this project and by other integrators, against stored exact results.

A work (`works.py`) knows its initial data and measures the error of a result.  A method (`method.py`) does works at
settings from coarse to fine; `explorer.py` is this project's, `peers/` holds the others.  `measure.py` finds for each
error asked for the cheapest setting that keeps it and times those of all methods in turn; `report.py` and `picture.py`
show it.
"""
