"""One server for the tests of a file."""

import pytest

from support.serving import served


@pytest.fixture(scope="module")
def base():
    with served() as url:
        yield url
