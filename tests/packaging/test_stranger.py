"""A package of someone else that brings a system and a scene, installed and shown."""

import os
import subprocess
import sys

import pytest
from PIL import Image

PROJECT = """
[build-system]
requires = ["hatchling"]
build-backend = "hatchling.build"
[project]
name = "stranger"
version = "1.0"
dependencies = ["hess-explorer"]
[project.entry-points."hess_explorer.scenes"]
oscillator = "stranger:SCENE"
[project.entry-points."hess_mechanics.systems"]
oscillator = "stranger:SYSTEM"
"""
MODULE = """
import hess_explorer as hess
from hess_mechanics import System

SYSTEM = System("oscillator", lambda y, p: (y[1], -p[0] * y[0]), "x v", {"k": 4.0}, (1.0, 0.0))
SCENE = hess.scene(SYSTEM, ["x v", "t x"])
"""
USE = """
import hess_explorer as hess
from hess_mechanics import systems
state = hess.state("oscillator", p_k=9.0)
print(state.pictures, "oscillator" in systems(), max(state.data("x-v").layer("orbit")["v"]))
"""


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """The environment of a process in which the package is installed."""
    source, target = tmp_path_factory.mktemp("source"), tmp_path_factory.mktemp("site")
    (source / "stranger").mkdir()
    (source / "stranger/__init__.py").write_text(MODULE)
    (source / "pyproject.toml").write_text(PROJECT)
    offline = ["--no-deps", "--no-build-isolation", "--no-index", "--quiet", "--disable-pip-version-check"]
    install = [sys.executable, "-m", "pip", "install", *offline, "--target", str(target), str(source)]
    subprocess.run(install, check=True, timeout=120)
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(target), *filter(None, [os.environ.get("PYTHONPATH")])])}


def test_its_scene_is_one_of_the_scenes_and_its_system_one_of_the_systems(environment):
    found = subprocess.run(
        [sys.executable, "-c", USE], env=environment, capture_output=True, text=True, check=True, timeout=120
    )
    pictures, velocity = found.stdout.split(" True ")
    assert pictures == "('x-v', 't-x')"
    # v = −3 sin 3t.
    assert float(velocity) == pytest.approx(3.0, abs=1e-3)


@pytest.mark.thorough
def test_the_page_shows_it(environment, tmp_path):
    picture = tmp_path / "page.png"
    shot = [
        sys.executable,
        "-m",
        "hess_explorer",
        "shot",
        "--state",
        "scene=oscillator",
        "--size",
        "900",
        "700",
        str(picture),
    ]
    subprocess.run(shot, env=environment, check=True, timeout=300)
    with Image.open(picture) as found:
        colours = {colour for _, colour in found.convert("RGB").getcolors(1_000_000)}
    # The blue of an orbit.
    assert (0x00, 0x72, 0xB2) in colours
