"""The image's steps in a clean root: `sudo python tests/clean_root.py`, where no engine is at hand to build it.

Each line of the Dockerfile is carried out by `chroot` in a system that `debootstrap` has just made: the rights of
users, missing libraries and a read-only root are as in a container.  What differs from the image: Python is that of the
Debian release, and processes and network are those of this machine.  Printed are the steps with their seconds, what the
health check says, and how the command ends.
"""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parent)]

from support.dockerfile import Image, instructions

PROJECT = Path(__file__).resolve().parents[1]
PACKAGES = "python3,python3-venv,ca-certificates"
PATH = "/opt/python/bin:/usr/local/bin:/usr/bin:/bin:/usr/sbin"
# Network access of this machine: pip's settings, certificates, host names.
REACHED = (
    "/etc/pip.conf",
    "/etc/resolv.conf",
    "/etc/hosts",
    *{value for name, value in os.environ.items() if name in ("PIP_CERT", "SSL_CERT_FILE")},
)


class ImageInRoot(Image):
    """A system of its own below `root`, entered by `chroot`."""

    @property
    def environment(self):
        """That of the image, with the Python that is made here."""
        # Debian's Python is for Debian's packages; that of the image, in which these are installed, has none of them.
        return {**super().environment, "PATH": PATH}

    def here(self, command):
        """Return the command line that runs a command in the root, as the image's user at this point."""
        return ["chroot", f"--userspec={self.user}", str(self.root), "env", f"--chdir={self.workdir}", *command]


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


@contextmanager
def mounted(image: ImageInRoot):
    """The root read-only but for /tmp and the kernels, with /proc, as compose.yaml asks for it."""
    root, kernels = image.root, image.root / image.set["NUMBA_CACHE_DIR"].lstrip("/")
    made = []
    try:
        for words in (
            ["--bind", root, root],
            ["-t", "tmpfs", "tmpfs", root / "tmp"],
            ["-t", "proc", "proc", root / "proc"],
            ["--bind", kernels, kernels],
        ):
            subprocess.run(["mount", *map(str, words)], check=True)
            made.append(words[-1])
        subprocess.run(["mount", "-o", "remount,ro,bind", str(root)], check=True)
        yield
    finally:
        for place in reversed(made):
            subprocess.run(["umount", "-l", str(place)], check=True)


def serve(image: ImageInRoot, seconds: float) -> None:
    """Run the command until its health check passes and it has printed its address; check how it exits."""
    begun = time.monotonic()

    def wait(until) -> None:
        while not until():
            if process.poll() is not None or time.monotonic() - begun > seconds:
                process.kill()
                raise RuntimeError(f"it does not serve\n{log.read_text()}")
            time.sleep(0.2)

    log = image.root.parent / "log"
    with (
        log.open("wb") as out,
        mounted(image),
        subprocess.Popen(
            image.here(image.cmd), env=image.environment, stdout=out, stderr=out, start_new_session=True
        ) as process,
    ):
        wait(
            lambda: (
                not subprocess.run(
                    image.here(image.health), env=image.environment, capture_output=True, check=False
                ).returncode
            )
        )
        print(f"healthy after {time.monotonic() - begun:.1f} s, user {Path(f'/proc/{process.pid}').stat().st_uid}")
        wait(lambda: "http" in log.read_text())
        print(f"ready after {time.monotonic() - begun:.1f} s", flush=True)
        ended = time.monotonic()
        process.send_signal(signal.Signals[image.stopsignal])
        print(
            f"{image.stopsignal}: code {process.wait(30)} after {time.monotonic() - ended:.1f} s; it said\n"
            f"{log.read_text()}"
        )


def main() -> None:
    """Make the root, carry out each line, serve."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--suite", default="trixie", help="the Debian release; its Python must be one that is allowed")
    parser.add_argument("--mirror", default="", help="where debootstrap finds it, if not at its own default")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder) / "root"
        debian(root, options.suite, options.mirror)
        for file in REACHED:
            if Path(file).is_file():
                (root / file.lstrip("/")).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(file, root / file.lstrip("/"))
        image = ImageInRoot(PROJECT, root)
        print(image.run(["python", "--version"]).strip(), flush=True)
        for instruction, rest in instructions((PROJECT / "Dockerfile").read_text("utf-8")):
            begun = time.monotonic()
            image.carry_out(instruction, rest)
            print(f"{time.monotonic() - begun:6.1f} s  {instruction} {rest[:90]}", flush=True)
        serve(image, 300.0)


if __name__ == "__main__":
    main()
