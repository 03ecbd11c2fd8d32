"""Parts for diagrams over a parameter."""
