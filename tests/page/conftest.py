"""The page that the browser tests of a process share."""

import pytest

from support.page import default_state, first_on_phone, one_phone, one_tab, page_with_websocket, tab_with_websocket

tab = pytest.fixture(scope="session")(one_tab)
explorer = pytest.fixture(default_state)
phone_tab = pytest.fixture(scope="session")(one_phone)
phone = pytest.fixture(first_on_phone)
websocket_tab = pytest.fixture(scope="session")(tab_with_websocket)
with_websocket = pytest.fixture(page_with_websocket)
