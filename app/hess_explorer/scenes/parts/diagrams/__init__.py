"""Parts about diagrams over a parameter."""
