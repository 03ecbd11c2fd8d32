"""Several lessons of one's own: files, folders, and names that clash."""

import re

import pytest

from hess_explorer.lessons import package_lessons
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
    found, mistakes = read_paths([last, tmp_path / "folder", first])
    assert not mistakes
    assert [lesson.name for lesson in found] == ["last", "a", "b", "first"]


def test_own_lessons_are_offered_first_and_the_first_opens(tmp_path):
    own, _ = read_paths(written(tmp_path, "two.md", "one.md"))
    opened = opening("", own)
    assert [*opened.lessons] == ["two", "one", *package_lessons()]
    assert opened.reading is own[0]
    assert opening("lesson=one", own).reading is own[1]
    assert opening("scene=suslov-hess", own).reading is None


def test_files_with_mistakes_and_names_that_are_taken_are_left_out_and_the_others_are_read(tmp_path):
    taken = next(iter(package_lessons()))
    files = written(tmp_path, "My lesson.md", "my-lesson.md", f"{taken}.md", "wrong.md", "last.md")
    files[3].write_text("")
    lessons, mistakes = read_paths(files)
    assert [lesson.name for lesson in lessons] == ["my-lesson", "last"]
    clash, shipped_name, *wrong = map(str, mistakes)
    assert re.match(r"my-lesson\.md, line 1: .*my-lesson, is that of .*My lesson\.md: rename", clash)
    assert f"{taken}, is that of a lesson of this package: rename" in shipped_name
    # The front matter and the steps are missing.
    assert len(wrong) == 2
    assert all(one.startswith("wrong.md, line 1") for one in wrong)


def test_a_folder_without_lessons_and_one_with_too_many_are_refused(tmp_path):
    with pytest.raises(LessonError, match="has no lesson"):
        read_paths([tmp_path])
    written(tmp_path, *(f"{number}.md" for number in range(MAX_LESSONS + 1)))
    with pytest.raises(LessonError, match=f"at most {MAX_LESSONS}"):
        read_paths([tmp_path])
