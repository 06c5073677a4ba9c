"""Pictures: what is drawn is the geometry and the forces of the program, and the same values give the same bytes."""

from __future__ import annotations

import math
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from grasps.test_objects import EVERY
from random_grasps import random_grasp
from scipy.spatial.transform import Rotation

from synergrip.errors import InputError
from synergrip.grasps.objects import Box, Cylinder, Shape, Sphere, Turned
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import Hand, SynergySet
from synergrip.linalg import Array, frozen
from synergrip.problems.problem import load_problem
from synergrip.reports.pictures.bearings import round_length
from synergrip.reports.pictures.contact_colors import COLORS
from synergrip.reports.pictures.depth import Depth, darkened, faded
from synergrip.reports.pictures.effects import effects, squeeze_shares
from synergrip.reports.pictures.forces import ContactForces, contact_forces, places_known
from synergrip.reports.pictures.free_places import apart, distances, free_places
from synergrip.reports.pictures.grasp_synergies import draw_grasp_synergies
from synergrip.reports.pictures.layout import Columns, fitted, window
from synergrip.reports.pictures.motions import motions
from synergrip.reports.pictures.scene import arrows, spin_arcs
from synergrip.reports.pictures.sheet import Sheet, svg_text, write_picture
from synergrip.reports.pictures.skeleton import skeleton
from synergrip.reports.pictures.solids import outline
from synergrip.reports.pictures.steps import DEGREE, LARGEST_TURN, MILLIMETRE, PLAIN, SHARE, steps, unit_of
from synergrip.reports.pictures.synergies import draw_synergies
from synergrip.reports.pictures.variance import draw_variance
from synergrip.reports.pictures.view import best_view, view_from
from synergrip.statics.analysis import Analysis, analyse

SVG = "{http://www.w3.org/2000/svg}"
PROBLEMS = ["table2-hard-motors", "table2-soft-motors", "barrett-ball-hold"]
VIEW = view_from(0.4, 0.6)


@pytest.fixture(scope="module")
def barrett() -> Hand:
    return load_hand("barrett", relative_to=None)


def analysed(name: str, *overrides: str) -> Analysis:
    return analyse(load_problem(name, overrides).grasp)


def texts(path: Path) -> list[str]:
    """The texts of an SVG file, in its order."""
    return ["".join(node.itertext()) for node in ElementTree.parse(path).iter(f"{SVG}text")]


# The hand


def test_bones_join_the_origins_of_links(barrett: Hand) -> None:
    q = np.random.default_rng(0).uniform(0.1, 1.0, 8)
    found = skeleton(barrett, q, list(barrett.pads.values()))

    def origin(link: str) -> Array:
        return barrett.kinematics.at(q, [(link, np.zeros(3))])[0].position

    expected = [(origin(parent), origin(link)) for link, parent in barrett.parents.items()]
    expected = [pair for pair in expected if not np.array_equal(*pair)]
    assert np.allclose(found.bones, expected, rtol=0, atol=1e-15)
    pads = [barrett.kinematics.at(q, [(pad.link, pad.point)])[0].position for pad in barrett.pads.values()]
    assert np.array_equal(found.pads, pads)
    assert np.array_equal(found.palm[0], np.zeros(3))
    assert len(found.palm) == 4


def test_bones_keep_their_lengths(barrett: Hand) -> None:
    rng = np.random.default_rng(1)
    first, second = (skeleton(barrett, rng.uniform(0, 1.5, 8), ()).bones for _ in range(2))
    lengths = [np.linalg.norm(bones[:, 1] - bones[:, 0], axis=1) for bones in (first, second)]
    assert np.allclose(*lengths, rtol=0, atol=1e-12)
    assert not np.allclose(first, second, atol=1e-3)


def test_a_bone_leads_to_the_pad_of_a_last_link(barrett: Hand) -> None:
    pad = replace(barrett.pads["finger1/tip"], point=frozen([0.01, 0.0, 0.0]))
    longer = replace(barrett, pads={"finger1/tip": pad, "finger1/pad": barrett.pads["finger1/pad"]})
    q = barrett.postures["ball"]
    found, plain = skeleton(longer, q, [pad]), skeleton(barrett, q, ())
    assert len(found.bones) == len(plain.bones) + 1
    assert np.array_equal(found.bones[-1, 1], found.pads[0])
    assert np.linalg.norm(found.bones[-1, 1] - found.bones[-1, 0]) == pytest.approx(0.01)


# Its motion


@pytest.mark.parametrize("name", ["motors", "close", "joints"])
def test_a_step_moves_the_hand_by_about_its_share(barrett: Hand, name: str) -> None:
    q, pads = barrett.postures["ball"], list(barrett.pads.values())
    moved = motions(barrett, barrett.synergy_sets[name], q, pads, 15)
    points = moved.rest.points
    size = np.linalg.norm(points[:, None] - points[None], axis=-1).max()
    assert len(moved.each) == len(barrett.synergy_sets[name].synergies)
    for each in moved.each:
        for there in (each.on, each.back):
            assert np.linalg.norm(there.points - points, axis=1).max() == pytest.approx(SHARE * size, rel=0.15)
        middle = (each.on.points + each.back.points) / 2  # to first order the posture itself
        assert np.linalg.norm(middle - points, axis=1).max() < 0.2 * SHARE * size


def with_kinds(hand: Hand, kinds: Sequence[str]) -> Hand:
    return replace(hand, joints=tuple(replace(j, kind=k) for j, k in zip(hand.joints, kinds, strict=True)))


def test_steps_are_in_the_units_of_the_joints_they_move(barrett: Hand) -> None:
    mixed = with_kinds(barrett, ["slide", "hinge"] * 4)
    assert unit_of(mixed, np.eye(8)[0]) is MILLIMETRE
    assert unit_of(mixed, np.eye(8)[1]) is DEGREE
    assert unit_of(mixed, np.ones(8)) is PLAIN
    q = barrett.postures["ball"]
    hinges = steps(barrett, barrett.synergy_sets["motors"], q)
    assert [step.text for step in hinges] == ["+13 deg", "+7 deg", "+7 deg", "+7 deg"]
    assert hinges[0].value == pytest.approx(math.radians(13))
    for step in steps(mixed, columns(np.eye(8)[:, ::2]), q):
        number, unit = step.text.split()
        assert unit == "mm"
        assert float(number) == pytest.approx(1e3 * step.value)


def columns(S: Array) -> SynergySet:
    names = tuple(f"s{i + 1}" for i in range(S.shape[1]))
    return SynergySet(
        name="made",
        title="",
        synergies=names,
        S=frozen(S),
        offset=frozen(np.zeros(len(S))),
        effort_limits=frozen(np.full(S.shape[1], math.inf)),
    )


def test_a_turn_in_place_has_a_largest_step_and_nothing_has_none(barrett: Hand) -> None:
    motionless = replace(barrett, pads={}, parents={"palm": "nothing"})
    motionless = replace(motionless, kinematics=_Still())
    turn, none = steps(motionless, columns(np.array([[1.0] + [0] * 7, [0.0] * 8]).T), np.zeros(8))
    assert turn.value == pytest.approx(LARGEST_TURN)
    assert (none.value, none.text) == (0.0, "")
    shift = steps(with_kinds(motionless, ["slide"] * 8), columns(np.eye(8)[:, :1]), np.zeros(8))[0]
    assert shift.value == 0
    moved = motions(barrett, columns(np.zeros((8, 1))), barrett.postures["ball"], (), 15)
    assert moved.each[0].title == "s1  moves nothing"


class _Still:
    """A hand whose points stand still whatever the joints do."""

    def at(self, q: Array, points: Sequence[tuple[str, Array]]) -> tuple[object, ...]:
        plain = load_hand("barrett", relative_to=None).kinematics.at(q, [("palm", np.zeros(3))])[0]
        return tuple(replace(plain, jacobian=frozen(np.zeros((6, 8)))) for _ in points)


# The view


@pytest.mark.parametrize(("azimuth", "elevation"), [(0.0, 0.0), (1.0, 0.5), (-2.0, 1.2)])
def test_a_view_is_a_parallel_projection(azimuth: float, elevation: float) -> None:
    view = view_from(azimuth, elevation)
    axes = np.column_stack([view.right, view.up, view.toward])
    assert np.allclose(axes.T @ axes, np.eye(3), atol=1e-15)
    assert np.linalg.det(axes) == pytest.approx(1)
    assert view.flat(np.array([0.0, 0.0, 1.0])) == pytest.approx([0.0, math.cos(elevation)])
    point = np.array([0.3, -0.2, 0.5])
    assert np.linalg.norm([*view.flat(point), view.depth(point)]) == pytest.approx(np.linalg.norm(point))


def test_the_best_view_does_not_look_along_a_motion() -> None:
    cloud = np.random.default_rng(2).normal(size=(50, 3))
    for azimuth in np.linspace(0, 2 * np.pi, 17):
        along = np.array([[math.cos(azimuth), math.sin(azimuth), 0.0]])
        view = best_view(cloud, [along])
        assert np.linalg.norm(view.flat(along)) > 0.8
        assert view.toward[2] > 0
        assert best_view(cloud[::-1], [along]).toward == pytest.approx(view.toward)


def test_another_direction_may_be_up() -> None:
    up = np.array([0.6, 0.0, -0.8])
    view = view_from(0.7, 0.5, up)
    axes = np.column_stack([view.right, view.up, view.toward])
    assert np.allclose(axes.T @ axes, np.eye(3), atol=1e-15)
    assert view.flat(up) == pytest.approx([0.0, math.cos(0.5)])


def test_what_is_near_is_thicker_and_less_faint() -> None:
    points = np.array([[0.0, 0.0, 0.0], VIEW.toward])
    depth = Depth.of(VIEW, points)
    far, near = (depth.drawn(point[None], "#204060", 2.0) for point in points)
    assert far[1] < 2.0 < near[1]
    assert near[0] == "#204060"
    assert far[0] == faded("#204060", 0.5)
    assert (faded("#204060", 1.0), darkened("#204060", 1.0)) == ("#ffffff", "#000000")


@pytest.mark.parametrize("seed", range(5))
def test_numbers_stand_free_of_arrows_and_of_each_other(seed: int) -> None:
    rng = np.random.default_rng(seed)
    anchors = 3 * rng.normal(size=(5, 2))
    lines = [np.array([anchor, anchor + rng.normal(size=2)]) for anchor in anchors]
    places = free_places(anchors, rng.normal(size=(5, 2)), lines, 0.4)
    assert np.linalg.norm(places - anchors, axis=1) == pytest.approx(0.4)
    for number, place in enumerate(places):
        others = [*lines, *(other[None] for k, other in enumerate(places) if k != number)]
        assert min(float(distances(place[None], line)[0]) for line in others) > 0.15


def test_names_below_each_other_keep_their_order_and_distance() -> None:
    moved = apart(np.array([0.0, 5.0, 0.1, 0.05]), 1.0)
    assert list(np.argsort(moved)) == [0, 3, 2, 1]
    assert np.diff(np.sort(moved)).min() > 0.99
    assert moved.mean() == pytest.approx(1.2875)


@pytest.mark.parametrize(("most", "found"), [(0.0631, 0.05), (0.05, 0.05), (0.019, 0.01), (0.9, 0.5), (0.0021, 0.002)])
def test_a_bar_is_a_round_length(most: float, found: float) -> None:
    assert round_length(most) == pytest.approx(found)


# Solids


TURNED = Turned(Box((0.03, 0.05, 0.08)), Rotation.from_rotvec([0.3, -0.8, 0.4]).as_matrix())
SHAPES: dict[str, Shape] = {
    "sphere": Sphere(0.03), "box": Box((0.03, 0.05, 0.08)), "cylinder": Cylinder(0.02, 0.09), "turned": TURNED
}  # fmt: skip


def shadow(shape: Shape) -> float:
    """The area of the parallel projection of a solid along the view, as a formula."""
    if isinstance(shape, Turned):
        x, y, z = np.abs(shape.rotation.T @ VIEW.toward)
    else:
        x, y, z = np.abs(VIEW.toward)
    match shape:
        case Sphere(radius):
            return math.pi * radius**2
        case Cylinder(radius, height):
            return math.pi * radius**2 * z + 2 * radius * height * math.hypot(x, y)
        case Box((a, b, c)) | Turned(Box((a, b, c))):
            return x * b * c + y * a * c + z * a * b
    raise AssertionError


@pytest.mark.parametrize("name", SHAPES)
def test_outlines_have_the_area_of_the_shadow(name: str) -> None:
    x, y = outline(SHAPES[name], VIEW).T
    area = abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) / 2
    assert area == pytest.approx(shadow(SHAPES[name]), rel=5e-3)


@pytest.mark.parametrize("shape", [*EVERY, TURNED], ids=lambda shape: shape.title)
def test_lines_run_on_the_surface_within_the_outline(shape: Shape) -> None:
    drawn = shape.lines()
    assert drawn
    edge = outline(shape, VIEW)
    for angle in np.linspace(0, 2 * np.pi, 73):  # no point is farther out than the outline, in any direction
        direction = np.array([math.cos(angle), math.sin(angle)])
        reach = max(float((VIEW.flat(line) @ direction).max()) for line in drawn)
        assert reach <= (edge @ direction).max() + 1e-12
    for line in drawn:
        assert max(abs(shape.surface(point)[0]) for point in line) < 1e-15


# Forces


def wrench(found: ContactForces, normals: Array) -> Array:
    """Force and moment about B."""
    moments = np.cross(found.points, found.forces) + found.spins[:, None] * normals
    return np.concatenate([found.forces.sum(axis=0), moments.sum(axis=0)])


@pytest.mark.parametrize("seed", range(10))
def test_forces_in_space_are_those_that_the_grasp_matrix_sees(seed: int) -> None:
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, [str(k) for k in rng.choice(["hard", "soft", "frictionless"], size=6)])
    values = rng.normal(size=grasp.n_l)
    normals = np.array([contact.frame[:, 0] for contact in grasp.contacts])
    assert wrench(contact_forces(grasp.contacts, values), normals) == pytest.approx(grasp.G @ values)


@pytest.mark.parametrize("name", [*PROBLEMS, "tripod", "pinch-soft", "barrett-ball-lift-joints"])
def test_what_is_drawn_are_internal_forces_that_balance(name: str) -> None:
    analysis = analysed(name)
    grasp = analysis.grasp
    found = effects(analysis, [DEGREE] * grasp.n_z)
    normals = np.array([contact.frame[:, 0] for contact in grasp.contacts])
    for k, effect in enumerate(found):
        assert effect.name == grasp.synergies[k]
        assert np.allclose(wrench(effect.forces, normals), 0, atol=1e-9 * max(effect.forces.largest, 1e-300))
        for row, contact, force in zip(grasp.rows, grasp.contacts, effect.forces.forces, strict=True):
            expected = math.radians(1) * contact.frame @ analysis.response.dlambda_dzr[row, k][:3]
            assert np.allclose(force, expected, rtol=0, atol=1e-7 * effect.forces.largest + 1e-10)


@pytest.mark.parametrize("stiffness", ["8 N/mm", "0.3 N/mm"])
def test_the_paper_says_which_synergies_generate_no_internal_force(stiffness: str) -> None:
    analysis = analysed("table2-hard-motors", f"contacts.stiffness={stiffness}")
    found = effects(analysis, [DEGREE] * 4)
    assert found[0].titles == ("no internal force", "it moves no contact")
    assert not np.any(found[0].forces.forces)
    assert all(effect.forces.largest > 0.1 for effect in found[1:])
    only = effects(analysed("table2-hard-motors", "hand.synergies=1"), [DEGREE])
    assert only[0].titles == ("no internal force", "it moves no contact")


def test_shares_are_one_for_a_squeeze_and_none_for_a_rigid_motion() -> None:
    shares = squeeze_shares(analysed("tripod").response)
    assert shares[0] == pytest.approx(1)
    assert np.array_equal(shares[1:3], [0, 0])
    titles = [effect.titles for effect in effects(analysed("tripod"), [PLAIN] * 4)]
    assert titles[1] == ("no internal force", "the object follows it rigidly")
    assert titles[0] == ("up to 10 N for dz_r = 0.01", "100% of its contact motion squeezes")


@pytest.mark.parametrize("seed", range(10))
def test_shares_do_not_depend_on_compliances_units_or_the_place_of_b(seed: int) -> None:
    grasp = random_grasp(np.random.default_rng(seed), ["soft"] * 3, degenerate=True)
    shares = squeeze_shares(analyse(grasp).response)
    softer = replace(grasp, C_s=frozen(3 * np.eye(grasp.n_l)), S=frozen(grasp.S * 50))
    assert squeeze_shares(analyse(softer).response) == pytest.approx(shares, rel=1e-9, nan_ok=True)
    forces = analyse(grasp).response.dlambda_dzr
    silent = np.linalg.norm(forces, axis=0) < 1e-8 * np.linalg.norm(forces)
    assert np.array_equal(silent, ~(shares > 0))


def test_arrows_are_proportional_to_the_forces() -> None:
    found = effects(analysed("barrett-ball-hold"), [DEGREE] * 4)[1].forces
    drawn = arrows(found, 0.05)
    assert np.linalg.norm(drawn, axis=1).max() == pytest.approx(0.05)
    assert drawn * (found.largest / 0.05) == pytest.approx(found.forces)
    nothing = replace(found, forces=frozen(np.zeros((3, 3))))
    assert not np.any(arrows(nothing, 0.05))


def test_spin_arcs_turn_about_the_normal_as_far_as_the_moment_is_large() -> None:
    analysis = analysed("table2-soft-motors")
    contacts = analysis.grasp.contacts
    found = replace(effects(analysis, [DEGREE] * 4)[0].forces, spins=frozen([2.0, -1.0, 0.001]))
    arcs = spin_arcs(contacts, found, 0.01)
    turns = []
    assert [index for index, _ in arcs] == [0, 1]  # the third moment is too small to be seen
    for contact, (_, arc) in zip(contacts[:2], arcs, strict=True):
        arms = arc - contact.point
        assert np.linalg.norm(arms, axis=1) == pytest.approx(0.01)
        assert arms @ contact.frame[:, 0] == pytest.approx(0, abs=1e-15)
        sines = np.cross(arms[:-1], arms[1:]) @ contact.frame[:, 0] / 0.01**2
        turns.append(np.arcsin(sines).sum())
    assert turns[0] == pytest.approx(1.5 * math.pi)
    assert turns[1] == pytest.approx(-turns[0] / 2)


def test_an_arrow_on_paper_is_as_long_as_its_vector(tmp_path: Path) -> None:
    """Read back from the file: from its tail to its tip, in the units of the panel."""
    vectors = np.array([[0.03, 0.01], [-0.02, 0.04], [0.0, -0.05]])
    path = tmp_path / "arrows.svg"

    def draw(sheet: Sheet) -> None:
        panel = sheet.panel(0.0, 0.0, 4.0, 4.0, np.zeros(2), 0.2)
        panel.arrows(np.zeros((3, 2)), vectors, "black")

    write_picture(path, 4.0, 4.0, draw)
    root = ElementTree.parse(path).getroot()
    group = next(node for node in root.iter(f"{SVG}g") if node.get("id", "").startswith("Quiver"))
    scale = 4.0 * 72 / 0.2  # points for each unit of the panel
    found = []
    for node in group.iter(f"{SVG}path"):
        corners = np.array(re.findall(r"-?[\d.]+(?:e-?\d+)?", node.get("d", "")), dtype=float).reshape(-1, 2)
        corners = (corners - 4.0 * 72 / 2) * [1, -1] / scale
        found.append(corners[np.argmax(np.linalg.norm(corners, axis=1))])
    assert np.array(found) == pytest.approx(vectors, abs=1e-6)


def test_places_are_known_when_they_account_for_the_grasp_matrix() -> None:
    grasp = load_problem("tripod").grasp
    assert places_known(grasp)
    assert not places_known(replace(grasp, G=frozen(np.vstack([grasp.G[:3], grasp.G[3:] * 1.1]))))


# Layout


@pytest.mark.parametrize(("count", "blocks", "across"), [(1, 1, 1), (5, 1, 5), (6, 2, 3), (8, 2, 4), (15, 3, 5)])
def test_columns_wrap_evenly_inside_the_sheet(count: int, blocks: int, across: int) -> None:
    found = Columns(count)
    assert (found.blocks, found.across) == (blocks, across)
    places = [found.place(index) for index in range(count)]
    assert len(set(places)) == count
    assert {block for block, _ in places} == set(range(blocks))
    assert all(left > 0 and left + 2.7 < found.width for _, left in places)


def test_a_window_holds_its_points() -> None:
    points = np.random.default_rng(3).normal(size=(40, 2)) * [3, 1]
    shown = window(points)
    half = np.array([shown.span, shown.span * shown.height / 2.7]) / 2
    assert np.all(np.abs(points - shown.middle) < half)


def test_texts_are_broken_into_lines() -> None:
    text = " ".join(["word"] * 60)
    assert " ".join(fitted(text, 5.0, 10.0)) == text
    assert len(fitted(text, 5.0, 10.0)) > len(fitted(text, 10.0, 10.0)) > 1


# Files


@pytest.mark.parametrize("name", PROBLEMS)
def test_figure_three_of_the_paper(name: str, tmp_path: Path) -> None:
    problem, path = load_problem(name), tmp_path / "figure.svg"
    analysis = analyse(problem.grasp)
    draw_grasp_synergies(problem, analysis, path)
    written = texts(path)
    steps_taken = steps(problem.held.hand, problem.held.synergies, problem.held.q)
    for step, effect in zip(steps_taken, effects(analysis, [DEGREE] * 4), strict=True):
        assert f"{effect.name}  {step.text}" in written
        assert set(effect.titles) <= set(written)
    dims = "dim E_s {}, dim Γ_ucs {}, dim Γ_zr {}".format(*analysis.spaces.dimensions)
    notes = " ".join(written)
    assert dims in notes
    for word in (problem.title, "contacts 0.125 mm/N", "1 finger1/tip 2 finger2/tip", "synergies 0"):
        assert word in notes
    for number in range(1, analysis.grasp.n_c + 1):
        assert written.count(str(number)) == 4  # beside its contact, for every synergy
        assert COLORS[number - 1] in path.read_text()
    assert set("xyzg") <= set(written)
    assert [text for text in written if re.fullmatch(r"(hand|forces) [125]0* mm", text)]
    assert ("arcs: their spin moments" in notes) == (name == "table2-soft-motors")
    arrows_drawn = ElementTree.parse(path).iter(f"{SVG}g")
    groups = [node for node in arrows_drawn if node.get("id", "").startswith("Quiver")]
    assert len(groups) == 4 + 4  # of the synergies, the axes and gravity


def test_a_grasp_given_as_matrices_shows_its_forces(tmp_path: Path) -> None:
    problem, path = load_problem("tripod"), tmp_path / "figure.svg"
    draw_grasp_synergies(problem, analyse(problem.grasp), path)
    written = texts(path)
    assert [f"z{k}" for k in range(1, 5)] == [text for text in written if re.fullmatch(r"z\d", text)]
    assert written.count("no internal force") == 2
    assert not [text for text in written if "iolet" in text]


def test_matrices_that_do_not_say_where_the_contacts_are(tmp_path: Path) -> None:
    problem = load_problem("tripod")
    grasp = replace(problem.grasp, G=frozen(np.vstack([problem.grasp.G[:3], problem.grasp.G[3:] * 1.1])))
    with pytest.raises(InputError, match="give their point_m and normal"):
        draw_grasp_synergies(problem, analyse(grasp), tmp_path / "figure.svg")
    assert not list(tmp_path.iterdir())


def test_more_synergies_than_there_is_room_for(barrett: Hand, tmp_path: Path) -> None:
    path, q = tmp_path / "many.svg", barrett.postures["ball"]
    draw_synergies(barrett, columns(np.random.default_rng(4).normal(size=(8, 17))), q, path)
    titles = [text for text in texts(path) if re.match(r"s\d+  \+", text)]
    assert [title.split()[0] for title in titles] == [f"s{k}" for k in range(1, 17)]
    assert "The first 16 of 17 synergies are drawn." in " ".join(texts(path))


def test_synergies_of_a_hand(barrett: Hand, tmp_path: Path) -> None:
    path = tmp_path / "hand.svg"
    draw_synergies(barrett, barrett.synergy_sets["close"], barrett.postures["ball"], path)
    written = texts(path)
    told = [text for text in written if text not in ("x", "y", "z")]
    assert told[:2] == [barrett.title, barrett.synergy_sets["close"].title]
    assert [text.split()[0] for text in told[2:4]] == ["spread", "close"]
    assert "50 mm" in told


def test_explained_variance(tmp_path: Path) -> None:
    path = tmp_path / "variance.svg"
    draw_variance(np.array([0.6, 0.25, 0.1, 0.05]), path, "Four synergies")
    written = texts(path)
    assert "Four synergies" in written
    for total in ("60", "85", "95", "100"):
        assert total in written
    draw_variance(np.full(40, 1 / 40), path, "Forty")
    assert texts(path).count("2.5") == 0


def digest(path: Path) -> bytes:
    problem = load_problem("table2-soft-motors")
    draw_grasp_synergies(problem, analyse(problem.grasp), path)
    return path.read_bytes()


@pytest.mark.parametrize("suffix", [".svg", ".png", ".pdf"])
def test_the_same_values_give_the_same_bytes(suffix: str, tmp_path: Path) -> None:
    first = digest(tmp_path / f"a{suffix}")
    kept = dict(matplotlib.rcParams)
    with matplotlib.rc_context({"font.family": "serif", "lines.linewidth": 9, "svg.hashsalt": "other"}):
        assert digest(tmp_path / f"b{suffix.upper()}") == first
    assert dict(matplotlib.rcParams) == kept
    magic = {".svg": b"<?xml", ".png": b"\x89PNG", ".pdf": b"%PDF"}
    assert first.startswith(magic[suffix])


def test_another_process_draws_the_same_without_a_screen(tmp_path: Path) -> None:
    code = """
import sys
from pathlib import Path
from synergrip.problems.problem import load_problem
from synergrip.statics.analysis import analyse
from synergrip.reports.pictures.grasp_synergies import draw_grasp_synergies
assert "matplotlib" not in sys.modules
problem = load_problem("table2-soft-motors")
draw_grasp_synergies(problem, analyse(problem.grasp), Path("there.svg"))
assert "matplotlib.pyplot" not in sys.modules
"""
    environment = {**os.environ, "PYTHONHASHSEED": "7"}
    environment.pop("DISPLAY", None)
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=environment, check=True)
    assert (tmp_path / "there.svg").read_bytes() == digest(tmp_path / "here.svg")


def test_titles_are_text_whatever_stands_in_them(tmp_path: Path) -> None:
    path, title = tmp_path / "title.svg", "5 $ for_x^2 & <b> 手 $\a"
    draw_variance(np.array([1.0]), path, title)
    assert title.removesuffix("\a") in texts(path)
    draw_variance(np.array([1.0]), path.with_suffix(".png"), title)


@pytest.mark.parametrize("name", ["picture", "picture.jpg", "picture.svg.gz"])
def test_a_suffix_that_says_no_format(name: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"'\.svg', '\.png' or '\.pdf'"):
        draw_variance(np.array([1.0]), tmp_path / name, "")
    assert not list(tmp_path.iterdir())


def test_an_error_while_drawing_leaves_what_was_there(tmp_path: Path) -> None:
    path = tmp_path / "kept.svg"
    path.write_text("kept", encoding="utf-8")

    def draw(sheet: Sheet) -> None:
        raise RuntimeError

    with pytest.raises(RuntimeError):
        write_picture(path, 2.0, 2.0, draw)
    assert [file.read_text(encoding="utf-8") for file in tmp_path.iterdir()] == ["kept"]


def test_a_picture_in_a_page_does_not_repeat_what_nobody_sees_and_keeps_its_words() -> None:
    word = "a \u202e  'DejaVu Sans', of my own, sans-serif"
    text = svg_text(2.0, 1.0, lambda sheet: sheet.write(0.1, 0.5, word))
    (family,) = re.findall(r"font-family: ([^;\"]*)", text)
    assert family == "'DejaVu Sans', 'Verdana', sans-serif"
    assert f">{word}<" in text
    assert "\n <" not in text
