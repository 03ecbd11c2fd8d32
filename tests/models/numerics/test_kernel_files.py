"""Damaged kernel files: kernels that cannot be read or written are recompiled, and results stay right."""

import json
import os
import pickle
import signal
import subprocess
import sys
from pathlib import Path

from numba.core.caching import FunctionCache
from numba.core.errors import TypingError
from pytest import fixture, mark, raises

import hess_mechanics
from hess_mechanics.numerics import jit

SOURCE = "def twice(x):\n    return 2 * x + 1\n"


@fixture
def kernels(tmp_path, monkeypatch):
    """made() → the kernel as a process that has just begun has it; its files are below `made.folder`."""
    folder = tmp_path / "hess-explorer"
    folder.mkdir(mode=0o700)
    monkeypatch.setattr(jit, "CACHE_FOLDER", folder)

    def made():
        return jit.derived_kernel("twice", SOURCE, __name__)

    made.folder = folder
    return made


def read(kernel):
    """Return the number of kernels loaded from disk."""
    return sum(kernel.stats.cache_hits.values())


def filled(kernels):
    """Compile the kernel, and check that the next process reads it."""
    first = kernels()
    assert (first(1.5), read(first)) == (4.0, 0)
    again = kernels()
    assert (again(1.5), read(again)) == (4.0, 1)


@mark.parametrize("which", ["*.nbi", "*.nbc"])
@mark.parametrize(
    "damage",
    [
        lambda whole: b"",
        lambda whole: whole[: int(0.99 * len(whole))],
        lambda whole: b"no pickle at all",
        lambda whole: pickle.dumps("0.0.1") + b"of another Numba",
        lambda whole: pickle.dumps(jit.numba.__version__) + pickle.dumps(17),
    ],
    ids=["empty", "cut short", "foreign", "another Numba", "another content"],
)
def test_a_file_cut_short_or_foreign_is_replaced(kernels, which, damage):
    filled(kernels)
    (file,) = kernels.folder.rglob(which)
    file.write_bytes(damage(file.read_bytes()))
    # The next process compiles it again, and the one after that reads it.
    for read_from_disk in (0, 1):
        mended = kernels()
        assert (mended(1.5), read(mended)) == (4.0, read_from_disk)


def test_a_kernel_for_other_arguments_is_never_called(kernels):
    """Two processes that write at once can leave this behind: the index names the other's file."""
    kernel = kernels()
    assert (kernel(1.5), kernel(10**15)) == (4.0, 2 * 10**15 + 1)
    one, other = kernels.folder.rglob("*.nbc")
    one_bytes, other_bytes = one.read_bytes(), other.read_bytes()
    one.write_bytes(other_bytes)
    other.write_bytes(one_bytes)
    mixed = kernels()
    assert (mixed(1.5), mixed(10**15), read(mixed)) == (4.0, 2 * 10**15 + 1, 0)


def test_a_derived_source_cut_short_is_written_again(kernels):
    filled(kernels)
    (source,) = kernels.folder.rglob("twice-*.py")
    source.write_text(SOURCE[:10])
    mended = kernels()
    # The machine code of the same source stays valid, as it must for two processes that write it one after the other.
    assert (mended(1.5), read(mended)) == (4.0, 1)
    assert source.read_text() == SOURCE


def test_a_kernel_is_locked_until_its_code_is_stored_or_its_compilation_fails(kernels, monkeypatch):
    locked, store = [], FunctionCache.save_overload

    def watched(files, signature, data):
        locked.append(files._lock.is_locked)
        store(files, signature, data)

    monkeypatch.setattr(FunctionCache, "save_overload", watched)
    kernel = kernels()
    kernel(1.5)
    assert (locked, kernel._cache._lock.is_locked) == ([True], False)
    with raises(TypingError):
        kernel("text")
    assert (locked, kernel._cache._lock.is_locked) == ([True], False)


# ---- processes --------------------------------------------------------------------------------------------------


PLUS = "def plus(x):\n    return {} + x\n"
MANY = """
import json, resource, sys

if sys.argv[1] == "full":
    # As on a full disk: not one byte can be written to a file.
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))

from hess_mechanics.numerics import jit

right = read = 0
for n in range(int(sys.argv[2])):
    kernel = jit.derived_kernel("plus", sys.argv[4].format(n), "__main__")
    # Another order of types in each process: both write into the same index.
    for value in (1.5, 2)[:: int(sys.argv[3])]:
        right += kernel(value) == n + value
    read += sum(kernel.stats.cache_hits.values())
    print(json.dumps([right, read]), flush=True)
"""


def process(folder, *arguments):
    models = Path(hess_mechanics.__file__).parents[1]
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(folder), "PYTHONPATH": str(models)}
    return subprocess.Popen(
        [sys.executable, "-W", "error", "-c", MANY, *map(str, arguments), PLUS],
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


def ended(running):
    """Assert that a process exits successfully without warnings; return its last line of output."""
    out, err = running.communicate(timeout=300)
    assert (running.returncode, err) == (0, "")
    return json.loads(out.splitlines()[-1])


def test_one_of_two_that_compile_into_one_folder_is_killed_and_the_other_and_the_next_are_right(tmp_path):
    killed, other = process(tmp_path, "", 2000, 1), process(tmp_path, "", 2, -1)
    with killed, other:
        # In the middle: it has written one kernel, and is about to write the next.
        assert json.loads(killed.stdout.readline())[0] == 2
        killed.send_signal(signal.SIGKILL)
        killed.communicate()
        assert killed.returncode == -signal.SIGKILL
        assert ended(other)[0] == 4
    with process(tmp_path, "", 2, 1) as after:
        assert ended(after)[0] == 4


def test_two_that_begin_together_compile_each_kernel_once(kernels, tmp_path):
    # If both wrote the source of a kernel, the older machine code would be stale.
    for n in range(2):
        jit.derived_kernel("plus", PLUS.format(n), "__main__")
    with process(tmp_path, "", 2, 1) as one, process(tmp_path, "", 2, 1) as other:
        found = [ended(one), ended(other)]
    assert [right for right, _ in found] == [4, 4]
    # Of two times four, one compiled each and the other read it.
    assert sum(read for _, read in found) == 4


def test_on_a_full_disk_kernels_are_compiled_all_the_same_and_nothing_is_left_behind(tmp_path):
    with process(tmp_path, "full", 2, 1) as running:
        assert ended(running) == [4, 0]
    assert [file for file in tmp_path.rglob("*") if file.is_file()] == []
