"""Generated source with unrolled loops.  Not for users.

LLVM keeps numbers in registers and packs them into vectors if each of them has a name.  Numba's loops over tuples
prevent this, so the few loops that matter are unrolled here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from types import CodeType, FunctionType
from typing import Any

from hess_mechanics.numerics.jit import part

__all__ = ["compile_source", "evaluation", "items"]


_LONGEST = 30
"""Length beyond which Python builds a tuple display from a list."""


def compile_source(source: str | CodeType, **names: Callable[..., Any]) -> dict[str, Callable[..., Any]]:
    """Return the compiled functions of a source by name; they may call each other and the functions `names`."""
    namespace: dict[str, Any] = dict(names)
    exec(source, namespace)
    functions = {
        name: part(value) for name, value in namespace.items() if isinstance(value, FunctionType) and name not in names
    }
    namespace.update(functions)
    return functions


def items(texts: Iterable[str]) -> str:
    """Return the source between the parentheses of a tuple; a long tuple is a sum of short ones, as Numba requires."""
    each = [f"{text}, " for text in texts]
    return ") + (".join("".join(each[i : i + _LONGEST]).rstrip() for i in range(0, len(each), _LONGEST))


@cache
def evaluation(count: int) -> Callable[..., Any]:
    """Return a function (c, s, increments) that sets increments[i] = Σ_{k≥1} c[k, i] s^k for i = 0 … count−1."""
    each = range(count)
    return compile_source(f"""
def evaluate(c, s, increments):
    {" = ".join(f"a{i}" for i in each)} = 0.0
    for k in range(c.shape[0] - 1, 0, -1):
        {"; ".join(f"a{i} = a{i} * s + c[k, {i}]" for i in each)}
    {"; ".join(f"increments[{i}] = a{i} * s" for i in each)}
""")["evaluate"]
