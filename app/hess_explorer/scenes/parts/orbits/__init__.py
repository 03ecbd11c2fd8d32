"""Parts about one orbit."""
