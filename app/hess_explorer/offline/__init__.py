"""Pages in files: computed states that play without a server, for a state with sliders, a lesson, and a whole site."""
