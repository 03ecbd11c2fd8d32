"""Parts of scenes, one per file; no part imports another."""
