"""All request handlers are replaced, or the server does not start; what is logged of them."""

import logging

import pytest
from panel.io.server import DocHandler, WSHandler
from tornado.websocket import WebSocketClosedError

from hess_explorer.server import handlers
from hess_explorer.server.headers import GuardedDocument
from hess_explorer.server.serving import _is_news
from hess_explorer.server.websockets import PanelSocket


@pytest.mark.parametrize("missing", [DocHandler, WSHandler])
def test_a_server_whose_handlers_are_others_does_not_start_and_says_which(missing, monkeypatch):
    there = [(r"/?", DocHandler), (r"/ws", WSHandler)]
    monkeypatch.setattr(handlers, "per_app_patterns", [route for route in there if route[1] is not missing])
    with pytest.raises(handlers.HandlerMissing, match=f"no {missing.__name__} of Panel.*install the versions"):
        handlers.replace_handlers(["*"])


def test_both_handlers_are_replaced_and_may_be_again(monkeypatch):
    routes = [(r"/?", DocHandler), (r"/metadata", object), (r"/ws", WSHandler)]
    monkeypatch.setattr(handlers, "per_app_patterns", routes)
    for _ in range(2):
        handlers.replace_handlers(["*"])
        assert routes == [(r"/?", GuardedDocument), (r"/metadata", object), (r"/ws", PanelSocket)]


def test_a_page_that_was_closed_is_no_news_and_everything_else_is():
    for error, news in ((WebSocketClosedError(), False), (ValueError(), True), (None, True)):
        raised = None if error is None else (type(error), error, None)
        record = logging.LogRecord("tornado.application", logging.ERROR, __file__, 1, "said", None, raised)
        assert _is_news(record) is news
