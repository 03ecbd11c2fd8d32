"""What can be asked of any system: orbits, ensembles, sections, exponents."""
