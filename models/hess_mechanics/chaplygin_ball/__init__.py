"""The Chaplygin ball with Suslov's constraint."""
