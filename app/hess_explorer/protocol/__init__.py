"""Messages between browser and server: parameters, requests and responses."""
