"""A hand that is posed is where its joints say, and what synergies add is taken back whole."""

from __future__ import annotations

import math
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from small_hands import hand_of, hinge, pad, slide, touching

from synergrip.grasps.asked_grasp import AskedGrasp, grasp_of
from synergrip.grasps.objects import Box, Object, Sphere
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import Coupling, Hand
from synergrip.hands.models.urdf_balls import Ball, balls_of
from synergrip.hands.spots import rest_posture, spots_of
from synergrip.hands.synergies.matrix import posture as posture_of
from synergrip.linalg import frozen
from synergrip.problems.hand_table import HandTable
from synergrip.problems.unplaced import unplaced_problem
from synergrip.reports.pictures.view import axes_apart, best_view, view_from
from synergrip.reports.text.text_grasp import _held_lines
from synergrip.reports.text.text_spots import balls_lines, spots_table
from synergrip.reports.view.labels import HIGH, apart
from synergrip.reports.view.looks import plain, table_of
from synergrip.reports.view.marks import axes_length, pad_axes
from synergrip.reports.view.posed import Posed
from synergrip.reports.view.posing import Posing, posture_line
from synergrip.reports.view.shown import hand_shown, problem_shown

ORIGIN = np.zeros(3)


@pytest.fixture(scope="module")
def barrett() -> Hand:
    return load_hand("barrett")


def begun(hand: Hand) -> Posing:
    return Posing.at(hand, next(iter(hand.synergy_sets.values())), hand.postures["open"], np.zeros(3))


def test_a_joint_goes_where_it_is_turned_and_its_followers_follow(barrett: Hand) -> None:
    posing = begun(barrett).with_synergy(1, 0.1).with_joint(0, 1.2)
    assert posing.q[0] == pytest.approx(1.2)
    assert posing.q[1] == pytest.approx(0.4)  # the outer joint follows by a third
    alone = posing.with_joint(1, 0.5)  # its clutch lets go
    assert alone.q[:2] == pytest.approx([1.2, 0.5])
    assert alone.q[2:] == pytest.approx(barrett.postures["open"][2:])


def test_a_synergy_that_is_turned_back_takes_nothing_along(barrett: Hand) -> None:
    first = begun(barrett)
    S = first.synergies.S
    assert first.with_synergy(2, 0.3).q == pytest.approx(first.q + 0.3 * S[:, 2])
    far = first.with_synergy(1, 9.0)
    assert far.q[0] == barrett.joints[0].upper
    assert far.with_synergy(1, 0.0).q == pytest.approx(first.q)
    other = far.with_set(barrett.synergy_sets["joints"])
    assert other.q == pytest.approx(far.q)
    assert not other.dz.any()


def test_synergies_that_are_the_joints_have_no_dials_of_their_own(barrett: Hand) -> None:
    assert list(hand_shown(barrett).sets) == ["motors", "close"]
    assert list(hand_shown(load_hand("robonaut")).sets) == ["eigengrasps"]  # "free" are joints that take others along
    alone = hand_shown(hand_of([hinge("a", "palm", (0, 0, 0)), hinge("b", "a_link", (0.1, 0, 0))]))
    assert (alone.sets, alone.begin.synergies.synergies) == ({}, ("a", "b"))
    on_joints = unplaced_problem("barrett-ball-hold", ["hand.synergies=joints"]).asked
    assert problem_shown(on_joints, None, None).begin.synergies.name == "motors"


def test_axes_are_seen_and_no_longer_than_goes_with_a_small_hand(barrett: Hand) -> None:
    for hand, long in ((barrett, 3.5 * 6.1e-3), (load_hand("human"), 0.12 * 0.109)):
        scene = Posed(hand).scene(rest_posture(hand), np.zeros(3))
        assert axes_length(scene) == pytest.approx(long, rel=0.02)
    assert axes_length(replace(scene, thickness=0.02)) == 0.04
    assert axes_length(replace(scene, links=scene.links * 0, pads=scene.pads * 0)) == 3.5 * scene.thickness


def test_dials_are_in_the_units_of_people_and_end_where_joints_do(barrett: Hand) -> None:
    posing = begun(barrett)
    inner = posing.joint_dials()[0]
    assert (inner.unit, inner.factor * inner.lower, inner.factor * inner.upper) == ("deg", 0, pytest.approx(140))
    for i, dial in enumerate(posing.synergy_dials()):
        for end in (dial.lower, dial.upper):
            assert np.any(np.isclose(posing.with_synergy(i, 1.001 * end).q, posing.with_synergy(i, end).q) & (
                posing.synergies.S[:, i] != 0
            ))  # fmt: skip
    free = hand_of(
        [hinge("turn", "palm", (0, 0, 0), (-math.inf, math.inf)), slide("out", "turn_link", (0, 0, 0), (1, 0, 0))]
    )
    dials = begun(replace(free, postures={"open": frozen([0.0, 0.0])})).joint_dials()
    assert [dial.unit for dial in dials] == ["deg", "mm"]
    assert (dials[0].lower, dials[0].upper) == (-math.pi, math.pi)
    tied = replace(free, couplings={"out": Coupling({"turn": 0.01}, rigid=True)}, postures={"open": frozen([0.0, 0.0])})
    assert [dial.follows for dial in begun(tied).joint_dials()] == [False, True]


def test_a_frame_is_where_the_kinematics_says(barrett: Hand) -> None:
    q, posed = barrett.postures["ball"], Posed(barrett)
    frame = posed.frame(q, np.zeros(3))
    for spot, place, pushing in zip(spots_of(barrett, q), frame.pads, frame.pushing, strict=False):
        assert place == pytest.approx(spot.position, abs=1e-12)
        assert pushing == pytest.approx(spot.normal, abs=1e-12)
    for link, place, turned in zip(barrett.links, frame.links, frame.turned, strict=True):
        (motion,) = barrett.kinematics.at(q, [(link, np.zeros(3))])
        assert place == pytest.approx(motion.position, abs=1e-12)
        assert turned == pytest.approx(motion.rotation, abs=1e-12)
    axes = pad_axes(np.vstack([frame.pushing, np.zeros(3)]))
    assert axes[:-1, :, 0] == pytest.approx(frame.pushing)
    assert np.linalg.det(axes) == pytest.approx(np.ones(len(axes)))
    assert len(table_of(posed.scene(q, np.zeros(3)), frame).splitlines()) == 2 + len(barrett.pads) + len(barrett.links)


def test_contacts_are_where_the_object_is_nearest_and_say_how_far() -> None:
    hand = hand_of([slide("left", "palm", (-0.05, 0, 0), (1, 0, 0))])
    touches = touching(pad("tip", "left_link", radius=0.004))
    posed = Posed(hand, Object(shape=Sphere(radius=0.02)), touches, frozen([0.0, -9.81, 0.0]))
    frame = posed.frame(np.array([0.01]), np.array([0.0, 0.0, 0.0]))
    assert frame.places == pytest.approx(np.array([[-0.02, 0, 0]]))
    assert frame.normals == pytest.approx(np.array([[1.0, 0, 0]]))
    assert (frame.labels, frame.caption) == (("tip 16 mm away",), "0 of 1 contacts touch")
    assert frame.up == pytest.approx([0, 1, 0])
    assert posed.frame(np.array([0.026]), np.zeros(3)).labels == ("tip touches",)
    assert posed.frame(np.array([0.03]), np.zeros(3)).labels == ("tip 4 mm inside",)
    bare = Posed(hand, Object(mass=0.1), touches).frame(np.array([0.0]), np.zeros(3))
    assert "no shape" in bare.caption


def test_fingers_without_pads_end_in_their_last_links(barrett: Hand) -> None:
    bare = replace(barrett, pads={})
    spots = spots_of(bare, rest_posture(bare))
    assert [spot.name for spot in spots] == ["finger1_tip", "finger2_tip", "finger3_tip"]
    assert not any(spot.pad for spot in spots)
    assert all(spot.normal is None for spot in spots)
    assert "no pads" in hand_shown(bare).notes[0]
    told = spots_table(spots).splitlines()
    assert [line.split()[:2] for line in told[1:-1]] == [["(frame)", spot.link] for spot in spots]
    assert "often its tip" in told[-1]  # no joint moves it: a frame that the file puts there
    hinged = hand_of([hinge("a", "palm", (0, 0, 1)), hinge("b", "a_link", (1, 0, 0))])
    told = spots_table(spots_of(hinged, np.zeros(2))).splitlines()
    assert told[1].startswith("(origin)")
    assert "not its tip" in told[-1]


def test_a_posture_is_written_as_the_file_takes_it(barrett: Hand) -> None:
    posing = begun(barrett).with_joint(0, 0.5).with_joint(1, 0.7)
    line = posture_line(posing)
    written = tomllib.loads(line)["posture"]
    assert len(written) == sum(not dial.follows for dial in posing.joint_dials())
    q = posture_of(barrett, posing.synergies, HandTable(model="barrett", posture=written).posture, "posture")
    assert q == pytest.approx(posing.q, abs=1e-4)
    tied = hand_of(
        [slide(n, "palm", (0, 0, 0), (1, 0, 0)) for n in "ab"], couplings={"b": Coupling({"a": 1.0}, rigid=True)}
    )
    assert posture_line(Posing.at(tied, next(iter(tied.synergy_sets.values())), np.zeros(2), ORIGIN)) == (
        'posture = { a = "0 mm" }'
    )
    odd = hand_of([hinge("a b.c", "palm", (0, 0, 1))])
    assert '"a b.c" = "0 deg"' in posture_line(
        Posing.at(odd, next(iter(odd.synergy_sets.values())), np.zeros(1), ORIGIN)
    )


def test_labels_are_not_over_each_other() -> None:
    camera, up = (np.array([1.0, 0, 0]), np.zeros(3)), np.array([0.0, 0, 1])
    places = np.array([[0.0, 0, 0], [0, 0.01, 0.001], [0, 0.8, 0], [0, 0, 0.5]])
    found = apart(places, ["thumb 3 N", "index 3 N", "far", "high"], camera, up)
    assert found[1:] == pytest.approx(places[1:])
    assert found[0] == pytest.approx([0, 0, places[1, 2] - HIGH])


def test_no_two_axes_of_the_palm_lie_on_each_other() -> None:
    """Of a hand that is flat along y the view along x shows most, and there y would point down as z points up."""
    for azimuth in range(0, 360, 5):
        view = view_from(np.radians(azimuth), np.radians(28))
        flat = view.flat(np.eye(3))
        angles = np.degrees(np.arctan2(flat[:, 1], flat[:, 0]))
        near = [abs((angles[i] - angles[j] + 180) % 360 - 180) for i, j in ((0, 1), (0, 2), (1, 2))]
        assert axes_apart(view) == (min(near) > 15)
    flat_hand = np.random.default_rng(1).normal(size=(40, 3)) * [1.0, 0.01, 1.0]
    assert not axes_apart(best_view(flat_hand, ()))
    assert axes_apart(best_view(flat_hand, (), clear=axes_apart))


def test_a_last_link_with_a_contact_is_no_other_pad() -> None:
    hand = hand_of([slide(name, "palm", (0, 0, 0), (way, 0, 0)) for name, way in (("a", -1.0), ("b", 1.0), ("c", 1.0))])
    touches = touching(pad("left", "a_link"), pad("right", "b_link"))
    touches = [replace(touch, aimed=False, pad=replace(touch.pad, normal=frozen([0.0, 0.0, 0.0]))) for touch in touches]
    asked = AskedGrasp(
        title="", hand=hand, synergies=hand.synergy_sets["joints"], q=frozen([0.02, 0.02, 0.02]), closing=None,
        body=Object(mass=0.1, shape=Sphere(0.02), position=frozen(np.zeros(3))), touches=tuple(touches), C_q=hand.C_q,
        C_z=frozen(np.zeros((3, 3))),
    )  # fmt: skip
    grasp = grasp_of(asked)
    assert grasp.held is not None
    others = "\n".join(_held_lines(grasp.held, grasp)).split("no contact at")[1]
    assert "c_link" in others
    assert "a_link" not in others


def test_balls_that_a_urdf_has_on_last_links_are_told_as_pads(tmp_path: Path) -> None:
    link = '<link name="{}"><{}><origin xyz="{}"/><geometry><sphere radius="{}"/></geometry></{}></link>'
    parts = [
        ("a", "collision", "0 0 0.01", "0.012"), ("b", "visual", "0 0 0.01", "0.012"),
        ("c", "collision", "0 0", "0.01"), ("d", "collision", "0 0 0", "nan"), ("e", "visual", "0 0 0", "0.01"),
    ]  # fmt: skip
    (tmp_path / "h.urdf").write_text(f"<robot>{''.join(link.format(*p, p[1]) for p in parts)}</robot>")
    balls = balls_of(str(tmp_path / "h.urdf"), "abcd")
    assert balls == dict.fromkeys("ab", Ball(0.012, (0.0, 0.0, 0.01)))
    told = " ".join(" ".join(balls_lines(balls)).split())
    assert "a, b: a ball of radius 12 mm at (0, 0, 10) mm" in told
    assert 'link = "a", point = ["0 mm", "0 mm", "10 mm"], radius = "12 mm" }]' in told
    assert balls_of(str(tmp_path / "h.xml"), "abcd") == balls_of("", "a") == {}


def unplaced(*overrides: str) -> AskedGrasp:
    return unplaced_problem("human-glass", list(overrides)).asked


def test_a_problem_that_is_no_grasp_is_shown_with_what_it_lacks() -> None:
    shown = problem_shown(unplaced("hand.posture=open"), None, (0, 0, -9.81), ["thumb: too far"])
    assert shown.notes == ("thumb: too far",)
    assert shown.begin.position == pytest.approx([-0.01237, 0.06449, -0.042])
    assert shown.closed is None
    auto = unplaced("hand.posture=open", "hand.close={pc1=1}", "object.position=auto")
    nowhere = problem_shown(auto, None, None)
    assert "nobody knows where the object is" in nowhere.notes[0]
    assert nowhere.closed is not None
    assert next(iter(nowhere.sets)) == auto.synergies.name


def test_names_of_the_user_stay_text() -> None:
    assert plain("<b>|`x`|\n# y") == "\\<b\\>\\|\\`x\\`\\| \\# y"


def test_an_object_of_flat_faces_is_drawn() -> None:
    hand = hand_of([slide("left", "palm", (-0.05, 0, 0), (1, 0, 0))])
    posed = Posed(hand, Object(shape=Box(size=(0.02, 0.02, 0.02))), touching(pad("tip", "left_link")))
    scene = posed.scene(np.zeros(1), np.zeros(3))
    assert scene.frame(0).places == pytest.approx(np.array([[-0.01, 0, 0]]))
    assert scene.friction == pytest.approx([0.5])
