"""Framework shared by all scenes."""
