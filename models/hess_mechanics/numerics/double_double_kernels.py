# mypy: allow-untyped-defs
"""Taylor series in double-double arithmetic, from the same traced fields: the reference for measured errors.

Not for users.  A number with 31 digits is a pair of doubles, stored as a complex number, so that arrays, tuples and
assignments need no change.  The functions of `pairs_kernels` replace every operation and function in the source of a
`Recursion`.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from hess_mechanics.numerics.jit import part
from hess_mechanics.numerics.pairs_kernels import DOUBLE_DOUBLE_FUNCTIONS, add, divide, multiply, subtract
from hess_mechanics.numerics.recursions import Recursion
from hess_mechanics.numerics.step_kernels import last_terms, step_size
from hess_mechanics.numerics.taylor_kernels import STEP_LIMIT_REACHED
from hess_mechanics.numerics.unrolled import compile_source, items

__all__ = ["ORDER", "TOLERANCE", "double_double_integrator"]

ORDER, TOLERANCE = 36, 1e-31
"""Order of the Taylor series, and tolerance in units in which the state is O(1)."""

_OPERATIONS = {ast.Add: "add", ast.Sub: "subtract", ast.Mult: "multiply", ast.Div: "divide"}
_NAMES = {"add": add, "subtract": subtract, "multiply": multiply, "divide": divide}


class _Doubled(ast.NodeTransformer):
    """Replace operations by calls and numbers by pairs; leave indices unchanged."""

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
        return node

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        return _call("complex", node, ast.Constant(0.0))

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        left, right = self.visit(node.left), self.visit(node.right)
        if any(isinstance(side, ast.Tuple) for side in (left, right)):
            # A sum of tuples is one long tuple, see `items`.
            return ast.BinOp(left, node.op, right)
        return _call(_OPERATIONS[type(node.op)], left, right)


def _call(name: str, *arguments: ast.expr) -> ast.Call:
    return ast.Call(ast.Name(name, ast.Load()), [*arguments], [])


@cache
def _expansion(recursion: Recursion) -> Callable[..., Any]:
    """Return expand(c, p, steps, inner, q), which computes c[1 … order, series] from the state in c[0].

    steps[k] = unit of time/(k+1); inner, q : scratch, one number for each product.  Auxiliary series that are still
    unknown are 0, so that products omit their terms.
    """
    tree = ast.fix_missing_locations(_Doubled().visit(ast.parse(recursion.source)))
    functions = compile_source(compile(tree, "<double_double>", "exec"), **_NAMES, **DOUBLE_DOUBLE_FUNCTIONS)
    n, known, pairs = recursion.variables, recursion.stage_starts, recursion.pairs
    moving = recursion.dimension
    y, q = items(f"c[k, {i}]" for i in range(known[-1])), items(f"q[{j}]" for j in range(len(pairs)))
    stages = "".join(
        f"""
        ends(c, inner, k, q)
        found = stage{i}(({y}), ({q}), p, one)
        {"; ".join(f"c[k, {known[i] + j}] = found[{j}]" for j in range(count))}"""
        for i, count in enumerate(recursion.stages)
    )
    left, right = (np.array([pair[side] for pair in pairs], int) for side in (0, 1))

    @part
    def inside(c, k, inner):
        for j in range(left.size):
            inner[j] = 0.0
        # Add the products of inner orders with the loop over j inside, because its sums are independent of each other.
        for m in range(1, k):
            for j in range(left.size):
                inner[j] = add(inner[j], multiply(c[m, left[j]], c[k - m, right[j]]))

    @part
    def ends(c, inner, k, q):
        for j in range(left.size):
            q[j] = add(inner[j], multiply(c[0, left[j]], c[k, right[j]]))
            if k > 0:
                q[j] = add(q[j], multiply(c[k, left[j]], c[0, right[j]]))

    return compile_source(
        f"""
def expand(c, p, steps, inner, q):
    k = 0
    {f"found = started(({y}), p)" if recursion.functions else "pass"}
    {"; ".join(f"c[0, {n + j}] = found[{j}]" for j in range(recursion.functions)) or "pass"}
    {f"p = p + constants(({y}), p)" if recursion.constants else "pass"}
    for k in range(steps.size):
        {"; ".join(f"c[k, {i}] = 0.0" for i in range(moving, known[-1])) or "pass"}
        one = complex(1.0, 0.0) if k == 0 else complex(0.0, 0.0)
        inside(c, k, inner){stages}
        ends(c, inner, k, q)
        found = rates(({y}), ({q}), p, one)
        {"; ".join(f"c[k + 1, {i}] = multiply(found[{i}], steps[k])" for i in range(moving))}
""",
        inside=inside,
        ends=ends,
        **_NAMES,
        **functions,
    )["expand"]


def double_double_integrator(recursion: Recursion) -> Callable[..., Any]:
    """Return the compiled solver of ẏ = f(y, p) with 31 digits.

    integrate(state, start, parameters, scale, unit, times, max_steps, out) starts from the state (d,) at the time
    `start` and writes the states at the times (n,), monotonic from `start`, into `out` (n, d).  Times are doubles,
    states and parameters are pairs.  unit : unit of time, a power of two, in which the motion is O(1); scale : (d,),
    units of the state.  It returns the number of steps; or `STEP_LIMIT_REACHED`, also if a step has no length.
    """
    n, parameters_count = recursion.variables, recursion.parameters
    expand = _expansion(recursion)
    packed = compile_source(f"""
def packed(parameters):
    return ({items(f"parameters[{i}]" for i in range(parameters_count))})
""")["packed"]
    series = recursion.stage_starts[-1]
    products = len(recursion.pairs)

    @part
    def evaluate(c, s, out):
        for i in range(n):
            total = complex(0.0, 0.0)
            for k in range(ORDER, 0, -1):
                total = multiply(add(total, c[k, i]), s)
            out[i] = add(c[0, i], total)

    @part
    def integrate(state, start, parameters, scale, unit, times, max_steps, out):
        c = np.zeros((ORDER + 1, series), np.complex128)
        inner, q = np.zeros(products, np.complex128), np.zeros(products, np.complex128)
        steps = np.zeros(ORDER, np.complex128)
        sizes = np.zeros((4, n))
        for k in range(ORDER):
            steps[k] = divide(complex(unit, 0.0), complex(k + 1.0, 0.0))
        p = packed(parameters)
        y = state.copy()
        t = complex(start, 0.0)
        direction = 1.0 if times[times.size - 1] >= start else -1.0
        j = 0
        taken = 0
        while True:
            for i in range(n):
                c[0, i] = y[i]
            expand(c, p, steps, inner, q)
            for k, row in enumerate((0, 1, ORDER - 1, ORDER)):
                for i in range(n):
                    sizes[k, i] = c[row, i].real / scale[i]
            last, previous = last_terms(sizes, n)
            h = step_size(last, previous, ORDER, TOLERANCE)
            taken += 1
            while j < times.size:
                left = add(complex(times[j], 0.0), -t)
                s = complex(left.real / unit, left.imag / unit)
                if direction * s.real > h:
                    break
                evaluate(c, s, out[j])
                j += 1
            if j == times.size:
                return taken
            if taken >= max_steps or not h > 0.0:
                return STEP_LIMIT_REACHED
            evaluate(c, complex(direction * h, 0.0), y)
            t = add(t, complex(direction * h * unit, 0.0))

    return integrate
