"""The image can be built and serves: every line of the Dockerfile is executed without Docker."""

import re
import signal
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

from hess_explorer.headless.browser import wait_ready
from hess_explorer.headless.screenshot import free_port, wait_alive
from support.dockerfile import ImageInVenv, instructions
from support.kernels import copy_kernels
from support.processes import interruptible

ROOT = Path(__file__).resolve().parents[2]
thorough = pytest.mark.thorough  # the image takes half a minute


@pytest.fixture(scope="module")
def image(tmp_path_factory):
    made = ImageInVenv(ROOT, tmp_path_factory.mktemp("image") / "root")
    for instruction, rest in instructions((ROOT / "Dockerfile").read_text()):
        made.carry_out(instruction, rest)
        if instruction == "ENV":
            copy_kernels(made.set["NUMBA_CACHE_DIR"], made.site / "hess_mechanics")
    return made


def test_the_readme_builds_and_runs_it_at_the_port_and_address_that_it_serves():
    """`docker build` of the root, and the page at the address that the server lets in."""
    readme, dockerfile = ((ROOT / name).read_text("utf-8") for name in ("README.md", "Dockerfile"))
    (port,) = re.findall(r"^EXPOSE (\d+)$", dockerfile, re.MULTILINE)
    (allowed,) = re.findall(r'"--allow-origin", "([^"]+)"', dockerfile)
    assert f"docker build -t hess-explorer . && docker run --rm -p {port}:{port} hess-explorer\n" in readme
    assert f"<http://{allowed}>" in readme
    assert allowed == f"localhost:{port}"


@thorough
def test_neither_the_folder_nor_its_files_shadow_the_packages(image):
    for name in ("models", "app", "static"):
        (image.at(image.workdir) / f"{name}.py").write_text("raise SystemExit('the wrong module')\n")
    image.run(["python", "-c", "import hess_mechanics, hess_explorer.page.page"])
    assert image.run(["python", "-m", "hess_explorer", "--version"]).startswith("hess-explorer ")


@thorough
def test_its_user_has_the_kernels_compiled(image):
    assert image.user != "root"
    (mark,) = Path(image.set["NUMBA_CACHE_DIR"]).glob("hess-explorer/complete-*")
    assert list(mark.parent.rglob("*.nbc"))


@thorough
def test_the_command_serves_the_page_is_healthy_and_ends(image, browser, tmp_path):
    port = free_port()

    def here(command):
        return [word.replace(str(image.port), str(port)) for word in command]

    log = tmp_path / "log"
    with (
        log.open("wb") as out,
        interruptible(),
        subprocess.Popen(
            here(image.cmd), cwd=image.at(image.workdir), env=image.environment, stdout=out, stderr=subprocess.STDOUT
        ) as process,
    ):
        try:
            wait_alive(process, port, log)
            image.run(here(image.health))
            context = browser.new_context(viewport={"width": 1280, "height": 720})
            failed = []
            context.on("response", lambda response: failed.append(response.url) if response.status >= 400 else None)
            context.on("weberror", lambda error: failed.append(str(error.error)))
            page = context.new_page()
            page.goto(f"http://localhost:{port}/")
            wait_ready(page)
            assert page.title().startswith("Hess Explorer · ")
            context.close()
            assert failed == []
        finally:
            process.send_signal(signal.Signals[image.stopsignal])
        # Docker waits ten seconds before it kills.
        assert process.wait(10) == 0
    assert "Traceback" not in log.read_text()


# The wheel


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    build = [
        sys.executable,
        "-m",
        "pip",
        "wheel",
        "-q",
        "--no-deps",
        "--no-build-isolation",
        "-w",
        str(folder),
        str(ROOT),
    ]
    subprocess.run(build, check=True)
    (file,) = folder.glob("*.whl")
    with zipfile.ZipFile(file) as opened:
        return {one.filename: one.compress_size for one in opened.infolist()}


def test_the_wheel_holds_distinctive_names_only(wheel):
    tops = {name.split("/")[0] for name in wheel}
    assert {name for name in tops if not name.endswith(".dist-info")} == {"hess_explorer", "hess_mechanics"}
    assert len(tops) == 3


def test_the_wheel_is_typed_and_holds_all_that_the_page_needs(wheel):
    assert {"hess_explorer/py.typed", "hess_mechanics/py.typed"} <= set(wheel)
    listed = subprocess.run(
        ["git", "ls-files", "static", "app/hess_explorer", "models/hess_mechanics"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split("\n")
    places = {"static/": "hess_explorer/static/", "app/": "", "models/": ""}
    for name in filter(None, listed):
        folder = name.split("/")[0] + "/"
        assert places[folder] + name.removeprefix(folder) in wheel, f"{name} is not in the wheel"


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
