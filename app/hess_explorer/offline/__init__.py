"""Pages in files: computed states without a server, for a state with sliders, a lesson, or a whole site."""
