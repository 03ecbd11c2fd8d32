"""Functions written out item by item.

LLVM keeps numbers in registers, and packs them into vectors, when it sees each of them by name;
Numba's loops over tuples hide them.  So the few loops that matter are written out here.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from hess_mechanics.numerics.jit import part

__all__ = ["compiled", "evaluation"]


def compiled(source: str, **names: Callable[..., Any]) -> Callable[..., Any]:
    """The compiled function of that name, `function`, in this source, which may call what `names` holds."""
    namespace: dict[str, Any] = dict(names)
    exec(source, namespace)
    return part(namespace["function"])


@cache
def evaluation(count: int) -> Callable[..., Any]:
    """The function of (c, s, increments) that sets increments[i] = Σ_{k≥1} c[k, i] s^k for i = 0 … count−1."""
    items = range(count)
    return compiled(f"""
def function(c, s, increments):
    {" = ".join(f"a{i}" for i in items)} = 0.0
    for k in range(c.shape[0] - 1, 0, -1):
        {"; ".join(f"a{i} = (a{i} + c[k, {i}]) * s" for i in items)}
    {"; ".join(f"increments[{i}] = a{i}" for i in items)}
""")
