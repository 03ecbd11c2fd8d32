"""Rows of `test_extremes`, by subject."""
