"""The page that the browser tests of a process share."""

import pytest

from support.page import HESS, PHONE, TOUCHED, Websocket, brought_on_phone, one_tab, own_tab

tab = pytest.fixture(scope="session")(one_tab)


@pytest.fixture
def scene():
    """Return the name of the scene in `explorer` and `phone`; a module overrides it, or a parameter of a test."""
    return HESS


@pytest.fixture
def explorer(tab, scene):
    """Return the page in the first state of its scene; at the end assert no errors and no requests to other hosts."""
    tab.fresh(scene)
    tab.assert_quiet()
    yield tab
    tab.assert_quiet()


@pytest.fixture(scope="session")
def phone_tab(browser, server):
    """Yield one phone tab for many tests, with the controls in their initial state."""
    with own_tab(browser, server, PHONE, **TOUCHED) as explorer:
        yield explorer.open()


@pytest.fixture
def phone(phone_tab, scene):
    """Return the page on a phone, as `explorer`."""
    phone_tab.assert_quiet()
    yield brought_on_phone(phone_tab, scene)
    phone_tab.assert_quiet()


@pytest.fixture(scope="session")
def websocket_tab(browser, server):
    """Yield (explorer, websocket): a tab for many tests, and the proxy between it and the server."""
    with own_tab(browser, server) as explorer:
        yield explorer, Websocket(explorer.page)


@pytest.fixture
def with_websocket(websocket_tab):
    """Return (explorer, websocket): the page in its default state, and the proxy between it and the server."""
    explorer, websocket = websocket_tab
    explorer.fresh()
    explorer.assert_quiet()
    yield explorer, websocket
    websocket.release()
    explorer.assert_quiet()
