"""Links, messages and command lines of strangers: `python tests/manual/fuzz.py links 1000 --seed 1`.

Counted are what is raised, warned of or logged, answers that take more than 5 s, numbers that are none on a picture or
in a sentence, and “could not be computed”.  The same seed sends the same.
"""

import argparse
import math
import random
import sys
import time
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_explorer.page.description import describe
from hess_explorer.scenes import scenes
from hess_explorer.server.warm import compute
from manual.fuzzing import Findings, fuzz_commands, fuzz_links, fuzz_messages

WORKS = {"links": fuzz_links, "messages": fuzz_messages, "commands": fuzz_commands}


def main():
    """Run and print; the exit code is 1 where anything was found."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("work", choices=WORKS)
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=math.inf, help="of the processor, after which it ends")
    options = parser.parse_args()
    # As a server does while it is idle.
    for name in scenes():
        compute(name)
        describe(name)
    Findings.ends = options.seconds + time.process_time()
    Findings.tell = staticmethod(lambda found: print(found, flush=True))
    findings = WORKS[options.work](random.Random(options.seed), options.count)
    print(f"{options.work}, seed {options.seed}: {findings}")
    return int(findings.total > 0)


if __name__ == "__main__":
    sys.exit(main())
