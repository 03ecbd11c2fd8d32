"""A package of someone else that brings a system and a scene, installed and used."""

import os
import subprocess
import sys

import pytest

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


def test_its_scene_is_one_of_the_scenes_and_its_system_one_of_the_systems(tmp_path):
    source, target = tmp_path / "source", tmp_path / "site"
    (source / "stranger").mkdir(parents=True)
    (source / "stranger/__init__.py").write_text(MODULE)
    (source / "pyproject.toml").write_text(PROJECT)
    offline = ["--no-deps", "--no-build-isolation", "--no-index", "--quiet", "--disable-pip-version-check"]
    install = [sys.executable, "-m", "pip", "install", *offline, "--target", str(target), str(source)]
    subprocess.run(install, check=True, timeout=120)
    path = os.pathsep.join([str(target), *filter(None, [os.environ.get("PYTHONPATH")])])
    environment = {**os.environ, "PYTHONPATH": path}
    found = subprocess.run(
        [sys.executable, "-c", USE], env=environment, capture_output=True, text=True, check=True, timeout=120
    )
    pictures, velocity = found.stdout.split(" True ")
    assert pictures == "('x-v', 't-x')"
    # v = −3 sin 3t.
    assert float(velocity) == pytest.approx(3.0, abs=1e-3)
