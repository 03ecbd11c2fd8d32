"""The arrows between the layers: parameters → model → computation → result → view → scene → page.

Nothing points back.  Imports are read from the source, also those inside functions.
"""

import ast
import sys

import pytest
from mechanics import ROOT

ABOVE = ("app.page", "app.session", "app.controls", "app.description", "app.components", "app.server")
# (folder or file, modules it must not import: they and everything below them).
RULES = [
    ("models", ("app", "panel", "panel_material_ui", "holoviews", "bokeh", "param", "tornado")),
    ("app/views", ("panel", "panel_material_ui", "app.state", *ABOVE)),
    ("app/scenes", ("panel", "panel_material_ui", *ABOVE)),
]
MODELS_MAY_IMPORT = {"numpy", "scipy", "numba", "models", *sys.stdlib_module_names}

SAMPLES = [
    ("import panel", "app/views/a.py", {"panel"}),
    ("import panel.widgets as w, math", "app/views/a.py", {"panel.widgets"}),
    ("from panel.widgets import Slider", "app/views/a.py", {"panel.widgets"}),
    ("from app import page", "app/views/a.py", {"app.page"}),
    ("from app.state import Number", "app/views/a.py", {"app.state"}),
    ("from .. import controls", "app/views/a.py", {"app.controls"}),
    ("from ..state import Number", "app/views/a.py", {"app.state"}),
    ("from ..page import Page", "app/views/deep/__init__.py", set()),  # this is app.views.page
    ("from ...page import Page", "app/views/deep/a.py", {"app.page"}),
    ("def f():\n    import panel_material_ui", "app/views/a.py", {"panel_material_ui"}),
    ("if TYPE_CHECKING:\n    from app.page import Page", "app/views/a.py", {"app.page"}),
    ("import importlib\nimportlib.import_module('app.page')", "app/views/a.py", {"app.page"}),
    ("from importlib import import_module\nimport_module('app.page')", "app/views/a.py", {"app.page"}),
    ("__import__('panel')", "app/views/a.py", {"panel"}),
    ("import panelling, app.pages\nfrom app import theme", "app/views/a.py", set()),  # names that only begin alike
    ("from .figure import Figure\nimport holoviews, numpy", "app/views/a.py", set()),
    ("'import panel'  # import panel", "app/views/a.py", set()),
    ("import app", "models/a.py", {"app"}),
    ("from app.views.figure import Figure", "models/a.py", {"app.views.figure"}),
    ("from bokeh import plotting", "models/a.py", {"bokeh"}),
    ("from .system import System", "models/a.py", set()),
    ("from app.page import Page", "app/scenes/a.py", {"app.page"}),
    ("from app.scenes.base import Scene", "app/scenes/a.py", set()),
]


def imported(source, path):
    """Every module that the source at this path may import, by its full name, as groups of one statement's names.

    `from app import page` may be the module app.page or a name of app: both stand in its group.
    """
    package = list(path.removesuffix(".py").split("/"))[:-1]
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield (alias.name,)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            module = ".".join([*base, *([node.module] if node.module else [])])
            for alias in node.names:
                yield (module, f"{module}.{alias.name}")
        elif isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.Constant):
            name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", None)
            if name in {"import_module", "__import__"}:
                yield (node.args[0].value,)


def violations(source, path, forbidden):
    """The forbidden modules it imports; of `from a import b` the shorter name that is forbidden."""
    found = set()
    for group in imported(source, path):
        hits = [name for name in group if any(name == bad or name.startswith(f"{bad}.") for bad in forbidden)]
        found.update(hits[:1])
    return found


def sources(folder):
    return {path.relative_to(ROOT).as_posix(): path.read_text() for path in sorted((ROOT / folder).rglob("*.py"))}


@pytest.mark.parametrize(("folder", "forbidden"), RULES, ids=[folder for folder, _ in RULES])
def test_no_import_points_back(folder, forbidden):
    files = sources(folder)
    assert len(files) > 1, "a rule about nothing"
    found = {path: violations(source, path, forbidden) for path, source in files.items()}
    assert {path: names for path, names in found.items() if names} == {}


def test_models_import_numpy_scipy_numba_the_standard_library_and_nothing_else():
    others = {
        (path, group[0])
        for path, source in sources("models").items()
        for group in imported(source, path)
        if group[0].split(".")[0] not in MODELS_MAY_IMPORT
    }
    assert others == set()


@pytest.mark.parametrize(("source", "path", "expected"), SAMPLES)
def test_the_table_catches_a_violation_and_nothing_but_a_violation(source, path, expected):
    (forbidden,) = (forbidden for folder, forbidden in RULES if path.startswith(f"{folder}/"))
    assert violations(source, path, forbidden) == expected


def test_forbidden_modules_of_the_app_exist_under_the_names_in_the_table():
    # A module that was renamed would leave its rule without teeth.
    own = {name for _, forbidden in RULES for name in forbidden if name.startswith("app")}
    for name in own:
        path = ROOT / name.replace(".", "/")
        assert path.is_dir() or path.with_suffix(".py").is_file(), name
