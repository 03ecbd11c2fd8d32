"""Fewer cases by default; all of them with `pytest --thorough`."""

from hypothesis import settings

MORE = 10
"""Examples of hypothesis with --thorough, relative to a default run."""

_is_thorough = False


def load_profile(*, is_thorough):
    """Set the number of cases of this process.  pytest calls this before it imports any test module."""
    global _is_thorough  # noqa: PLW0603
    _is_thorough = is_thorough
    # The same examples in every run, on every machine.
    settings.register_profile("hess", deadline=None, derandomize=True, database=None, max_examples=examples(10))
    settings.load_profile("hess")


def examples(n):
    """Return n, or ten times as many with --thorough: for `@settings(max_examples=examples(n))`."""
    return MORE * n if _is_thorough else n


def sample(cases, n):
    """Return n of the cases, evenly spread over their order and always the same; all cases with --thorough."""
    cases = list(cases)
    if _is_thorough or len(cases) <= n:
        return cases
    return [cases[i * len(cases) // n] for i in range(n)]
