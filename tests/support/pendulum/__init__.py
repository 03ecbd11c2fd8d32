"""A system and a scene from outside the package: the spherical pendulum."""
