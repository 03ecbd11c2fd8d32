"""The command line in this process: `answer` returns the output, `refusal` the message of a rejected request."""

import pytest

from hess_explorer.__main__ import main
from hess_explorer.commands import output
from support.command_line import strict_json, table


@pytest.fixture(autouse=True)
def no_patience(monkeypatch):
    """Suppress progress messages: the first run compiles kernels and takes longer."""
    monkeypatch.setattr(output, "LONG", 1e6)


@pytest.fixture
def answer(capsys):
    """Return the answer as JSON."""

    def call(*words):
        assert main([*words, "--format", "json"]) == 0
        out, err = capsys.readouterr()
        assert err == ""
        return strict_json(out)

    return call


@pytest.fixture
def as_table(capsys):
    """Return facts, header and rows of the answer as CSV."""

    def call(*words):
        assert main([*words, "--format", "csv"]) == 0
        return table(capsys.readouterr().out)

    return call


@pytest.fixture
def refusal(capsys):
    """Return the single error message of a rejected request."""

    def call(*words):
        assert main(words) == 2
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith("hess-explorer: ")
        assert err.count("\n") == 1
        assert err.endswith((".\n", "?\n"))
        return err

    return call
