"""Pictures of results, as data."""
