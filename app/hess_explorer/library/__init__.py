"""What `import hess_explorer` offers: states of the explorer in Python, with their data and pictures."""
