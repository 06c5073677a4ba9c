"""The arrays of a plan in one table: what plan.json, plan.npz, plan.csv and docs/answers.md say of them.

A new one is one line here, and its line in the documentation, which a test compares with this table.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from synergrip.documents.time_table import REFERENCES
from synergrip.grasps.contacts.kind import is_moment
from synergrip.grasps.grasp import Grasp
from synergrip.hands.units import SI_UNITS, joint_kinds, synergy_kinds
from synergrip.linalg import Array
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion
from synergrip.values import Value

AXES = ("x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad")

Size = Literal["exact", "force", "forces", "torque", "effort", "path", "du", "dq", "references", "wrench"]
"""Of the terms that an array is made of, against which rounding is small (`planning/sizes.py`)."""


class Columns(NamedTuple):
    """Columns of plan.csv."""

    like: str
    """One of them, for the documentation."""
    names: Callable[[Grasp], Sequence[str]]
    """Each with its unit."""


@dataclass(frozen=True, eq=False, repr=False)
class Moved(Value):
    """What references do, and their coordinates."""

    analysis: Analysis
    motion: Motion
    alpha: Array
    beta: Array
    gamma: Array
    elastic_motion: Array
    margins: Array


@dataclass(frozen=True)
class PlanArray:
    """One array, with a row for each knot."""

    key: str
    """In plan.json and plan.npz."""
    shape: tuple[str, ...]
    unit: str
    meaning: str
    of: Callable[[Moved], Array]
    size: Size
    columns: Columns | None = None
    """Of plan.csv; None when it is not in it."""
    inside: str = ""
    """Key in plan.json inside the table `key`."""

    @property
    def place(self) -> str:
        """Where it stands in plan.json."""
        return f"{self.key}.{self.inside}" if self.inside else self.key


def _synergies(grasp: Grasp) -> Sequence[str]:
    """Return the columns of references; how synergies of a file of matrices are measured nobody knows."""
    held = grasp.held
    kinds = synergy_kinds(held.synergies, joint_kinds(held.hand.joints).values()) if held is not None else {}
    return [f"{REFERENCES}{name}{f'_{SI_UNITS[kinds[name]]}' if name in kinds else ''}" for name in grasp.synergies]


def _torques(grasp: Grasp) -> Sequence[str]:
    """Return the columns of joint torques; the joints of a file of matrices turn."""
    kinds = joint_kinds(grasp.held.hand.joints) if grasp.held is not None else {}
    return [f"tau_{name}_{'N' if kinds.get(name) == 'slide' else 'Nm'}" for name in grasp.joints]


def _forces(grasp: Grasp) -> Sequence[str]:
    return [f"lambda_{name}_{c}_{'Nm' if is_moment(c) else 'N'}" for name, c in grasp.components]


START = " that the references ask for at the start posture (33)"
"""Of the coordinates: along the motion the grasp is another one, whose forces and rigid motion are not of these."""

SYNERGIES = Columns("zr_SYNERGY_rad", _synergies)
FORCES = Columns("lambda_CONTACT_n_N", _forces)
TORQUES = Columns("tau_JOINT_Nm", _torques)
DISPLACEMENT = Columns("du_x_m", lambda _: [f"du_{axis}" for axis in AXES])
MARGINS = Columns("margin_CONTACT_N", lambda grasp: [f"margin_{contact.name}_N" for contact in grasp.contacts])

ARRAYS = (
    PlanArray("time_s", ("T",), "s", "knots", lambda p: p.motion.times, "exact", Columns("t_s", lambda _: ["t_s"])),
    PlanArray("dz_r", ("T", "n_z"), "rad or m", "synergy references from those at the start: what to send to the hand",
              lambda p: p.motion.dz_r, "references", SYNERGIES),
    PlanArray("alpha", ("T", "dim E_s"), "N", f"coordinates of the internal force{START}", lambda p: p.alpha, "force"),
    PlanArray("beta", ("T", "dim Gamma_ucs"), "m", f"coordinates of the rigid motion{START}", lambda p: p.beta, "path"),
    PlanArray("gamma", ("T", "dim Gamma_zr"), "rad or m", f"coordinates of the redundancy{START}",
              lambda p: p.gamma, "references"),
    PlanArray("lambda", ("T", "n_l"), "N, N m",
              "contact forces of the hand on the object, rows (n, t, o [, moments]) of each contact",
              lambda p: p.motion.forces, "forces", FORCES),
    PlanArray("wrench", ("T", "6"), "N, N m", "external wrench on the object about B, axes of N",
              lambda p: p.motion.wrench, "wrench"),
    PlanArray("tau", ("T", "n_q"), "N m or N", "joint torques J' lambda",
              lambda p: p.motion.torques, "torque", TORQUES),
    PlanArray("sigma", ("T", "n_z"), "N m or N", "actuator efforts S' tau", lambda p: p.motion.efforts, "effort"),
    PlanArray("du", ("T", "6"), "m, rad", "object displacement about B: rigid motion + `elastic_motion` + `sag`",
              lambda p: p.motion.du, "du", DISPLACEMENT),
    PlanArray("elastic_motion", ("T", "6"), "m, rad", "the part of `du` that the grip makes beyond the rigid motion",
              lambda p: p.elastic_motion, "du"),
    PlanArray("sag", ("T", "6"), "m, rad", "the part of `du` that the change of the load makes",
              lambda p: p.motion.sag, "du"),
    PlanArray("dq", ("T", "n_q"), "rad or m", "joint displacement", lambda p: p.motion.dq, "dq"),
    PlanArray("margin", ("T", "n_c"), "N", "slip margin of each contact", lambda p: p.margins, "force", MARGINS,
              inside="per_contact_N"),
)  # fmt: skip
"""In the order of the columns of plan.csv."""


def arrays_of(moved: Moved) -> dict[str, Array]:
    """Return every array by its key, as in plan.npz."""
    return {each.key: each.of(moved) for each in ARRAYS}


def columns_of(grasp: Grasp) -> dict[str, tuple[str, ...]]:
    """Return the names of the columns of plan.csv by the keys of their arrays."""
    return {each.key: tuple(map(one_line, each.columns.names(grasp))) for each in ARRAYS if each.columns is not None}


def table_of(moved: Moved) -> Array:
    """Return the lines (T, ...) of plan.csv: the columns of `columns_of` one after the other."""
    return np.column_stack([each.of(moved) for each in ARRAYS if each.columns is not None])


def names_of(grasp: Grasp) -> dict[str, list[str]]:
    """Return the names of rows and columns, in their order."""
    contacts = list(grasp.contact_names)
    return {"contacts": contacts, "joints": list(grasp.joints), "synergies": list(grasp.synergies)}


def measures_of(grasp: Grasp) -> dict[str, Any]:
    """Return the force components of each contact, and what joints and synergies are measured in; None if unknown."""
    held = grasp.held
    joints = joint_kinds(held.hand.joints) if held is not None else dict.fromkeys(grasp.joints, "hinge")
    synergies = synergy_kinds(held.synergies, joints.values()) if held is not None else {}
    return {
        "components": [list(contact.kind.components) for contact in grasp.contacts],
        "units": {
            "joints": [SI_UNITS[joints[name]] for name in grasp.joints],
            "synergies": [SI_UNITS[synergies[name]] if name in synergies else None for name in grasp.synergies],
        },
    }  # fmt: skip


def documentation() -> str:
    """Return the table for people, in Markdown."""
    lines = ["| key | shape | unit | in plan.csv | meaning |", "| --- | --- | --- | --- | --- |"]
    for each in ARRAYS:
        named = f"`{each.columns.like}`" if each.columns is not None else ""
        lines.append(f"| `{each.place}` | {' x '.join(each.shape)} | {each.unit} | {named} | {each.meaning} |")
    return "\n".join(lines)


def one_line(name: str) -> str:
    """Return a name without control characters, which a model file may hold."""
    return "".join(letter if letter.isprintable() else "?" for letter in name)
