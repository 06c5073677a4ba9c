"""The classical figures: closed forms, independent hulls, and what the synergies leave of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from random_grasps import random_grasp
from scipy.optimize import linprog, minimize
from scipy.spatial import ConvexHull
from second_disturbances import unscaled
from second_wrench_space import EDGES, edge_wrenches
from small_grasps import pinch, tripod

import synergrip as sg
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import frozen, split
from synergrip.margin.wrench_space.controlled_wrenches import controlled_figures
from synergrip.margin.wrench_space.quality import Contacts


def closing(rng: np.random.Generator) -> Grasp:
    """A random grasp of hard fingers that has force closure."""
    while True:
        grasp = random_grasp(rng, ["hard"] * 4)
        if ConvexHull(edge_wrenches(grasp, EDGES)).equations[:, -1].max() < -0.01:
            return grasp


@pytest.mark.parametrize("seed", range(2))
def test_pyramids_have_the_epsilon_and_volume_of_an_independent_hull(seed: int) -> None:
    rng = np.random.default_rng([3, seed])
    grasp = closing(rng)
    found, points = sg.wrench_space_quality(grasp, edges=EDGES), edge_wrenches(grasp, EDGES)
    independent = ConvexHull(points)
    assert found.epsilon_pyramids[0] == pytest.approx(-independent.equations[:, -1].max(), rel=1e-9)
    assert found.volume[0] >= independent.volume * (1 - 1e-9)
    fine = ConvexHull(edge_wrenches(grasp, 3 * EDGES))
    assert found.epsilon_pyramids[0] <= found.epsilon[0] * (1 + 1e-6) <= found.epsilon[1] * (1 + 2e-6)
    assert found.epsilon[1] <= found.epsilon_pyramids[1]
    assert -fine.equations[:, -1].max() <= found.epsilon[1]
    assert fine.volume <= found.volume[1]
    normals = rng.normal(size=(200, 6))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    own = Contacts.of(sg.analyse(grasp).response)
    assert min(own.farthest(normal)[1] for normal in normals) >= found.epsilon[0]
    for normal in normals[:5]:  # what is in the ball is made of the edges of fine pyramids, by a linear program
        edges = edge_wrenches(grasp, 3 * EDGES)
        answer = linprog(np.zeros(len(edges)), A_eq=np.vstack([edges.T, np.ones(len(edges))]),
                         b_eq=np.append(0.98 * found.epsilon[0] * normal, 1.0))  # fmt: skip
        assert answer.status == 0


def test_a_pinch_of_soft_fingers_is_as_good_as_its_spin() -> None:
    """Spin by one finger, nu / L of the normal force; where spin is strong, the plane 2 u = mu (2 - 2 u^2)^(1/2)."""
    weak, strong = (sg.wrench_space_quality(pinch(0.5, nu), each=nu < 0.01) for nu in (0.005, 0.05))
    assert weak.epsilon[0] <= 0.25 <= weak.epsilon[1]
    assert strong.epsilon[0] <= 1 / 3 <= strong.epsilon[1]
    assert weak.epsilon[1] - weak.epsilon[0] < 0.02 * 0.25
    # both share a spin, and the finger that a force along their line unloads has less: |m| / nu + |f| <= 1
    shared = 1 / np.hypot(1.0, 0.02 / 0.005)
    assert weak.epsilon_synergies[0] <= shared <= weak.epsilon_synergies[1] * (1 + 1e-6)
    assert weak.epsilon_synergies[0] > 0.94 * weak.epsilon_synergies[1]
    assert strong.epsilon_each is None
    assert weak.epsilon_each is not None
    # each presses with 1: both spin, and a force along their line that takes one of them away, |m| / nu + |f| <= 2
    assert weak.epsilon_each[0] <= 2 * shared
    assert weak.epsilon_each[0] > 0.93 * weak.epsilon_each[1]
    assert weak.singular_values == pytest.approx([np.sqrt(2)] * 6)
    assert weak.isotropy == pytest.approx(1.0)


def test_each_normal_force_alone_is_the_support_of_a_sum() -> None:
    """L-infinity: the least of ``sum max(0, n + mu |(t, o)|)`` over unit wrenches, by another optimiser's descent."""
    rng = np.random.default_rng(13)
    grasp = closing(rng)
    found, inverse = sg.wrench_space_quality(grasp, each=True), np.linalg.inv(unscaled(grasp))
    arms = [inverse @ np.vstack([np.eye(3), np.cross(c.point, np.eye(3)).T]) @ c.frame for c in grasp.contacts]

    def support(along: np.ndarray) -> float:
        parts = [arm.T @ (along / np.linalg.norm(along)) for arm in arms]
        pairs = zip(parts, grasp.contacts, strict=True)
        return float(sum(max(0.0, n + c.friction * np.hypot(t, o)) for (n, t, o), c in pairs))

    starts = sorted(rng.normal(size=(300, 6)), key=support)[:6]
    least = min(minimize(support, start, method="Nelder-Mead", options={"maxiter": 3000}).fun for start in starts)
    assert found.epsilon_each is not None
    assert found.epsilon_each_synergies is not None
    assert found.epsilon_each[0] <= least * (1 + 1e-9)
    assert found.epsilon_each[1] == pytest.approx(least, rel=0.02)
    assert found.epsilon[0] <= found.epsilon_each[1]
    assert found.epsilon_each[0] <= len(grasp.contacts) * found.epsilon[1]
    held = found.epsilon_each_synergies
    assert held[0] <= found.epsilon_each[1]
    assert found.epsilon_synergies[0] <= held[1]


def test_three_fingers_on_a_sphere_have_the_singular_values_of_their_arms() -> None:
    """G G' is 3 for forces, the sum of L^2 I - r r' over L^2 for moments: 3/2, 3/2 and 3."""
    found = sg.wrench_space_quality(tripod())
    assert found.singular_values == pytest.approx(np.sqrt([3, 3, 3, 3, 1.5, 1.5]))
    assert (found.smallest_singular_value, found.isotropy) == (pytest.approx(np.sqrt(1.5)), pytest.approx(np.sqrt(0.5)))
    # a force along z by three fingers together, each with all its friction: no more than mu; a supporting plane
    assert found.epsilon[1] <= 0.8


def test_where_there_is_no_ball_it_is_said_why() -> None:
    flat = sg.wrench_space_quality(sg.load_problem("pinch-hard").grasp)
    assert (flat.epsilon, flat.epsilon_synergies, flat.volume) == ((0.0, 0.0), (0.0, 0.0), (0.0, 0.0))
    assert "flat" in flat.why
    below = sg.wrench_space_quality(tripod(mu=0.2, below=0.6))  # fingers that only lift
    assert below.epsilon == pytest.approx((0.0, 0.0), abs=1e-5)  # what is not quite 0 is not known to be anything
    assert "force closure" in below.why
    stuck = pinch()
    idle = sg.wrench_space_quality(replace(stuck, S=frozen(np.eye(8)[:, [1]])))  # a synergy that does not squeeze
    assert idle.epsilon[0] > 0
    assert idle.epsilon_synergies == (0.0, 0.0)
    assert "synergies" in idle.why


@pytest.mark.parametrize("seed", range(2))
def test_synergies_cost_and_all_internal_forces_cost_nothing(seed: int) -> None:
    rng = np.random.default_rng([7, seed])
    grasp = closing(rng)
    found, response = sg.wrench_space_quality(grasp), sg.analyse(grasp).response
    whole = controlled_figures(response, split(response.grasp.G).null_space)
    assert whole.epsilon[0] <= found.epsilon[1] * (1 + 1e-6)
    assert found.epsilon[0] <= whole.epsilon[1] * (1 + 1e-6)
    assert found.epsilon_synergies[0] <= found.epsilon[1] * (1 + 1e-6)
    assert whole.volume <= found.volume[1]


def test_figures_do_not_depend_on_the_frame_or_the_size() -> None:
    grasp = tripod()
    grown = tuple(replace(each, point=frozen(3 * each.point + np.array([0.1, 0.2, 0.0]))) for each in grasp.contacts)
    here, there = sg.wrench_space_quality(grasp), sg.wrench_space_quality(
        replace(grasp, contacts=grown, G=grasp_matrix(grown))
    )  # fmt: skip
    assert there.length == pytest.approx(3 * here.length)
    assert there.singular_values == pytest.approx(here.singular_values)
    assert there.epsilon_pyramids == pytest.approx(here.epsilon_pyramids, rel=1e-6)


def test_edges_and_grasps_that_are_none_are_refused() -> None:
    for arguments, key in (({"grasp": None}, "grasp"), ({"edges": 2}, "edges"), ({"edges": 4.5}, "edges")):
        with pytest.raises(sg.InputError) as error:
            sg.wrench_space_quality(**{"grasp": pinch(), **arguments})  # type: ignore[arg-type]
        assert error.value.issues[0].key == key
