"""Parts of scenes.  The subpackages do not import one another, except that `sections` imports `orbits`."""
