"""Quantities between bounds, as rows: the most common limit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from synergrip.conic.affine import Affine
from synergrip.conic.rows import Rows, items_of, nonnegative
from synergrip.documents.judging import Arguments, as_numbers, described
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.linalg import Array, sealed


@naming_arguments
def within(
    limit: str, names: Sequence[str], value: Affine, lower: Array | float, upper: Array | float, unit: Array | float
) -> list[Rows]:
    """Return rows ``lower <= value <= upper`` at every knot; infinite bounds add nothing.

    Args:
        limit: the limit's `key`, under which a proof names it.
        names: (m) one for each quantity, for people: contacts, joints, synergies or any words.
        value: m quantities, such as ``formulation.torque``.
        lower: (m,) or (T, m), or a number for all, in the units of the value; ``-math.inf`` where there is none.
        upper: likewise; ``math.inf`` where there is none.
        unit: (m,) or a number: size of each quantity, by which its rows are divided, so that they are near 1 (such as
            the bound itself); it changes no answer.

    Raises:
        InputError: names, bounds or units that are none, do not fit the quantities, or contradict each other.

    Example:
        >>> names = grasp.joints
        >>> [rows.items[0] for rows in within("torque", names, formulation.torque, -2.0, math.inf, 2.0)]
        [Item(name='finger1_inner', side='lowest')]
    """
    return within_bounds(limit, names, value, *_judged(limit, names, value, lower=lower, upper=upper, unit=unit))


def within_bounds(
    limit: str, names: Sequence[str], value: Affine, lower: Array, upper: Array, unit: Array
) -> list[Rows]:
    """Return the rows of `within` for arrays that are known to fit, as those of the limits of this package are."""
    result = []
    for side, bound in (("lowest", lower), ("highest", upper)):
        finite: NDArray[np.bool_] = np.isfinite(bound)
        if finite.all():
            result.append(one_bound(limit, names, value, bound, unit, side))
            continue
        keep = np.flatnonzero(finite if finite.ndim == 1 else np.all(finite, axis=0)).tolist()
        if keep:
            own = [names[at] for at in keep]
            result.append(one_bound(limit, own, value.taken(keep), bound[..., keep], unit[keep], side))
    return result


def one_bound(
    limit: str, names: Sequence[str], value: Affine, bound: Array | float, unit: Array | float, side: str
) -> Rows:
    """Return the rows of one side of `within`, "lowest" or "highest", for finite bounds: (m,), (T, m) or a number."""
    signed = np.asarray(unit if side == "lowest" else -unit)
    slack = (value.constant - bound) / signed
    return nonnegative(limit, items_of(names, side), Affine(sealed(value.matrix / signed[..., None]), sealed(slack)))


def _judged(limit: object, names: object, value: object, **given: object) -> tuple[Array, ...]:
    """Return lower bounds, upper bounds and units as arrays, one for each name (and knot), or refuse them."""
    judge = Arguments("within")
    judge.text("limit", limit, empty=False)
    judge.one("value", value, Affine, "formulation.force.after(matrix)")
    if not isinstance(value, Affine):
        raise InputError(judge.issues)
    T, m = value.constant.shape
    judge.named("names", names, m, "quantity")
    shapes = {"lower": ((m,), (T, m)), "upper": ((m,), (T, m)), "unit": ((m,),)}
    found = {}
    for name, each in given.items():
        array = as_numbers(each)
        if array is None or array.shape not in ((), *shapes[name]):
            judge.refuse(name, f"expected a number, or {m} numbers, one for each quantity; got {described(each)}")
        elif np.any(np.isnan(array)):
            judge.refuse(name, "expected numbers, got nan; infinity stands for no bound")
        else:
            found[name] = array if array.ndim else np.full(m, float(array))
    if np.any(~(found.get("unit", np.ones(1)) > 0) | np.isinf(found.get("unit", np.ones(1)))):
        judge.refuse("unit", "expected sizes greater than 0, finite ones")
    for name, side, no_bound in (("lower", np.inf, "-math.inf"), ("upper", -np.inf, "math.inf")):
        if name in found and np.any(found[name] == side):
            judge.refuse(name, f"no quantity is beyond {side:g}; {no_bound} stands for no bound")
    judge.finish()
    if np.any(found["lower"] > found["upper"]):
        raise InputError.at("within.lower", "some lower bounds are above the upper ones; swap them")
    return found["lower"], found["upper"], found["unit"]
