"""Requests that are refused, as a table."""

from pytest import mark, raises

from hess_mechanics.errors import InvalidParameter


def refused(*cases):
    """Return a test: each call raises an error with these words (a pattern), `InvalidParameter` if none is named."""

    @mark.parametrize(
        ("call", "words", "error"), [(call, words, *(error or [InvalidParameter])) for call, words, *error in cases]
    )
    def test(call, words, error):
        with raises(error, match=words):
            call()

    return test
