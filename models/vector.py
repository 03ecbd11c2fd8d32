"""Eight numbers side by side, with which compiled functions compute as with one number.

The processor computes with all of them at once.  LLVM has such a type; Numba does not, so here it is.
"""
# ruff: noqa: ANN001, ANN201, ANN202 -- Numba calls these functions with types and with LLVM's values.

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

from numba.core import cgutils, types
from numba.extending import intrinsic, models, overload, register_model

__all__ = ["LANES", "load", "same", "store"]

LANES = 8

ir = cgutils.ir
"""LLVM's language, as Numba writes it."""

_EIGHT = ir.VectorType(ir.DoubleType(), LANES)


class _Vector(types.Type):
    def __init__(self) -> None:
        super().__init__(f"vector of {LANES}")


_VECTOR = _Vector()


@register_model(_Vector)
class _VectorModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _EIGHT)


def _place(context, builder, kind, array, index):
    """Where the row array[index] begins."""
    indices = [*cgutils.unpack_tuple(builder, index), context.get_constant(types.intp, 0)]
    structure = context.make_array(kind)(context, builder, array)
    return builder.bitcast(cgutils.get_item_pointer(context, builder, kind, structure, indices), _EIGHT.as_pointer())


@intrinsic
def load(_, array, index):
    """The row array[index], index a tuple."""
    def generate(context, builder, signature, arguments):
        return builder.load(_place(context, builder, signature.args[0], *arguments), align=8)

    return _VECTOR(array, index), generate


@intrinsic
def store(_, array, index, vector):
    """array[index] = vector."""
    def generate(context, builder, signature, arguments):
        builder.store(arguments[2], _place(context, builder, signature.args[0], *arguments[:2]), align=8)
        return context.get_dummy_value()

    return types.void(array, index, vector), generate


@intrinsic
def same(_, number):
    """The vector of eight times this number."""
    def generate(_context, builder, _signature, arguments):
        undefined, first = ir.Constant(_EIGHT, ir.Undefined), ir.IntType(32)(0)
        places = ir.Constant(ir.VectorType(ir.IntType(32), LANES), None)
        return builder.shuffle_vector(builder.insert_element(undefined, arguments[0], first), undefined, places)

    return _VECTOR(number), generate


def _arithmetic(instruction: str, *operations: Callable[..., Any]) -> None:
    """Teach Numba operators of two vectors, or of a vector and a number."""
    @intrinsic
    def compute(_, left, right):
        def generate(_context, builder, _signature, arguments):
            return getattr(builder, instruction)(*arguments)

        return _VECTOR(left, right), generate

    def of_two(left, right):
        return compute(left, right)

    def with_number(left, right):
        return compute(left, same(right))

    def of_number(left, right):
        return compute(same(left), right)

    def choose(left, right):
        kinds = left is _VECTOR, right is _VECTOR
        numbers = isinstance(left, types.Float), isinstance(right, types.Float)
        if all(kinds):
            return of_two
        if kinds[0] and numbers[1]:
            return with_number
        return of_number if numbers[0] and kinds[1] else None

    for operation in operations:
        overload(operation)(choose)


_arithmetic("fadd", operator.add, operator.iadd)
_arithmetic("fsub", operator.sub)
_arithmetic("fmul", operator.mul)


@intrinsic
def _minus(_, vector):
    def generate(_context, builder, _signature, arguments):
        return builder.fneg(arguments[0])

    return _VECTOR(vector), generate


@overload(operator.neg)
def _negative(vector):
    def minus(vector):
        return _minus(vector)

    return minus if vector is _VECTOR else None
