"""The Barrett Hand closes on the ball that ships with it; directions by name."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.grasps.closing import close
from synergrip.grasps.closing_direction import closing_direction
from synergrip.grasps.objects import Object, Sphere
from synergrip.grasps.placing import Placed, place
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import SynergySet
from synergrip.hands.synergies.matrix import posture
from synergrip.linalg import Array, frozen
from synergrip.problems.problem import load_problem

HELD = load_problem("barrett-ball-hold").held
assert HELD is not None
HAND, BALL, TOUCHES, Q = HELD.hand, HELD.body, HELD.touches, HELD.q
MOTORS, CLOSE, JOINTS = (HAND.synergy_sets[name] for name in ("motors", "close", "joints"))
SPREAD = np.deg2rad(60.0)
BENT = {name: HAND.joint_names.index(f"{name}_inner") for name in ("finger1", "finger2", "finger3")}


def closed(q: Array, wish: str | dict[str, float], body: Object = BALL, synergies: SynergySet = MOTORS) -> Array:
    return close(HAND, q, closing_direction(HAND, synergies, wish), body, TOUCHES)


def placed(q: Array, body: Object) -> Placed:
    return place("test", HAND, MOTORS, q, body, TOUCHES, HAND.C_q, frozen(np.zeros((4, 4))))


@pytest.mark.parametrize("wish", ["close", {"finger1": 1.0, "finger2": 1.0, "finger3": 1.0},
                                  {"finger1": 0.2, "finger2": 1.0, "finger3": 0.7},
                                  {"finger1_inner": 3.0, "finger2_inner": 2.0, "finger3_inner": 1.0}])  # fmt: skip
def test_the_fingers_close_on_the_shipped_ball_in_the_shipped_posture(wish: str | dict[str, float]) -> None:
    """Each finger reaches the ball by itself, whatever the others do: the posture is that of the problem."""
    q = closed(HAND.postures["open"], wish)
    assert q == pytest.approx(Q, abs=1e-9)
    assert placed(q, BALL).gaps == pytest.approx([0, 0, 0], abs=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_from_any_open_posture_the_first_touch_on_the_way_is_found(seed: int) -> None:
    rng = np.random.default_rng(seed)
    values = {"spread": rng.uniform(0.7, 1.2), **{name: rng.uniform(0.0, 0.6) for name in BENT}}
    start = posture(HAND, MOTORS, values)
    ball = Object(
        title="ball",
        mass=0.2,
        position=frozen(BALL.position + rng.uniform(-4e-3, 4e-3, 3)),
        shape=Sphere(rng.uniform(0.046, 0.054)),
    )
    q = closed(start, {name: rng.uniform(0.2, 1.0) for name in BENT}, ball)
    grasp = placed(q, ball)
    assert grasp.gaps == pytest.approx([0, 0, 0], abs=1e-9)
    for contact in grasp.grasp.contacts:
        assert ball.shape is not None
        assert ball.shape.surface(contact.point)[0] == pytest.approx(0, abs=1e-9)
    assert all(joint.lower <= value <= joint.upper for joint, value in zip(HAND.joints, q, strict=True))
    assert q[[2, 5]] == pytest.approx([values["spread"], -values["spread"]], abs=1e-15)
    assert q[[1, 4, 7]] == pytest.approx(q[[0, 3, 6]] / 3, abs=1e-12)
    for share in np.linspace(0.0, 0.999, 60):  # fingers do not share a joint that closes: each has its own way
        motions = HAND.kinematics.at(start + share * (q - start), [(t.pad.link, t.pad.point) for t in TOUCHES])
        assert all(ball.shape.surface(motion.position - ball.position)[0] > 0 for motion in motions)


def test_a_spread_that_closes_too_stops_with_the_finger_that_touches() -> None:
    """Finger 2 and 3 turn about their spread axes while they bend; each stops as a whole."""
    q = closed(HAND.postures["open"], {"spread": 0.1, "finger1": 1.0, "finger2": 1.0, "finger3": 0.5})
    start = HAND.postures["open"]
    assert q[2] - start[2] == pytest.approx(0.1 * (q[3] - start[3]), abs=1e-12)
    assert q[5] - start[5] == pytest.approx(-0.2 * (q[6] - start[6]), abs=1e-12)
    assert placed(q, BALL).gaps == pytest.approx([0, 0, 0], abs=1e-9)


def test_opening_brings_every_finger_to_its_limit_and_says_so() -> None:
    with pytest.raises(InputError) as caught:
        closed(HAND.postures["open"], "-close")
    assert [issue.key for issue in caught.value.issues] == [f"contacts.at[{i}]" for i in range(3)]
    assert all("finger" in issue.message and "at its limit" in issue.message for issue in caught.value.issues)


def test_a_hand_that_has_closed_already_is_told_so() -> None:
    with pytest.raises(InputError, match=r"pad 'finger1/tip' is \S+ mm inside the ball r 50 mm before the hand closes"):
        closed(posture(HAND, MOTORS, {"spread": SPREAD, "finger1": 1.2, "finger2": 1.0, "finger3": 1.0}), "close")


# Directions


def columns(**weights: float) -> Array:
    return np.array([weights.get(name, 0.0) for name in HAND.joint_names])


@pytest.mark.parametrize(
    ("synergies", "wish", "expected"),
    [
        (MOTORS, "spread", columns(finger2_spread=1, finger3_spread=-1)),
        (MOTORS, "-spread", columns(finger2_spread=-1, finger3_spread=1)),
        (MOTORS, "finger1", columns(finger1_inner=1, finger1_outer=1 / 3)),
        (MOTORS, "finger1_inner", columns(finger1_inner=1, finger1_outer=1 / 3)),
        (MOTORS, "-finger1_outer", columns(finger1_outer=-1)),
        (JOINTS, {"finger1_inner": -2, "finger1_outer": 1}, columns(finger1_inner=-2, finger1_outer=1)),
        (JOINTS, "finger1_inner", columns(finger1_inner=1, finger1_outer=1 / 3)),
        (MOTORS, {"spread": 0.5, "finger1": -3}, columns(
            finger2_spread=0.5, finger3_spread=-0.5, finger1_inner=-3, finger1_outer=-1)),
    ],
)  # fmt: skip
def test_directions_by_name(synergies: SynergySet, wish: str | dict[str, float], expected: Array) -> None:
    direction = closing_direction(HAND, synergies, wish)
    assert direction == pytest.approx(expected, abs=1e-15)
    assert not direction.flags.writeable


def test_the_chosen_set_is_looked_up_first_and_offsets_do_not_count() -> None:
    own = replace(MOTORS, name="own", S=frozen(2 * MOTORS.S), offset=frozen(np.ones(8)))
    assert closing_direction(HAND, own, "spread") == pytest.approx(2 * closing_direction(HAND, MOTORS, "spread"))
    assert closing_direction(HAND, own, "close") == pytest.approx(closing_direction(HAND, CLOSE, "close"))


def test_a_name_that_begins_with_a_dash_is_a_name() -> None:
    own = replace(MOTORS, synergies=("-spread", "a", "b", "c"))
    assert closing_direction(HAND, own, "-spread")[2] == 1.0


@pytest.mark.parametrize(
    ("wish", "key", "fragment"),
    [
        ("clsoe", "close", "did you mean 'close'?"),
        ("-clsoe", "close", "did you mean 'close'?"),
        ("-", "close", "'-' is not one of 'spread'"),
        ({"finger1": 1, "fingr2": 1}, "close.fingr2", "did you mean 'finger2'?"),
        ({"finger1": 1, "finger1_inner": 1}, "close", "use one kind"),
        ({"finger1": 1, "close": 1}, "close", "two synergy sets"),
        ({"finger1": 0}, "close", "moves no joint"),
    ],
)
def test_directions_that_cannot_be(wish: str | dict[str, float], key: str, fragment: str) -> None:
    with pytest.raises(InputError) as caught:
        closing_direction(HAND, MOTORS, wish)
    (issue,) = caught.value.issues
    assert issue.key == key
    assert fragment in issue.message


def test_another_coupling_closes_otherwise() -> None:
    hand = load_hand("barrett", coupling=0.5)
    direction = closing_direction(hand, hand.synergy_sets["motors"], "finger1_inner")
    assert direction[:2] == pytest.approx([1.0, 0.5])
