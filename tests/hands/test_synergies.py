import math
import re

import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.files import bundled
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import Coupling, Joint, SynergySet
from synergrip.hands.synergies.matrix import coupling_map, joint_posture, joint_vector, outside_limits, posture, resting
from synergrip.hands.synergies.select import select

DEG = math.pi / 180
ABCD = ("a", "b", "c", "d")


@pytest.fixture(scope="module")
def barrett():
    return load_hand("barrett")


@pytest.fixture(scope="module")
def actuated(tmp_path_factory):
    """The same hand without any synergy set of its own."""
    folder = tmp_path_factory.mktemp("actuated")
    source = bundled("models") / "hands" / "barrett"
    text = (source / "hand.toml").read_text(encoding="utf-8")
    (folder / "hand.toml").write_text(text[: text.index("[couplings]")], encoding="utf-8")
    (folder / "hand.urdf").write_bytes((source / "hand.urdf").read_bytes())
    return load_hand(folder)


def refused(call, *arguments):
    with pytest.raises(InputError) as caught:
        call(*arguments)
    (issue,) = caught.value.issues
    return issue.key, issue.message


def test_followers_take_their_value_from_the_driver():
    E, e = coupling_map(ABCD, {"c": Coupling({"a": 0.5}, 0.25)})
    np.testing.assert_array_equal(E @ [2, 3, 99, 5] + e, [2, 3, 1.25, 5])


def test_a_chain_of_followers_is_followed_to_its_driver_in_any_order():
    chain = {"d": Coupling({"c": -3}, 1), "c": Coupling({"a": 0.5}, 0.25)}
    for couplings in (chain, dict(reversed(chain.items()))):
        E, e = coupling_map(ABCD, couplings)
        np.testing.assert_allclose(E @ [2, 3, 99, 99] + e, [2, 3, 1.25, -3 * 1.25 + 1])


def test_a_joint_may_follow_several_others():
    E, e = coupling_map(ABCD, {"d": Coupling({"a": 2, "b": -1}, 0.5), "b": Coupling({"c": 3}, 0.1)})
    np.testing.assert_allclose(E, [[1, 0, 0, 0], [0, 0, 3, 0], [0, 0, 1, 0], [2, 0, -3, 0]])
    np.testing.assert_allclose(e, [0, 0.1, 0, 0.4])


@pytest.mark.parametrize(
    ("couplings", "key", "fragment"),
    [
        ({"x": Coupling({"a": 1})}, "x", "'x' is not one of 'a'"),
        ({"a": Coupling({"x": 1})}, "a.joint", "'x' is not one of 'a'"),
        ({"a": Coupling({"a": 1})}, "a.joint", "'a' would follow itself"),
        ({"a": Coupling({"b": 1}), "b": Coupling({"a": 1})}, "a.joint", "'a' would follow itself"),
        (
            {"c": Coupling({"a": 1}), "a": Coupling({"b": 1}), "b": Coupling({"a": 1})},
            "c.joint",
            "'a' would follow itself",
        ),
    ],
)
def test_couplings_that_lead_nowhere_are_refused(couplings, key, fragment):
    found, message = refused(coupling_map, ABCD, couplings)
    assert found == key
    assert fragment in message


def test_a_column_names_joints_that_are_driven():
    np.testing.assert_array_equal(joint_vector(ABCD, {"d": 2, "b": -1}, {}), [0, -1, 0, 2])
    assert refused(joint_vector, ABCD, {"e": 1}, {}) == ("e", "'e' is not one of 'a', 'b', 'c' or 'd'")
    key, message = refused(joint_vector, ABCD, {"c": 1}, {"c": Coupling({"a": 1})})
    assert (key, message) == ("c", "'c' follows 'a'; name that one only")


def test_in_a_posture_a_follower_follows_unless_it_is_named():
    couplings = {"c": Coupling({"a": 0.5}, 0.25)}
    np.testing.assert_array_equal(joint_posture(ABCD, {"a": 2}, couplings), [2, 0, 1.25, 0])
    np.testing.assert_array_equal(joint_posture(ABCD, {"a": 2, "c": 7}, couplings), [2, 0, 7, 0])


@pytest.mark.parametrize("wish", [None, "motors", 4, ["spread", "finger1", "finger2", "finger3"]])
def test_the_default_set_has_many_names(barrett, wish):
    chosen = select(barrett, wish)
    assert chosen.synergies == ("spread", "finger1", "finger2", "finger3")
    np.testing.assert_array_equal(chosen.S, barrett.synergy_sets["motors"].S)


@pytest.mark.parametrize("wish", ["all", "joints"])
def test_all_means_every_joint(barrett, wish):
    chosen = select(barrett, wish)
    np.testing.assert_array_equal(chosen.S, np.eye(8))
    assert chosen.synergies == barrett.joint_names


def test_a_number_takes_the_first_columns_and_names_take_theirs(barrett):
    S = barrett.synergy_sets["motors"].S
    np.testing.assert_array_equal(select(barrett, 2).S, S[:, :2])
    chosen = select(barrett, ("finger3", "spread"))
    assert chosen.synergies == ("finger3", "spread")
    np.testing.assert_array_equal(chosen.S, S[:, [3, 0]])
    assert chosen.effort_limits.shape == (2,)
    np.testing.assert_array_equal(select(barrett, ["close"]).S, S[:, 1:].sum(axis=1, keepdims=True))
    np.testing.assert_array_equal(select(barrett, ["finger3_spread"]).S[:, 0], np.eye(8)[5])


@pytest.mark.parametrize(
    ("wish", "key", "fragment"),
    [
        ("motor", "k", "did you mean 'motors'?"),
        ("nothing-like-it", "k", "'motors', 'close', 'joints' or 'all'"),
        (0, "k", "expected 1 to 4"),
        (5, "k", 'got 5; write "all" for the 8 joints'),
        (True, "k", "expected 1 to 4"),
        ([], "k", "at least one"),
        (["spread", "fingr1"], "k[1]", "did you mean 'finger1'"),
        (["spread", "spread"], "k[1]", "'spread' is listed twice"),
        (["finger1", "close"], "k", "no synergy set has all of finger1, close"),
    ],
)
def test_unknown_synergies_are_refused(barrett, wish, key, fragment):
    found, message = refused(select, barrett, wish, "k")
    assert found == key
    assert fragment in message


def test_a_hand_without_synergies_is_fully_actuated(actuated):
    assert select(actuated, None).name == "joints"
    np.testing.assert_array_equal(select(actuated, 3).S, np.eye(8)[:, :3])
    assert refused(select, actuated, 9, "k")[1] == "expected 1 to 8, the number of synergies of 'joints', got 9"


def test_a_posture_by_synergies_is_S_z(barrett):
    wish = {"spread": 60 * DEG, "finger2": 30 * DEG}
    expected = np.array([0, 0, 60, 30, 10, -60, 0, 0]) * DEG
    for chosen in (None, 1, "all", ["finger3"]):  # the names of the default set are known whatever is chosen
        np.testing.assert_allclose(posture(barrett, select(barrett, chosen), wish), expected, atol=1e-15)
    closing = posture(barrett, select(barrett, 4), {"close": 30 * DEG})
    np.testing.assert_allclose(closing, np.array([30, 10, 0, 30, 10, 0, 30, 10]) * DEG, atol=1e-15)


def test_a_posture_by_joints_or_by_name(barrett):
    chosen = select(barrett, None)
    by_joint = posture(barrett, chosen, {"finger1_inner": 30 * DEG, "finger2_inner": 30 * DEG, "finger2_outer": 0.0})
    np.testing.assert_allclose(by_joint, np.array([30, 10, 0, 30, 0, 0, 0, 0]) * DEG, atol=1e-15)
    np.testing.assert_array_equal(posture(barrett, chosen, "ball"), barrett.postures["ball"])


@pytest.mark.parametrize(
    ("wish", "key", "fragment"),
    [
        ("bal", "k", "did you mean 'ball'?"),
        ({}, "k", "at least one"),
        ({"spred": 1.0}, "k.spred", "did you mean 'spread'?"),
        ({"spread": 1.0, "finger1_inner": 1.0}, "k", "use one kind"),
        ({"finger1": 141 * DEG}, "k", "'finger1_inner' would be at 141 deg, outside 0 to 140 deg"),
        ({"finger1_outer": 49 * DEG}, "k", "'finger1_outer' would be at 49 deg, outside 0 to 48 deg"),
        ({"finger3_spread": 1 * DEG}, "k", "'finger3_spread' would be at 1 deg, outside -180 to 0 deg"),
        ({"finger1": math.nan}, "k", "would be at nan"),
    ],
)
def test_postures_the_hand_cannot_take_are_refused(barrett, wish, key, fragment):
    with pytest.raises(InputError, match=re.escape(fragment)) as caught:
        posture(barrett, select(barrett, None), wish, "k")
    assert caught.value.issues[0].key == key


def test_limits_are_told_in_the_unit_of_the_joint_and_reached_exactly():
    slide = Joint(name="rail", kind="slide", lower=0.0, upper=0.02, torque_limit=math.inf)
    hinge = Joint(name="turn", kind="hinge", lower=-1.0, upper=1.0, torque_limit=math.inf)
    assert outside_limits((slide, hinge), np.array([0.02, -1.0]), "k") == []
    (issue,) = outside_limits((slide, hinge), np.array([0.03, 0.0]), "k")
    assert issue.message == "joint 'rail' would be at 30 mm, outside 0 to 20 mm"


def test_at_rest_a_hand_is_at_the_offset_of_the_set_inside_its_ranges():
    joints = (
        Joint(name="a", kind="hinge", lower=-1.0, upper=1.0, torque_limit=math.inf),
        Joint(name="b", kind="hinge", lower=0.5, upper=math.inf, torque_limit=math.inf),
    )
    for offset, expected in (([0.2, 0.7], [0.2, 0.7]), ([3, 0], [1, 0.5]), ([-3, 1e9], [-1, 1e9])):
        chosen = SynergySet(
            name="s",
            title="",
            synergies=("z",),
            S=np.ones((2, 1)),
            offset=np.array(offset),
            effort_limits=np.full(1, math.inf),
        )
        np.testing.assert_array_equal(resting(joints, chosen), expected)
