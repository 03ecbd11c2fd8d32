"""Cached and background computation."""
