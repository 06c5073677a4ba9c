"""A hand closed on an object at many places at once is where it is when it closes on each by itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, replace

import numpy as np
import pytest
from small_hands import hand_of, pad, slide, touching

from synergrip.errors import InputError
from synergrip.grasps.asked_grasp import AskedGrasp, asked_grasp
from synergrip.grasps.clearance import deepest, depth
from synergrip.grasps.closing import close
from synergrip.grasps.closing_at_many import ClosedAtMany, Closer
from synergrip.grasps.contact_at import ContactAt
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.grasps.objects import Box, Object, Shape, Sphere
from synergrip.grasps.pad_overlaps import overlap_notes, overlaps
from synergrip.grasps.place_search import (
    TouchingPlaces,
    around,
    at_stops,
    closed_and_centred,
    nearest,
    off_centre,
    space,
    touching_places,
)
from synergrip.hands.hand import Coupling, Hand, Pad
from synergrip.linalg import frozen

JAWS = (slide("left", "palm", (-0.05, 0, 0), (1, 0, 0)), slide("right", "palm", (0.05, 0, 0), (-1, 0, 0)))
ANY = frozen(np.zeros(3))
PADS = (pad("left/tip", "left_link"), pad("right/tip", "right_link"))


def asked_of(hand: Hand, shape: Shape | None, along: Sequence[float] | None, *pads: Pad) -> AskedGrasp:
    """Return what is to become a grasp by a small hand, from all joints at 0."""
    n = len(hand.joints)
    return AskedGrasp(
        title="", hand=hand, synergies=hand.synergy_sets["joints"], q=frozen(np.zeros(n)),
        closing=None if along is None else frozen(along), body=Object(mass=0.1, shape=shape), touches=touching(*pads),
        C_q=hand.C_q, C_z=frozen(np.zeros((n, n))),
    )  # fmt: skip


@pytest.fixture(scope="module")
def barrett() -> AskedGrasp:
    contacts = [ContactAt(f"finger{i}/tip", HardFinger(friction=0.6), stiffness=8e3) for i in (1, 2, 3)]
    body = Object(mass=0.2, shape=Sphere(radius=0.05))
    return asked_grasp("barrett", body, posture="open", close="close", contacts=contacts, anywhere=True)


def test_each_place_is_closed_on_as_by_itself(barrett: AskedGrasp) -> None:
    closer, rng = Closer(barrett), np.random.default_rng(3)
    positions = rng.uniform([-0.08, -0.07, 0.1], [0.08, 0.09, 0.22], (60, 3))
    found, seen = closer.closed(positions), 0
    assert 30 < len(found.q) < 60  # of the others a pad begins inside
    for position, q, touches in zip(found.positions, found.q, found.touching.all(axis=1), strict=True):
        body = barrett.at(position).body
        try:
            alone = close(barrett.hand, barrett.q, np.array(barrett.closing), body, barrett.touches)
        except InputError:
            assert not touches
            continue
        seen += 1
        assert q == pytest.approx(alone, abs=1e-4)
    assert 3 < seen < len(found.q)


def test_the_skeleton_is_inside_where_each_line_is(barrett: AskedGrasp) -> None:
    shape, position = Sphere(radius=0.05), np.array([[0.0, 0.003, 0.109], [0.0, 0.003, 0.3]])
    found = deepest(barrett.hand, np.tile(barrett.q, (2, 1)), shape, position, barrett.touches)
    knuckle, tip = (
        motion.position - position[0]
        for motion in barrett.hand.kinematics.at(
            barrett.q, [("finger1_inner_link", np.zeros(3)), ("finger1_base", np.zeros(3))]
        )
    )
    assert found[0] >= depth(shape, knuckle, tip) - 1e-3
    assert found[0] > 5e-4
    assert found[1] < 0


def test_a_gripper_of_one_motor_touches_in_its_middle_alone() -> None:
    """Both jaws stop at the first touch: from places all over, the object is moved to where they touch at once."""
    hand = hand_of(JAWS, couplings={"right": Coupling({"left": 1.0}, rigid=True)})
    closer = Closer(asked_of(hand, Box(size=(0.04, 0.03, 0.02)), (1, 1), *PADS))
    places, apart = space(closer)
    assert 1e-3 < apart < 0.02
    alone = closer.closed(places + 0.004)  # no place of these is in the middle
    assert not alone.touching.all(axis=1).any()
    found = touching_places(closer, closed_and_centred(closer, places + 0.004))
    assert len(found.q) > 10
    assert np.abs(found.positions[:, 0]).max() < 1e-3
    assert found.q[:, 0] == pytest.approx(found.q[:, 1], abs=1e-9)


def test_a_pad_that_does_not_move_says_where_the_object_can_be() -> None:
    hand = hand_of([*JAWS, slide("palm", "palm", (0, -0.02, 0), (0, 1, 0))])
    thumb = replace(pad("thumb", "palm_link"), normal=frozen([0.0, 1.0, 0.0]))
    closer = Closer(asked_of(hand, Sphere(radius=0.02), (1, 1, 0), *PADS, thumb))
    found = touching_places(closer, closed_and_centred(closer, space(closer)[0]))
    assert len(found.q) > 5
    assert np.linalg.norm(found.positions - [0, -0.02, 0], axis=1) == pytest.approx(0.02, abs=3e-5)
    assert np.all(found.q[:, 2] == 0)


def test_what_lacks_most_is_told_with_its_distance() -> None:
    hand = hand_of([slide("left", "palm", (-0.05, 0, 0), (1, 0, 0), upper=0.01),
                    slide("right", "palm", (0.05, 0, 0), (-1, 0, 0), upper=0.01)])  # fmt: skip
    closer = Closer(asked_of(hand, Sphere(radius=0.01), (1, 1), *PADS))
    found = closed_and_centred(closer, space(closer)[0])
    assert not len(touching_places(closer, found).q)
    place, issue = nearest(closer, found)
    assert issue.key == "object.position"
    gap = 0.08 - 0.02  # jaws that end 80 mm apart, around 20 mm
    touched, rest = sorted(np.abs(closer.seen(place[None], np.array([[0.01, 0.01]])).gaps[0]))
    assert touched < 1e-3
    assert rest < gap + 0.02
    assert "touches, " in issue.message
    assert f"stays {1e3 * rest:.3g} mm away" in issue.message


def test_places_where_pads_are_inside_each_other_are_none() -> None:
    """Two round pads side by side, 23 mm apart across, need 24 mm: only where one is farther than the other."""
    joints = [*JAWS, slide("third", "palm", (0.05, 0.023, 0), (-1, 0, 0))]
    tips = tuple(pad(f"{name}/tip", f"{name}_link", radius=0.012) for name in ("left", "right", "third"))
    asked = asked_of(hand_of(joints), Sphere(radius=0.035), (1, 1, 1), *(replace(tip, normal=ANY) for tip in tips))
    asked = replace(asked, touches=tuple(replace(touch, aimed=False) for touch in asked.touches))
    closer = Closer(asked)
    closed = closed_and_centred(closer, space(closer)[0])
    everywhere, found = closed.q[closed.touching.all(axis=1)], touching_places(closer, closed)
    before, after = (np.hypot(0.023, q[:, 1] - q[:, 2]) for q in (everywhere, found.q))
    assert before.min() < 0.0235
    assert len(after) > 3
    assert after.min() > 0.024 - 2.1e-5
    pairs, depths = overlaps(asked.hand, np.array([[0, 0.01, 0.01]]), asked.touches)
    assert pairs[int(np.argmax(depths))] == ("right/tip", "third/tip")
    assert depths.max() == pytest.approx(0.001, abs=1e-12)
    (note,) = overlap_notes(asked.hand, np.array([0, 0.01, 0.01]), asked.touches)
    assert "'right/tip' and 'third/tip' by 1 mm;" in note
    assert not overlap_notes(asked.hand, np.array([0, 0.01, 0.02]), asked.touches)
    worst = np.flatnonzero(closed.touching.all(axis=1))[np.argsort(before)[:1]]
    narrow = ClosedAtMany(*(getattr(closed, each.name)[worst] for each in fields(closed)))
    assert not len(touching_places(closer, narrow).q)
    assert "pads are inside each other; least at" in nearest(closer, narrow)[1].message


def test_places_where_two_pads_are_on_one_spot_are_none() -> None:
    twins = [JAWS[0], slide("twin", "palm", (-0.05, 5e-6, 0), (1, 0, 0))]
    tips = (pad("left/tip", "left_link"), pad("twin/tip", "twin_link"))
    asked = asked_of(hand_of(twins), Sphere(radius=0.02), (1, 1), *tips)
    closer = Closer(asked)
    found = closed_and_centred(closer, space(closer)[0])
    assert found.touching.all(axis=1).any()
    assert not len(touching_places(closer, found).q)
    assert "two of them are on the same spot of the ball r 20 mm" in nearest(closer, found)[1].message


def test_joints_that_closing_brings_to_their_stops_are_known() -> None:
    asked = asked_of(hand_of(JAWS), Sphere(radius=0.02), (1, -1), *PADS)  # from 0 to 100 mm, one closes downward
    q = np.array([[0.0, 0.05], [0.0995, 0.05], [0.05, 0.0005], [0.05, 0.1]])
    assert at_stops(asked, q).tolist() == [[False, False], [True, False], [False, True], [False, False]]


def test_a_hand_that_does_not_close_is_refused() -> None:
    for shape, along in ((Sphere(radius=0.02), None), (None, (1, 1))):
        with pytest.raises(InputError, match="found by a hand that closes"):
            Closer(asked_of(hand_of(JAWS), shape, along, *PADS))


def test_neighbours_stand_once_and_places_are_judged_by_the_middle_of_their_pads() -> None:
    near = around(np.array([[0.0, 0.0, 0.0], [0.01, 0.0, 0.0]]), 0.01)
    assert len(near) == 4 * 9
    asked = asked_of(hand_of(JAWS), Sphere(radius=0.02), (1, 1), *PADS)
    places = TouchingPlaces(np.array([[0.0, 0.003, 0.004]]), np.zeros((1, 2)), np.ones(1, dtype=bool))
    assert off_centre(asked, places) == pytest.approx([0.005])
