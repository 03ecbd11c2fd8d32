"""Cost of a change on the server: `python tests/benchmarks/benchmark_change.py`; `--beside FOLDER` for two checkouts.

In milliseconds of one core, never of the clock: the answer to one change of a scene's first number, what is filled in
behind it when nobody moves on, and an answer where 42 sessions ask without a pause, with all computed meanwhile.
Checkouts take turns, each in a process of its own, and the least of the rounds counts.
"""

import argparse
import json
import os
import random
import subprocess
import sys
import threading
import time
from pathlib import Path

SESSIONS, CHANGES = 42, 6


class Page:
    """Client side of a session."""

    def __init__(self, scene, seed=5):
        from hess_explorer.lessons import shipped
        from hess_explorer.page.session import Session
        from hess_explorer.protocol.parameters import Number

        self.size = 0
        self._spec = next(spec for spec in scene.specs if isinstance(spec, Number))
        self._chance = random.Random(seed)
        self.session = Session(scene, scene.defaults(), [], shipped())
        self._send(0, {})

    def _send(self, requested, values):
        from hess_explorer.protocol.messages import Request

        self.size = len(self.session.answer(Request(requested, values=values)).encode())
        self.session.start_tasks()

    def change(self):
        low, high = self._spec.softbounds
        value = self._spec.default + 0.05 * (high - low) * (self._chance.random() - 0.5)
        self._send(1, {self._spec.name: min(max(value, low), high)})

    def rest(self):
        while self.session.background.left:
            time.sleep(0.002)


def alone(scene, changes):
    """Return the cost of one change: (ms of its answer, ms of all its work, KB sent)."""
    page = Page(scene)
    for _ in range(2):
        page.change()
        page.rest()
    answers, size, begun = 0.0, 0, time.process_time()
    for _ in range(changes):
        before = time.thread_time()
        page.change()
        answers += time.thread_time() - before
        size += page.size
        page.rest()
    whole = time.process_time() - begun
    return 1e3 * answers / changes, 1e3 * whole / changes, size / changes / 1024


def crowd(scenes):
    """Return the milliseconds per answer when all sessions send their next request as soon as they are answered."""
    from hess_explorer.compute.scheduler import RequestQueue

    pages = [Page(scenes[i % len(scenes)]) for i in range(SESSIONS)]
    ended = threading.Semaphore(0)

    def ask(page, turns, left):
        page.change()
        if left > 1:
            turns.put(lambda: ask(page, turns, left - 1))
        else:
            ended.release()

    begun = time.process_time()
    for page in pages:
        turns = RequestQueue()
        turns.put(lambda page=page, turns=turns: ask(page, turns, CHANGES))
    for _ in pages:
        ended.acquire()
    spent = time.process_time() - begun
    for page in pages:
        page.session.background.stop()
    for page in pages:
        page.rest()
    return 1e3 * spent / (SESSIONS * CHANGES)


def measure(changes):
    """Print all measurements of this checkout as JSON."""
    from hess_explorer.scenes import scenes

    own = [scene for scene in scenes().values() if scene.origin is None]
    found = {scene.name: alone(scene, changes) for scene in own}
    found["42 sessions"] = (crowd(own), 0.0, 0.0)
    print(json.dumps(found))


def _run(folder, changes):
    path = os.pathsep.join(str(folder / part) for part in ("app", "models"))
    ended = subprocess.run(
        [sys.executable, __file__, "--here", str(changes)],
        env={**os.environ, "PYTHONPATH": path},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    return json.loads(ended.stdout.splitlines()[-1])


def main():
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--beside", type=Path, default=None, metavar="FOLDER", help="another checkout")
    parser.add_argument("--changes", type=int, default=6, help="of each scene in a round")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--here", type=int, default=0, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.here:
        return measure(options.here)
    folders = [Path(__file__).resolve().parents[2], *([options.beside] if options.beside else [])]
    rounds = [[_run(folder, options.changes) for folder in folders] for _ in range(options.rounds)]
    print("| | " + " | ".join(["answer, ms", "with all behind it, ms", "KB"] * len(folders)) + " |")
    print("|---" * (1 + 3 * len(folders)) + "|")
    for name in rounds[0][0]:
        least = [min(one[at][name][i] for one in rounds) for at in range(len(folders)) for i in range(3)]
        print(f"| {name} | " + " | ".join(f"{value:.1f}" for value in least) + " |")
    return None


if __name__ == "__main__":
    main()
