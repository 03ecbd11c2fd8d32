"""The oldest and the newest allowed versions: `python tests/manual/versions.py 3.11 3.12 3.13 3.14` prints a table.

For each version of Python that is here, and for the oldest and the newest versions of what the explorer is built on,
uv makes a virtual environment and installs this folder; a server is started there, each scene opened over the websocket
and changed, one command and one export carried out.
"""

import argparse
import asyncio
import json
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from importlib import metadata
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from support.measured import line, table

ROOT = Path(__file__).resolve().parents[2]
SHOWN = ("panel", "bokeh", "holoviews", "numba", "numpy")
AGES = {"oldest": "lowest-direct", "newest": "highest"}


# ---- in the environment -----------------------------------------------------------------------------------------


async def _scenes(base):
    """Return the number of scenes that open and answer."""
    from hess_explorer.protocol.specs import NumberSpec
    from hess_explorer.scenes import scenes
    from support.visitor import Visitor

    for name, scene in scenes().items():
        visitor = await Visitor.open(base, f"scene={name}&accuracy=draft", timeout=900.0)
        spec = next(spec for spec in scene.specs if isinstance(spec, NumberSpec))
        state = await visitor.ask(timeout=900.0, values={spec.name: spec.default + spec.step})
        assert state["scene"] == name
        assert "could not be computed" not in json.dumps(state["tree"]), name
        await visitor.leave()
    return len(scenes())


def smoke():
    """Run everything once; any failure ends the run."""
    from hess_explorer.headless.screenshot import server_process

    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "log"
        with server_process(log) as (_, base):
            opened = asyncio.run(_scenes(base))
        # Warnings of a library are no errors of the explorer.
        assert "Traceback" not in log.read_text(), log.read_text()
    for words in (
        ["circle-map", "--h", "1.5", "--f", "0.6", "--a", "0.5", "--phi", "1"],
        ["export", "--state", "h=1.2&f=0.3", "--picture", "circle", "--format", "csv"],
    ):
        done = subprocess.run([sys.executable, "-m", "hess_explorer", *words], capture_output=True, check=True)
        assert done.stdout
    print(json.dumps({"scenes": opened, **{name: metadata.version(name) for name in SHOWN}}))


# ---- from outside -----------------------------------------------------------------------------------------------


def tried(python, age, folder):
    """Return the versions and the result of a trial."""
    uv = shutil.which("uv") or str(Path(sys.executable).with_name("uv"))
    here = str(folder / "venv" / "bin" / "python")
    # Neither the caller's packages nor kernels of others.
    settings = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "VIRTUAL_ENV")}
    settings |= {"NUMBA_CACHE_DIR": str(folder / "kernels")}
    install = shlex.split(f"pip install -q --only-binary :all: --no-binary hess-explorer --resolution {AGES[age]}")
    steps = {
        "there is no such Python here": [uv, "venv", "-q", "--no-config", "--python", python, str(folder / "venv")],
        "cannot be installed": [uv, *install, "--python", here, str(ROOT)],
        "failed": [here, str(Path(__file__)), "--smoke"],
    }
    begun = time.monotonic()
    for why, step in steps.items():
        done = subprocess.run(step, cwd=folder, env=settings, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            print(f"--- {python}, {age}: {done.stderr[-3000:]}", file=sys.stderr)
            return {}, f"{why}: {done.stderr.strip().splitlines()[-1][:160]}"
    found = json.loads(done.stdout.splitlines()[-1])
    return found, f"{found['scenes']} scenes, a command and an export in {time.monotonic() - begun:.0f} s"


def main():
    """Try all pairs, or run as one of the trials."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("pythons", nargs="*", metavar="PYTHON", help="versions, or paths of interpreters")
    parser.add_argument("--smoke", action="store_true", help="try this environment")
    options = parser.parse_args()
    if options.smoke:
        return smoke()
    print(table(["Python", "", *SHOWN, ""], []), flush=True)
    for python in options.pythons:
        for age in AGES:
            with tempfile.TemporaryDirectory() as folder:
                found, said = tried(python, age, Path(folder))
            shown = python if "/" not in python else Path(python).resolve().name.removeprefix("python")
            print(line([shown, age, *(found.get(name, "") for name in SHOWN), said]), flush=True)
    return None


if __name__ == "__main__":
    main()
