"""The command line within this process: `answer` reads what it prints, `refusal` the sentence of a refused request."""

from __future__ import annotations

import pytest

from hess_explorer.__main__ import main
from support.command_line import strict_json


@pytest.fixture
def answer(capsys):
    def call(*words):
        assert main(words) == 0
        out, err = capsys.readouterr()
        assert err == ""
        return strict_json(out)

    return call


@pytest.fixture
def refusal(capsys):
    """The one sentence of a refused request."""

    def call(*words):
        assert main(words) == 2
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith("hess-explorer: ")
        assert err.count("\n") == 1
        assert err.endswith(".\n")
        return err

    return call
