"""The modules of the page in one file."""

import re

from hess_explorer.bundle import bundle

SERVER_ONLY = {"page/served.js", "page/websocket.js", "page/room.js", "controls/export.js"}


def test_a_file_has_nothing_that_talks_to_a_server():
    # A bundle exports each of its modules by its path.
    found = set(re.findall(r' as "([\w/]+\.js)"', bundle("offline/file.js").splitlines()[-1]))
    assert {"offline/file.js", "page/shell.js", "base/bus.js", "pictures/sphere.js", "controls/player.js"} <= found
    assert not SERVER_ONLY & found
