"""What can be computed for any system: orbits, ensembles, sections, exponents."""
