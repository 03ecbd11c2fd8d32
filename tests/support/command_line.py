"""The command line: as a process of its own, and its outputs read strictly."""

import csv
import json
import shlex
import subprocess
import sys

from hess_explorer.commands.output import PATIENCE
from support.mechanics import ROOT


def no_constant(name):
    raise AssertionError(f"{name} is not JSON")


def strict_json(text):
    return json.loads(text, parse_constant=no_constant)


def typed(line):
    """The words of a command line, as a shell passes them."""
    return shlex.split(line)


def run(*words, timeout=120, env=None):
    command = [sys.executable, "-m", "hess_explorer", *words]
    return subprocess.run(command, cwd=ROOT, env=env, capture_output=True, timeout=timeout, check=False)


def without_patience(said):
    """Return the output of a process (bytes) without progress messages, which appear while kernels compile."""
    return said.replace(f"{PATIENCE}\n".encode(), b"")


def replaced(words, option, value):
    at = words.index(option)
    return [*words[: at + 1], value, *words[at + 2 :]]


def table(text):
    lines = text.splitlines()
    facts = dict(line.removeprefix("# ").split(": ", 1) for line in lines if line.startswith("#"))
    header, *rows = csv.reader(line for line in lines if not line.startswith("#"))
    return {key: strict_json(value) for key, value in facts.items()}, header, rows
