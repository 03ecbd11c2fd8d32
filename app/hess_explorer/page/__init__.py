"""The page and its sessions."""
