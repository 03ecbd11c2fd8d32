"""The Hess case of the Suslov problem."""
