"""Recursions of Taylor coefficients, derived from recorded expressions and written as Python source.  Not for users.

Taylor coefficients of sums are sums, those of a product are Cauchy products q_k = Σ_m a_m b_(k−m).  Hence the recorded
field is brought into the form

    ẏ = rates(y, q),   linear in the series y and in products q of two of them,

which holds at every order k and gives (k+1) y_(k+1).  Factors that are sums of variables are multiplied out.  Any other
factor and every quotient become auxiliary series, computed at each order in stages.  A stage is linear in the
variables, in the results of earlier stages, and in products of these.  For z = r/d it is z_k = (r_k − (d z)_k)/d_0,
where (d z)_k is taken without the still unknown term d_0 z_k.

Expressions keep the form in which they were written, so that a common factor has the same round-off everywhere.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from hess_mechanics.numerics.expressions import FUNCTIONS, Node, Tape
from hess_mechanics.numerics.unrolled import items

__all__ = ["Recursion", "Series", "topological_order"]


@dataclass(frozen=True)
class Recursion:
    """The Taylor recursion of a field.

    variables, parameters : lengths of y and p.
    stages : number of auxiliary series of each stage; they follow the variables in y.
    pairs : indices into y of the two factors of each product.
    read : indices of the products that each stage reads, and last those that `rates` reads.
    constants : number of values that are constant during a step; they follow the parameters in p.
    observables : number of series that the field returns after its rates.
    monitors : kinds of the series after these, on which the step depends, see `tracing.trace`.
    functions : number of functions of the state; they follow the variables in y, and their rates follow the rates of
        the variables.
    source : Python source of `rates(y, q, p, one)` and, if needed, of `stage0(y, q, p, one)`, … and `constants(y, p)`;
        each returns a tuple.  one : the series of the number 1, which is 1 at order 0 and 0 at all others.
        `started(y, p)` returns the functions at a state, and `extended(y, p)` the rates of variables and functions in
        plain arithmetic, from variables and functions.
    """

    variables: int
    parameters: int
    stages: tuple[int, ...]
    pairs: tuple[tuple[int, int], ...]
    read: tuple[frozenset[int], ...]
    constants: int
    source: str
    observables: int = 0
    monitors: tuple[str, ...] = ()
    functions: int = 0

    @property
    def dimension(self) -> int:
        """Number of series with a rate: variables and functions."""
        return self.variables + self.functions

    @property
    def outputs(self) -> int:
        """Number of series that are observed or watched."""
        return self.observables + len(self.monitors)

    @property
    def stage_starts(self) -> list[int]:
        """Number of series known before the first stage and after each stage; those with a rate come first."""
        return [self.dimension + sum(self.stages[:i]) for i in range(len(self.stages) + 1)]

    @property
    def is_quadratic(self) -> bool:
        """True if the recursion needs products of variables and functions only."""
        return not self.stages and not self.constants


class Series:
    """The expressions of a tape, rewritten in terms of series and their products."""

    def __init__(self, tape: Tape, variables: int, functions: Sequence[Node], multiplies_out: bool) -> None:
        self._tape, self._multiplies_out = tape, multiplies_out
        self._functions = {node: variables + i for i, node in enumerate(functions)}
        self._variables = variables + len(functions)  # Number of series with a rate.
        self._one = tape.linear("one")
        self._lowered: dict[Node, Node] = {}
        self._rules: list[Node] = []  # Rules of the auxiliary series.
        self._places: dict[Node, int] = {}
        self._divided: set[Node] = set()  # Products d·z of the quotients.

    def lower(self, node: Node) -> Node:
        """Return the node as a sum of series and products with constant factors."""
        if node not in self._lowered:
            self._lowered[node] = self._lower(node)
        return self._lowered[node]

    def _lower(self, node: Node) -> Node:
        if not node.moves:
            return self._scaled(node, self._one)
        if node.operation == "variable":
            return self._tape.leaf("series", node.value)
        if node in self._functions:
            return self._tape.leaf("series", self._functions[node])
        if node.operation == "negative":
            return self._sum((-1, self.lower(node.arguments[0])))
        a, b = node.arguments
        if node.operation in "+-":
            return self._sum((1, self.lower(a)), (1 if node.operation == "+" else -1, self.lower(b)))
        if node.operation == "*":
            if not a.moves or not b.moves:
                factor, series = (a, b) if not a.moves else (b, a)
                return self._scaled(factor, self.lower(series))
            return self._product(self.lower(a), self.lower(b))
        if not b.moves:
            return self._scaled(self._tape.apply("/", self._tape.number(1), b), self.lower(a))
        return self._quotient(self.lower(a), b)

    def _sum(self, *signed: tuple[int, Node]) -> Node:
        terms: list[tuple[int, Node]] = []
        for sign, form in signed:
            terms += [(sign * own, term) for own, term in _terms(form)]
        if [sign for sign, _ in terms] == [1]:
            return terms[0][1]
        return self._tape.linear("sum", *(term for _, term in terms), signs=tuple(sign for sign, _ in terms))

    def _scaled(self, factor: Node, series: Node) -> Node:
        if series.operation == "scaled":
            factor, series = self._tape.apply("*", factor, series.arguments[0]), series.arguments[1]
        if factor.operation == "negative" or (factor.operation == "number" and factor.value < 0):
            return self._sum((-1, self._scaled(self._tape.negative(factor), series)))
        return series if factor is self._tape.number(1) else self._tape.linear("scaled", factor, series)

    def _product(self, a: Node, b: Node) -> Node:
        for factor, other in ((a, b), (b, a)):
            if factor is self._one:
                return other
            if factor.operation == "scaled":
                return self._scaled(factor.arguments[0], self._product(factor.arguments[1], other))
        for factor, other in ((a, b), (b, a)):
            if factor.operation == "sum" and factor.value[0] < 0:
                # Normalise the sign, so that x and −x are the same factor.
                return self._sum((-1, self._product(self._sum((-1, factor)), other)))
        for factor, other in ((a, b), (b, a)):
            if factor.operation == "sum" and self._multiplies_out and self._is_of_variables(factor):
                return self._sum(*((sign, self._product(term, other)) for sign, term in _terms(factor)))
        left, right = sorted((self._series(a), self._series(b)), key=lambda node: node.value)
        return self._tape.linear("product", left, right)

    def _is_of_variables(self, form: Node) -> bool:
        if form.operation == "series":
            return bool(form.value < self._variables)
        if form.operation == "scaled":
            return self._is_of_variables(form.arguments[1])
        return form is self._one or (form.operation == "sum" and all(map(self._is_of_variables, form.arguments)))

    def _series(self, form: Node) -> Node:
        """Return the series equal to a form; a form that is not yet a series gets an auxiliary one."""
        if form.operation == "series":
            return form
        if form not in self._places:
            self._places[form] = self._variables + len(self._rules)
            self._rules.append(form)
        return self._tape.leaf("series", self._places[form])

    def _quotient(self, numerator: Node, divisor: Node) -> Node:
        d = self._series(self.lower(divisor))
        inverse = self._tape.apply("/", self._tape.number(1), self._tape.start(divisor))
        z = self._tape.leaf("series", self._variables + len(self._rules))
        product = self._tape.linear("product", d, z)
        self._divided.add(product)
        self._rules.append(self._scaled(inverse, self._sum((-1, product), (1, numerator))))
        return z

    def _levels(self) -> list[int]:
        """Return the stage of each auxiliary series, later than those of all series that its rule needs."""
        levels: list[int] = []
        for i, rule in enumerate(self._rules):
            needed = [node.value - self._variables for node in topological_order([rule]) if node.operation == "series"]
            levels.append(1 + max((levels[j] for j in needed if 0 <= j != i), default=-1))
        return levels

    def recursion(self, rates: Sequence[Node], parameters: int, watched: tuple[str, ...] = ()) -> Recursion:
        """Return the recursion of a field with these rates, of which the last are the `monitors`."""
        forms = [self.lower(rate) for rate in rates]
        # Keep only the series that the rates need: an unused intermediate result costs nothing.
        used = self._used(forms)
        levels = self._levels()
        order = sorted(used, key=lambda i: (levels[i], i))
        stages = [[i for i in order if levels[i] == level] for level in sorted({levels[i] for i in order})]
        places = {i: i for i in range(self._variables)}
        places |= {self._variables + i: self._variables + at for at, i in enumerate(order)}
        rules = [[self._rules[i] for i in stage] for stage in stages]
        everything = topological_order([*forms, *(rule for stage in rules for rule in stage)])
        products = [node for node in everything if node.operation == "product"]
        factors = [
            node
            for node in dict.fromkeys(node.arguments[0] for node in everything if node.operation == "scaled")
            if node.uses_start
        ]

        names: dict[Node, str] = {}
        late = {self._one: 0}
        for node in everything:
            if node.operation == "series":
                names[node] = f"y[{places[node.value]}]"
                late[node] = 0 if node.value < self._variables else 2 + 2 * levels[node.value - self._variables]
        for node in everything:
            if node.operation == "product":
                # The product in the rule of a quotient depends on the divisor only.
                late[node] = 1 + (min if node in self._divided else max)(late[factor] for factor in node.arguments)
        names |= {node: f"q[{j}]" for j, node in enumerate(products)} | {self._one: "one"}
        names |= {node: f"p[{parameters + j}]" for j, node in enumerate(factors)}
        functions = []
        for i, (stage, rule) in enumerate(zip(stages, rules, strict=True)):
            functions.append(_function(f"stage{i}(y, q, p, one)", rule, names, late))
            # Later stages use these results instead of computing them again.
            names |= {self._rules[j]: f"y[{places[self._variables + j]}]" for j in stage}
        functions.append(_function("rates(y, q, p, one)", forms, names, late))
        read = tuple(frozenset(map(int, re.findall(r"q\[(\d+)\]", function))) for function in functions)
        at_start = {node: f"y[{i}]" for node, i in self._functions.items()}
        if factors:
            functions.append(_function("constants(y, p)", factors, at_start, {}))
        if self._functions:
            functions.append(_function("started(y, p)", [*self._functions], {}, {}))
        functions.append(_function("extended(y, p)", rates[: self._variables], at_start, {}))
        pairs = tuple((places[a.value], places[b.value]) for a, b in (node.arguments for node in products))
        return Recursion(
            self._variables - len(self._functions),
            parameters,
            tuple(map(len, stages)),
            pairs,
            read,
            len(factors),
            "\n\n".join(functions),
            len(rates) - self._variables - len(watched),
            watched,
            len(self._functions),
        )

    def _used(self, forms: Sequence[Node]) -> list[int]:
        indices: dict[int, None] = {}
        waiting = list(forms)
        while waiting:
            for node in topological_order([waiting.pop()]):
                i = node.value - self._variables if node.operation == "series" else -1
                if i >= 0 and i not in indices:
                    indices[i] = None
                    waiting.append(self._rules[i])
        return list(indices)


def topological_order(roots: Iterable[Node]) -> list[Node]:
    """Return all nodes of these expressions, each once and after its arguments."""
    nodes: dict[Node, None] = {}

    def visit(node: Node) -> None:
        if node not in nodes:
            for argument in node.arguments:
                visit(argument)
            nodes[node] = None

    for root in roots:
        visit(root)
    return list(nodes)


def _terms(form: Node) -> list[tuple[int, Node]]:
    """Return the terms of a form with their signs."""
    return list(zip(form.value, form.arguments, strict=True)) if form.operation == "sum" else [(1, form)]


def _function(head: str, results: Sequence[Node], names: dict[Node, str], late: dict[Node, int]) -> str:
    """Return the source of a function that returns these expressions.

    names : names of known expressions; late : stage at which each series and product becomes known.  In a sum the term
    that is known last comes last, so that the processor need not wait for it earlier.
    """
    latest = dict(late)

    def when(node: Node) -> int:
        if node not in latest:
            latest[node] = max(map(when, node.arguments), default=0)
        return latest[node]

    uses = Counter(id(result) for result in results)
    seen: set[Node] = set()

    def count(node: Node) -> None:
        if node not in seen and node not in names:
            seen.add(node)
            uses.update(map(id, node.arguments))
            for argument in node.arguments:
                count(argument)

    for result in results:
        count(result)
    lines: list[str] = []
    texts = dict(names)

    def text(node: Node) -> str:
        if node not in texts:
            written = _written(node, text, when)
            if uses[id(node)] > 1 and node.arguments and node.operation != "start":
                lines.append(f"    t{len(lines)} = {written}")
                written = f"t{len(lines) - 1}"
            texts[node] = written
        return texts[node]

    values = [text(result) for result in results]
    return "\n".join([f"def {head}:", *lines, f"    return ({items(values)})"])


def _written(node: Node, text: Callable[[Node], str], when: Callable[[Node], int]) -> str:
    """Return the source of an expression; every number is written as a float, so that Numba sees one type."""
    if node.operation in ("variable", "parameter"):
        return f"{'y' if node.operation == 'variable' else 'p'}[{node.value}]"
    if node.operation == "number":
        return f"({float(node.value)!r})" if node.value < 0 else repr(float(node.value))
    if node.operation == "sum":
        terms = sorted(_terms(node), key=lambda term: when(term[1]))
        # A leading minus costs a negation: among the terms known first, put a positive one in front.
        first = next((term for term in terms if term[0] > 0 and when(term[1]) == when(terms[0][1])), terms[0])
        terms.remove(first)
        rest = "".join(f" {'+' if sign > 0 else '-'} {text(term)}" for sign, term in terms)
        return f"({'' if first[0] > 0 else '-'}{text(first[1])}{rest})"
    arguments = [text(argument) for argument in node.arguments]
    if node.operation in ("start", "carried"):
        return arguments[0]
    if node.operation in FUNCTIONS:
        return f"{node.operation}({', '.join(arguments)})"
    if node.operation == "negative":
        return f"(-{arguments[0]})"
    sign = "*" if node.operation == "scaled" else node.operation
    return f"({arguments[0]} {sign} {arguments[1]})"
