"""A written file is whole or not there."""

import os
import threading

from pytest import mark, raises

from hess_mechanics.numerics.files import write_atomically
from support.disk import full_disk, names


def test_an_earlier_file_stays_until_the_new_one_is_complete(tmp_path):
    file = tmp_path / "file"
    write_atomically(file, b"earlier")
    with full_disk(), raises(OSError):
        write_atomically(file, bytes(10_000))
    assert (file.read_bytes(), names(tmp_path)) == (b"earlier", ["file"])
    write_atomically(file, bytes(10_000))
    assert (file.read_bytes(), names(tmp_path)) == (bytes(10_000), ["file"])


def test_without_an_earlier_one_there_is_no_file(tmp_path):
    with full_disk(), raises(OSError):
        write_atomically(tmp_path / "file", bytes(10_000))
    assert names(tmp_path) == []
    with raises(FileNotFoundError, match=r"'nowhere/file'$"):
        write_atomically("nowhere/file", b"")


@mark.skipif(os.name != "posix", reason="links, modes and pipes of POSIX")
def test_a_link_the_mode_of_a_file_and_a_pipe_stay_what_they_are(tmp_path):
    file, link, pipe = (tmp_path / name for name in ("file", "link", "pipe"))
    file.touch(mode=0o604)
    link.symlink_to("file")
    write_atomically(link, b"new")
    assert link.is_symlink()
    assert (file.read_bytes(), file.stat().st_mode & 0o777) == (b"new", 0o604)
    os.mkfifo(pipe)
    writer = threading.Thread(target=write_atomically, args=(pipe, b"new"))
    writer.start()
    assert pipe.read_bytes() == b"new"
    writer.join()
    assert pipe.is_fifo()
    before = os.umask(0o027)
    try:
        write_atomically(tmp_path / "fresh", b"")
    finally:
        os.umask(before)
    assert (tmp_path / "fresh").stat().st_mode & 0o777 == 0o640
