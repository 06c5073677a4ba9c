"""Stiffnesses that differ by many powers of ten: right maps, or said not to be; ranks told from a map's own error."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from decimal_response import decimal_maps, yields_everywhere
from elastic_grasp import course
from judged_response import judged, stiff_grasp
from random_grasps import random_grasp
from small_grasps import pinch, tripod

from synergrip.errors import RigidContactError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.statics import coordinates, respond, subspaces
from synergrip.statics.motion import forward


def of_pinch(S: np.ndarray, C_s: np.ndarray | None = None, **changes: np.ndarray) -> Grasp:
    """The pinch with other synergies."""
    grasp, count = pinch(), S.shape[1]
    matrices = {"S": frozen(S), "C_z": frozen(np.zeros((count, count)))} | {k: frozen(v) for k, v in changes.items()}
    if C_s is not None:
        matrices["C_s"] = frozen(C_s)
    return replace(grasp, synergies=tuple(f"z{i}" for i in range(count)), **matrices)


@pytest.mark.parametrize("seeds", [range(start, start + 12) for start in range(0, 48, 12)], ids=lambda s: f"from{s[0]}")
def test_maps_are_right_against_decimal_arithmetic(seeds: range) -> None:
    found = [judged(seed) for seed in seeds]
    assert [each.wrong for each in found] == [[]] * len(found)
    answered = [each for each in found if each.digits]
    assert {each.digits for each in answered} == {"float64", "doubled"}
    assert max(each.error for each in answered) < 1e-11


@pytest.mark.parametrize("ratio", [1e6, 1e9, 1e12])
@pytest.mark.parametrize("seed", range(4))
def test_stiff_and_soft_contacts_side_by_side(seed: int, ratio: float) -> None:
    """A contact that is much softer than the others: C^-1 and G C^-1 G' lose the digits of the soft ones."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, ["hard", "soft", "hard"], compliances=("diagonal", "zero", "zero"))
    soft = np.array(grasp.C_s)
    soft[4:8] *= ratio
    grasp = replace(grasp, C_s=frozen(soft))
    response = respond(grasp)
    for name, true in decimal_maps(grasp).items():
        assert np.abs(getattr(response, name) - true).max() <= 1e-12 * np.abs(true).max(), name


@pytest.mark.parametrize("size", [1e-3, 1e-9, 1e-12, 1e-15, 1e-18])
def test_contacts_nearly_rigid_beside_yielding_joints(size: float) -> None:
    rng = np.random.default_rng(3)
    grasp = random_grasp(rng, ["hard", "hard", "hard"], n_q=6, n_z=4, compliances=("scalar", "full", "diagonal"))
    grasp = replace(grasp, C_s=frozen(size * np.eye(9)))
    response = respond(grasp)
    for name, true in decimal_maps(grasp).items():
        assert np.abs(getattr(response, name) - true).max() <= 1e-9 * np.abs(true).max(), name


def test_rigid_contacts_are_refused_exactly_where_nothing_else_yields() -> None:
    rng = np.random.default_rng(3)
    few = random_grasp(rng, ["hard", "hard", "hard"], n_q=6, n_z=4, compliances=("scalar", "full", "diagonal"))
    many = random_grasp(rng, ["hard", "hard", "hard"], n_q=10, n_z=4, compliances=("scalar", "full", "zero"))
    few, many = (replace(grasp, C_s=frozen(np.zeros((9, 9)))) for grasp in (few, many))
    assert not yields_everywhere(few)
    with pytest.raises(RigidContactError, match="no compliance"):
        respond(few)
    assert yields_everywhere(many)
    assert respond(many).accuracy["dlambda_dzr"].error < 1e-10


def test_joints_that_move_contacts_by_rounding_only_do_not_yield() -> None:
    stiff = np.diag([0.0, *[1e-3] * 7])
    J = np.eye(8)
    J[0, 0] = 0.0
    rounding = np.array(J)
    rounding[0] = 1e-17
    S = np.eye(8)[:, :1] - np.eye(8)[:, 1:2] / 3
    for C_q, C_z in ((1e-2 * np.eye(8), np.zeros((1, 1))), (np.zeros((8, 8)), np.eye(1))):
        with pytest.raises(RigidContactError, match="component n of contact left"):
            respond(replace(of_pinch(S, stiff), J=frozen(rounding), C_q=frozen(C_q), C_z=frozen(C_z)))
    cancelling = np.array(J)
    cancelling[:, 1] = cancelling[:, 0] = 0.0
    cancelling[0, :2] = 0.1, 0.3
    S = np.zeros((8, 1))
    S[:2, 0] = 1.0, -1 / 3  # moves the contact by 0.1 - 0.3 / 3: nothing but rounding
    assert 0 < np.abs(cancelling @ S).max() < 1e-15
    with pytest.raises(RigidContactError, match="component n of contact left"):
        respond(replace(of_pinch(S, stiff), J=frozen(cancelling), C_q=frozen(np.zeros((8, 8))), C_z=frozen(np.eye(1))))


@pytest.mark.parametrize("seed", range(3))
def test_estimates_tell_of_digits_that_are_not_there(seed: int) -> None:
    """Beside synergies whose rigid directions are so to the last digit only, contacts are ever stiffer."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, ["hard", "hard", "soft"], n_q=9, n_z=6, compliances=("scalar", "zero", "singular"))
    known = {}
    for size in (1e-3, 1e-9, 1e-15, 1e-18):
        stiff = replace(grasp, C_s=frozen(size * np.eye(10)))
        response, known[size] = respond(stiff), 0.0
        for name, true in decimal_maps(stiff).items():
            error = np.abs(getattr(response, name) - true).max() / np.abs(true).max()
            assert error <= 2 * response.accuracy[name].error + 1e-14, (size, name)
            assert error < 1e-12, (size, name)
            known[size] = max(known[size], response.accuracy[name].sensitivity)
    assert known[1e-3] < 1e-11
    assert known[1e-9] < 1e-8
    assert known[1e-15] > 1e-6


@pytest.mark.parametrize("seed", [61, 125, 287])
def test_internal_forces_stay_internal_however_weak_they_are(seed: int) -> None:
    """Directions of force that the stiffest drown: cleaned of what the singular vectors let through."""
    response = respond(stiff_grasp(seed))
    internal = response.grasp.G @ subspaces(response).E_s
    assert np.abs(response.scale.wrench(internal.T)).max() < 2e-13


def test_a_force_counts_when_its_map_is_known_that_well() -> None:
    """Squeezing is 1e10 times as stiff as twisting; both are forces, and neither is in doubt."""
    S = np.zeros((8, 2))
    S[[0, 4], 0] = 1.0
    S[[3, 7], 1] = 0.002
    soft = np.diag([1e-9, 1e-3, 1e-3, 1.0] * 2)
    spaces = subspaces(respond(of_pinch(S, soft)))
    assert spaces.decisions["forces"].singular_values[1] == pytest.approx(1e-10, rel=1e-6)
    assert spaces.dimensions == (2, 0, 0)
    assert not spaces.ambiguous


def test_a_force_that_is_rounding_does_not_count() -> None:
    """Two references of which one carries the object to the last digit but one, on contacts of 1e12 N/m."""
    S = np.zeros((8, 2))
    S[[0, 4], 0] = 1.0
    S[[0, 4], 1] = 1.0, -1 + 1e-15
    spaces = subspaces(respond(of_pinch(S, 1e-12 * np.eye(8))))
    assert spaces.dimensions == (1, 1, 0)
    assert spaces.decisions["forces"].rank == 1
    assert not spaces.ambiguous


def test_stiff_forces_and_small_motions_share_one_matrix() -> None:
    """One synergy carries the object and squeezes it by a millionth, the other squeezes by one finger: 1e9 N to 1 m."""
    S = np.zeros((8, 2))
    S[[0, 4], 0] = 1 + 1e-6, -1 + 1e-6
    S[0, 1] = 1.0
    response = respond(of_pinch(S, 1e-9 * np.eye(8)))
    coords = coordinates(response, subspaces(response))
    assert coords.dimensions == (1, 1, 0)
    missed = np.abs(coords.M @ coords.inverse - np.eye(2))
    assert np.all(missed <= 1e-15 * np.outer(np.linalg.norm(coords.M, axis=1), np.linalg.norm(coords.inverse, axis=0)))


@pytest.mark.parametrize("seed", range(4))
def test_synergies_give_way_to_references_and_loads(seed: int) -> None:
    """All that a motion holds, against one elastic system, with every compliance at work."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, compliances=("diagonal", "full", "full"))
    grasp = replace(grasp, w_0=frozen(rng.normal(size=6)))
    times, dz_r, wrench = np.arange(3.0), rng.normal(size=(3, grasp.n_z)), rng.normal(size=(3, 6))
    found, true = forward(respond(grasp), times, dz_r, wrench), course(grasp, times, dz_r, wrench)
    for name in ("forces", "torques", "efforts", "du", "sag", "dq", "dz"):
        assert np.allclose(
            getattr(found, name), getattr(true, name), rtol=0, atol=1e-10 * np.abs(getattr(true, name)).max()
        )
    still = forward(respond(grasp), times, 0 * dz_r, wrench)
    assert np.abs(still.dz).max() > 1e-3 * np.abs(found.dz).max()  # the load alone moves them


@pytest.mark.parametrize("grasp", [tripod(), pinch()], ids=["tripod", "pinch"])
@pytest.mark.parametrize("softness", [1e-3, 1.0, 1e3, 1e6, 1e9, 1e13, 1e16])
def test_very_soft_synergies_keep_the_digits_of_the_little_that_they_move(grasp: Grasp, softness: float) -> None:
    """Of references of 1 the softest move next to nothing: the difference of 1 and what their actuators give way."""
    grasp = replace(grasp, C_z=frozen(softness * np.eye(grasp.n_z)))
    response, true = respond(grasp), decimal_maps(grasp)
    assert np.abs(true["dz_dzr"]).max() < 1 / (1 + softness)
    for name in ("dz_dzr", "dq_dzr", "dsigma_dzr"):
        assert np.abs(getattr(response, name) - true[name]).max() <= 1e-12 * np.abs(true[name]).max(), name
    moved = forward(response, np.zeros(1), np.ones((1, grasp.n_z)), np.zeros((1, 6))).dz[0]
    assert np.allclose(moved, true["dz_dzr"].sum(axis=1), rtol=0, atol=1e-12 * np.abs(true["dz_dzr"]).max())


def test_only_what_is_lost_is_said_to_be_inaccurate() -> None:
    """Contacts of 1e-12 m/N and synergies of 1e3 rad/(N m): what refining has brought back is not lost."""
    assert judged(592).verdict == "right"
    assert judged(592).wrong == []


def test_forces_in_doubt_make_their_rank_ambiguous() -> None:
    """Twisting is weaker than what the last digits of the data change in squeezing."""
    C_s = np.diag([1e-6, 1e-3, 1e-3, 1.0] * 2)
    C_s[0, 4] = C_s[4, 0] = -1e-6 * (1 - 1e-9)
    S = np.zeros((8, 2))
    S[[0, 4], 0] = 1.0
    S[[3, 7], 1] = 1.0
    spaces = subspaces(respond(of_pinch(S, C_s)))
    assert spaces.dimensions == (2, 0, 0)  # by the kinematics
    assert spaces.decisions["forces"].rank == 1
    assert spaces.ambiguous


@pytest.mark.parametrize("share", [1e-4, 1e-6, 1e-8, 1e-10])
def test_what_the_last_digits_of_the_data_decide_is_measured(share: float) -> None:
    """Two contacts that yield together 1 / share times as much as to a squeeze: a difference of like numbers."""
    C_s = 1e-3 * np.eye(8)
    C_s[0, 4] = C_s[4, 0] = -1e-3 * (1 - share)
    S = np.zeros((8, 1))
    S[[0, 4], 0] = 1.0
    response = respond(of_pinch(S, C_s))
    known, digit = response.accuracy["dlambda_dzr"], 2.0**-53 / share
    assert 0.1 * digit < known.sensitivity < 1000 * digit
    assert known.error < 1e-10
    assert np.allclose(response.dlambda_dzr, decimal_maps(response.grasp)["dlambda_dzr"], rtol=1e-10)
