"""Stores: resumed after every kind of end, read back, and refused if they belong to another sweep."""

import json
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import xarray as xr
import zarr

from hess_explorer.sweep import Interrupted, OtherSweep, StoreError, read
from hess_explorer.sweep import workers as working


@pytest.fixture(autouse=True)
def small_pieces(in_pieces):
    in_pieces(9)


def test_a_second_run_goes_on_where_the_first_ended(tori, tmp_path, computed, interrupt):
    store = tmp_path / "rho.zarr"
    in_memory = tori()
    pieces = len(computed)
    assert pieces > 8
    with pytest.raises(Interrupted, match=r"saved in .*rho\.zarr.*run the same sweep again to continue") as ended:
        tori(store=store, progress=interrupt(20))
    begun = len(computed) - pieces
    assert 0 < begun < pieces
    assert read(store).identical(ended.value.dataset)
    done = ended.value.dataset.status.values > 0
    assert 20 <= done.sum() < 108
    assert np.isnan(ended.value.dataset.rotation_number.values[~done]).all()
    seen = []
    found = tori(store=str(store), progress=seen.append)
    assert len(computed) == 2 * pieces
    assert seen[0].done == done.sum()
    assert found.identical(in_memory)
    with xr.open_zarr(store, consolidated=False) as opened:
        assert opened.identical(in_memory)


def test_damaged_pieces_are_computed_again(tori, tmp_path, computed):
    store = tmp_path / "rho.zarr"
    whole = tori(store=store)
    pieces = len(computed)
    files = [sorted(path for path in (store / name / "c").rglob("*") if path.is_file()) for name in ("trace", "status")]
    assert files[0] == []
    values, status = sorted((store / "rotation_number" / "c").rglob("*/*")), files[1]
    # Cut, away, one bit wrong; and a status that is cut.
    cut, away, flipped = values[-1], values[-2], values[-3]
    cut.write_bytes(cut.read_bytes()[:-7])
    with pytest.raises(StoreError, match="run the same sweep again"):
        read(store)
    away.unlink()
    content = bytearray(flipped.read_bytes())
    content[6] ^= 1
    flipped.write_bytes(bytes(content))
    status[0].write_bytes(status[0].read_bytes()[:5])
    # A file as it is after a kill during its write.
    (status[0].parent / "0.5e1f.partial").write_bytes(b"\x28\xb5")
    assert tori(store=store).identical(whole)
    assert len(computed) == pieces + 4


def test_a_piece_that_lacks_the_status_of_one_cell_is_computed_again(tori, tmp_path, computed):
    """As the writer of another program could leave it."""
    whole = tori(store=tmp_path / "rho.zarr")
    pieces = len(computed)
    zarr.open_group(tmp_path / "rho.zarr", mode="r+")["status"][3, 4] = 0
    assert tori(store=tmp_path / "rho.zarr").identical(whole)
    assert len(computed) == pieces + 1


def test_what_is_left_of_a_store_that_was_killed_when_it_was_made_does_no_harm(tori, tmp_path):
    (tmp_path / "rho.zarr.begun-0" / "h").mkdir(parents=True)
    (tmp_path / "rho.zarr.begun-0" / "zarr.json").write_text("{")
    (tmp_path / "rho.zarr").mkdir()
    assert (tori(store=tmp_path / "rho.zarr").status.values > 0).all()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["rho.zarr", "rho.zarr.begun-0"]


def test_runs_at_once_share_one_store_and_lose_nothing(tori, tmp_path):
    store = tmp_path / "rho.zarr"
    with ThreadPoolExecutor(3) as pool:
        found = list(pool.map(lambda _: tori(store=store), range(3)))
    in_memory = tori()
    assert all(one.identical(in_memory) for one in (*found, read(store)))
    assert [path.name for path in tmp_path.iterdir()] == ["rho.zarr"]


def test_a_store_is_plain_zarr_that_says_what_it_is(tori, tmp_path):
    tori(store=tmp_path / "rho.zarr", accuracy="draft")
    # Read without this package, and without Zarr.
    facts = json.loads((tmp_path / "rho.zarr" / "zarr.json").read_text())["attributes"]
    assert (facts["computation"], facts["numbers"], facts["accuracy"]) == ("circle-map", "rotation-number", "draft")
    assert json.loads(facts["parameters"]) == {"a": 0.5, "phi": 0.5}
    array = json.loads((tmp_path / "rho.zarr" / "rotation_number" / "zarr.json").read_text())
    assert array["dimension_names"] == ["h", "f"]
    assert array["attributes"]["units"] == "turns per return"


@pytest.mark.parametrize(
    "change, said",
    [
        ({"numbers": ["trace"]}, "has numbers = rotation-number, not trace"),
        ({"over": {"h": (-1.2, 2.0, 13), "f": (0.0, 1.2, 9)}}, "has other values of h"),
        ({"a": 0.25}, 'has parameters = {"a": 0.5, .* not {"a": 0.25, '),
    ],
)
def test_the_store_of_another_sweep_is_refused_and_not_touched(tori, tmp_path, interrupt, change, said):
    store = tmp_path / "rho.zarr"
    with pytest.raises(Interrupted):
        tori(store=store, progress=interrupt(1))
    files = {path: path.read_bytes() for path in store.rglob("*") if path.is_file()}
    with pytest.raises(OtherSweep, match=said):
        tori(store=store, **change)
    assert {path: path.read_bytes() for path in store.rglob("*") if path.is_file()} == files


def test_what_is_no_store_is_refused(tori, tmp_path):
    file = tmp_path / "letter"
    file.write_text("a letter")
    for call in (lambda place: tori(store=place), read):
        for place in (file, tmp_path):
            with pytest.raises(StoreError, match="does not contain a sweep: choose another folder"):
                call(place)
    assert file.read_text() == "a letter"
    with pytest.raises(StoreError, match="cannot be written"):
        tori(store=file / "below")


def test_a_disk_that_is_full_is_said_and_the_rest_is_kept(tori, tmp_path, monkeypatch):
    store, left = tmp_path / "rho.zarr", iter(range(3))
    real = working.compute

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    def until_full(piece):
        if next(left, None) is None:
            monkeypatch.setattr("zarr.storage._local._put", full)
        return real(piece)

    with monkeypatch.context() as now:
        now.setattr(working, "compute", until_full)
        with pytest.raises(StoreError, match=r"No space left on device.*run the same sweep again to continue"):
            tori(store=store)
    monkeypatch.undo()
    assert (read(store).status.values > 0).any()
    assert tori(store=store).identical(tori())
