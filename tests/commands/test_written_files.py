"""Files of the user on a full disk: an earlier one stays whole, a new one is not there, and a sentence says why."""

import subprocess
import sys
from pathlib import Path

from pytest import mark, raises

import hess_explorer as hess
from hess_explorer.__main__ import main
from support.command_line import typed
from support.disk import full_disk, names
from support.mechanics import ROOT

ORBIT = "orbit hess --duration 5 --samples 50 --format csv"
FULL = Path("/dev/full")


def command(words):
    def write(file):
        if main(typed(f"{words} {file}")):
            raise OSError

    return write


def saved(file):
    state = hess.state("suslov-hess", accuracy="draft")
    state.data("circle")
    state.save(file, "circle")


WRITERS = [
    (command(f"{ORBIT} --out"), "csv"),
    (command("export --state accuracy=draft --picture circle --format json --out"), "json"),
    (command("shot"), "png"),
    (saved, "csv"),
    (command("export --state accuracy=draft --format html --out"), "html"),
]


@mark.parametrize("write, suffix", WRITERS, ids=["orbit", "export", "shot", "save", "page"])
def test_an_earlier_file_stays_whole_on_a_full_disk(write, suffix, tmp_path, monkeypatch):
    monkeypatch.setattr("hess_explorer.headless.screenshot.screenshot", lambda *_, **__: bytes(10_000))
    file = tmp_path / f"file.{suffix}"
    file.write_bytes(b"earlier")
    with full_disk(), raises(OSError):
        write(file)
    assert (file.read_bytes(), names(tmp_path)) == (b"earlier", [file.name])
    write(file)
    assert file.stat().st_size > 1000
    assert names(tmp_path) == [file.name]


@mark.skipif(not FULL.exists(), reason="a device of Linux")
def test_a_standard_output_without_room_is_a_sentence():
    with FULL.open("wb") as full:
        ran = subprocess.run(
            [sys.executable, "-m", "hess_explorer", *typed(ORBIT)],
            cwd=ROOT,
            stdout=full,
            stderr=subprocess.PIPE,
            check=False,
        )
    assert ran.returncode == 2
    assert ran.stderr.splitlines()[-1] == (
        b"hess-explorer: Cannot write to standard output (No space left on device): use --out FILE."
    )
    assert b"Traceback" not in ran.stderr and b"Exception" not in ran.stderr
