"""Graphs of functions."""
