"""Rooms: an audience follows the page of a lecturer on its own phones."""
