"""Parts for one orbit."""
