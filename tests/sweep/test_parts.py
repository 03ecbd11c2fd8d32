"""Parts of a job array: each writes its own files into one store, and what is missing is known."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from hess_explorer.sweep import OtherSweep, StoreError, read, store_status, sweep, work
from hess_explorer.sweep import run as running
from hess_explorer.sweep import workers as working
from hess_mechanics.errors import InvalidParameter

TORI = {"h": (-1.2, 2.0, 12), "f": (0.0, 1.2, 9)}


def tori(**options):
    """The rotation numbers of `TORI`; the options are those of `sweep`."""
    return sweep("rotation-number", TORI, a=0.5, **options)


@pytest.fixture(autouse=True)
def small_pieces(monkeypatch):
    monkeypatch.setattr(running, "_cells_of_a_piece", lambda *_: 4)


def files_of(store):
    return {path.relative_to(store): path.read_bytes() for path in store.rglob("*") if path.is_file()}


def test_parts_write_their_own_files_and_are_together_the_whole(tmp_path):
    store, seen = tmp_path / "rho.zarr", []
    first = tori(store=store, part=(2, 3), progress=seen.append)
    assert seen[-1].done == seen[-1].cells == np.count_nonzero(first.status) < 60
    assert store_status(store).missing_parts == (1, 3)
    before = files_of(store)
    tori(store=store, part=(1, 3))
    after = files_of(store)
    # Nothing of the other part has been touched.
    assert {name: after[name] for name in before} == before
    assert len(after) > len(before)
    found = store_status(store)
    assert (found.cells, found.parts, found.missing_parts) == (108, 3, (3,))
    assert found.missing == np.count_nonzero(read(store).status == 0) > 0
    whole = tori(store=store, part=(3, 3))
    assert store_status(store).missing == 0
    assert whole.drop_attrs(deep=False).identical(tori().drop_attrs(deep=False))


def test_a_part_again_computes_nothing_and_a_run_without_part_the_rest(tmp_path, monkeypatch):
    pieces = []
    monkeypatch.setattr(working, "compute", lambda piece: pieces.append(piece) or work.compute(piece))
    store = tmp_path / "rho.zarr"
    tori(store=store, part=(1, 3))
    own = len(pieces)
    tori(store=store, part=(1, 3))
    assert len(pieces) == own
    assert (tori(store=store).status.values > 0).all()
    assert sum(np.prod([axis.size for axis in piece.axes.values()]) for piece in pieces) == 108


def test_parts_that_start_together_share_one_store(tmp_path):
    store = tmp_path / "rho.zarr"
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(lambda k: tori(store=store, part=(k, 4)), range(1, 5)))
    assert store_status(store).missing == 0
    assert np.array_equal(read(store).rotation_number, tori().rotation_number, equal_nan=True)
    assert [path.name for path in tmp_path.iterdir()] == ["rho.zarr"]


def test_what_is_wrong_is_one_sentence(tmp_path):
    with pytest.raises(InvalidParameter, match="The parts of a sweep need a store"):
        tori(part=(1, 2))
    for part in ((0, 3), (4, 3), (1, 10**6)):
        with pytest.raises(InvalidParameter, match="does not exist: count from 1, up to 10000 parts"):
            tori(part=part, store=tmp_path / "rho.zarr")
    tori(part=(1, 3), store=tmp_path / "rho.zarr")
    with pytest.raises(OtherSweep, match="was begun in 3 parts, not 4: use the same number, or no part"):
        tori(part=(1, 4), store=tmp_path / "rho.zarr")
    with pytest.raises(StoreError, match="does not contain a sweep"):
        store_status(tmp_path)


def test_a_damaged_file_is_missing(tmp_path):
    store = tmp_path / "rho.zarr"
    tori(store=store, part=(1, 1))
    file = next(path for path in (store / "status" / "c").rglob("*") if path.is_file())
    file.write_bytes(file.read_bytes()[:-3])
    assert store_status(store).missing > 0
    tori(store=store, part=(1, 1))
    assert store_status(store).missing == 0
