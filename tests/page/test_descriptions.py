"""The libraries that draw descriptions of scenes are not loaded at the start."""

import subprocess
import sys


def test_a_server_starts_without_what_only_some_pages_need():
    seldom = {"holoviews", "matplotlib", "panel_material_ui", "hess_explorer.sweep"}
    code = f"import sys, hess_explorer.server.serving; print({seldom!r} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"
