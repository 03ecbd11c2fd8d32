"""Metadata and extras: complete, and every requirement of an extra can be imported where it is installed."""

import importlib
import re
import tomllib
from importlib import metadata

import pytest
import yaml
from packaging.requirements import Requirement

from support.mechanics import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
EXTRAS = PROJECT["optional-dependencies"]
IMPORTED_AS = {
    "import-linter": "importlinter",
    "pillow": "PIL",
    "pytest-xdist": "xdist",
    "python-flint": "flint",
    "zxing-cpp": "zxingcpp",
}
"""Modules whose name is not that of the distribution."""
FOR_USE = {"export", "data", "notebook", "shot", "prove", "sweep", "docs"}
"""Extras of users; the others are for developers, or compare with other programs."""


def requirements(extra):
    """Return the requirements of an extra without those of this package."""
    return [one for one in map(Requirement, EXTRAS[extra]) if one.name != "hess-explorer"]


def test_all_has_every_extra_for_use_but_the_documentation():
    (everything,) = map(Requirement, EXTRAS["all"])
    assert everything.name == PROJECT["name"]
    assert everything.extras == FOR_USE - {"docs"}
    assert set(EXTRAS) == FOR_USE | {"all", "bench", "test", "lint"}


EACH = {(one.name, str(one.specifier)): one for extra in EXTRAS for one in requirements(extra)}


@pytest.mark.parametrize("of", EACH.values(), ids=str)
def test_each_requirement_of_an_extra_is_imported_where_it_is_installed(of):
    try:
        installed = metadata.version(of.name)
    except metadata.PackageNotFoundError:
        pytest.skip(f"{of.name} is not installed")
    assert of.specifier.contains(installed)
    importlib.import_module(IMPORTED_AS.get(of.name, of.name.replace("-", "_")))


def test_binder_installs_extras_that_exist():
    environment = yaml.safe_load((ROOT / ".binder/environment.yml").read_text(encoding="utf-8"))
    *conda, pip = environment["dependencies"]
    assert "pip" in conda
    (own,) = pip["pip"]
    named = re.fullmatch(r"\.\.\[([a-z,]+)\]", own)
    assert {"notebook", "sweep"} <= set(named[1].split(",")) <= FOR_USE
    (python,) = (one for one in conda if one.startswith("python"))
    assert f"Programming Language :: Python :: {python.partition('=')[2]}" in PROJECT["classifiers"]


def test_the_description_of_the_package_needs_no_repository():
    text = (ROOT / PROJECT["readme"]).read_text(encoding="utf-8")
    links = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'(?:src|href)="([^"]+)"', text)
    assert links
    assert all(link.startswith("https://") for link in links)
    assert "![" not in text
