"""What textbooks name of a grasp: closed forms, an implementation of plain NumPy, identities, frames and units."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from free_grasps import FORMS, free_grasp
from plain_properties import disagreements, same_space
from random_grasps import compliance, moved_frame, random_grasp
from scipy.linalg import null_space
from small_grasps import pinch, tripod

import synergrip as sg
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.statics.effects import ReferenceEffect
from synergrip.statics.grasp_properties import GraspProperties, grasp_properties

SMALL, HALF = 1e-3, 0.02
"""Compliance of each component of a pinch [m/N, rad/(N m)], and half of its width [m]."""


def dimensions(found: GraspProperties) -> dict[str, tuple[int, int]]:
    pairs = zip(found.of_joints.values(), found.of_synergies.values(), strict=True)
    return {joints.name: (joints.dimension, synergies.dimension) for joints, synergies in pairs}


def test_a_pinch_has_the_classes_stiffness_and_squeeze_of_its_closed_form() -> None:
    found = grasp_properties(pinch())
    assert dimensions(found) == {
        "redundant": (0, 0), "indeterminate": (0, 0), "graspable": (2, 2), "defective": (0, 7), "hyperstatic": (0, 1),
    }  # fmt: skip
    spin = found.of_synergies["hyperstatic"].basis[:, 0]  # each finger turns against the other
    assert spin[[3, 7]] == pytest.approx([HALF / np.sqrt(2)] * 2)
    assert np.abs(np.delete(spin, [3, 7])).max() < 1e-12
    bend = 2 * HALF**2 / SMALL
    assert found.stiffness == pytest.approx(np.diag([2 / SMALL] * 3 + [2 / SMALL, bend, bend]), abs=1e-9)
    values = {name: each.values for name, each in found.ellipsoids.items()}
    assert values["stiffness"] == pytest.approx([2 / SMALL / HALF**2] + [2 / SMALL] * 5)
    assert values["compliance in rotation"] == pytest.approx([1 / bend, 1 / bend, SMALL / 2])
    assert values["force by references"] == pytest.approx([np.sqrt(2) / SMALL])
    assert values["motion by references"].tolist() == [0.0]
    assert found.singularity["restraint"].smallest == pytest.approx(np.sqrt(2))
    assert found.singularity["restraint"].relative == pytest.approx(1.0)


def test_a_squeeze_is_pure_when_both_sides_yield_alike_and_else_spurious() -> None:
    pure = grasp_properties(pinch()).effects["pure squeeze"]
    assert pure.references == pytest.approx(np.array([[SMALL / np.sqrt(2)]]))
    assert (pure.dimension, grasp_properties(pinch()).effects["spurious squeeze"].dimension) == (1, 0)
    softer = grasp_properties(pinch(compliance=(1e-3, 3e-3))).effects
    spurious = softer["spurious squeeze"]
    assert (softer["pure squeeze"].dimension, spurious.dimension) == (0, 1)
    assert spurious.forces[[0, 4], 0] == pytest.approx([1 / np.sqrt(2)] * 2)
    moved = (3e-3 - 1e-3) / 2 / np.sqrt(2)  # toward the softer side, half the difference of what the contacts yield
    assert spurious.motions[:, 0] == pytest.approx([moved, 0, 0, 0, 0, 0], abs=1e-15)


def test_what_the_digits_of_the_data_leave_is_told_as_nothing_and_as_doubtful_in_between() -> None:
    """The matrices of this file have 12 digits; sides that differ by a millionth are a squeeze that hardly moves."""
    found = grasp_properties(sg.load_problem("tripod").grasp)
    assert found.ellipsoids["force by references"].values[2:].tolist() == [0.0, 0.0]
    assert found.ellipsoids["motion by references"].values[3] == 0.0
    assert found.singularity["motion by synergies"].smallest == 0.0
    assert not found.ambiguous
    for difference, pure, doubtful in ((1e-4, 0, False), (1e-6, 0, True), (1e-9, 1, True), (1e-12, 1, False)):
        near = grasp_properties(pinch(compliance=(1e-3, (1 + difference) * 1e-3)))
        assert (near.effects["pure squeeze"].dimension, near.ambiguous) == (pure, doubtful), difference


@pytest.mark.parametrize("below", [0.0, 0.4])
def test_three_fingers_around_a_ball(below: float) -> None:
    """Each of three contacts, equally stiff in all directions, adds as much: 3 k for translations, k r^2 for turns."""
    found, radius = grasp_properties(tripod(below=below)), 0.04
    out, down = radius * np.cos(below), radius * np.sin(below)
    about_z, about_x = 3 * out**2 / SMALL, (1.5 * out**2 + 3 * down**2) / SMALL
    assert found.stiffness[:3, :3] == pytest.approx(3 / SMALL * np.eye(3), abs=1e-9)
    assert found.stiffness[3:, 3:] == pytest.approx(np.diag([about_x, about_x, about_z]), abs=1e-12)
    assert dimensions(found)["graspable"] == (3, 3)


def test_an_object_that_is_free_to_move_is_indeterminate_and_yields_there_without_end() -> None:
    found = grasp_properties(sg.load_problem("pinch-hard").grasp)
    assert found.of_joints["indeterminate"].basis[:, 0] * HALF == pytest.approx([0, 0, 0, 1, 0, 0])
    assert found.compliance is None
    assert found.stiffness[3] == pytest.approx(np.zeros(6), abs=1e-12)
    assert (found.ellipsoids["stiffness"].values[-1], found.ellipsoids["compliance"].values[0]) == (0.0, np.inf)
    assert found.singularity["restraint"].smallest == 0.0
    assert "free" not in repr(found)


def test_table_two_is_what_its_dimensions_say() -> None:
    """The synergies of the Barrett hand cannot move the object, and squeeze with all that they have."""
    found = grasp_properties(sg.load_problem("table2-soft-motors").grasp)
    assert dimensions(found)["hyperstatic"] == (0, 2)  # 6 internal forces, of which 4 motors feel 4
    assert [each.dimension for each in found.effects.values()] == [0, 4, 0, 0]


def test_an_implementation_from_the_definitions_agrees() -> None:
    for seed in range(12):
        grasp = random_grasp(np.random.default_rng([3, seed]), degenerate=seed % 2 == 0)
        assert disagreements(grasp) == [], seed


@pytest.mark.parametrize("form", FORMS)
def test_of_an_object_that_is_free_to_move_all_else_is_told_as_the_definitions_have_it(form: str) -> None:
    for seed in range(3):
        grasp = free_grasp(np.random.default_rng([9, seed]), form)
        found = grasp_properties(grasp)
        assert found.of_joints["indeterminate"].dimension == FORMS[form]
        assert np.sum(np.isinf(found.ellipsoids["compliance"].values)) == FORMS[form]
        assert disagreements(grasp) == [], seed


@pytest.mark.parametrize("seed", range(6))
def test_references_do_what_their_effects_say(seed: int) -> None:
    grasp = random_grasp(np.random.default_rng([4, seed]), degenerate=True)
    found = grasp_properties(grasp)
    response, scale = found.analysis.response, found.analysis.response.scale
    for effect in found.effects.values():
        forces, motions = response.dlambda_dzr @ effect.references, response.du_dzr @ effect.references
        assert np.abs(forces - effect.forces).max(initial=0.0) < 1e-9 * np.abs(response.dlambda_dzr).max()
        assert np.abs(motions - effect.motions).max(initial=0.0) < 1e-9 * max(np.abs(response.du_dzr).max(), 1.0)
    squeezes = np.hstack([found.effects[f"{name} squeeze"].forces for name in ("pure", "spurious")])
    scaled = scale.force[:, None] * squeezes
    assert scaled.T @ scaled == pytest.approx(np.eye(squeezes.shape[1]), abs=1e-9)
    for ellipsoid in (found.ellipsoids["motion by references"], found.ellipsoids["force by references"]):
        made = response.du_dzr if ellipsoid.formula == "U" else response.dlambda_dzr
        difference = made @ ellipsoid.references - ellipsoid.axes * ellipsoid.values
        assert np.abs(difference).max() < 1e-8 * np.abs(made).max()


@pytest.mark.parametrize("pure", [0, 1, 2])
def test_synergies_that_push_along_internal_forces_squeeze_purely(pure: int) -> None:
    """With contacts equally stiff and nothing else that yields, the object follows range(G') and feels no null(G)."""
    rng = np.random.default_rng([7, pure])
    grasp = random_grasp(rng, ["hard"] * 4, n_q=8, n_z=4)
    internal = null_space(grasp.G)
    along = grasp.G.T @ rng.normal(size=(6, 1))
    mixed = internal @ rng.normal(size=(6, 3 - pure)) + grasp.G.T @ rng.normal(size=(6, 3 - pure))
    JS = np.hstack([internal @ rng.normal(size=(6, pure)), mixed, along])
    J = np.hstack([JS, rng.normal(size=(12, 4))])
    made = replace(grasp, J=frozen(J), S=frozen(np.eye(8, 4)), C_s=frozen(1e-3 * np.eye(12)),
                   C_q=frozen(np.zeros((8, 8))), C_z=frozen(np.zeros((4, 4))))  # fmt: skip
    effects = grasp_properties(made).effects
    assert [each.dimension for each in effects.values()] == [pure, 3 - pure, 1, 0]
    assert same_space(np.linalg.qr(effects["pure squeeze"].references)[0], np.eye(4)[:, :pure])


@pytest.mark.parametrize("seed", range(4))
def test_frame_and_units_change_nothing_but_units(seed: int) -> None:
    rng = np.random.default_rng([5, seed])
    grasp = random_grasp(rng, degenerate=seed % 2 == 0)
    length, force = 1000.0, 1e-3
    here, there = (grasp_properties(g) for g in (grasp, moved_frame(grasp, rng.normal(size=3), length, force)))
    assert dimensions(here) == dimensions(there)
    factors = {"stiffness": force / length, "compliance": length / force, "motion by references": length,
               "force by references": force}  # fmt: skip
    for name, factor in factors.items():
        values = factor * here.ellipsoids[name].values
        assert there.ellipsoids[name].values == pytest.approx(values, rel=1e-6, abs=1e-7 * values[0]), name
    for name, distance in here.singularity.items():
        assert there.singularity[name].relative == pytest.approx(distance.relative, abs=1e-9), name


def test_a_compliant_finger_makes_the_object_softer_and_a_stiff_one_nothing_else() -> None:
    """Springs in series: what contacts, joints and synergies yield adds up."""
    grasp = pinch()
    series = replace(grasp, C_q=compliance(np.random.default_rng(0), 8, 2e-3, "scalar"))
    assert grasp_properties(series).stiffness == pytest.approx(grasp_properties(grasp).stiffness / 3)


@pytest.mark.parametrize("of", ["grasp", "analysis"])
def test_a_grasp_or_its_analysis_may_be_asked(of: str) -> None:
    grasp = tripod()
    asked: Callable[[Grasp], object] = sg.analyse if of == "analysis" else lambda each: each
    found = grasp_properties(asked(grasp))  # type: ignore[arg-type]
    assert found.effects["redundant motion"].dimension == 0
    assert all(isinstance(each, ReferenceEffect) and each.source and each.unit for each in found.effects.values())
