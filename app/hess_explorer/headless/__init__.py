"""Pictures, films and screenshots of the page with a headless browser."""
