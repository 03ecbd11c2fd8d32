"""Pictures in a plane: of ω, of γ, of coordinates, of sections."""
