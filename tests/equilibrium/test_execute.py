"""References executed: the linear model in the small, rigid springs as a limit, guesses, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from synergrip.equilibrium.execute import execute
from synergrip.equilibrium.execution import Execution
from synergrip.equilibrium.setting import setting
from synergrip.equilibrium.states import Loads, States
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.problems.problem import load_problem
from synergrip.statics.motion import forward
from synergrip.statics.response import respond

ONES = ("barrett-ball-lift-joints", "gripper-peg", "human-glass", "dlr-ball-lift-free")


@cache
def bundled(name: str) -> Grasp:
    return load_problem(name).grasp


def driven(grasp: Grasp, size: float, seed: int = 4) -> tuple[Array, Array]:
    """Return references (1, n_z) that change forces by some newtons and move the object, and a load (1, 6)."""
    rng, response = np.random.default_rng(seed), respond(grasp)
    z = rng.normal(size=grasp.n_z)
    z *= size / np.abs(response.dlambda_dzr @ z).max()
    wrench = size * np.array([0.1, -0.2, 0.15, 0.002, -0.001, 0.003])
    return z[None], grasp.w_0 + wrench[None]


@pytest.mark.parametrize("name", ONES)
def test_the_linear_model_is_the_tangent(name: str) -> None:
    """From a grasp that nothing loads, half the references leave a quarter of the difference.

    Contacts stay fixed: where pads roll, the plan has them on the pad's point and the execution on the surface.
    """
    whole = bundled(name)
    grasp = replace(whole, lambda_0=None, w_0=np.zeros(6))
    response, off = respond(grasp), []
    for share in (1.0, 0.5, 0.25):
        z, wrench = (share * each for each in driven(grasp, 2.0))
        found = execute(grasp, np.zeros(1), z, Loads.of(wrench), contact_model="fixed")
        linear = forward(response, np.zeros(1), z, wrench)
        pairs = ((found.states.forces, linear.forces), (found.du, linear.du), (found.joint, linear.dq),
                 (found.balance.torques, linear.torques))  # fmt: skip
        off.append([float(np.abs(one - other).max()) for one, other in pairs])
    for larger, smaller in pairwise(np.array(off)):
        assert larger / smaller == pytest.approx(np.full(4, 4.0), rel=0.25), off


@pytest.mark.parametrize("name", ["human-glass", "dlr-ball-lift-free"])
def test_rigid_contacts_are_the_limit_of_stiff_ones(name: str) -> None:
    grasp = bundled(name)
    z, wrench = driven(grasp, 1.0)
    own = setting(grasp, "fixed")  # the forces at the start stay what they are

    def forces(share: float) -> Array:
        stiff = replace(own, grasp=replace(grasp, C_s=share * grasp.C_s))
        return execute(stiff, np.zeros(1), z, Loads.of(wrench)).states.forces[0]

    assert np.linalg.matrix_rank(grasp.J) == grasp.n_l  # else joints alone leave some force undetermined
    rigid, off = forces(0.0), []
    for share in (1e-3, 1e-4):
        off.append(np.abs(forces(share) - rigid).max())
    assert off[0] / off[1] == pytest.approx(10, rel=0.1)
    assert off[1] < 1e-2


@pytest.mark.parametrize("name", ONES)
@pytest.mark.parametrize("model", ["fixed", "rolling"])
def test_a_guess_changes_how_long_it_takes_and_nothing_else(name: str, model: Any) -> None:
    grasp = bundled(name)
    z, wrench = driven(grasp, 2.0)
    shares, times = np.array([[0.5], [0.7], [1.0]]), np.arange(3.0)
    references, loads = shares * z, Loads.of(np.tile(wrench, (3, 1)))
    alone = execute(grasp, times, references, loads, contact_model=model)
    assert alone.whole, alone.why
    assert alone.residual < 1e-10
    again = execute(grasp, times, references, loads, contact_model=model, guess=alone)
    off = replace(alone.states, q=alone.states.q + 0.005, forces=1.1 * alone.states.forces)
    near = execute(grasp, times, references, loads, contact_model=model, guess=off)
    assert again.iterations < alone.iterations
    for other in (again, near):
        for each in ("q", "position", "rotation", "forces"):
            assert getattr(other.states, each) == pytest.approx(getattr(alone.states, each), abs=1e-9)


def test_a_guess_that_leads_nowhere_is_left() -> None:
    grasp = bundled("gripper-peg")
    z, wrench = driven(grasp, 2.0)
    alone = execute(grasp, np.zeros(1), z, Loads.of(wrench))
    lost = replace(alone.states, position=alone.states.position + 0.5, forces=-1e3 * alone.states.forces)
    found = execute(grasp, np.zeros(1), z, Loads.of(wrench), guess=lost)
    assert found.states.forces == pytest.approx(alone.states.forces, abs=1e-9)


def test_a_finger_is_not_longer_than_it_is() -> None:
    grasp = bundled("gripper-box")
    up = np.array([0, 0, 0.5, 0, 0, 0])
    z = np.linalg.lstsq(respond(grasp).du_dzr, up, rcond=None)[0]
    shares = np.linspace(0, 1, 11)
    found = execute(grasp, shares, shares[:, None] * z, Loads.of(np.tile(grasp.w_0, (11, 1))), contact_model="fixed")
    assert not found.whole
    assert found.why == "no equilibrium is near: the hand does not follow there"
    count = len(found.states)
    assert 0 < count < 11
    assert {len(each) for each in (found.du, found.joint, found.margins, found.stiffness, found.balance.G)} == {count}
    last = found.states.taken([count - 1])
    there = found.interpolated(np.array([shares[count - 1], shares[count], 1.0]))
    assert len(there) == 3
    for name in ("q", "position", "rotation", "forces"):
        assert getattr(there, name) == pytest.approx(np.repeat(getattr(last, name), 3, axis=0), abs=1e-12)


@pytest.mark.parametrize("model", ["fixed", "rolling"])
def test_states_between_those_that_were_followed_step_by_step_are_a_guess(model: Any) -> None:
    grasp = bundled("gripper-peg")
    z, wrench = driven(grasp, 2.0)
    found = execute(grasp, np.array([0.0, 1.0]), np.repeat(z, 2, axis=0), Loads.of(np.repeat(wrench, 2, axis=0)),
                    contact_model=model)  # fmt: skip
    assert len(found.path.states) > 2  # followed from the start
    times = np.array([0.0, 0.5, 1.0])
    again = execute(grasp, times, np.repeat(z, 3, axis=0), Loads.of(np.repeat(wrench, 3, axis=0)),
                    guess=found.interpolated(times), contact_model=model)  # fmt: skip
    assert again.whole
    assert again.states.forces == pytest.approx(np.repeat(found.states.forces[:1], 3, axis=0), abs=1e-6)


@pytest.mark.parametrize("reached", [0, 1])
def test_an_execution_that_reaches_next_to_nothing_says_so(reached: int) -> None:
    grasp = bundled("gripper-box")
    references = np.full((reached + 1, grasp.n_z), 1e4)
    references[:reached] = 0
    found = execute(grasp, np.arange(reached + 1.0), references, Loads.of(np.tile(grasp.w_0, (reached + 1, 1))))
    assert (len(found.states), found.whole) == (reached, False)
    assert {len(each) for each in (found.du, found.joint, found.margins, found.stiffness)} == {reached}
    assert 0 <= found.residual < 1e-8
    if reached:
        assert found.interpolated(np.array([0.0, 5.0])).q[-2:] == pytest.approx(np.repeat(found.states.q, 2, axis=0))
    else:
        with pytest.raises(InputError, match=f"no instant was reached, so no state is known: {found.why}"):
            found.interpolated(np.array([0.0]))


def test_the_grasp_at_an_equilibrium_is_one_in_balance() -> None:
    grasp = bundled("gripper-peg")
    z, wrench = driven(grasp, 2.0)
    found = execute(grasp, np.zeros(1), z, Loads.of(wrench))
    G, frames, arms = found.balance.G[0], found.balance.frames[0], found.balance.arms[0]
    assert G @ found.states.forces[0] == pytest.approx(-wrench[0], abs=1e-9)
    for rows, frame, arm in zip(grasp.rows, frames, arms, strict=True):
        assert G[:3, rows][:, :3] == pytest.approx(frame, abs=1e-15)
        assert G[3:, rows.start] == pytest.approx(np.cross(arm, frame[:, 0]), abs=1e-12)
    wanted = np.array(found.du)
    assert found.left(wanted) == pytest.approx(np.zeros((1, 6)), abs=1e-12)
    wanted[0, 0] += 1e-3
    assert found.left(wanted)[0, 0] == pytest.approx(1e-3)


def run(**changes: Any) -> Execution:
    grasp = bundled("gripper-peg")
    two = Loads.of(np.zeros((2, 6)))
    right = {"grasp": grasp, "times": [0.0, 1.0], "references": np.zeros((2, grasp.n_z)), "loads": two}
    return execute(**{**right, **changes})  # type: ignore[arg-type]


WRONG: dict[str, tuple[Callable[[], Any], str]] = {
    "matrices": (lambda: run(grasp=load_problem("tripod").grasp), "grasp: a grasp given as matrices"),
    "no grasp": (lambda: run(grasp="gripper"), "grasp: expected a Grasp"),
    "model": (lambda: run(contact_model="roling"), "contact_model: .*rolling"),
    "model of another type": (lambda: run(contact_model=np.zeros(3)), "contact_model"),
    "no times": (lambda: run(times=[]), "times"),
    "times in rows": (lambda: run(times=[[0.0, 1.0]]), "times"),
    "too few references": (lambda: run(references=np.zeros((1, 3))), r"references: expected shape \(2, "),
    "references nan": (lambda: run(references=np.full((2, 3), np.nan)), "references"),
    "loads as an array": (lambda: run(loads=np.zeros((2, 6))), r"loads: .*Loads\.of"),
    "too many loads": (lambda: run(loads=Loads.of(np.zeros((3, 6)))), "loads: expected loads at 2 times, got 3"),
    "guess of no states": (lambda: run(guess=3), "guess"),
    "guess of another grasp": (
        lambda: run(guess=States(np.zeros((2, 1)), np.zeros((2, 3)), np.zeros((2, 3, 3)), np.zeros((2, 1)))), "guess",
    ),
    "response": (lambda: run(response=3), "response"),
    "misspelt": (lambda: run(load=3), "load: no such argument"),
    "wrench of five": (lambda: Loads.of(np.zeros((2, 5))), "Loads.wrench"),
    "one wrench": (lambda: Loads.of(np.zeros(6)), "Loads.wrench"),
    "a number": (lambda: Loads.of(3.0), "Loads.wrench"),  # type: ignore[arg-type]
    "forces without points": (lambda: Loads(np.zeros((2, 6)), np.zeros((0, 3)), np.zeros((2, 1, 3))), "at_points"),
    "points of two": (lambda: Loads(np.zeros((2, 6)), np.zeros((1, 2)), np.zeros((2, 1, 3))), "Loads.points"),
}  # fmt: skip


@pytest.mark.parametrize("what", WRONG)
def test_what_does_not_fit_is_refused_by_name(what: str) -> None:
    call, message = WRONG[what]
    with pytest.raises(InputError, match=message):
        call()
