"""Stores: resumed after every kind of end, read back, and refused if they belong to another sweep."""

import json
import math
import shutil
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from hess_explorer.sweep import QUANTITIES, Interrupted, OtherSweep, StoreError, read, sweep, work
from hess_explorer.sweep import run as running
from hess_explorer.sweep import store as storing
from hess_explorer.sweep import workers as working
from hess_explorer.sweep.grid import SweepGrid

TORI = {"h": (-1.2, 2.0, 12), "f": (0.0, 1.2, 9)}
CYCLES = {"h": (0.5, 2.0, 6), "f": (0.0, 0.6, 4)}


def tori(**options):
    """The rotation numbers of `TORI`; the options are those of `sweep`."""
    return sweep("rotation-number", TORI, a=0.5, **options)


@pytest.fixture(autouse=True)
def small_pieces(monkeypatch):
    monkeypatch.setattr(running, "_cells_of_a_piece", lambda *_: 8)


@pytest.fixture
def computed(monkeypatch):
    """The pieces that have been computed since."""
    pieces = []
    monkeypatch.setattr(working, "compute", lambda piece: pieces.append(piece) or work.compute(piece))
    return pieces


def interrupted_after(cells):
    def report(now):
        if now.done >= cells:
            raise KeyboardInterrupt

    return report


def test_a_second_run_goes_on_where_the_first_ended(tmp_path, computed):
    name, over = "limit-cycles", CYCLES
    in_memory = sweep(name, over, a=0.5)
    pieces = len(computed)
    assert pieces > 2
    with pytest.raises(Interrupted, match=r"saved in .*rho\.zarr.*run the same sweep again to continue") as ended:
        sweep(name, over, a=0.5, store=tmp_path / "rho.zarr", progress=interrupted_after(9))
    begun = len(computed) - pieces
    assert 0 < begun < pieces
    assert read(tmp_path / "rho.zarr").identical(ended.value.dataset)
    assert (read(tmp_path / "rho.zarr").status.values == 0).any()
    seen = []
    found = sweep(name, over, a=0.5, store=tmp_path / "rho.zarr", progress=seen.append)
    assert len(computed) == 2 * pieces
    assert seen[0].done == np.count_nonzero(ended.value.dataset.status)
    assert found.identical(in_memory)
    assert found[name.replace("-", "_")].values.tobytes() == in_memory[name.replace("-", "_")].values.tobytes()
    # No piece is left.
    assert sweep(name, over, a=0.5, store=str(tmp_path / "rho.zarr")).identical(in_memory)
    assert len(computed) == 2 * pieces
    assert read(tmp_path / "rho.zarr").identical(in_memory)


def test_damaged_pieces_are_computed_again(tmp_path, computed, monkeypatch):
    monkeypatch.setattr(running, "_cells_of_a_piece", lambda *_: 4)
    monkeypatch.setattr("hess_explorer.sweep.store._MOST_BOXES", 2)
    store = tmp_path / "cycles.zarr"
    whole = sweep("limit-cycles", CYCLES, a=0.5, store=store)
    # Of the four files two have two pieces, and two have one.
    assert len(computed) == 6
    assert len([path for path in (store / "status" / "c").rglob("*") if path.is_file()]) == 4

    # The numbers of two pieces are cut, those of one are away; in one a bit of the errors is wrong, in one the status
    # is cut.
    cut = store / "limit_cycles" / "c" / "0" / "0" / "0"
    cut.write_bytes(cut.read_bytes()[:-7])
    with pytest.raises(StoreError, match="run the same sweep again"):
        read(store)
    (store / "limit_cycles" / "c" / "1" / "0" / "0").unlink()
    flipped = store / "error" / "c" / "0" / "1"
    content = bytearray(flipped.read_bytes())
    content[6] ^= 1
    flipped.write_bytes(bytes(content))
    status = store / "status" / "c" / "1" / "1"
    status.write_bytes(status.read_bytes()[:5])
    # Leftovers of a killed writer.
    (status.parent / "0.5e1f.partial").write_bytes(b"\x28\xb5")
    again = sweep("limit-cycles", CYCLES, a=0.5, store=store)
    assert again.identical(whole)
    assert len(computed) == 6 + 5


def test_what_is_left_of_a_store_that_was_killed_when_it_was_made_does_no_harm(tmp_path):
    (tmp_path / "rho.zarr.begun-0" / "h").mkdir(parents=True)
    (tmp_path / "rho.zarr.begun-0" / "zarr.json").write_text("{")
    (tmp_path / "rho.zarr").mkdir()
    found = tori(store=tmp_path / "rho.zarr")
    assert (found.status.values > 0).all()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["rho.zarr", "rho.zarr.begun-0"]


def test_a_hundred_thousand_pieces_are_few_files():
    what = QUANTITIES["rotation-number"]
    grid = SweepGrid.of(what, {"h": (0.0, 2.0, 4000), "f": (0.0, 1.0, 2500)}, {"a": 0.5}, 10**7)
    boxes = math.prod(grid.shape) // 100
    for parts in (1, 40):
        files = len(list(grid.boxes(storing._shards(grid, (10, 10), what.numbers, parts))))
        assert 4 * parts <= files <= boxes // 50
    # Large pieces are files of their own, and the parts of a small sweep have files of one piece.
    assert storing._shards(grid, (1000, 500), what.numbers, 1) == (1000, 500)
    assert storing._shards(grid, (2000, 625), what.numbers, 40) == (2000, 625)


def test_two_runs_at_once_lose_nothing(tmp_path):
    """Each piece is written by reading its file and writing it again."""
    in_memory = tori()
    what, store = QUANTITIES["rotation-number"], tmp_path / "rho.zarr"
    grid = SweepGrid.of(what, TORI, {"a": 0.5}, 10**4)
    boxes = list(grid.boxes((2, 1)))
    storing.Store.create(store, what, grid, "precise", (2, 1))

    def write(own):
        run = storing.Store(store, what, grid)
        for box in own:
            run.write(box, work.compute(work.Chunk(what.name, "precise", work.version(), grid.pieces(box), grid.fixed)))

    with ThreadPoolExecutor(2) as both:
        list(both.map(write, (boxes[::2], boxes[1::2])))
    assert read(store).identical(in_memory)


def test_a_store_is_plain_zarr_that_says_what_it_is(tmp_path):
    tori(store=tmp_path / "rho.zarr", level="draft")
    # Read without this package, and without Zarr.
    said = json.loads((tmp_path / "rho.zarr" / "zarr.json").read_text())
    assert said["zarr_format"] == 3
    assert said["attributes"]["quantity"] == "rotation-number"
    assert said["attributes"]["level"] == "draft"
    assert said["attributes"]["parameters"] == '{"a": 0.5}'
    assert said["attributes"]["version"]
    assert json.loads((tmp_path / "rho.zarr" / "status" / "zarr.json").read_text())["data_type"] == "uint8"
    array = json.loads((tmp_path / "rho.zarr" / "rotation_number" / "zarr.json").read_text())
    assert array["dimension_names"] == ["h", "f"]
    assert array["attributes"]["units"] == "turns per return"


@pytest.mark.parametrize(
    "change, said",
    [
        ({"quantity": "trace"}, "has quantity 'rotation-number', not 'trace'"),
        ({"over": {"h": (-1.2, 2.0, 13), "f": (0.0, 1.2, 9)}}, "has other values of h"),
        ({"a": 0.25}, "has a = 0.5, not 0.25"),
    ],
)
def test_the_store_of_another_sweep_is_refused_and_not_touched(tmp_path, change, said):
    store = tmp_path / "rho.zarr"
    with pytest.raises(Interrupted):
        tori(store=store, progress=interrupted_after(1))
    files = {path: path.read_bytes() for path in store.rglob("*") if path.is_file()}
    with pytest.raises(OtherSweep, match=said):
        sweep(**{"quantity": "rotation-number", "over": TORI, "a": 0.5, "store": store, **change})
    assert {path: path.read_bytes() for path in store.rglob("*") if path.is_file()} == files


def test_what_is_no_store_is_refused(tmp_path):
    (tmp_path / "file").write_text("a letter")
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "letter").write_text("a letter")
    for place in ("file", "folder"):
        with pytest.raises(StoreError, match="does not contain a sweep: choose another folder"):
            tori(store=tmp_path / place)
        said = {"folder": "does not contain a sweep: choose another folder", "file": "not contain a complete chart"}[
            place
        ]
        with pytest.raises(StoreError, match=said):
            read(tmp_path / place)
    assert (tmp_path / "folder" / "letter").read_text() == "a letter"
    with pytest.raises(StoreError, match="does not contain a sweep"):
        read(tmp_path / "nothing")
    with pytest.raises(StoreError, match="cannot be written"):
        tori(store=tmp_path / "file" / "below")


def test_a_store_that_loses_an_array_is_no_whole_store(tmp_path):
    tori(store=tmp_path / "rho.zarr")
    shutil.rmtree(tmp_path / "rho.zarr" / "status")
    with pytest.raises(StoreError, match="damaged or incomplete store"):
        tori(store=tmp_path / "rho.zarr")


def test_a_disk_that_is_full_is_said_and_the_rest_is_kept(tmp_path, monkeypatch):
    store, left = tmp_path / "rho.zarr", iter(range(3))
    real = work.compute

    def until_full(piece):
        if next(left, None) is None:
            monkeypatch.setattr("zarr.storage._local._put", full)
        return real(piece)

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(working, "compute", until_full)
    with pytest.raises(StoreError, match=r"No space left on device.*run the same sweep again to continue"):
        tori(store=store)
    monkeypatch.undo()
    monkeypatch.setattr(running, "_cells_of_a_piece", lambda *_: 8)
    assert (read(store).status.values > 0).any()
    assert tori(store=store).identical(tori())
