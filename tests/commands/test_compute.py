"""The computations of the catalogue as commands: their numbers, their formats, and a sentence for every error."""

import math
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from pytest import approx

from hess_explorer.__main__ import main
from hess_explorer.commands import output
from hess_explorer.commands.compute import command_of
from hess_mechanics import SuslovBody, basins, return_map
from hess_mechanics.catalogue import catalogue, find
from hess_mechanics.errors import WorkLimit
from support.command_line import replaced, typed, without_patience
from support.mechanics import ROOT

CIRCLE_MAP = typed("circle-map --h 1.5 --f 0.6 --a 0.5 --accuracy reference")
SUSLOV = typed(
    "orbit suslov --I11 2 --I22 1 --I13 0.3 --I23 0.5 --b1 0.3 --b2 -.5 --b3 1 --w1 0.8 --w2 -0.4 --g1 0.3 --g2 0.2 "
    "--g3 0.93 --duration 10 --samples 3 --accuracy reference"
)
OWN = """
from hess_mechanics import System
SYSTEM = System("spring", lambda y, p: (y[1], -p[0] * y[0]), "x v", {"k": 4.0}, example=(1.0, 0.0))
"""


def example(what):
    return [*what.key.split(), *typed(command_of(what).example), "--accuracy", "draft"]


# Values


def test_what_double_precision_cannot_hold_is_null_with_a_note(answer, as_table):
    found = answer("circle-map", "--a", "500")
    assert found["numbers"]["trace"] is None
    assert found["numbers"]["log-multiplier"] < -2 * 709
    assert found["notes"] == [output._NULLS]
    facts, _, _ = as_table("circle-map", "--a", "500")
    assert facts["facts"]["trace"] is None
    # A torus without limit cycles.
    found = answer("circle-map", "--a", "0.1", "--h", "0.5", "--f", "0.3")
    assert found["numbers"]["stable"] is None
    assert found["notes"][0].startswith("stable: The circle map is elliptic")


@pytest.mark.parametrize("words", ["euler-poisson --a3 9", "suslov --I13 2"])
def test_moments_of_no_body_are_noted_and_computed(answer, words):
    (note,) = answer("orbit", *typed(words), "--duration", "1")["notes"]
    assert note.startswith("Not a rigid body")


# Every command


@pytest.mark.parametrize("key", ["circle-map", "spectrum hess", "megno ball", "tube suslov"])
def test_all_formats_say_the_same(key, answer, as_table, capsys, tmp_path):
    what, file = find(key), tmp_path / "out.nc"
    found, result = answer(*example(what)), what.compute(what.example, "draft")
    facts, header, rows = as_table(*example(what))
    frame = result.to_pandas()
    assert header == list(frame)
    assert rows == [["" if pd.isna(cell) else str(cell) for cell in row] for row in frame.itertuples(index=False)]
    for name, column in frame.replace([np.inf, -np.inf], np.nan).items():
        assert found[name] == [None if pd.isna(cell) else cell for cell in column.tolist()]
    assert found["parameters"] == what.values(what.example)
    assert list(found["numbers"]) == list(what.numbers)
    assert {name: found[name] for name in facts} == facts
    assert set(found["facts"]) == set(result.labels().facts)
    assert main([*example(what), "--format", "netcdf", "--out", str(file)]) == 0
    with xr.open_dataset(file, engine="scipy") as data:
        found = {one.attrs["long_name"]: one.values.tolist() for one in data.variables.values()}
        assert found == {name: one.values.tolist() for name, one in result.to_xarray().variables.items()}
        assert {"computation", "parameters", "numbers", "facts"} <= set(data.attrs)
    assert main(example(what)) == 0
    out = capsys.readouterr().out
    assert out.startswith(f"computation: {key}\n")
    assert f"numbers: {next(iter(what.numbers))} = " in out


def test_the_help_lists_commands_systems_options_and_numbers(capsys):
    def told(*words):
        with pytest.raises(SystemExit) as end:
            main([*words, "--help"])
        assert end.value.code == 0
        return capsys.readouterr().out

    assert told().count("\n  orbit ") == 1
    assert all(one.system in told(one.name) for one in catalogue().values())
    text = told("circle-map")
    for part in ("--phi PHI", "between -1000 and 1000", "rotation number (ρ, turns per return)", "eq0003"):
        assert part in text


def test_a_system_of_ones_own(answer, refusal, tmp_path):
    file = tmp_path / "own.py"
    file.write_text(OWN)
    found = answer("orbit", f"{file}:SYSTEM", "--k", "1", "--duration", repr(math.pi))
    assert found["computation"] == "orbit spring"
    assert found["numbers"]["x"] == approx(-1.0, abs=1e-9)
    assert "defines no System 'other'" in refusal("orbit", f"{file}:other")
    file.write_text(OWN.replace("k", "out"))
    assert "There are two options --out: rename one" in refusal("orbit", f"{file}:SYSTEM")


@pytest.mark.parametrize(
    "script",
    [
        "import hess_mechanics; assert not unused('numba', 'hess_mechanics.catalogue'); "
        "assert not hasattr(hess_mechanics, 'nothing'); from hess_mechanics import *; circle_map; proved_orbit",
        "parse(['serve']); assert not unused('numpy', 'hess_mechanics')",
        f"main({CIRCLE_MAP}); assert not unused('panel', 'bokeh', 'holoviews', 'playwright')",
        "import hess_explorer.server.serving; "
        "assert not unused('holoviews', 'matplotlib', 'panel_material_ui', 'hess_explorer.sweep')",
        "import hess_explorer as hess; hess.state('suslov-hess', accuracy='draft').data('circle'); assert not unused("
        "'panel', 'panel_material_ui', 'param', 'holoviews', 'matplotlib', 'tornado', 'pandas', 'xarray')",
    ],
    ids=["package", "serve", "circle-map", "server", "data"],
)
def test_nothing_is_imported_that_is_not_used(script):
    first = (
        "import sys; from hess_explorer.__main__ import main, parse; unused = lambda *names: {*names} & {*sys.modules}"
    )
    code = [sys.executable, "-c", f"{first}\n{script}"]
    done = subprocess.run(code, cwd=ROOT, capture_output=True, timeout=120, check=False)
    assert (done.returncode, without_patience(done.stderr)) == (0, b"")


# Errors


@pytest.mark.parametrize(
    "words, part",
    [
        (["orbti"], "There is no command 'orbti': did you mean orbit?"),
        (["xyzzy"], "There is no command 'xyzzy': choose from serve, shot, "),
        (["orbit", "sulsov"], "There is no system 'sulsov': did you mean suslov"),
        (["orbit"], "Add a system after orbit: ball, "),
        (replaced(CIRCLE_MAP, "--h", "nan"), "h is not a finite number"),
        (replaced(CIRCLE_MAP, "--h", "x"), "--h: invalid float value: 'x'"),
        (replaced(CIRCLE_MAP, "--f", "9"), "choose |f| ≤ 1.81"),
        (replaced(SUSLOV, "--I11", "0"), "I11 = 0 is not between 0.001 and 1000"),
        (replaced(SUSLOV, "--duration", "1e9"), "shorter"),
        # Abbreviated, this was `--help`.
        ([*SUSLOV, "--he", "1"], "unrecognized arguments: --he 1"),
    ],
)
def test_refusals(refusal, words, part):
    assert part in refusal(*words)


@pytest.mark.parametrize(
    "words, library, extra",
    [
        (["tube", "suslov"], "flint", "prove"),
        (["prove", "--a", "-0.5", "--h", "1.5", "--f", "1.7"], "flint", "prove"),
        ([*CIRCLE_MAP, "--format", "netcdf", "--out", "circle.nc"], "xarray", "data"),
    ],
)
def test_without_a_library_it_says_what_to_install(refusal, monkeypatch, words, library, extra):
    monkeypatch.setitem(sys.modules, library, None)
    assert f"pip install 'hess-explorer[{extra}]'" in refusal(*words)


def test_a_reader_that_has_seen_enough_is_no_error():
    words = [*replaced(SUSLOV, "--samples", "20000"), "--format", "csv"]
    with subprocess.Popen(
        [sys.executable, "-m", "hess_explorer", *words], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        assert process.stdout.readline().startswith(b"# computation")
        process.stdout.close()
        assert without_patience(process.stderr.read()) == b""
    assert process.returncode == 0


def test_basins_of_a_body_beyond_double_range_end():
    """No subinterval of a step was ever free of roots, so the search did not end; now it names what is too large."""
    body = SuslovBody(1.5, 1.07, 4.4e90, 0.0, 0.3, -0.5, 1.0)
    with pytest.raises(WorkLimit, match=r"the field exceeds the range of double precision in .*I13 \* ω1"):
        basins(return_map(body, E=0.68, plane=2, accuracy="draft"), cells=(8, 6))
