"""The cache of kernels: invalidation, ownership of its folder, and distinct kernels for distinct functions."""

import os
import re
import shutil
from pathlib import Path

from pytest import fixture, mark, raises

import hess_mechanics
from hess_mechanics import System
from hess_mechanics.numerics import jit
from hess_mechanics.numerics.jit import kernel, with_compile_notice
from hess_mechanics.numerics.patience import work_limit

PACKAGE = Path(hess_mechanics.__file__).parent
PARTS = ("numerics", "dynamics", "rigid_body", "suslov", "suslov_hess", "chaplygin_ball", "euler_poisson")


# ---- what makes it stale ----------------------------------------------------------------------------------------


@fixture(scope="module")
def copied(tmp_path_factory):
    """A copy of the package, and a folder where its hashes are kept."""
    package, memory = (tmp_path_factory.mktemp(name) / "hess_mechanics" for name in ("models", "cache"))
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    memory.mkdir(mode=0o700)
    return package, memory


@fixture
def hashes(copied, monkeypatch):
    """hashes() → those of the copied package, as a process that has just begun finds them."""
    monkeypatch.setattr(jit, "_PACKAGE", copied[0])
    monkeypatch.setattr(jit, "CACHE_FOLDER", copied[1])

    def forget():
        jit._sources.cache_clear()
        jit.source_hash.cache_clear()

    def found():
        forget()
        return {part: jit.source_hash(part) for part in PARTS} | {"all": jit.source_hash()}

    yield found
    forget()


@mark.parametrize(
    ("file", "change", "stale"),
    [
        ("suslov/equations.py", lambda text: f"# a comment\n\n{text}", set()),
        ("euler_poisson/andoyer.py", lambda text: f"{text}\n_NEW = 1\n", {"euler_poisson"}),
        (
            "suslov/equations.py",
            lambda text: f"{text}\n_NEW = 1\n",
            {"suslov", "suslov_hess", "chaplygin_ball", "euler_poisson"},
        ),
        ("numerics/taylor_kernels.py", lambda text: f"{text}\n_NEW = 1\n", set(PARTS)),
    ],
    ids=["comment", "subject", "imported", "numerics"],
)
def test_a_change_makes_stale_what_it_is_part_of_and_nothing_else(copied, hashes, file, change, stale):
    before = hashes()
    assert hashes() == before
    path = copied[0] / file
    text = path.read_text(encoding="utf-8")
    assert change(text) != text
    path.write_text(change(text), encoding="utf-8")
    after = hashes()
    # Restoring the text restores the hashes.
    path.write_text(text, encoding="utf-8")
    assert hashes() == before
    changed = {part for part in PARTS if before[part] != after[part]}
    assert changed == stale
    assert (before["all"] != after["all"]) == bool(changed)


def test_hashes_that_cannot_be_read_are_found_anew(copied, hashes):
    right = hashes()
    (file,) = copied[1].glob("sources-*.json")
    whole = file.read_text()
    for said in ("", "[]", '{"errors.py": [1, 2]}'):
        file.write_text(said)
        assert (hashes(), file.read_text()) == (right, whole)


# ---- whose folder it is -----------------------------------------------------------------------------------------


@fixture
def nowhere(tmp_path, monkeypatch):
    """No folder of the user's own can be written; the shared one is tmp_path/shared."""
    file, shared = tmp_path / "file", tmp_path / "shared"
    file.touch()
    shared.mkdir()
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(file))
    monkeypatch.setenv("HOME", str(file))
    monkeypatch.setattr(jit.tempfile, "tempdir", str(shared))
    return shared


def test_the_users_own_folder_comes_first_and_is_closed_to_others(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    for _ in range(2):
        folder = jit._cache_folder()
        assert folder == tmp_path / "hess-explorer"
        assert folder.stat().st_mode & 0o777 == 0o700
        folder.chmod(0o755)


def test_in_a_shared_folder_its_name_cannot_be_guessed_and_it_is_found_again(nowhere):
    folder = jit._cache_folder()
    assert folder.parent == nowhere
    assert re.fullmatch(r"hess-explorer-.{8,}", folder.name)
    assert folder.stat().st_mode & 0o777 == 0o700
    assert jit._cache_folder() == folder
    shutil.rmtree(folder)
    assert jit._cache_folder().name != folder.name


@mark.parametrize("mode", [0o777, 0o770, 0o702])
def test_a_folder_that_others_may_write_to_is_not_used(nowhere, mode):
    theirs = nowhere / "hess-explorer-0"
    theirs.mkdir()
    theirs.chmod(mode)
    assert jit._cache_folder() != theirs


def test_a_folder_of_somebody_else_or_a_link_to_one_is_not_used(nowhere, tmp_path, monkeypatch):
    theirs, elsewhere = nowhere / "hess-explorer-0", tmp_path / "elsewhere"
    theirs.mkdir(mode=0o700)
    assert jit._cache_folder() == theirs
    theirs.rename(elsewhere)
    theirs.symlink_to(elsewhere)
    assert jit._cache_folder() != theirs
    theirs.unlink()
    elsewhere.rename(theirs)
    own = os.getuid()
    monkeypatch.setattr(os, "getuid", lambda: own + 1)
    assert jit._cache_folder() != theirs


def test_without_any_folder_kernels_are_compiled_all_the_same(nowhere, monkeypatch):
    monkeypatch.setattr(jit.tempfile, "tempdir", str(nowhere / "missing"))
    assert jit._cache_folder() is None
    monkeypatch.setattr(jit, "CACHE_FOLDER", None)
    twice = jit.derived_kernel("twice", "def twice(x):\n    return factor() * x\n", __name__, factor=jit.inner(two))
    assert twice(1.5) == 3.0


def two():
    return 2.0


# ---- no kernel is taken for another -----------------------------------------------------------------------------


def test_systems_of_one_name_have_each_its_own_file(tmp_path, monkeypatch):
    """Numba tells kernels apart by their files."""
    monkeypatch.setattr(jit, "CACHE_FOLDER", tmp_path)
    # A field whose code was run without a name belongs to no module.
    nameless = eval("lambda y, p: (p[0] * y[0] + 1,)", {})
    assert nameless.__module__ is None
    for field in (lambda y, p: (p[0] * y[0],), lambda y, p: (-p[0] * y[0],), nameless):
        assert callable(System("same", field, "x", {"a": 0.5}).orbit)
    assert len(list(tmp_path.rglob("same_orbit-*.py"))) == 3


class Cancelled(Exception):
    """Raised by a request that nobody waits for."""


def test_a_long_compilation_is_announced_and_ends_with_its_request(caplog, tmp_path, monkeypatch):
    monkeypatch.setattr(jit, "CACHE_FOLDER", tmp_path)
    double = with_compile_notice(kernel(lambda x: 2.0 * x), "a double", 100.0)
    asked = []

    def check():
        asked.append(caplog.text)
        if len(asked) == 5:
            raise Cancelled

    with raises(Cancelled), work_limit(check, lambda seconds: None):
        double(1.0)
    assert "Compiling a double takes about 100 s" in asked[0]
    caplog.clear()
    assert double(1.0) == 2.0
    # Now it is compiled, and a kernel that takes no longer than most says nothing.
    caplog.clear()
    assert (double(3.0), with_compile_notice(kernel(lambda x: 3.0 * x), "a triple", 10.0)(1.0)) == (6.0, 3.0)
    assert caplog.text == ""
