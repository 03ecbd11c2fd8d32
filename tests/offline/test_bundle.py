"""The modules of the page in one file."""

import re
import subprocess

import pytest

from hess_explorer.assets import STATIC
from hess_explorer.bundle import bundle

ENTRIES = ["page/served.js", "page/follow.js", "offline/file.js"]
SERVER_ONLY = {"page/served.js", "page/websocket.js", "page/room.js", "controls/export.js"}


def paths(entry):
    """Return the paths under which a bundle exports its modules."""
    return re.findall(r' as "([\w/]+\.js)"', bundle(entry).splitlines()[-1])


@pytest.mark.parametrize("entry", ENTRIES)
def test_nothing_is_imported_any_more_and_each_module_exports_all_that_it_did(entry):
    code = bundle(entry)
    assert not re.search(r"^\s*import\b", code, re.MULTILINE)
    # Exports stand at the end only; those of the modules have become results.
    assert [line.split()[0] for line in code.splitlines() if "export" in line.split()[:1]] == ["export", "export"]
    for path in paths(entry):
        source = (STATIC / path).read_text(encoding="utf-8")
        exported = re.findall(r"^export (?:async )?\w+\*? ([\w$]+)", source, re.MULTILINE)
        part = code.partition(f"// {path}\n")[2].partition("\n})()\n")[0]
        assert part.splitlines()[-1] == f"return {{ {', '.join(exported)} }}", path
        assert len(re.findall(r"^export\b", source, re.MULTILINE)) == len(exported), path


def test_each_module_comes_after_those_that_it_imports():
    written = re.findall(r"^// ([\w/]+\.js)$", bundle("page/served.js"), re.MULTILINE)
    assert written == paths("page/served.js")
    assert len(written) == len(set(written)) > 80
    assert written.index("base/bus.js") < written.index("page/client.js") < written.index("page/served.js")


def test_a_file_has_nothing_that_talks_to_a_server():
    found = {*paths("offline/file.js")}
    assert {"offline/file.js", "page/shell.js", "base/bus.js", "pictures/sphere.js", "controls/player.js"} <= found
    assert not SERVER_ONLY & found


def test_a_bundle_is_a_module_that_runs(tmp_path):
    # This one needs no browser.
    (tmp_path / "bundle.mjs").write_text(bundle("pictures/projection.js"), encoding="utf-8")
    script = """
import(process.argv[1]).then((all) => {
  const { "pictures/projection.js": own, ...others } = all
  const names = Object.keys(own)
  console.log(names.every((name) => others[name] === own[name]), names.length)
})"""
    told = subprocess.run(
        ["node", "-e", script, str(tmp_path / "bundle.mjs")], capture_output=True, text=True, check=True, timeout=60
    )
    assert told.stdout.split()[0] == "true"
    assert int(told.stdout.split()[1]) > 0
