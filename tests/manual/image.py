"""The image built and run by a container engine: `sudo python tests/manual/image.py`, with Podman or Docker.

Built is the Dockerfile as it stands.  Where its base image cannot be had, `--debian trixie` makes one by `debootstrap`,
whose Python is that of the Debian release.  Run is one replica as compose.yaml asks for it; printed are its user, what
it may write, its health, the page's answer, its memory, and how it ends.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path
from urllib.request import urlopen

import yaml

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from support.serving import free_port

PROJECT = Path(__file__).resolve().parents[2]
NAME, BASE = "localhost/hess-explorer:try", "localhost/debian-python:try"
PACKAGES = "python3,python3-venv,ca-certificates"
PATH = "/opt/python/bin:/usr/local/bin:/usr/bin:/bin:/usr/sbin"
# Network access of this machine: pip's settings, certificates, host names.
REACHED = (
    "/etc/pip.conf",
    "/etc/resolv.conf",
    "/etc/hosts",
    *{value for name, value in os.environ.items() if name in ("PIP_CERT", "SSL_CERT_FILE")},
)


class Engine:
    """The words of an engine, such as `podman --runtime runc`."""

    def __init__(self, words: str) -> None:
        self.words = words.split()

    def __call__(self, *words: str, fails: bool = False) -> str:
        # Podman's own format has no health check; Docker does not know the option --format, and ignores the variable.
        done = subprocess.run(
            [*self.words, *words],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "BUILDAH_FORMAT": "docker"},
        )
        if done.returncode and not fails:
            raise RuntimeError(f"{' '.join(words)}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
        return done.stdout.strip()

    def made_of(self, root: Path) -> None:
        """The base image of a system below `root`."""
        with subprocess.Popen(["tar", "-C", str(root), "-c", "."], stdout=subprocess.PIPE) as packed:
            subprocess.run(
                [*self.words, "import", "--change", f"ENV PATH={PATH}", "-", BASE],
                stdin=packed.stdout,
                stdout=subprocess.DEVNULL,
                check=True,
            )


def debian(root: Path, suite: str, mirror: str = "") -> None:
    """A system of this release below `root`, with a Python below /opt that has no packages of Debian's."""
    begun = time.monotonic()
    subprocess.run(
        ["debootstrap", "--variant=minbase", f"--include={PACKAGES}", suite, str(root), *filter(None, [mirror])],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    subprocess.run(["chroot", str(root), "python3", "-m", "venv", "/opt/python"], check=True)
    print(f"debootstrap {suite}: {time.monotonic() - begun:.0f} s", flush=True)


def wanted(port: int) -> list[str]:
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


def _tried(engine: Engine, options: list[str]) -> None:
    port = free_port()
    begun = time.monotonic()
    one = engine("run", "--detach", *options, *wanted(port))
    try:
        while "http" not in engine("logs", one):
            if time.monotonic() - begun > 300.0 or not json.loads(engine("inspect", one))[0]["State"]["Running"]:
                raise RuntimeError(f"it does not serve\n{engine('logs', one)}")
            time.sleep(0.2)
        print(f"ready after {time.monotonic() - begun:.1f} s")
        image = json.loads(engine("image", "inspect", NAME))[0]
        # Podman has it beside what Docker has it in.
        test = (image.get("Healthcheck") or image["Config"]["Healthcheck"])["Test"]
        engine("exec", one, *(word.replace("5006", str(port)) for word in test[1:]))
        print("healthy")
        print(
            engine(
                "exec",
                one,
                "sh",
                "-c",
                "id; grep -E 'CapEff|NoNewPrivs' /proc/1/status; for f in /x ~/x /tmp/x "
                "$NUMBA_CACHE_DIR/x; do touch $f 2>/dev/null && echo $f written || echo $f refused; done",
            )
        )
        with urlopen(f"http://localhost:{port}/") as page:
            print(f"the page: {page.status}, {len(page.read())} bytes")
        print(engine("stats", "--no-stream", "--format", "memory {{.MemUsage}}, processes {{.PIDs}}", one))
        begun = time.monotonic()
        engine("stop", one)
        print(
            f"stopped after {time.monotonic() - begun:.1f} s, code "
            f"{json.loads(engine('inspect', one))[0]['State']['ExitCode']}; it said\n{engine('logs', one)}"
        )
    finally:
        engine("rm", "--force", one)
        engine("volume", "rm", "--force", "try-kernels", fails=True)


def main() -> None:
    """Build, run, end."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--engine", default="podman", help="its command, with options of its own (default: podman)")
    parser.add_argument("--debian", metavar="SUITE", help="make the base image of this Debian release")
    parser.add_argument(
        "--option", action="append", default=[], help="one more for `run`, such as --option=--ulimit=host"
    )
    options = parser.parse_args()
    engine = Engine(options.engine)
    with ExitStack() as stack:
        build = ["build", "--tag", NAME]
        if options.debian:
            root = Path(stack.enter_context(tempfile.TemporaryDirectory())) / "root"
            debian(root, options.debian)
            engine.made_of(root)
            build += [
                "--from",
                BASE,
                *(
                    f"--volume={file}:{file}:ro"
                    for file in REACHED
                    if Path(file).is_file() and not file.endswith(("/resolv.conf", "/hosts"))
                ),
            ]
        begun = time.monotonic()
        engine(*build, str(PROJECT))
        print(
            f"built in {time.monotonic() - begun:.0f} s, "
            f"{int(json.loads(engine('image', 'inspect', NAME))[0]['Size']) / 1e6:.0f} MB",
            flush=True,
        )
        _tried(engine, options.option)


if __name__ == "__main__":
    main()
