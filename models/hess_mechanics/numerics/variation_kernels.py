# mypy: allow-untyped-defs
"""Variational equations V̇ = J(y(t)) V, solved by Taylor series along with the orbit.  Not for users.

V with V(0) = 1 is the fundamental matrix.  The Jacobian J is derived symbolically from the traced field.  The series of
its nonzero entries, quotients included, are computed along with the motion.  The recursion

    (k+1) V_(k+1) = Σ_m J_m V_(k−m)

treats all columns of V side by side, so that it uses vector instructions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from textwrap import indent
from typing import Any

import numpy as np

from hess_mechanics.numerics.expressions import Symbol
from hess_mechanics.numerics.jit import inner, part
from hess_mechanics.numerics.recursions import Recursion
from hess_mechanics.numerics.step_kernels import last_terms, step_check, step_condition, step_size
from hess_mechanics.numerics.taylor_kernels import (
    PATIENCE,
    STALLED,
    STEP_LIMIT_REACHED,
    STOPPED,
    columns_of,
    compensated_sum,
    expansion,
    workspace,
)
from hess_mechanics.numerics.tracing import Field, derivative, trace
from hess_mechanics.numerics.unrolled import compile_source, evaluation

__all__ = ["Variation", "products", "variation", "variation_integrator"]


_WRITTEN_OUT = 400
"""Largest number of products of an entry of J and one of a column that are written out, for vector instructions.  More
are a loop over the columns: 30 variables then compile in a seventh of the time."""


@dataclass(frozen=True)
class Variation:
    """A field with its Jacobian.

    recursion : recursion of the field, extended by the nonzero entries of J and, last, the divergence tr J.
    state_entries, constant_entries : rows and columns of the entries that depend on the state, and of those that depend
        on parameters only, in this order.
    """

    recursion: Recursion
    state_entries: tuple[tuple[int, int], ...]
    constant_entries: tuple[tuple[int, int], ...]


def variation(field: Field, variables: int, parameters: int) -> Variation:
    """Return the recursion of a field and its Jacobian.  Raises `NotTraceable`."""
    moving: list[tuple[int, int]] = []
    fixed: list[tuple[int, int]] = []

    def with_jacobian(y: Sequence[Any], p: Sequence[Any]) -> Sequence[Any]:
        for places in (moving, fixed):
            places.clear()
        rates = tuple(field(y, p))
        entries = {(i, j): derivative(rate, x) for i, rate in enumerate(rates) for j, x in enumerate(y)}
        for place, entry in entries.items():
            if isinstance(entry, Symbol):
                (moving if entry.moves else fixed).append(place)
        divergence = sum(entries[i, i] for i in range(len(rates)))
        return *rates, *(entries[place] for place in (*moving, *fixed)), divergence

    # The nonzero entries are known only after the field has been called.
    trace(lambda y, p: with_jacobian(y, p)[: len(y)], variables, parameters)
    recursion = trace(with_jacobian, variables, parameters, len(moving) + len(fixed) + 1)
    return Variation(recursion, tuple(moving), tuple(fixed))


def _lanes(columns: int) -> int:
    """Return the length of a row of V, padded to a multiple of four unless the length is 1."""
    return 1 if columns == 1 else columns + -columns % 4


def products(of: Variation, columns: int) -> int:
    """Return the number of products in the source of the kernel, on which its compile time depends."""
    entries = len(of.state_entries) + len(of.constant_entries)
    lanes = _lanes(columns)
    return len(of.recursion.pairs) + len(of.state_entries) * (1 if lanes * entries > _WRITTEN_OUT else lanes)


def _carrying_source(of: Variation, lanes: int) -> str:
    """Return the source of carry(seen, v, inverses), which computes v[1 … order, row, lane] from v[0] and J."""
    n = of.recursion.variables
    entries = [*of.state_entries, *of.constant_entries]
    is_long = lanes * len(entries) > _WRITTEN_OUT
    each: Sequence[int | str] = ("lane",) if is_long else range(lanes)

    def sums(row: int) -> tuple[str, ...]:
        """Return two partial sums for a row with many terms, so that additions overlap."""
        return ("s", "t") if sum(i == row for i, _ in of.state_entries) > 2 else ("s",)

    beginnings, used = [], {j for _, j in of.state_entries}
    for row in range(n):
        for lane in each:
            terms = [
                f"seen[0, {e}] * v[k, {j}, {lane}]"
                for e, (i, j) in enumerate(entries)
                if i == row and e >= len(of.state_entries)
            ]
            beginnings.append(f"s{row}_{lane} = {' + '.join(terms) or '0.0'}")
            beginnings += [f"t{row}_{lane} = 0.0"] if len(sums(row)) > 1 else []
    products, counted = [], dict.fromkeys(range(n), 0)
    for e, (i, j) in enumerate(of.state_entries):
        names = sums(i)
        name = names[counted[i] % len(names)]
        counted[i] += 1
        products.append("; ".join(f"{name}{i}_{lane} += a{e} * x{j}_{lane}" for lane in each))
    ends = [
        f"v[k + 1, {i}, {lane}] = ({' + '.join(f'{name}{i}_{lane}' for name in sums(i))}) * inverse"
        for i in range(n)
        for lane in each
    ]
    newline = "\n        "
    body = f"""
        {newline.join(beginnings)}
        for m in range(k, -1, -1):
            {"; ".join(f"a{e} = seen[m, {e}]" for e in range(len(of.state_entries))) or "pass"}
            {"; ".join(f"x{j}_{lane} = v[k - m, {j}, {lane}]" for j in sorted(used) for lane in each) or "pass"}
            {(newline + "    ").join(products) or "pass"}
        {newline.join(ends)}
"""
    if is_long:
        body = f"\n        for lane in range({lanes}):{indent(body, '    ')}"
    return f"""
def carry(seen, v, inverses):
    for k in range(inverses.size):
        inverse = inverses[k]{body}"""


@inner
def _largest_entry(v, rows, columns):
    """Return max |v| over v[row, column]."""
    largest = 0.0
    for i in range(rows):
        for j in range(columns):
            largest = max(largest, abs(v[i, j]))
    return largest


@inner
def _length_of(rates, rows):
    """Return |f|."""
    square = 0.0
    for i in range(rows):
        square += rates[i] * rates[i]
    return np.sqrt(square)


@inner
def _orthonormalised(v, rates, speed, rows, columns, growth):
    """Orthonormalise the columns of v[row, column] by Gram–Schmidt and add the logarithms of their lengths to growth.

    rates : if their length `speed` is not 0, the columns are made orthogonal to them first.
    """
    for j in range(columns):
        if speed > 0.0:
            along = 0.0
            for i in range(rows):
                along += rates[i] * v[i, j]
            along /= speed * speed
            for i in range(rows):
                v[i, j] -= along * rates[i]
        for other in range(j):
            along = 0.0
            for i in range(rows):
                along += v[i, other] * v[i, j]
            for i in range(rows):
                v[i, j] -= along * v[i, other]
        square = 0.0
        for i in range(rows):
            square += v[i, j] * v[i, j]
        length = np.sqrt(square)
        growth[j] += np.log(length)
        for i in range(rows):
            v[i, j] /= length


@inner
def _is_bent(v, rows, columns, known, volume, limit):
    """Return True if the condition number of the columns, or their length, may have passed the limit.

    known : 1 if a column of length 1 comes before them, else 0; volume : ln det v.
    The condition number of a square matrix of d columns is at most 2 (|v|²/d)^(d/2)/det v (Guggenheimer, Edelman,
    Johnson 1995).  If the columns do not form a basis, only their length is tested.
    """
    square = float(known)
    for i in range(rows):
        for j in range(columns):
            square += v[i, j] * v[i, j]
    d = columns + known
    if not 1e-6 < square / d < 1e6:
        return True
    return d == rows and 0.5 * d * np.log(square / d) - volume > np.log(limit)


def variation_integrator(of: Variation, columns: int, ahead: bool = False) -> Callable[..., Any]:
    """Return the compiled solver of ẏ = f(y, p), V̇ = J V for V with `columns` columns.

    ahead : True if f(y), the column along the motion, precedes the columns of V; it is known and not integrated.

    vary(state, frame, parameters, times, order, tolerance, max_steps, limit, states, frames, growth, divergence)
    integrates from the state (d,) and V = `frame` (d, c) at t = 0.  At the times (n,), monotonic and all ≥ 0 or all
    ≤ 0, it writes y into `states` (n, d), V into `frames` (n, d, c), and ∫ tr J dt into `divergence` (n,).  It returns
    the number of steps, or `STEP_LIMIT_REACHED` or `STOPPED`.

    limit : if finite, V is orthonormalised (also against f(y) with `ahead`) after a step at which its condition number,
    or the length of its columns, may have passed the limit.  `growth` (n, c) receives the logarithms of the lengths
    removed before each time.
    """
    recursion = of.recursion
    n, width, lanes, last_seen = recursion.variables, columns_of(recursion), _lanes(columns), recursion.observables - 1
    watched = recursion.outputs
    expand, evaluate, check = expansion(recursion), evaluation(n), step_check(recursion)
    suspects = step_condition(recursion)
    carry = compile_source(_carrying_source(of, lanes))["carry"]
    evaluate_row = evaluation(lanes)
    known = int(ahead)

    @part
    def vary(state, frame, parameters, times, order, tolerance, max_steps, limit, states, frames, growth, divergence):
        c, left, right, inverses = workspace(order, n, width)
        seen = np.zeros((order, watched))
        v = np.zeros((order + 1, n, lanes))
        moved = np.zeros((n, lanes))
        grown = np.zeros(columns)
        y = state.copy()
        low = np.zeros(n)
        increments = np.zeros(n)
        for i in range(n):
            for j in range(columns):
                v[0, i, j] = frame[i, j]
        t = 0.0
        t_low = 0.0
        volume = 0.0
        volume_low = 0.0
        # ln |f| and ∫ tr J dt at the last time at which V was orthonormal.
        speed_then = 0.0
        volume_then = 0.0
        before = 0.0
        mark = 0.0
        count = times.size
        direction = 1.0 if times[count - 1] >= 0.0 else -1.0
        sample = 0
        steps = 0
        while True:
            for i in range(n):
                c[0, i] = y[i]
            expand(c, left, right, inverses, parameters, seen)
            if limit < np.inf:
                speed = _length_of(c[1], n) if ahead else 0.0
                rise = np.log(speed) if ahead else 0.0
                if steps == 0:
                    speed_then = rise
                # Count the column f(y) with length 1.
                if _is_bent(v[0], n, columns, known, (volume - volume_then) - (rise - speed_then), limit):
                    _orthonormalised(v[0], c[1], speed, n, columns, grown)
                    speed_then, volume_then = rise, volume
            carry(seen, v, inverses)
            size = _largest_entry(v[0], n, columns)
            last, previous = last_terms(c, n)
            last = max(last, _largest_entry(v[order], n, columns) / size)
            previous = max(previous, _largest_entry(v[order - 1], n, columns) / size)
            most = direction * ((times[count - 1] - t) - t_low)
            h = min(step_size(last, previous, order, tolerance), most)
            if suspects(seen, h, before):
                h = check(c, seen, h, most, direction, parameters, tolerance)
            while sample < count:
                s = (times[sample] - t) - t_low
                if direction * s > h:
                    break
                evaluate(c, s, increments)
                for i in range(n):
                    evaluate_row(v[:, i], s, moved[i])
                    states[sample, i] = y[i] + (low[i] + increments[i])
                    for j in range(columns):
                        frames[sample, i, j] = v[0, i, j] + moved[i, j]
                for j in range(columns):
                    growth[sample, j] = grown[j]
                divergence[sample] = volume + (volume_low + _spread_over(seen, last_seen, inverses, s))
                sample += 1
            if sample == count:
                return steps + 1
            if steps % PATIENCE == 0:
                mark = t
            ends = not (h > 0.0) or (steps % PATIENCE == PATIENCE - 1 and abs(t - mark) <= STALLED * abs(t))
            if steps >= max_steps or ends:
                return STOPPED if ends else STEP_LIMIT_REACHED
            before = h
            s = direction * h
            evaluate(c, s, increments)
            for i in range(n):
                evaluate_row(v[:, i], s, moved[i])
                y[i], low[i] = compensated_sum(y[i], low[i], increments[i])
                for j in range(columns):
                    v[0, i, j] += moved[i, j]
            volume, volume_low = compensated_sum(volume, volume_low, _spread_over(seen, last_seen, inverses, s))
            t, t_low = compensated_sum(t, t_low, s)
            steps += 1

    return vary


@inner
def _spread_over(seen, which, inverses, s):
    """Return the integral of an observed series from 0 to s."""
    total = 0.0
    for k in range(inverses.size - 1, -1, -1):
        total = (total + seen[k, which] * inverses[k]) * s
    return total
