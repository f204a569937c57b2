"""Sums over grains in eight fixed lanes, the same bits on every processor.

A sum whose order is left to the compiler follows the width of the vector unit, and compression is
chaotic: another last bit soon means another packing. Here grain i always adds to lane i mod 8, and
the lanes are added up as a tree:

    ((l_0 + l_4) + (l_2 + l_6)) + ((l_1 + l_5) + (l_3 + l_7))

A `Lanes` is eight float64 in one variable, and compiled code knows +, * and `total` for it. On a
processor with wider or narrower vectors the eight lanes fill one register or several. Each lane is
rounded as IEEE 754 says, so the numbers stay the same.

The last n mod 8 grains are added to that one by one; `lane_sum` is the simplest example.
"""

from __future__ import annotations

import operator
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.errors import TypingError
from numba.extending import intrinsic, models, overload, register_model

from grainmodes.kernels.compiler import kernel


def _intrinsic(build: Any) -> Any:
    """numba's `intrinsic`, whose stated type does not know that callers give no context."""
    return intrinsic(build)


LANES = 8
"""Lanes of a sum: enough to hide the latency of an addition on 256-bit vectors."""

VECTOR = ir.VectorType(ir.DoubleType(), LANES)


class LanesType(types.Type):
    """numba's type of eight float64 lanes."""

    def __init__(self):
        super().__init__(name="Lanes")


lanes = LanesType()


@register_model(LanesType)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager, numba_type):
        super().__init__(manager, numba_type, VECTOR)


@kernel
def whole_lanes(n):
    """The largest multiple of LANES that is not above n."""
    return n - n % LANES


@_intrinsic
def no_lanes(typing_context):
    """Eight zeros."""
    return lanes(), lambda context, builder, signature, args: ir.Constant(VECTOR, [0.0] * LANES)


@_intrinsic
def same_lanes(typing_context, value):
    """Eight times the same float64."""

    def generate(context, builder, signature, args):
        vector = ir.Constant(VECTOR, ir.Undefined)
        for lane in range(LANES):
            vector = builder.insert_element(vector, args[0], ir.IntType(32)(lane))
        return vector

    return lanes(types.float64), generate


@_intrinsic
def load(typing_context, array, index):
    """array[index : index + LANES] of a contiguous float64 array; the bounds are not checked."""
    if array.layout != "C" or array.dtype is not types.float64:
        raise TypingError(f"load: expected a contiguous array of float64, got {array}")

    def generate(context, builder, signature, args):
        view = context.make_array(signature.args[0])(context, builder, args[0])
        first = cgutils.gep(builder, view.data, args[1])
        return builder.load(builder.bitcast(first, VECTOR.as_pointer()), align=8)

    return lanes(array, types.intp), generate


@_intrinsic
def total(typing_context, value):
    """The sum of the lanes, added up as the tree above."""

    def generate(context, builder, signature, args):
        part = [builder.extract_element(args[0], ir.IntType(32)(k)) for k in range(LANES)]
        while len(part) > 1:
            half = len(part) // 2
            part = [builder.fadd(part[k], part[half + k]) for k in range(half)]
        return part[0]

    return types.float64(lanes), generate


def _elementwise(operation, instruction):
    """Teach compiled code an operator on two `Lanes`."""

    @_intrinsic
    def apply(typing_context, left, right):
        def generate(context, builder, signature, args):
            return getattr(builder, instruction)(*args)

        return lanes(lanes, lanes), generate

    @overload(operation)
    def choose(left, right):
        if left is lanes and right is lanes:
            return lambda left, right: apply(left, right)
        return None


_elementwise(operator.add, "fadd")
_elementwise(operator.mul, "fmul")
_elementwise(operator.iadd, "fadd")


@kernel
def lane_sum(values):
    """The sum of a contiguous array (n,) float64, the same bits on every processor."""
    n = values.shape[0]
    sum_lanes = no_lanes()
    for i in range(0, whole_lanes(n), LANES):
        sum_lanes += load(values, i)
    result = total(sum_lanes)
    for i in range(whole_lanes(n), n):
        result += values[i]
    return result
