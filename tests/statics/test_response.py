"""The response maps against the equations they solve, the paper's X and Y, and their own invariances."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from made_kinds import made_kind
from random_grasps import compliance, moved_frame, random_grasp

from synergrip.errors import NotRestrainedError, RigidContactError
from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import frozen
from synergrip.statics import coordinates, respond, subspaces
from synergrip.statics.motion import forward, largest_term


def equilibrium(grasp: Grasp, dz_r: np.ndarray, dw: np.ndarray) -> dict[str, np.ndarray]:
    """Solve (6), (7), (10), (12), (14) as one linear system, eliminating nothing."""
    n_l, n_q, n_z = grasp.n_l, grasp.n_q, grasp.n_z
    sizes = {"lambda": n_l, "u": 6, "q": n_q, "z": n_z}
    starts = dict(zip(sizes, np.cumsum([0, *sizes.values()])[:-1], strict=True))
    A, b = np.zeros((sum(sizes.values()),) * 2), np.zeros(sum(sizes.values()))

    def put(row: int, name: str, block: np.ndarray) -> None:
        A[row : row + len(block), starts[name] : starts[name] + block.shape[1]] += block

    put(0, "lambda", grasp.G)  # G dlambda = -dw
    b[:6] = -dw
    row = 6
    put(row, "lambda", grasp.C_s)  # C_s dlambda = J dq - G' du
    put(row, "q", -grasp.J)
    put(row, "u", grasp.G.T)
    row += n_l
    put(row, "q", np.eye(n_q))  # dq = S dz - C_q J' dlambda
    put(row, "z", -grasp.S)
    put(row, "lambda", grasp.C_q @ grasp.J.T)
    row += n_q
    put(row, "z", np.eye(n_z))  # dz = dz_r - C_z S' J' dlambda
    put(row, "lambda", grasp.C_z @ grasp.S.T @ grasp.J.T)
    b[row:] = dz_r
    scale = np.abs(A).max(axis=1)
    x = np.linalg.solve(A / scale[:, None], b / scale)
    return {name: x[start : start + sizes[name]] for name, start in starts.items()}


@pytest.mark.parametrize("seed", range(60))
def test_maps_solve_the_equilibrium_equations(seed: int) -> None:
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, degenerate=seed % 3 == 0)
    response = respond(grasp)
    dz_r, dw = rng.normal(size=grasp.n_z) * 0.1, rng.normal(size=6) * [1, 1, 1, 0.03, 0.03, 0.03]
    x = equilibrium(grasp, dz_r, dw)
    ours = {
        "lambda": response.dlambda_dzr @ dz_r + response.dlambda_dw @ dw,
        "u": response.du_dzr @ dz_r + response.du_dw @ dw,
        "q": response.dq_dzr @ dz_r + response.dq_dw @ dw,
    }
    for name, value in ours.items():
        assert np.abs(value - x[name]).max() < 1e-8 * np.abs(x[name]).max(), name
    dz = response.dz_dzr @ dz_r - grasp.C_z @ grasp.S.T @ grasp.J.T @ response.dlambda_dw @ dw
    assert np.abs(dz - x["z"]).max() < 1e-8 * np.abs(x["z"]).max()
    assert np.allclose(response.dtau_dzr, grasp.J.T @ response.dlambda_dzr)
    assert np.allclose(response.dsigma_dzr, grasp.S.T @ response.dtau_dzr)


@pytest.mark.parametrize("seed", range(20))
def test_the_papers_x_and_y_give_the_same_maps(seed: int) -> None:
    grasp = random_grasp(np.random.default_rng(seed), compliances=("full", "full", "full"))
    response = respond(grasp)
    G, J, S = grasp.G, grasp.J, grasp.S
    K_q = np.linalg.inv(grasp.C_s + J @ grasp.C_q @ J.T)
    right = K_q @ G.T @ np.linalg.inv(G @ K_q @ G.T)
    P = (np.eye(grasp.n_l) - right @ G) @ K_q
    X = np.eye(grasp.n_q) - grasp.C_q @ J.T @ P @ J  # (24)
    Y = np.linalg.inv(np.eye(grasp.n_z) + grasp.C_z @ S.T @ J.T @ P @ J @ S)  # (25), corrected
    pairs = (
        (response.dq_dzr, X @ S @ Y),  # (26)
        (response.du_dzr, np.linalg.inv(G @ K_q @ G.T) @ G @ K_q @ J @ S @ Y),  # (27)
        (response.dlambda_dzr, P @ J @ S @ Y),  # (28)
        (response.dz_dzr, Y),
    )
    for ours, theirs in pairs:
        assert np.abs(ours - theirs).max() < 1e-9 * np.abs(theirs).max()


@pytest.mark.parametrize("seed", range(10))
def test_internal_forces_need_no_load_and_the_reaction_balances_it(seed: int) -> None:
    response = respond(random_grasp(np.random.default_rng(seed)))
    G, scale = response.grasp.G, response.scale
    assert np.abs(scale.wrench((G @ response.dlambda_dzr).T)).max() < 1e-11 * np.abs(response.dlambda_dzr).max()
    assert np.allclose(G @ response.right_inverse, np.eye(6), atol=1e-10)
    assert np.all(np.linalg.eigvalsh(response.du_dw) > 0)


@pytest.mark.parametrize("seed", range(30))
def test_dimensions_and_singular_values_do_not_depend_on_frame_or_units(seed: int) -> None:
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, degenerate=seed % 2 == 0)
    other = moved_frame(grasp, rng.normal(size=3) * 10.0 ** rng.integers(-2, 2), 1000.0, 1e-3)
    here, there = (subspaces(respond(g)) for g in (grasp, other))
    assert here.dimensions == there.dimensions
    for name in ("restraint", "redundancy", "rigid"):
        a, b = here.decisions[name].singular_values, there.decisions[name].singular_values
        assert np.allclose(a, b, atol=1e-9), name
    assert np.allclose(here.Gamma_zr @ here.Gamma_zr.T, there.Gamma_zr @ there.Gamma_zr.T, atol=1e-8)


@pytest.mark.parametrize("seed", range(10))
def test_references_do_not_depend_on_where_the_object_frame_is(seed: int) -> None:
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, degenerate=True)
    responses = [respond(g) for g in (grasp, moved_frame(grasp, np.array([0.3, -0.2, 0.5]), 1.0, 1.0))]
    spaces = [subspaces(r) for r in responses]
    dz_r = rng.normal(size=grasp.n_z)
    parts = [coordinates(r, s).coordinates(dz_r) for r, s in zip(responses, spaces, strict=True)]
    forces = [s.E_s @ alpha for s, (alpha, _, _) in zip(spaces, parts, strict=True)]
    assert np.allclose(forces[0], forces[1], atol=1e-9 * np.abs(forces[0]).max())
    followed = [s.Gamma_zcs @ beta for s, (_, beta, _) in zip(spaces, parts, strict=True)]
    assert np.allclose(followed[0], followed[1], atol=1e-9)


def pinch(kind: str) -> Grasp:
    contacts = tuple(
        Contact(
            name=name,
            kind=made_kind(kind, 0.5, 0.005 if kind == "soft" else 0.0),
            point=frozen(point),
            frame=contact_frame(normal),
        )
        for name, point, normal in (("left", [-0.02, 0, 0], [1, 0, 0]), ("right", [0.02, 0, 0], [-1, 0, 0]))
    )
    G = grasp_matrix(contacts)
    n = G.shape[1]
    return Grasp(
        title="pinch",
        contacts=contacts,
        G=G,
        J=frozen(np.eye(n)),
        S=frozen(np.eye(n)),
        C_s=frozen(1e-3 * np.eye(n)),
        C_q=frozen(np.zeros((n, n))),
        C_z=frozen(np.zeros((n, n))),
        lambda_0=None,
        w_0=frozen([0, 0, -1, 0.1, 0, 0]),
        joints=tuple(f"q{i}" for i in range(n)),
        synergies=tuple(f"z{i}" for i in range(n)),
    )


def test_two_hard_fingers_leave_the_rotation_about_their_line() -> None:
    with pytest.raises(NotRestrainedError, match="rotation about the line through left and right") as caught:
        respond(pinch("hard"))
    twist = caught.value.free_twists[:, 0]
    assert np.allclose(twist / twist[3], [0, 0, 0, 1, 0, 0], atol=1e-12)
    assert np.allclose(caught.value.unsupported, [0, 0, 0, 0.1, 0, 0], atol=1e-12)
    assert "no contact force can balance" in str(caught.value)


def test_two_soft_fingers_restrain() -> None:
    assert respond(pinch("soft")).restraint.rank == 6


def test_a_rigid_direction_is_named() -> None:
    grasp = pinch("soft")
    stiff = np.array(grasp.C_s)
    stiff[5, 5] = 0.0  # t of the right finger
    with pytest.raises(RigidContactError, match="component t of contact right") as caught:
        respond(replace(grasp, C_s=frozen(stiff)))
    assert (caught.value.contact, caught.value.component) == ("right", "t")


def test_a_rigid_combination_is_found_even_when_every_component_yields() -> None:
    grasp = pinch("soft")
    rank_deficient = np.array(grasp.C_s)
    rank_deficient[0, 4] = rank_deficient[4, 0] = 1e-3  # n of left and right yield only together
    with pytest.raises(RigidContactError, match="component n of contact"):
        respond(replace(grasp, C_s=frozen(rank_deficient)))


def test_joint_compliance_alone_is_enough() -> None:
    rng = np.random.default_rng(5)
    grasp = random_grasp(rng, ["hard", "hard", "hard"], n_q=9, n_z=4)
    soft = replace(grasp, C_s=frozen(np.zeros((9, 9))), C_q=compliance(rng, 9, 0.02, "full"))
    assert sum(subspaces(respond(soft)).dimensions) == 4


@pytest.mark.parametrize("seed", range(6))
def test_the_object_gives_way_to_its_load(seed: int) -> None:
    """Sag does positive work with the load, and is all that the load adds to the motion."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng)
    grasp = replace(grasp, w_0=frozen(rng.normal(size=6)))
    response = respond(grasp)
    dz_r, load = rng.normal(size=(3, grasp.n_z)), grasp.w_0 + rng.normal(size=(3, 6))
    loaded = forward(response, np.arange(3.0), dz_r, load)
    unloaded = forward(response, np.arange(3.0), dz_r, np.tile(grasp.w_0, (3, 1)))
    assert np.all(np.sum(loaded.sag * (load - grasp.w_0), axis=1) > 0)
    assert np.allclose(loaded.du - unloaded.du, loaded.sag)
    assert not np.any(unloaded.sag)
    assert np.allclose(loaded.torques, loaded.forces @ grasp.J)
    assert np.abs(response.scale.wrench(loaded.forces @ grasp.G.T + load)).max() < 1e-9 * np.abs(loaded.forces).max()


@pytest.mark.parametrize("seed", range(12))
def test_internal_forces_stay_internal_when_the_stiffness_is_ill_conditioned(seed: int) -> None:
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng)
    stiff = replace(
        grasp, C_s=frozen(2e-9 * np.eye(grasp.n_l)), C_q=frozen(0 * grasp.C_q), C_z=frozen(0.07 * np.eye(grasp.n_z))
    )
    response = respond(stiff)
    spaces = subspaces(response)
    wrench = response.scale.wrench((stiff.G @ response.dlambda_dzr).T)
    assert np.abs(wrench).max() < 1e-12 * np.abs(response.dlambda_dzr).max()
    assert np.abs(response.scale.wrench((stiff.G @ spaces.E_s).T)).max(initial=0.0) < 1e-13
    assert np.allclose(stiff.G @ response.right_inverse, np.eye(6), atol=1e-12)


@pytest.mark.parametrize("seed", range(12))
def test_rigid_motion_costs_no_force_on_small_objects_with_soft_contacts(seed: int) -> None:
    """A spin stiffness on a 5 mm object is 1 / L^2 times the others: the maps keep their digits all the same."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, ["hard", "soft", "hard", "soft"], n_q=8, n_z=6, degenerate=True)
    contacts = tuple(replace(c, point=frozen(c.point / 8)) for c in grasp.contacts)
    spin = np.array([1e-3 if c == "m" else 1.0 for _, c in grasp.components])
    small = replace(grasp, contacts=contacts, G=grasp_matrix(contacts), C_s=frozen(1e-4 * np.diag(spin)))
    small = replace(small, J=frozen(np.column_stack([small.J[:, :1], small.G.T @ rng.normal(size=6), small.J[:, 2:]])))
    response = respond(small)
    spaces = subspaces(response)
    assert spaces.Gamma_zcs.shape[1] > 0
    leak = response.scale.force[:, None] * (response.dlambda_dzr @ spaces.Gamma_zcs)
    JS = small.J @ small.S
    C = small.C_s + small.J @ small.C_q @ small.J.T + JS @ small.C_z @ JS.T
    terms = response.scale.force[:, None] * np.linalg.solve(C, JS @ spaces.Gamma_zcs)
    assert np.abs(leak).max() < 5e-13 * np.abs(terms).max()


@pytest.mark.parametrize("seed", range(4))
def test_the_largest_term_of_forces_counts_moments_over_the_length(seed: int) -> None:
    response = respond(random_grasp(np.random.default_rng(seed)))
    dz_r = np.random.default_rng(seed).normal(size=(3, response.grasp.n_z))
    terms = np.abs(dz_r) @ np.abs(response.dlambda_dzr).T
    assert largest_term(response, dz_r) == pytest.approx(response.scale.largest_force(terms), rel=1e-12)
    assert largest_term(response, 0 * dz_r) == 0
