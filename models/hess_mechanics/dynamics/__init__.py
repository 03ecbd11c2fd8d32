"""Computations for any system: orbits, ensembles, sections, exponents."""
