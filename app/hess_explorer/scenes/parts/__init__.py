"""Parts that scenes are composed of: one in each file, and no part imports another."""
