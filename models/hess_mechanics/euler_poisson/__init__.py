"""The Euler–Poisson equations and their Hess case."""
