"""Sections: their orbits, and what is found out about them."""
