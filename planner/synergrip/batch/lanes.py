"""Eight numbers side by side as one value in code that Numba compiles: the compiler keeps them in vector registers.

Loops over eight problems are not vectorised by themselves, because arrays might overlap. A type that is a vector to the
compiler leaves nothing to find out: ``load``, ``store``, arithmetic and ``where_less`` work on all lanes at once.
Imported only where Numba is there.
"""

from __future__ import annotations

import operator
from typing import Any

from llvmlite import ir
from numba import types
from numba.core.cgutils import get_or_insert_function
from numba.extending import intrinsic, models, overload, register_model

LANES = 8
VECTOR = ir.VectorType(ir.DoubleType(), LANES)
ANY_ORDER = ("contract",)
"""A product and a sum may become one instruction."""


class Lanes(types.Type):  # type: ignore[misc]
    """The type of eight numbers."""

    def __init__(self) -> None:
        """Make it."""
        super().__init__(name=f"Lanes{LANES}")


lanes = Lanes()


@register_model(Lanes)
class _Model(models.PrimitiveModel):  # type: ignore[misc]
    def __init__(self, dmm: Any, fe_type: Any) -> None:
        super().__init__(dmm, fe_type, VECTOR)


def _place(context: Any, builder: Any, of: Any, array: Any, index: Any) -> Any:
    """Return a pointer to eight numbers of an array (entries * 8,)."""
    data = context.make_array(of)(context, builder, array).data
    first = builder.gep(data, [builder.mul(index, ir.Constant(index.type, LANES))])
    return builder.bitcast(first, VECTOR.as_pointer())


@intrinsic  # type: ignore[untyped-decorator]
def load(typing: Any, array: Any, index: Any) -> Any:
    """Return the entry (8,) of an array (entries * 8,)."""

    def made(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.load(_place(context, builder, signature.args[0], *arguments), align=8)

    return lanes(array, types.intp), made


@intrinsic  # type: ignore[untyped-decorator]
def store(typing: Any, array: Any, index: Any, value: Any) -> Any:
    """Write an entry (8,) of an array (entries * 8,)."""

    def made(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        builder.store(arguments[2], _place(context, builder, signature.args[0], *arguments[:2]), align=8)
        return context.get_dummy_value()

    return types.void(array, types.intp, lanes), made


def _transposed(builder: Any, rows: list[Any]) -> list[Any]:
    """Return the columns of eight vectors: halves of pairs change places, of entries 1, 2 and 4 apart."""
    kind = ir.VectorType(ir.IntType(32), LANES)
    for apart in (1, 2, 4):
        low = [i if not i & apart else i - apart + LANES for i in range(LANES)]
        high = [i + apart if not i & apart else i + LANES for i in range(LANES)]
        orders = [ir.Constant(kind, order) for order in (low, high)]
        pairs = [(rows[i & ~apart], rows[i | apart], orders[bool(i & apart)]) for i in range(LANES)]
        rows = [builder.shuffle_vector(*pair) for pair in pairs]
    return rows


def _at(context: Any, builder: Any, of: Any, array: Any, place: Any) -> Any:
    """Return a pointer to the numbers of a contiguous array from one of them on."""
    return builder.gep(context.make_array(of)(context, builder, array).data, [place])


@intrinsic  # type: ignore[untyped-decorator]
def load_columns(typing: Any, w: Any, index: Any, rows: Any, first: Any, down: Any) -> Any:
    """Write eight entries (8, 8) of `w`: entry k has number ``first + k`` of each of eight rows, `down` apart."""

    def made(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        w, index, rows, first, down = arguments
        found = []
        for lane in range(LANES):
            place = builder.add(first, builder.mul(down, ir.Constant(down.type, lane)))
            whole = builder.bitcast(_at(context, builder, signature.args[2], rows, place), VECTOR.as_pointer())
            found.append(builder.load(whole, align=8))
        for k, column in enumerate(_transposed(builder, found)):
            entry = builder.add(index, ir.Constant(index.type, k))
            builder.store(column, _place(context, builder, signature.args[0], w, entry), align=8)
        return context.get_dummy_value()

    return types.void(w, types.intp, rows, types.intp, types.intp), made


@intrinsic  # type: ignore[untyped-decorator]
def store_columns(typing: Any, w: Any, index: Any, rows: Any, first: Any, down: Any) -> Any:
    """Write the other way round: eight numbers of each of eight rows from eight entries of `w`."""

    def made(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        w, index, rows, first, down = arguments
        found = []
        for k in range(LANES):
            entry = builder.add(index, ir.Constant(index.type, k))
            found.append(builder.load(_place(context, builder, signature.args[0], w, entry), align=8))
        for lane, row in enumerate(_transposed(builder, found)):
            place = builder.add(first, builder.mul(down, ir.Constant(down.type, lane)))
            whole = builder.bitcast(_at(context, builder, signature.args[2], rows, place), VECTOR.as_pointer())
            builder.store(row, whole, align=8)
        return context.get_dummy_value()

    return types.void(w, types.intp, rows, types.intp, types.intp), made


@intrinsic  # type: ignore[untyped-decorator]
def all_of(typing: Any, value: Any) -> Any:
    """Return a number in all lanes."""

    def made(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        one = builder.insert_element(ir.Constant(VECTOR, ir.Undefined), arguments[0], ir.Constant(ir.IntType(32), 0))
        order = ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES)
        return builder.shuffle_vector(one, one, order)

    return lanes(types.float64), made


@intrinsic  # type: ignore[untyped-decorator]
def root(typing: Any, value: Any) -> Any:
    """Return square roots."""

    def made(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kind = ir.FunctionType(VECTOR, [VECTOR])
        return builder.call(get_or_insert_function(builder.module, kind, f"llvm.sqrt.v{LANES}f64"), arguments)

    return lanes(lanes), made


@intrinsic  # type: ignore[untyped-decorator]
def where_less(typing: Any, a: Any, b: Any, yes: Any, no: Any) -> Any:
    """Return `yes` in lanes where a < b, else `no`: that also where one of the two is no number."""

    def made(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        a, b, yes, no = arguments
        return builder.select(builder.fcmp_ordered("<", a, b), yes, no)

    return lanes(lanes, lanes, lanes, lanes), made


@intrinsic  # type: ignore[untyped-decorator]
def any_above_zero(typing: Any, value: Any) -> Any:
    """Return whether a lane is above 0."""

    def made(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        above = builder.fcmp_ordered(">", arguments[0], ir.Constant(VECTOR, [0.0] * LANES))
        bits = builder.bitcast(above, ir.IntType(LANES))
        return builder.icmp_unsigned("!=", bits, ir.Constant(bits.type, 0))

    return types.boolean(lanes), made


@intrinsic  # type: ignore[untyped-decorator]
def kept_apart(typing: Any) -> Any:
    """Have the function it is called in compiled once, and called: copied to where it is used it takes far longer."""

    def made(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        builder.function.attributes.add("noinline")
        return context.get_dummy_value()

    return types.void(), made


def _binary(name: str) -> Any:
    @intrinsic  # type: ignore[untyped-decorator]
    def made(typing: Any, a: Any, b: Any) -> Any:
        def built(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            return getattr(builder, name)(*arguments, flags=ANY_ORDER)

        return lanes(lanes, lanes), built

    return made


_add, _sub, _mul, _div = (_binary(name) for name in ("fadd", "fsub", "fmul", "fdiv"))


def _operator(which: Any, vectors: Any) -> None:
    def applied(a: Any, b: Any) -> Any:
        return vectors(a, b)

    @overload(which)  # type: ignore[untyped-decorator]
    def chosen(a: Any, b: Any) -> Any:
        return applied if isinstance(a, Lanes) and isinstance(b, Lanes) else None


for _which, _vectors in ((operator.add, _add), (operator.sub, _sub), (operator.mul, _mul), (operator.truediv, _div)):
    _operator(_which, _vectors)
