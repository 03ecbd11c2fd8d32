"""Numerical methods: compiled Taylor series, accuracy levels and measured errors, arguments and results."""
