"""Cached computations, and the pool of threads for requests and background work."""
