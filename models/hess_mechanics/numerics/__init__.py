"""Compilation, accuracy levels, Taylor series, events, batches."""
