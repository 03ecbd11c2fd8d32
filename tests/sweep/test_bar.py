"""The progress bar of a sweep in a notebook, whose standard error is no terminal."""

import nbformat
import pytest
from nbclient import NotebookClient

CELL = "from hess_explorer.sweep import sweep\nsweep('cos-chi', {'I11': (1.0, 3.0, 5)}, progress=True).cos_chi.size"


@pytest.mark.thorough
def test_the_bar_is_shown_in_a_notebook():
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(CELL)])
    NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    outputs = notebook.cells[0].outputs
    said = "".join(one.get("text", "") for one in outputs)
    shown = [name for one in outputs for name in one.get("data", {})]
    # A widget where ipywidgets is installed, as the extra "notebook" does; otherwise a bar of text.
    assert "application/vnd.jupyter.widget-view+json" in shown or "100%" in said
    assert outputs[-1]["data"]["text/plain"] == "5"
