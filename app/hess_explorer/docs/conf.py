"""How Sphinx builds the documentation: `hess-explorer docs`.  It works from a folder, without a network."""

from importlib.metadata import version as installed

from sphinx.application import Sphinx

project = "Hess Explorer"
version = release = installed("hess-explorer")

extensions = ["myst_nb", "sphinx.ext.autodoc", "numpydoc"]
html_theme = "furo"
html_title = "Hess Explorer"
html_show_sourcelink = html_show_copyright = False

# A tutorial that fails ends the build.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_show_tb = True
nb_execution_in_temp = True
nb_execution_timeout = 300
suppress_warnings = ["mystnb.unknown_mime_type"]  # what HoloViews would load in a notebook

autodoc_member_order = "alphabetical"
autodoc_typehints = "none"  # the signatures of numpydoc have them
numpydoc_show_class_members = False


def _escape_bars(app: object, what: str, name: str, of: object, options: object, lines: list[str]) -> None:
    """Keep |f| as it is: reStructuredText would take the bars for a substitution."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("autodoc-process-docstring", _escape_bars)
