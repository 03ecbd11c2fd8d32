"""Unit tests of the page's JavaScript modules that need no browser, with Node's test runner."""

import shutil
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).parent


def test_the_modules_that_need_no_browser():
    node = shutil.which("node")
    if node is None:
        pytest.fail("These tests need Node.js 20.19 or later: install it (Debian: apt-get install nodejs).")
    files = sorted(str(file) for file in HERE.glob("*.test.mjs"))
    run = subprocess.run(
        [node, "--disable-warning=MODULE_TYPELESS_PACKAGE_JSON", "--test", *files],
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=120,
        check=False,
    )
    assert run.returncode == 0, run.stdout + run.stderr
