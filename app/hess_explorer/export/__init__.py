"""Export of a state: data as tables, pictures as figures and films, code and notebooks."""
