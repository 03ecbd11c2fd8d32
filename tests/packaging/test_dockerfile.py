"""The README names the image's port and address; the wheel and the lock file hold all that the image installs."""

import re
import subprocess
import sys
import tomllib
import zipfile

import pytest

from support.mechanics import ROOT


def test_the_readme_builds_and_runs_it_at_the_port_and_address_that_it_serves():
    """`docker build` of the root, and the page at the address that the server lets in."""
    readme, dockerfile = ((ROOT / name).read_text("utf-8") for name in ("README.md", "Dockerfile"))
    (port,) = re.findall(r"^EXPOSE (\d+)$", dockerfile, re.MULTILINE)
    (allowed,) = re.findall(r'"--allow-origin", "([^"]+)"', dockerfile)
    assert f"docker build -t hess-explorer . && docker run --rm -p {port}:{port} hess-explorer\n" in readme
    assert f"<http://{allowed}>" in readme
    assert allowed == f"localhost:{port}"


# The wheel


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    build = f"-m pip wheel -q --no-deps --no-build-isolation -w {folder} {ROOT}".split()
    subprocess.run([sys.executable, *build], check=True)
    (file,) = folder.glob("*.whl")
    with zipfile.ZipFile(file) as opened:
        return set(opened.namelist())


def test_the_wheel_is_typed_and_holds_all_that_the_page_needs_under_distinctive_names(wheel):
    tops = {name.split("/")[0] for name in wheel}
    assert {name for name in tops if not name.endswith(".dist-info")} == {"hess_explorer", "hess_mechanics"}
    assert {"hess_explorer/py.typed", "hess_mechanics/py.typed"} <= wheel
    words = ["git", "ls-files", "static", "app/hess_explorer", "models/hess_mechanics"]
    listed = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    places = {"static": "hess_explorer/static/", "app": "", "models": ""}
    parts = (name.partition("/") for name in listed)
    assert [name for top, _, name in parts if places[top] + name not in wheel] == []


# The lock file


def test_the_lock_file_has_every_dependency_with_a_hash_and_names_no_host():
    """The image installs only locked packages, so a missing one would fail at start."""
    lock = (ROOT / "app" / "requirements.lock").read_text()
    blocks = lock.replace("\\\n", " ").splitlines()
    assert len(blocks) > 20
    for block in blocks:
        assert "==" in block
        assert " --hash=sha256:" in block
        assert "://" not in block
    locked = {block.partition("==")[0] for block in blocks}
    asked = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["dependencies"]
    assert {re.match(r"[A-Za-z0-9-]+", one)[0].lower() for one in asked} <= locked
