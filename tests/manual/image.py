"""The image built and run by a container engine: `sudo python tests/manual/image.py`, with Podman or Docker.

Run is one replica as compose.yaml asks for it; printed are its user, what it may write, its health, the page's answer,
its memory, and how it ends.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path
from urllib.request import urlopen

import yaml

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_explorer.headless.screenshot import free_port

PROJECT = Path(__file__).resolve().parents[2]
NAME = "localhost/hess-explorer:try"
RIGHTS = """id; grep -E 'CapEff|NoNewPrivs' /proc/1/status
for f in /x ~/x /tmp/x $NUMBA_CACHE_DIR/x; do touch $f 2>/dev/null && echo $f written || echo $f refused; done"""


def run(*words, check=True):
    """Return what the engine says."""
    # Podman's own format has no health check; Docker does not know the option --format, and ignores the variable.
    settings = {**os.environ, "BUILDAH_FORMAT": "docker"}
    return subprocess.run(words, env=settings, stdout=subprocess.PIPE, text=True, check=check).stdout.strip()


def wanted(port):
    """The options of a replica of compose.yaml, as an engine takes them; and its command, at this port."""
    service = yaml.safe_load((PROJECT / "app/deployment/compose.yaml").read_text("utf-8"))["services"]["explorer-1"]
    kernels = next(one for one in service["volumes"] if one.startswith("kernels:"))
    command = [re.sub(r"^\$\{.*\}$", f"localhost:{port}", word) for word in service["command"]]
    command[command.index("--port") + 1] = str(port)
    return [
        *(["--read-only"] if service["read_only"] else []),
        "--volume",
        f"try-{kernels}",
        *(f"--tmpfs={one}" for one in service["tmpfs"]),
        *(f"--cap-drop={one}" for one in service["cap_drop"]),
        *(f"--security-opt={one.removesuffix(':true')}" for one in service["security_opt"]),
        f"--memory={service['mem_limit']}",
        f"--pids-limit={service['pids_limit']}",
        f"--stop-timeout={service['stop_grace_period'].removesuffix('s')}",
        "--network=host",
        NAME,
        *command,
    ]


def visit(engine, options):
    """Run a replica, look at it, end it."""
    port, begun = free_port(), time.monotonic()
    one = run(*engine, "run", "--detach", *options, *wanted(port))
    try:
        while "http" not in run(*engine, "logs", one):
            if time.monotonic() - begun > 300.0 or not json.loads(run(*engine, "inspect", one))[0]["State"]["Running"]:
                raise RuntimeError("it does not serve")
            time.sleep(0.2)
        print(f"ready after {time.monotonic() - begun:.1f} s")
        image = json.loads(run(*engine, "image", "inspect", NAME))[0]
        # Podman has it beside what Docker has it in.
        test = (image.get("Healthcheck") or image["Config"]["Healthcheck"])["Test"]
        run(*engine, "exec", one, *(word.replace("5006", str(port)) for word in test[1:]))
        print("healthy", run(*engine, "exec", one, "sh", "-c", RIGHTS), sep="\n")
        with urlopen(f"http://localhost:{port}/") as page:
            print(f"the page: {page.status}, {len(page.read())} bytes")
        print(run(*engine, "stats", "--no-stream", "--format", "memory {{.MemUsage}}, processes {{.PIDs}}", one))
        begun = time.monotonic()
        run(*engine, "stop", one)
        code = json.loads(run(*engine, "inspect", one))[0]["State"]["ExitCode"]
        print(f"stopped after {time.monotonic() - begun:.1f} s, code {code}; it said\n{run(*engine, 'logs', one)}")
    finally:
        run(*engine, "rm", "--force", one)
        run(*engine, "volume", "rm", "--force", "try-kernels", check=False)


def main():
    """Build, run, end."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--engine", default="podman", help="its command, with options of its own (default: podman)")
    parser.add_argument(
        "--build", action="append", default=[], help="one more option for `build`, such as --build=--from=…"
    )
    parser.add_argument("--run", action="append", default=[], help="one more for `run`, such as --run=--ulimit=host")
    given = parser.parse_args()
    engine, begun = given.engine.split(), time.monotonic()
    run(*engine, "build", "--tag", NAME, *given.build, str(PROJECT))
    size = int(json.loads(run(*engine, "image", "inspect", NAME))[0]["Size"]) / 1e6
    print(f"built in {time.monotonic() - begun:.0f} s, {size:.0f} MB", flush=True)
    visit(engine, given.run)


if __name__ == "__main__":
    main()
