"""An MJCF file as MuJoCo's own parser and compiler understand it; the only reader that imports MuJoCo."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.hands.models.mjcf_source import Source, kinematic_source
from synergrip.hands.models.mjcf_springs import Spring, joint_springs, tendon_springs
from synergrip.hands.models.xml_elements import Element
from synergrip.linalg import Array, frozen

MOST_RELATIONS = 500
"""Equalities, actuators or tendons."""

_SPRINGDAMPER = re.compile(r' springdamper="[^"]*"')
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


@dataclass(frozen=True)
class Actuator:
    """An actuator that pulls at a joint or at a tendon."""

    name: str
    joint: int | None
    """Column of q; None for a tendon, and for a ball or free joint."""
    tendon: int | None
    gear: float
    force: float
    """The largest [N, N m]; infinity when the file states none."""


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
    """(n_t, n_q) coefficients of the fixed tendons [m/rad or 1]; zeros for spatial ones."""
    spatial: tuple[int, ...]
    """Numbers of the spatial tendons."""
    actuators: tuple[Actuator, ...]
    springs: tuple[Spring, ...]

    @cached_property
    def tendon_names(self) -> tuple[str, ...]:
        """Names of the tendons; a number for one without."""
        return tuple(self.model.tendon(number).name or str(number + 1) for number in range(self.model.ntendon))

    def routed(self, postures: Array) -> tuple[Array, Array]:
        """Return the moment arms (n_p, n_t, n_q) and lengths (n_p, n_t) of all tendons in `postures` (n_p, n_q)."""
        import mujoco

        model, data = self.model, mujoco.MjData(self.model)
        joints = list(self.q)
        columns, places = model.jnt_dofadr[joints], model.jnt_qposadr[joints]
        arms = np.zeros((len(postures), model.ntendon, len(joints)))
        lengths = np.zeros((len(postures), model.ntendon))
        for number, posture in enumerate(postures):
            data.qpos[places] = posture
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            mujoco.mj_tendon(model, data)
            arms[number], lengths[number] = _tendon_jacobian(model, data)[:, columns], data.ten_length
        return arms, lengths


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
    spatial = tuple(number for number in range(model.ntendon) if not _fixed(model, number))
    bodies = _named([model.body(number).name or f"body{number}" for number in range(model.nbody)])
    names = [model.joint(number).name or bodies[model.jnt_bodyid[number]] for number in range(model.njnt)]
    joints = _named(names)
    return Mjcf(
        model, source, bodies, joints, kinds, q, frozen(model.qpos0[model.jnt_qposadr[list(q)]]),
        tuple(_equality(model, number, q, element) for number, element in _active(model, source)),
        _coefficients(model, q), spatial,
        tuple(_actuator(model, number, q) for number in range(model.nu)),
        (*joint_springs(model, q, joints, _tuned(model, source)), *tendon_springs(model)),
    )  # fmt: skip


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


def _fixed(model: Any, tendon: int) -> bool:
    import mujoco

    return bool(model.wrap_type[model.tendon_adr[tendon]] == mujoco.mjtWrap.mjWRAP_JOINT)


def _coefficients(model: Any, q: tuple[int, ...]) -> Array:
    coefficients = np.zeros((model.ntendon, len(q)))
    for number in filter(lambda tendon: _fixed(model, tendon), range(model.ntendon)):
        first = model.tendon_adr[number]
        for wrap in range(first, first + model.tendon_num[number]):
            coefficients[number, q.index(model.wrap_objid[wrap])] += model.wrap_prm[wrap]
    return frozen(coefficients)


def _tendon_jacobian(model: Any, data: Any) -> Array:
    """Return (n_t, n_v); MuJoCo 4 keeps the places of its entries in the model, MuJoCo 3 in the data, if anywhere."""
    import mujoco

    where = model if hasattr(model, "ten_J_rownnz") else data
    if where is data and not mujoco.mj_isSparse(model):
        return np.reshape(data.ten_J, (model.ntendon, model.nv))
    dense, columns = np.zeros((model.ntendon, model.nv)), where.ten_J_colind.ravel()
    mujoco.mju_sparse2dense(dense, data.ten_J.ravel(), where.ten_J_rownnz, where.ten_J_rowadr, columns)
    return dense


def _actuator(model: Any, number: int, q: tuple[int, ...]) -> Actuator:
    import mujoco

    driven = int(model.actuator_trnid[number, 0])
    on_tendon = model.actuator_trntype[number] == mujoco.mjtTrn.mjTRN_TENDON
    limited = bool(model.actuator_forcelimited[number])
    return Actuator(
        model.actuator(number).name or str(number + 1),
        q.index(driven) if not on_tendon and driven in q else None,
        driven if on_tendon else None,
        float(model.actuator_gear[number, 0]),
        float(np.abs(model.actuator_forcerange[number]).max()) if limited else math.inf,
    )


def _tuned(model: Any, source: Source) -> NDArray[np.bool_]:
    """Return (n_j,) whether the stiffness is made from a springdamper: it is another one without."""
    import mujoco

    without = _SPRINGDAMPER.sub("", source.text)
    files = {name: _SPRINGDAMPER.sub("", text.decode()).encode() for name, text in source.files.items()}
    if (without, files) == (source.text, dict(source.files)):
        return np.zeros(model.njnt, dtype=bool)
    return np.asarray(mujoco.MjModel.from_xml_string(without, files).jnt_stiffness != model.jnt_stiffness)
