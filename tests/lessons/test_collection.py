"""Several lessons of one's own: files, folders, and names that clash."""

import pytest

from hess_explorer.lessons import shipped
from hess_explorer.lessons.collection import MAX_LESSONS, read_paths
from hess_explorer.lessons.lesson import LessonError
from hess_explorer.page.opening import opening

LESSON = """---
title: {}
minutes: 1
---
## One
```step
state: "?scene=suslov-hess&h=1.5"
```
"""


def written(folder, *names):
    folder.mkdir(exist_ok=True)
    for name in names:
        (folder / name).write_text(LESSON.format(name), encoding="utf-8")
    return [folder / name for name in names]


def test_files_keep_their_order_and_a_folder_is_read_by_name(tmp_path):
    last, first = written(tmp_path, "last.md", "first.md")
    written(tmp_path / "folder", "b.md", "a.md", "notes.txt")
    found = read_paths([last, tmp_path / "folder", first])
    assert [lesson.name for lesson in found] == ["last", "a", "b", "first"]


def test_own_lessons_are_offered_first_and_the_first_opens(tmp_path):
    own = read_paths(written(tmp_path, "two.md", "one.md"))
    opened = opening("", own)
    assert [*opened.lessons] == ["two", "one", *shipped()]
    assert opened.reading is own[0]
    assert opening("lesson=one", own).reading is own[1]
    assert opening("scene=suslov-hess", own).reading is None


def test_lessons_that_cannot_be_told_apart_are_refused(tmp_path):
    one, other = written(tmp_path, "My lesson.md", "my-lesson.md")
    with pytest.raises(LessonError, match=r"my-lesson, is that of .*My lesson\.md: rename") as caught:
        read_paths([one, other])
    assert caught.value.file == str(other)
    taken = next(iter(shipped()))
    with pytest.raises(LessonError, match=f"{taken}, is that of a lesson of this package: rename"):
        read_paths(written(tmp_path / "other", f"{taken}.md"))


def test_a_folder_without_lessons_and_one_with_too_many_are_refused(tmp_path):
    with pytest.raises(LessonError, match="has no lesson"):
        read_paths([tmp_path])
    written(tmp_path, *(f"{number}.md" for number in range(MAX_LESSONS + 1)))
    with pytest.raises(LessonError, match=f"at most {MAX_LESSONS}"):
        read_paths([tmp_path])
