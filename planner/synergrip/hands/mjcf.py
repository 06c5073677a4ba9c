"""An MJCF file as MuJoCo's own parser and compiler understand it; the only reader that imports MuJoCo."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.hands.mjcf_source import Source, kinematic_source
from synergrip.hands.xml_elements import Element
from synergrip.linalg import Array, frozen

MOST_RELATIONS = 500
"""Equalities, actuators or tendons."""

_LINE = re.compile(r"\bline (\d+)")
_FRAME = re.compile(r"^(XML )?Error: |^Schema violation: |\s*Element( name)? '.*$", re.DOTALL)


@dataclass(frozen=True)
class Equality:
    """An equality constraint that is switched on."""

    kind: str
    """"joint", "tendon" or what closes a loop: "connect", "weld"."""
    ends: tuple[int, ...]
    """Columns of q, tendons, or bodies."""
    polynomial: tuple[float, ...]
    """Coefficients c of e_1 = c_0 + c_1 e_2 + c_2 e_2^2 + ..., where e are the values from their reference."""
    element: Element


@dataclass(frozen=True, eq=False)
class Mjcf:
    """A compiled MJCF file. Columns of q are the joints that turn or slide, in the order of the file."""

    model: Any
    """The `mujoco.MjModel`."""
    source: Source
    bodies: tuple[str, ...]
    """Names; the world is the first. Those that the file leaves out are made up."""
    joints: tuple[str, ...]
    """Names."""
    kinds: tuple[str, ...]
    """"hinge", "slide", "ball" or "free", by joint."""
    q: tuple[int, ...]
    """Numbers of the joints in q."""
    q_0: Array
    """(n_q,) values in the drawing of the file (``ref``) [rad or m]."""
    equalities: tuple[Equality, ...]
    tendons: Array
    """(n_t, n_q) coefficients of the fixed tendons [m/rad or 1]."""
    pulls: Array
    """(n_a, n_q) joint torque per force of each actuator."""
    forces: Array
    """(n_a,) largest force of each actuator; infinity when the file states none."""


def compiled(root: Element) -> Mjcf:
    """Return what MuJoCo makes of the part of an MJCF file that bears on kinematics.

    Args:
        root: the element <mujoco> of the file.

    Raises:
        InputError: what `kinematic_source` or MuJoCo refuses, with file and line.
    """
    import mujoco

    source = kinematic_source(root)
    try:
        model = mujoco.MjModel.from_xml_string(source.text, dict(source.files))
    except (ValueError, mujoco.FatalError) as error:
        element = source.at([int(number) for number in reversed(_LINE.findall(str(error)))])
        inmost = str(error).strip().rpartition("model file with error: ")[2]
        said = " ".join(_FRAME.sub("", _FRAME.sub("", inmost)).split())
        raise element.refused(f"<{element.tag}>: MuJoCo says: {said}") from None
    for count, what in ((model.neq, "equalities"), (model.nu, "actuators"), (model.ntendon, "tendons")):
        if count > MOST_RELATIONS:
            raise root.refused(f"the file has {count} {what}, and a hand has at most {MOST_RELATIONS}")
    kinds = tuple(mujoco.mjtJoint(kind).name.removeprefix("mjJNT_").lower() for kind in model.jnt_type)
    q = tuple(number for number, kind in enumerate(kinds) if kind in ("hinge", "slide"))
    tendons = _tendons(model, q)
    bodies = _named([model.body(number).name or f"body{number}" for number in range(model.nbody)])
    names = [model.joint(number).name or bodies[model.jnt_bodyid[number]] for number in range(model.njnt)]
    return Mjcf(
        model,
        source,
        bodies,
        _named(names),
        kinds,
        q,
        frozen(model.qpos0[model.jnt_qposadr[list(q)]]),
        tuple(_equality(model, number, q, element) for number, element in _active(model, source)),
        tendons,
        _pulls(model, q, tendons),
        frozen(np.where(model.actuator_forcelimited, np.abs(model.actuator_forcerange).max(axis=1), math.inf)),
    )


def _named(names: list[str]) -> tuple[str, ...]:
    """Return `names` with those that stand twice told apart by a number."""
    told: dict[str, None] = {}
    for name in names:
        count = 1
        while (name if count == 1 else f"{name}/{count}") in told:
            count += 1
        told[name if count == 1 else f"{name}/{count}"] = None
    return tuple(told)


def _active(model: Any, source: Source) -> list[tuple[int, Element]]:
    """Return number and element of the equalities that hold from the start."""
    elements = [*source.equalities, *[source.lines[0]] * model.neq]  # an attached model may bring its own
    return [(number, elements[number]) for number in range(model.neq) if model.eq_active0[number]]


def _equality(model: Any, number: int, q: tuple[int, ...], element: Element) -> Equality:
    import mujoco

    kind = mujoco.mjtEq(model.eq_type[number]).name.removeprefix("mjEQ_").lower()
    ends = [int(end) for end in (model.eq_obj1id[number], model.eq_obj2id[number]) if end >= 0]
    if kind == "joint":
        ends = [q.index(end) for end in ends]
    elif kind != "tendon" and model.eq_objtype[number] == mujoco.mjtObj.mjOBJ_SITE:
        ends = [int(model.site_bodyid[end]) for end in ends]
    return Equality(kind, tuple(ends), tuple(model.eq_data[number][:5].tolist()), element)


def _tendons(model: Any, q: tuple[int, ...]) -> Array:
    coefficients = np.zeros((model.ntendon, len(q)))
    for number in range(model.ntendon):
        first = model.tendon_adr[number]
        for wrap in range(first, first + model.tendon_num[number]):
            coefficients[number, q.index(model.wrap_objid[wrap])] += model.wrap_prm[wrap]
    return frozen(coefficients)


def _pulls(model: Any, q: tuple[int, ...], tendons: Array) -> Array:
    import mujoco

    pulls = np.zeros((model.nu, len(q)))
    for number in range(model.nu):
        driven, gear = model.actuator_trnid[number, 0], model.actuator_gear[number, 0]
        if model.actuator_trntype[number] == mujoco.mjtTrn.mjTRN_TENDON:
            pulls[number] = gear * tendons[driven]
        elif driven in q:  # an actuator of a ball or free joint drives no column of q
            pulls[number, q.index(driven)] = gear
    return frozen(pulls)
