"""The example in the help of every command that computes runs, and says the same as JSON and as CSV."""

import pytest

SYSTEMS = {
    "orbit": ("suslov", "hess", "euler-poisson", "ball"),
    "section": ("suslov", "euler-poisson", "ball"),
    "lyapunov": ("suslov", "euler-poisson", "ball"),
    **dict.fromkeys(("periodic", "orbit-diagram", "regime"), ("suslov", "quartic", "ball", "euler-poisson", "hess")),
}
ALONE = ("circle-map", "period", "scattering", "rotation-number", "basins", "cloud", "sweep")


def flat(value):
    """The fields of a row of CSV for a value of JSON."""
    if isinstance(value, list):
        return [field for part in value for field in flat(part)]
    return ["" if value is None else str(value)]


@pytest.mark.parametrize(
    "words",
    [[name] for name in ALONE] + [[name, system] for name, systems in SYSTEMS.items() for system in systems],
    ids=" ".join,
)
def test_the_example_of_the_help_says_the_same_as_json_and_as_csv(answer, example, as_table, words):
    found = example(*words)
    assert found[: len(words)] == words
    expected = answer(*found, "--format", "json")
    facts, header, rows = as_table(*found)
    series = {name: column for name, column in expected.items() if name not in facts}
    assert rows == [flat(list(row)) for row in zip(*series.values(), strict=True)]
    assert len(rows) > 0
    assert {len(row) for row in rows} == {len(header)}
    facts.pop("wall_ms", None)
    assert {name: expected[name] for name in facts} == facts
    assert {name for name in header if name in expected} <= {*series}
