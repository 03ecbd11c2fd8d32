"""Fewer cases by default; all of them with `pytest --thorough`."""

from hypothesis import settings

_is_thorough, _factor = False, 1


def load_profile(*, is_thorough, factor=1):
    """Set the number of cases of this process.  pytest calls this before it imports any test module."""
    global _is_thorough, _factor
    _is_thorough, _factor = is_thorough, 10 * factor if is_thorough else factor
    # The same examples in every run, on every machine.
    settings.register_profile("hess", deadline=None, derandomize=True, database=None, max_examples=examples(10))
    settings.load_profile("hess")


def examples(n):
    """Return n times the factors of --thorough (10) and --examples: for `@settings(max_examples=examples(n))`."""
    return _factor * n


def sample(cases, n):
    """Return n of the cases, evenly spread over their order and always the same; all cases with --thorough."""
    cases = list(cases)
    if _is_thorough or len(cases) <= n:
        return cases
    return [cases[i * len(cases) // n] for i in range(n)]
