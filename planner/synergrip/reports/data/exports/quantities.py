"""The columns of an exported plan: one list of quantities, from which csv, npz and parquet are written."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from synergrip.grasps.contacts.kind import is_moment
from synergrip.linalg import Array
from synergrip.reports.data.exports.exported_plan import ExportedPlan, HandStates
from synergrip.values import Value
from synergrip.vectors import quaternions

TRUE = "true_"
"""Begins the names of what is so at the equilibria that a hand really comes to."""
MOTION = (("x", "m"), ("y", "m"), ("z", "m"), ("rx", "rad"), ("ry", "rad"), ("rz", "rad"))
WRENCH = (("fx", "N"), ("fy", "N"), ("fz", "N"), ("mx", "Nm"), ("my", "Nm"), ("mz", "Nm"))
QUATERNION = ("w", "x", "y", "z")


@dataclass(frozen=True, eq=False, repr=False)
class Quantity(Value):
    """Columns of one meaning."""

    key: str
    names: tuple[str, ...]
    units: tuple[str, ...]
    """Of each column, as names have them: "rad", "m", "N", "Nm", or empty."""
    values: Array  # (T, m)
    meaning: str

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns: key, name, unit."""
        pairs = zip(self.names, self.units, strict=True)
        return tuple("_".join(part for part in (self.key, *pair) if part) for pair in pairs)

    def by_unit(self) -> Iterator[tuple[str, tuple[str, ...], Array]]:
        """Yield key and unit, the names, and the values (T, m) of the columns of each unit."""
        for unit in dict.fromkeys(self.units):
            places = [i for i, each in enumerate(self.units) if each == unit]
            names = tuple(self.names[i] for i in places)
            yield "_".join(part for part in (self.key, unit) if part), names, self.values[:, places]


def quantities(plan: ExportedPlan) -> tuple[Quantity, ...]:
    """Return all that is known at the knots, but the times themselves."""
    true = TRUE if plan.true else ""
    rows = [(f"{name}_{c}", c) for name, own in zip(plan.contacts, plan.components, strict=True) for c in own]
    forces = tuple("Nm" if is_moment(component) else "N" for _, component in rows)
    torques = tuple("N" if unit == "m" else "Nm" for unit in plan.joint_units)
    return (
        Quantity("zr", plan.synergies, plan.synergy_units, plan.dz_r, "synergy reference from that at the start"),
        *_of_joints(plan, true),
        Quantity(f"{true}tau", plan.joints, torques, plan.torques, "joint torque"),
        Quantity(f"{true}lambda", tuple(name for name, _ in rows), forces, plan.forces,
                 "contact force of the hand on the object, along n, t, o of the contact; moment about n"),
        _paired(f"{true}du", MOTION, plan.du, "displacement of the object since the start: shift, rotation vector"),
        *(() if plan.hand is None else _of_object(plan.hand, true)),
        Quantity(f"{true}margin", plan.contacts, ("N",) * len(plan.contacts), plan.margins, "slip margin"),
        _paired("wrench", WRENCH, plan.wrench, "external wrench on the object about its origin, axes of the palm"),
    )  # fmt: skip


def header(found: Sequence[Quantity]) -> list[str]:
    """Return the names of all columns, the times first."""
    return ["t_s", *(name for each in found for name in each.columns)]


def _of_joints(plan: ExportedPlan, true: str) -> tuple[Quantity, ...]:
    hand = plan.hand
    if hand is None:
        return (Quantity("dq", plan.joints, plan.joint_units, plan.dq, "displacement of the joint since the start"),)
    meant = "where the joint would stand if it carried nothing: the command of a position controller of its compliance"
    return (
        Quantity("qr", plan.joints, plan.joint_units, hand.commanded, meant),
        Quantity(f"{true}q", plan.joints, plan.joint_units, hand.q, "value of the joint"),
    )


def _of_object(hand: HandStates, true: str) -> tuple[Quantity, ...]:
    units, turned = ("m",) * 3, quaternions(hand.rotation)
    return (
        Quantity(f"{true}object", ("x", "y", "z"), units, hand.position, "place of the object, frame of the palm"),
        Quantity(f"{true}object_quaternion", QUATERNION, ("",) * 4, turned,
                 "rotation of the object since the start, axes of the palm"),
    )  # fmt: skip


def _paired(key: str, pairs: Sequence[tuple[str, str]], values: Array, meaning: str) -> Quantity:
    names, units = zip(*pairs, strict=True)
    return Quantity(key, names, units, values, meaning)
