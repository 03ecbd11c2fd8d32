"""Screenshots of the page with a headless browser."""
