"""Maps and diagrams: circle maps, scattering, rotation numbers, branches."""
