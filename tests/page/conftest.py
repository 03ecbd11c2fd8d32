"""The page that the browser tests of a process share."""

import pytest

from support.page import default_state, first_on_phone, one_phone, one_tab, page_on_a_line, tab_on_a_line

tab = pytest.fixture(scope="session")(one_tab)
explorer = pytest.fixture(default_state)
phone_tab = pytest.fixture(scope="session")(one_phone)
phone = pytest.fixture(first_on_phone)
line_tab = pytest.fixture(scope="session")(tab_on_a_line)
on_a_line = pytest.fixture(page_on_a_line)
