"""Implementation of the Python interface: states with their data, drawings and notebooks."""
