"""What scenes are composed of: one part in each file, and no part imports another."""
