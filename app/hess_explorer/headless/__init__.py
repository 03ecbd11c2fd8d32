"""A headless browser: screenshots."""
