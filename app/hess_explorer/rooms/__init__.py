"""Rooms: followers see the page of a lecturer on their phones."""
