"""Pictures in space: the body, spheres, tori, clouds."""
