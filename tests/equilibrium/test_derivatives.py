"""The tangent against differences, and the equations as the gradient of an energy that is written down here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from jaws_that_move import SOFT, jaws
from scipy.spatial.transform import Rotation

from synergrip.equilibrium.balance import Balance
from synergrip.equilibrium.setting import Setting, setting
from synergrip.equilibrium.states import Loads, States
from synergrip.grasps.contact_at import ContactAt
from synergrip.grasps.contacts.frictionless import Frictionless
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.making import make_grasp
from synergrip.grasps.objects import Object
from synergrip.grasps.shapes.box import Box
from synergrip.grasps.shapes.cylinder import Cylinder
from synergrip.grasps.shapes.sphere import Sphere
from synergrip.linalg import Array
from synergrip.problems.problem import load_problem
from synergrip.statics.response import Maps, respond

HARD = ("barrett-ball-hold", "barrett-ball-lift-joints")
SOFT_ONES = ("human-glass", "gripper-peg")
STEP = 1e-3


@cache
def bundled(name: str) -> Grasp:
    return load_problem(name).grasp


def anywhere(own: Setting, seed: int = 0, turn: float = 0.2) -> Balance:
    """Return the equations at a state, under a load and with references that mean nothing."""
    rng, grasp = np.random.default_rng(seed), own.grasp
    start = own.start
    state = States(
        start.q + rng.normal(scale=0.2, size=(1, grasp.n_q)),
        start.position + rng.normal(scale=0.01, size=(1, 3)),
        Rotation.from_rotvec(rng.normal(scale=turn, size=(1, 3))).as_matrix(),
        start.forces + rng.normal(scale=3.0, size=(1, grasp.n_l)),
    )
    pushes = rng.normal(size=(1, 2, 3))
    loads = Loads(rng.normal(size=(1, 6)), rng.normal(scale=0.03, size=(2, 3)), pushes)
    return Balance.of(own, state, loads, rng.normal(scale=0.1, size=(1, grasp.n_z)))


def moved(balance: Balance, change: Array) -> Array:
    """Return the residuals (n,) after the unknowns have changed: forces, joints, shift, turn."""
    n_l, was = balance.setting.grasp.n_l, balance.states
    forces, joints, shift, turn = np.split(change, [n_l, len(change) - 6, len(change) - 3])
    rotation = Rotation.from_rotvec(turn).as_matrix() @ was.rotation
    state = States(was.q + joints, was.position + shift, rotation, was.forces + forces)
    return np.hstack(Balance.of(balance.setting, state, balance.loads, balance.references).residuals)[0]


def differences(function: Callable[[Array], Array], count: int, step: float = STEP) -> Array:
    """Return the derivatives (m, count) at 0, of the fourth order."""
    found = []
    for h in step * np.eye(count):
        found.append((8 * (function(h) - function(-h)) - (function(2 * h) - function(-2 * h))) / (12 * step))
    return np.array(found).T


def off(balance: Balance, step: float = STEP) -> tuple[Array, Array]:
    """Return how far the tangent is from the differences in its rows (r_s, r_q, r_w), and its largest entry there."""
    tangent, n_l = balance.tangent[0], balance.setting.grasp.n_l
    seen = differences(lambda change: moved(balance, change), len(tangent), step)
    rows = (slice(0, n_l), slice(n_l, -6), slice(-6, None))
    apart = [float(np.abs(tangent[part] - seen[part]).max()) for part in rows]
    return np.array(apart), np.array([np.abs(tangent[part]).max() for part in rows])


@pytest.mark.parametrize("name", HARD)
def test_the_tangent_of_hard_contacts_that_stick_is_the_derivative(name: str) -> None:
    grasp = bundled(name)
    rng = np.random.default_rng(1)
    C_z = np.diag(rng.uniform(0.01, 0.1, size=grasp.n_z))
    own = setting(replace(grasp, C_z=C_z), "fixed")
    assert all(contact.kind.components == ("n", "t", "o") for contact in grasp.contacts)
    for seed in range(3):
        apart, size = off(anywhere(own, seed))
        assert np.all(apart < 1e-8 * size)


def test_soft_contacts_that_stick_have_their_derivatives_but_for_turning_axes() -> None:
    """Those of r_w are whole; of r_q, how moments turn with joints is left out, of r_s, large turns."""
    grasp = bundled("gripper-peg")
    assert "m" in grasp.contacts[0].kind.components
    balance = anywhere(setting(grasp, "fixed"))
    tangent, n_l = balance.tangent[0], grasp.n_l
    seen = differences(lambda change: moved(balance, change), len(tangent))
    assert tangent[-6:] == pytest.approx(seen[-6:], abs=1e-8)
    assert tangent[n_l:, :n_l] == pytest.approx(seen[n_l:, :n_l], abs=1e-8)
    assert tangent[n_l:, -6:] == pytest.approx(seen[n_l:, -6:], abs=1e-8)


def test_a_push_turns_with_the_object() -> None:
    rng = np.random.default_rng(2)
    loads = Loads(rng.normal(size=(1, 6)), rng.normal(size=(2, 3)), rng.normal(size=(1, 2, 3)))
    R = Rotation.from_rotvec([[0.3, -0.4, 0.5]]).as_matrix()
    by_hand = loads.wrench[0].copy()
    for point, force in zip(loads.points, loads.at_points[0], strict=True):
        by_hand[3:] += np.cross(R[0] @ point, force) - np.cross(point, force)
    assert loads.acting(R)[0] == pytest.approx(by_hand, abs=1e-14)

    def moment(turn: Array) -> Array:
        return np.asarray(loads.acting(Rotation.from_rotvec(turn).as_matrix()[None] @ R)[0, 3:])

    assert differences(moment, 3) == pytest.approx(loads.turning(R)[0], abs=1e-10)


@pytest.mark.parametrize("name", [*SOFT_ONES, "human-ball", "dlr-ball-move"])
@pytest.mark.parametrize("model", ["fixed", "rolling"])
def test_the_tangent_is_the_derivative_where_contacts_begin(name: str, model: Any) -> None:
    """With the forces of the start and more: a normal turns where a tip rolls, and the force acts elsewhere."""
    own = setting(bundled(name), model)
    assert own.contact_model == model
    state = replace(own.start, forces=own.start.forces + 1.0)
    balance = Balance.of(own, state, own.unloaded(Loads.of(np.zeros((1, 6)))), np.zeros((1, own.grasp.n_z)))
    errors, size = off(balance, 1e-4)
    soft = any(len(contact.kind.components) > 3 for contact in own.grasp.contacts)
    assert np.all(errors[[0, 2]] < 1e-9 * size[[0, 2]])
    assert errors[1] < (1e-2 if soft else 1e-9) * size[1]  # how moments turn with joints is left out
    if model == "rolling":
        assert np.abs(balance.tangent - replace(balance, setting=setting(own.grasp, "fixed")).tangent).max() > 1e-3


def test_where_no_forces_act_the_maps_are_those_of_the_linear_statics() -> None:
    for name in ("human-glass", "dlr-ball-move", "table2-soft-motors"):
        grasp = replace(bundled(name), lambda_0=None, w_0=np.zeros(6))
        linear, own = respond(grasp), setting(grasp, "fixed")
        assert not own.start.forces.any()
        balance = Balance.of(own, own.start, Loads.of(np.zeros((1, 6))), np.zeros((1, grasp.n_z)))
        for each in fields(Maps):
            ours, theirs = getattr(balance.maps, each.name)[0], getattr(linear, each.name)
            assert np.abs(ours - theirs).max() < 1e-9 * max(np.abs(theirs).max(), 1e-3), (name, each.name)


def test_the_equations_are_the_gradient_of_an_energy() -> None:
    """U = springs of contacts, with the work of the forces they start with, and of joints, less that of the load."""
    grasp = bundled("barrett-ball-lift-joints")
    assert not grasp.C_z.any()
    own = setting(grasp, "fixed")
    rng = np.random.default_rng(3)
    C_q = np.diag(rng.uniform(0.01, 0.1, size=grasp.n_q))
    own = setting(replace(grasp, C_q=C_q), "fixed")
    at = anywhere(own)
    dz_r, pushes, points = at.references[0], at.loads.at_points[0], at.loads.points
    force = rng.normal(size=3)
    wrench = np.hstack([force + pushes.sum(axis=0), np.cross(points, pushes).sum(axis=0)])
    loads = Loads(wrench[None], points, pushes[None])
    K_s, K_q = np.linalg.inv(grasp.C_s), np.linalg.inv(C_q)

    def stretch(q: Array, p: Array, R: Array) -> Array:
        motions = own.held.hand.kinematics.at(q, [(touch.pad.link, touch.pad.point) for touch in own.held.touches])
        starts = own.held.hand.kinematics.at(own.held.q, [(t.pad.link, t.pad.point) for t in own.held.touches])
        found = []
        for contact, now, was in zip(grasp.contacts, motions, starts, strict=True):
            from_pad = was.rotation.T @ (contact.point + own.held.body.position - was.position)
            x_h = now.position + now.rotation @ from_pad
            found.append((R @ contact.frame).T @ (x_h - p - R @ contact.point))
        return np.concatenate(found)

    def placed(change: Array) -> tuple[Array, Array, Array]:
        n_q = grasp.n_q
        R = Rotation.from_rotvec(change[n_q + 3 :]).as_matrix() @ at.states.rotation[0]
        return at.states.q[0] + change[:n_q], at.states.position[0] + change[n_q : n_q + 3], R

    def energy(change: Array) -> Array:
        q, p, R = placed(change)
        d, turned = stretch(q, p, R), q - own.held.q - grasp.S @ dz_r
        springs = own.forces @ d + d @ K_s @ d / 2 + turned @ K_q @ turned / 2 - own.torques @ q
        work = force @ p + sum(push @ (p + R @ point) for push, point in zip(pushes, points, strict=True))
        return np.array([springs - work])

    q, p, R = placed(np.zeros(grasp.n_q + 6))
    forces = own.forces + K_s @ stretch(q, p, R)
    state = States(q[None], p[None], R[None], forces[None])
    r_s, r_q, r_w = Balance.of(own, state, loads, dz_r[None]).residuals
    gradient = differences(energy, grasp.n_q + 6)[0]
    assert r_s[0] == pytest.approx(np.zeros(grasp.n_l), abs=1e-12)
    size = np.abs(gradient).max()
    assert K_q @ r_q[0] == pytest.approx(gradient[: grasp.n_q], abs=1e-8 * size)
    assert -r_w[0] == pytest.approx(gradient[grasp.n_q :], abs=1e-8 * size)


def test_a_tip_that_rolls_stays_on_the_surface_and_acts_where_it_touches() -> None:
    for shape in (Box(size=(0.04, 0.04, 0.04)), Sphere(radius=0.02)):
        own = setting(jaws(shape, 0.02, 0.005, C_s=[1e-4] * 3 + [1.0], C_q=[0.0] * 6, kind=SOFT), "rolling")
        balance = anywhere(own, turn=0.05)
        placed, meeting = balance.placed, balance.meeting
        assert meeting.left.tolist() == [1] * own.grasp.n_c
        for i, frame in enumerate(meeting.frame[0]):
            point, R = placed.point[0, i], placed.rotation[0]
            assert frame.T @ frame == pytest.approx(np.eye(3), abs=1e-12)
            assert meeting.place[0, i] - point == pytest.approx(0.005 * frame[:, 0], abs=1e-12)
            centre = R.T @ (point - placed.position[0] - frame @ meeting.stretch[0, i, :3])
            assert meeting.centre[0, i] == pytest.approx(centre, abs=1e-12)
            distance, outward = shape.surface(centre)
            assert distance == pytest.approx(0.005, abs=1e-12)
            assert R @ outward == pytest.approx(-frame[:, 0], abs=1e-12)


@pytest.mark.parametrize("shape", [Sphere(radius=0.02), Box(size=(0.04, 0.04, 0.04))])
def test_a_way_looked_at_in_one_go_is_that_gone_step_by_step(shape: Sphere | Box) -> None:
    """A long one, of 1.5 rad: a ball's normals turn as far, so that where a step begins matters at every one."""
    own = setting(jaws(shape, 0.02, 0.005, C_s=[1e-4] * 3 + [1.0], C_q=[0.0] * 6, kind=SOFT), "rolling")
    T, rng = 30, np.random.default_rng(8)
    turns = np.cumsum(rng.normal([0.04, 0.02, -0.02], 0.01, (T, 3)), axis=0) if isinstance(shape, Sphere) else (
        np.outer(np.linspace(0, 0.05, T), [1.0, 1.0, 1.0]))  # fmt: skip
    states = States(
        own.held.q + rng.normal(size=(T, own.grasp.n_q)) * 1e-4, own.held.body.position + np.zeros((T, 3)),
        Rotation.from_rotvec(turns).as_matrix(), np.tile(own.forces, (T, 1)),
    )  # fmt: skip
    loads, references = Loads.of(np.zeros((T, 6))), np.zeros((T, own.grasp.n_z))
    at_once, here = Balance.of(own, states, loads, references), own
    for k in range(T):
        one = Balance.of(here, states.taken([k]), loads.taken([k]), references[[k]])
        here = one.moved_on()
        for name in ("place", "frame", "stretch", "centre"):
            assert getattr(at_once.meeting, name)[k] == pytest.approx(getattr(one.meeting, name)[0], abs=1e-13)
    near = Balance.of(own, states, loads, references, near=at_once)
    assert near.meeting.stretch == pytest.approx(at_once.meeting.stretch, abs=1e-14)


@pytest.mark.parametrize("shape", [Sphere(radius=0.05), Cylinder(radius=0.045, height=0.2), Box(size=(0.3, 0.3, 0.3))])
@pytest.mark.parametrize("kinds", [("frictionless",) * 3, ("hard", "frictionless", "hard")])
def test_the_tangent_of_pads_that_slide_is_the_derivative(shape: Any, kinds: tuple[str, ...]) -> None:
    """Where a pad slides the normal turns with the surface: far from the start, and with forces."""
    made = {"frictionless": Frictionless(), "hard": HardFinger(friction=0.6)}
    contacts = [ContactAt(f"finger{i}/tip", made[kind], stiffness=8e3) for i, kind in enumerate(kinds, start=1)]
    place = bundled("barrett-ball-hold").held.body.position
    body = Object(mass=0.2, shape=Sphere(radius=0.05), position=place)
    grasp = make_grasp("barrett", body, posture="ball", contacts=contacts, synergies="joints", joint_compliance=0.02)
    assert grasp.held is not None
    own = setting(replace(grasp, held=replace(grasp.held, body=replace(body, shape=shape))), "fixed")
    for seed in range(3):
        apart, size = off(anywhere(own, seed), 1e-4)
        assert np.all(apart < 2e-6 * size)
