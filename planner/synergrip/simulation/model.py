"""The model for MuJoCo: links, joints, an elastic pad at each contact, and the object as a free body.

The hand's masses are not in plan.json. Links have next to none; joints and pads get the inertia that keeps their
springs from swinging faster than the step can follow, which does not count where motion is slow.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.errors import InputError, Issue, raise_issues
from synergrip.hands.kinematics import link_spec
from synergrip.linalg import Array, frozen
from synergrip.simulation.geoms import GEOMS
from synergrip.simulation.joint_springs import NOTHING, JointSprings, joint_springs
from synergrip.simulation.played_plan import Pad, PlayedPlan
from synergrip.values import Value

SMALL_PAD = 2e-4
"""Radius [m] of the sphere that touches where a pad has none; it rolls, but not far."""
SWING = 0.15
"""Largest product of a natural frequency of joints and pads and the step."""
STAND_IN = 0.1
"""Mass [kg] of an object without one, where it does not count."""
HEAVY = 1e6
"""How much more inertia joints have that do not give at all."""
OVERLAP = 1e-9
"""How deep pads are in the object at the start [m], so that they touch."""
LIGHT, LIGHT_INERTIA = 1e-6, 1e-9
"""[kg], [kg m^2] of links."""
STIFF = (0.999, 0.999, 1e-3, 0.5, 2.0)
"""The impedance of contacts: they give some 1e-7 m, next to nothing beside the pads, and enough that a small jerk does
not part what touches for a step."""
SOFTEST = 4.0
"""Time constant of contacts, in steps."""
STICKING = 400.0
"""How much stiffer contacts are against sliding than along the normal: with less they creep, with 1e4 some chatter."""


@dataclass(frozen=True, eq=False, repr=False)
class PadModel(Value):
    """Where a pad stands in the model."""

    pad: Pad
    radius: float  # [m] of its sphere
    stiffness: Array  # (3,) or (4,) along its slides, and about the normal
    pair: int
    geom: int
    dofs: Array
    frame_o: Array  # (3, 3) columns n, t, o at the start
    preload: Array  # (rows,) what it carries at the start


@dataclass(frozen=True, eq=False, repr=False)
class Model(Value):
    """The compiled model and where things stand in it."""

    mujoco: Any
    """`mujoco.MjModel`."""
    text: str
    """As MJCF."""
    step: float  # [s]
    springs: JointSprings
    pads: tuple[PadModel, ...]
    places: Array
    """Of q among the coordinates."""
    dofs: Array
    """Of q among the degrees of freedom."""
    body: int
    """The object."""
    body_dof: int
    body_place: int
    mass: float  # [kg] of the object
    lag: float  # [s] damping of every spring over its stiffness


def make_model(plan: PlayedPlan, step: float) -> Model:
    """Return the model of a plan for a step [s].

    Raises:
        InputError: contacts that it cannot play, each by its name.
    """
    import mujoco

    _refuse(plan)
    mass = plan.mass or STAND_IN
    springs = joint_springs(plan.C)
    lag = _lag(plan, mass)
    spec = link_spec(plan.tree)
    for body in spec.bodies:
        if body.name != "world":
            body.mass, body.inertia = LIGHT, [LIGHT_INERTIA] * 3
    spec.compiler.degree, option = False, spec.option
    option.timestep, option.gravity, option.impratio = step, [0.0, 0.0, 0.0], STICKING
    option.cone, option.integrator = mujoco.mjtCone.mjCONE_ELLIPTIC, mujoco.mjtIntegrator.mjINT_EULER
    option.solver, option.iterations, option.tolerance = mujoco.mjtSolver.mjSOL_NEWTON, 100, 1e-12
    for name, inertia in zip(plan.kinematics.joints, _armature(plan, springs, step), strict=True):
        spec.joint(f"joint:{name}").armature = inertia
    _add_object(spec, plan, mass)
    links = plan.kinematics.at(plan.q_0, [(pad.link, pad.centre) for pad in plan.pads])
    made = [
        _add_pad(spec, plan, pad, number, link.rotation, step, lag)
        for number, (pad, link) in enumerate(zip(plan.pads, links, strict=True))
    ]
    made = _closed(spec, plan, made)
    compiled = spec.compile()
    names = plan.kinematics.joints
    joints = [compiled.joint(f"joint:{name}") for name in names]
    pads = tuple(
        PadModel(
            pad, radius, frozen(stiffness), number, int(compiled.geom(f"pad:{number}").id),
            np.array([int(compiled.joint(f"pad:{number}:{i}").dofadr[0]) for i in range(len(stiffness))]),
            pad.contact.frame, plan.forces_0[number],
        )
        for number, (pad, (radius, stiffness)) in enumerate(zip(plan.pads, made, strict=True))
    )  # fmt: skip
    free = compiled.joint("object")
    return Model(
        compiled, spec.to_xml(), step, springs, pads, np.array([int(j.qposadr[0]) for j in joints]),
        np.array([int(j.dofadr[0]) for j in joints]), int(compiled.body("object").id), int(free.dofadr[0]),
        int(free.qposadr[0]), mass, lag,
    )  # fmt: skip


def _refuse(plan: PlayedPlan) -> None:
    issues = []
    for number, pad in enumerate(plan.pads):
        key, name = f"execution.contacts[{number}]", pad.contact.name
        if pad.contact.kind.name not in _CONDIM:
            message = f"contact '{name}' is {pad.contact.kind.name}; MuJoCo plays {', '.join(_CONDIM)} contacts"
            issues.append(Issue(message, key=f"{key}.kind"))
        linear = pad.compliance[:3, :3]
        if np.linalg.eigvalsh((linear + linear.T) / 2).min() <= 0:
            message = (
                f"the pad of contact '{name}' is rigid (C_s = 0), which no elastic pad can be; give it a stiffness"
            )
            issues.append(Issue(message, key=f"{key}.compliance"))
        if np.any(pad.compliance[3:, :3]) or np.any(pad.compliance[:3, 3:]):
            message = f"contact '{name}' couples its spin with its forces, which slides and a hinge cannot"
            issues.append(Issue(message, key=f"{key}.compliance"))
    raise_issues(issues)


_CONDIM = {"frictionless": 1, "hard": 3, "soft": 4, "soft-elliptic": 4}


def _lag(plan: PlayedPlan, mass: float) -> float:
    """Return the damping of springs over their stiffness [s] that damps the object on its pads well."""
    total = sum(1 / float(pad.compliance[0, 0]) for pad in plan.pads)
    return float(np.sqrt(mass / total))


def _armature(plan: PlayedPlan, springs: JointSprings, step: float) -> Array:
    """Return the inertia of joints (n_q,): row sums of stiffness, that of the pads included, bound frequencies."""
    total = np.abs(springs.K)
    points = plan.kinematics.at(plan.q_0, [(pad.link, pad.centre) for pad in plan.pads])
    for pad, point in zip(plan.pads, points, strict=True):
        linear = np.abs(point.jacobian[:3])
        total = total + linear.T @ linear / np.linalg.eigvalsh(pad.compliance[:3, :3]).min()
    sums = total.sum(axis=1)
    found = np.maximum(sums, 1e-3 * sums.max()) * (step / SWING) ** 2
    return np.asarray(np.where(np.diag(springs.held) < NOTHING, HEAVY * found, found))


def _add_object(spec: Any, plan: PlayedPlan, mass: float) -> None:
    import mujoco

    (name, sizes), = plan.shape.items()  # fmt: skip
    size, kind = GEOMS[name].size(sizes), getattr(mujoco.mjtGeom, GEOMS[name].kind)
    inertia = plan.inertia if plan.inertia is not None else mass * (0.4 * float(np.max(size)) ** 2) * np.eye(3)
    body = spec.worldbody.add_body(name="object", pos=plan.position.tolist(), mass=mass, explicitinertial=True)
    body.ipos = [0.0, 0.0, 0.0]  # else MuJoCo takes it to be where the body is
    body.fullinertia = [*np.diag(inertia), inertia[0, 1], inertia[0, 2], inertia[1, 2]]
    body.add_freejoint(name="object")
    turned = np.zeros(4)
    mujoco.mju_mat2Quat(turned, np.ravel(sizes.get("rotation", np.eye(3))))
    body.add_geom(name="object", type=kind, size=size.tolist(), quat=turned.tolist(), contype=0, conaffinity=0)


def _add_pad(
    spec: Any, plan: PlayedPlan, pad: Pad, number: int, link: Array, step: float, lag: float
) -> tuple[float, Array]:
    """Add a pad held to its link by slides along the principal axes of its compliance; return radius, stiffness."""
    import mujoco

    contact, forces = pad.contact, plan.forces_0[number]
    normal = contact.normal
    at = plan.position + contact.point  # of the contact
    link_at = plan.kinematics.at(plan.q_0, [(pad.link, np.zeros(3))])[0].position
    centre = link_at + link @ pad.centre
    radius = float((at - centre) @ normal) if pad.radius > 0 else SMALL_PAD
    middle = at - radius * normal
    values, axes = np.linalg.eigh(pad.compliance[:3, :3])  # (1, 1) of a frictionless pad
    linear = len(values)
    mass = (1 / values).max() * (step / SWING) ** 2
    body = spec.body(f"link:{pad.link}").add_body(
        name=f"pad:{number}", pos=(link.T @ (middle - link_at)).tolist(), mass=mass, ipos=[0.0] * 3,
        inertia=[0.4 * mass * radius**2] * 3, explicitinertial=True,
    )  # fmt: skip
    stiffness = list(1 / values)
    for i, k in enumerate(stiffness):
        direction, preload = contact.frame[:, :linear] @ axes[:, i], float(axes[:, i] @ forces[:linear])
        joint = body.add_joint(name=f"pad:{number}:{i}", type=mujoco.mjtJoint.mjJNT_SLIDE)
        joint.axis = (link.T @ direction).tolist()
        _spring(joint, k, lag, preload)
    if len(forces) == 4 and pad.compliance[3, 3] > 0:
        k = 1 / float(pad.compliance[3, 3])
        joint = body.add_joint(name=f"pad:{number}:3", type=mujoco.mjtJoint.mjJNT_HINGE)
        joint.axis, most = (link.T @ normal).tolist(), k + radius**2 * max(stiffness)  # it rolls as it turns
        joint.armature = most * (step / SWING) ** 2
        _spring(joint, k, lag, float(forces[3]))
        stiffness.append(k)
    body.add_geom(
        name=f"pad:{number}", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[radius, 0, 0], contype=0, conaffinity=0
    )
    kind = contact.kind
    slide, cross = getattr(kind, "friction", 0.0), getattr(kind, "cross_friction", None)
    if cross is not None and cross != slide:
        raise InputError.at(f"execution.contacts[{number}].kind", f"contact '{contact.name}' has two frictions")
    spin = getattr(kind, "spin_friction", 0.0)
    spec.add_pair(
        name=f"pad:{number}", geomname1=f"pad:{number}", geomname2="object", condim=_CONDIM[contact.kind.name],
        friction=[slide, slide, spin, 0.0, 0.0], solref=[SOFTEST * step, 1.0], solimp=list(STIFF),
    )  # fmt: skip
    glue = spec.add_actuator(name=f"pad:{number}", target=f"pad:{number}", trntype=mujoco.mjtTrn.mjTRN_BODY)
    glue.gainprm[0] = 1.0
    return radius, np.array(stiffness)


def _closed(spec: Any, plan: PlayedPlan, made: list[tuple[float, Array]]) -> list[tuple[float, Array]]:
    """Close the gaps that a plan leaves between pads and object: a round pad grows, a point moves along its normal."""
    import mujoco

    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[[int(model.joint(f"joint:{name}").qposadr[0]) for name in plan.kinematics.joints]] = plan.q_0
    mujoco.mj_kinematics(model, data)
    target, found = int(model.geom("object").id), []
    for number, (pad, (radius, stiffness)) in enumerate(zip(plan.pads, made, strict=True)):
        gap = mujoco.mj_geomDistance(model, data, int(model.geom(f"pad:{number}").id), target, 1.0, None) + OVERLAP
        body = spec.body(f"pad:{number}")
        if pad.radius > 0:
            radius += gap
            spec.geom(f"pad:{number}").size = [radius, 0, 0]
        else:
            turned = data.xmat[int(model.body(f"link:{pad.link}").id)].reshape(3, 3)
            body.pos = body.pos + gap * (turned.T @ pad.contact.normal)
        found.append((radius, stiffness))
    return found


def _spring(joint: Any, stiffness: float, lag: float, preload: float) -> None:
    """Give a joint a damped spring that pushes with `preload` at 0."""
    for name, value in (("stiffness", stiffness), ("damping", lag * stiffness)):
        polynomial = np.ndim(getattr(joint, name)) > 0  # since MuJoCo 4
        setattr(joint, name, [value, 0.0, 0.0] if polynomial else value)
    joint.springref = preload / stiffness
