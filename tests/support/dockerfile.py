"""Execute a Dockerfile without Docker: a folder serves as the image's root.

Every instruction is read from the file, so what runs is what it says.
"""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path


def instructions(text):
    """[(INSTRUCTION, rest)] of a Dockerfile, continued lines joined, comments left out."""
    lines = "\n".join(line for line in text.splitlines() if not line.lstrip().startswith("#"))
    joined = re.sub(r"\\\n\s*", "", lines)
    return [tuple(line.split(maxsplit=1)) for line in joined.splitlines() if line.strip()]


class ImageInVenv:
    """The image of `project`/Dockerfile below the folder `root`, whose Python is a virtual environment.

    Not covered: the base image, other users' rights, and the libraries the base image lacks.
    """

    def __init__(self, project, root):
        self.project, self.root = project, root
        (root / "root").mkdir(parents=True)
        subprocess.run([sys.executable, "-m", "venv", root / "venv"], check=True)
        # The libraries come from the environment of the tests; what the Dockerfile installs goes before them.
        self.site = Path(sysconfig.get_path("purelib", vars={"base": str(root / "venv")}))
        (self.site / "libraries.pth").write_text(f"{sysconfig.get_path('purelib')}\n{sysconfig.get_path('platlib')}\n")
        self.user, self.workdir, self.set = "root", "/", {}
        # Docker sends it unless another one is named.
        self.stopsignal = "SIGTERM"
        self.cmd = self.health = None

    def at(self, path):
        """Return the local path of a path in the image."""
        return self.root / path.lstrip("/")

    def mapped(self, text):
        """Replace the image's absolute paths by the local ones."""
        return re.sub(r"(?<![\w.:/])/(?=(src|home|root)\b)", lambda _: f"{self.root}/", text)

    @property
    def environment(self):
        """Return an environment without the caller's variables, in particular without PYTHONPATH and home."""
        home = "/root" if self.user == "root" else f"/home/{self.user}"
        reached = {name: value for name, value in os.environ.items() if name.startswith(("PIP_", "SSL_"))}
        return {
            **reached,
            "PATH": f"{self.root / 'venv' / 'bin'}:/usr/local/bin:/usr/bin:/bin",
            "LANG": "C.UTF-8",
            "HOME": self.mapped(home),
            **self.set,
        }

    def run(self, command):
        """Run a command as the image would at this point.  Fails with all the output if the command does."""
        done = subprocess.run(
            command,
            cwd=self.at(self.workdir),
            env=self.environment,
            text=True,
            timeout=900,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            check=False,
        )
        assert done.returncode == 0, f"{command}\n{done.stdout}"
        return done.stdout

    def carry_out(self, instruction, rest):
        """Execute one instruction.  Unknown instructions fail: add them to this class."""
        getattr(self, f"_{instruction.lower()}")(rest)

    def _from(self, rest):
        assert re.fullmatch(r"python:3\.\d+-slim", rest)

    def _copy(self, rest):
        *sources, target = shlex.split(rest)
        for source in sources:
            assert not self._is_ignored(source), f".dockerignore leaves out {source}"
            into = self.at(target) / source.rsplit("/", 1)[-1] if target.endswith("/") else self.at(target)
            if (self.project / source).is_dir():
                shutil.copytree(
                    self.project / source, into, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__")
                )
            else:
                into.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(self.project / source, into)

    def _is_ignored(self, source):
        """Return whether a .dockerignore of the form used here (`*`, then exceptions) excludes a path."""
        rules = (self.project / ".dockerignore").read_text().splitlines()
        assert "*" in rules
        return not any(source == rule[1:] or source.startswith(f"{rule[1:]}/") for rule in rules if rule[:1] == "!")

    def _run(self, rest):
        useradd = re.fullmatch(r"useradd --create-home (\w+)", rest)
        if useradd:
            self.at(f"/home/{useradd[1]}").mkdir(parents=True)
        else:
            self.run(["sh", "-c", self.mapped(rest)])

    def _user(self, rest):
        assert self.at(f"/home/{rest}").is_dir(), f"no such user: {rest}"
        self.user = rest

    def _workdir(self, rest):
        self.workdir = rest
        self.at(rest).mkdir(parents=True, exist_ok=True)

    def _env(self, rest):
        name, value = rest.split("=", 1)
        self.set[name] = self.mapped(value)

    def _expose(self, rest):
        self.port = int(rest)

    def _healthcheck(self, rest):
        self.health = json.loads(rest.partition("CMD ")[2])

    def _stopsignal(self, rest):
        self.stopsignal = rest

    def _cmd(self, rest):
        self.cmd = json.loads(rest)
