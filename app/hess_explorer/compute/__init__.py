"""Cached computations, the scheduler of requests and background work."""
