"""Log messages of the server."""

import logging

import pytest
from tornado.websocket import WebSocketClosedError

from hess_explorer.server.serving import _is_news


@pytest.mark.parametrize(
    ("error", "news"), [(WebSocketClosedError(), False), (ValueError("what was not expected"), True), (None, True)]
)
def test_a_page_that_was_closed_is_no_news_and_everything_else_is(error, news):
    raised = None if error is None else (type(error), error, None)
    record = logging.LogRecord("tornado.application", logging.ERROR, __file__, 1, "said", None, raised)
    assert _is_news(record) is news
