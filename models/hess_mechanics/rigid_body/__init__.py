"""Rigid bodies: inertia tensors and attitudes."""
