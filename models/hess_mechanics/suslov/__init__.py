"""The Suslov problem."""
