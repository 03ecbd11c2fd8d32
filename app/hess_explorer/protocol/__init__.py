"""What travels between browser and server: parameters and data."""
