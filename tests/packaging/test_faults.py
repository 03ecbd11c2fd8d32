"""Each fault of `tests/manual/mutate.py` can be seeded: one whose source has changed tests nothing."""

from manual.mutate import ROOT, faults, not_found_once


def test_every_fault_can_be_seeded_and_names_tests_that_are_there():
    assert not_found_once(faults([])) == []
    for fault in faults([]):
        files = [word for word in fault.tests if word.startswith("tests/")]
        assert files, fault.name
        assert all((ROOT / file).exists() for file in files), fault.name
