"""The faults of `tests/mutate.py` can be seeded: sources change, and a fault that cannot be seeded tests nothing."""

from mutate import ROOT, faults, not_found_once


def test_every_fault_can_be_seeded():
    assert len(faults([])) >= 58
    assert not_found_once(faults([])) == []


def test_every_fault_changes_something_and_names_tests_that_are_there():
    for fault in faults([]):
        assert fault.old != fault.new, fault.name
        files = [word for word in fault.tests if word.startswith("tests/")]
        assert files, fault.name
        assert all((ROOT / file).exists() for file in files), fault.name
