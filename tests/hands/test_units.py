"""Values of joints that slide are lengths and forces, those of joints that turn angles and torques."""

from __future__ import annotations

import copy
import pickle
import re
from pathlib import Path

import numpy as np
import pytest

from synergrip.documents.fields import Measured, either, unit_schema
from synergrip.errors import InputError
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.synergies.matrix import posture
from synergrip.hands.units import list_misfits, misfits, synergy_kinds, unit_of
from synergrip.linalg import frozen

DEG = np.pi / 180
URDF = """<robot name="r">
  <link name="palm"/><link name="jaw"/><link name="thumb"/><link name="nail"/>
  <joint name="push" type="prismatic">
    <parent link="palm"/><child link="jaw"/><axis xyz="0 1 0"/><limit lower="-0.05" upper="0.05"/>
  </joint>
  <joint name="turn" type="revolute">
    <parent link="palm"/><child link="thumb"/><axis xyz="1 0 0"/><limit lower="-1" upper="1"/>
  </joint>
  <joint name="reach" type="prismatic">
    <parent link="thumb"/><child link="nail"/><axis xyz="0 0 1"/><limit lower="-0.05" upper="0.05"/>
  </joint>
</robot>
"""
TOML = """schema = 1
title = "One joint turns, two slide"
model = "hand.urdf"
joint = [{ name = "push" }, { name = "turn" }, { name = "reach" }]

[couplings]
reach = { joint = "push", ratio = 0.5, offset = "2 mm" }

[synergies.motors]
columns.shove = { push = 1 }
columns.curl = { turn = 1 }
columns.both = { push = 0.01, turn = 1 }
offset = { push = "4 mm", turn = "3 deg" }
effort_limits = { shove = "20 N", curl = "2 N m", both = "3 N m" }

[postures.half]
joints = { push = "10 mm", turn = "20 deg" }

[postures.drawn]
synergies = { shove = "6 mm", curl = "7 deg" }
"""
LENGTH, ANGLE = "write a length such as '10 mm'", "write an angle such as '5 deg'"


def hand(folder: Path, toml: str = TOML) -> Hand:
    (folder / "hand.urdf").write_text(URDF)
    (folder / "hand.toml").write_text(toml)
    return load_hand(folder)


def refused(made: Hand, wish: dict[str, float]) -> list[tuple[str, str]]:
    with pytest.raises(InputError) as caught:
        posture(made, next(iter(made.synergy_sets.values())), wish)
    return [(issue.key, issue.message) for issue in caught.value.issues]


def test_a_hand_file_has_the_units_of_its_joints(tmp_path: Path) -> None:
    made = hand(tmp_path)
    np.testing.assert_allclose(made.postures["half"], [0.010, 20 * DEG, 0.007], atol=1e-15)
    np.testing.assert_allclose(made.postures["drawn"], [0.010, 10 * DEG, 0.007], atol=1e-15)
    np.testing.assert_allclose(made.synergy_sets["motors"].offset, [0.004, 3 * DEG, 0.004], atol=1e-15)
    np.testing.assert_array_equal(made.synergy_sets["motors"].effort_limits, [20, 2, 3])


@pytest.mark.parametrize(
    ("old", "new", "key", "fragment"),
    [
        ('push = "10 mm"', 'push = "1 deg"', "postures.half.joints.push", f"joint 'push' slides: {LENGTH}"),
        ('turn = "20 deg"', 'turn = "20 mm"', "postures.half.joints.turn", f"joint 'turn' turns: {ANGLE}"),
        ('shove = "6 mm"', 'shove = "6 deg"', "postures.drawn.synergies.shove", f"only joints that slide: {LENGTH}"),
        ('curl = "7 deg"', 'curl = "7 mm"', "postures.drawn.synergies.curl", f"joints that turn: {ANGLE}"),
        ('push = "4 mm"', 'push = "4 mrad"', "synergies.motors.offset.push", LENGTH),
        ('turn = "3 deg"', 'turn = "3 mm"', "synergies.motors.offset.turn", ANGLE),
        ('"20 N"', '"20 N m"', "synergies.motors.effort_limits.shove", "write a force such as '0.5 N', not '20 N m'"),
        ('"2 N m"', '"2 N"', "synergies.motors.effort_limits.curl", "write a torque such as '1.5 N m', not '2 N'"),
        ('"3 N m"', '"3 N"', "synergies.motors.effort_limits.both", "write a torque such as '1.5 N m'"),
        ('offset = "2 mm"', 'offset = "2 deg"', "couplings.reach.offset", f"joint 'reach' slides: {LENGTH}"),
        ('push = "10 mm"', 'push = "10 kg"', "postures.half.joints.push", 'a slide takes a length such as "10 mm"'),
        ('push = "10 mm"', "push = 0.01", "postures.half.joints.push", "0.01 has no unit; expected an angle"),
    ],
)
def test_a_unit_of_the_other_kind_is_refused_at_its_key(
    tmp_path: Path, old: str, new: str, key: str, fragment: str
) -> None:
    assert old in TOML
    with pytest.raises(InputError) as caught:
        hand(tmp_path, TOML.replace(old, new, 1))
    (issue,) = caught.value.issues
    assert issue.key == key
    assert fragment in issue.message
    assert issue.line > 0


def test_a_posture_by_name_is_judged_by_what_each_name_moves(tmp_path: Path) -> None:
    made = hand(tmp_path)
    metre, radian = Measured(0.01, "length", "10 mm"), Measured(0.01, "angle", "10 mrad")
    chosen = next(iter(made.synergy_sets.values()))
    np.testing.assert_allclose(posture(made, chosen, {"push": metre, "turn": radian}), [0.01, 0.01, 0.007])
    np.testing.assert_allclose(posture(made, chosen, {"shove": metre, "both": radian})[0], 0.004 + 0.01 + 0.0001)
    assert [key for key, _ in refused(made, {"push": radian, "turn": metre})] == [
        "posture.push", "posture.turn",
    ]  # fmt: skip
    assert [key for key, _ in refused(made, {"shove": radian, "both": metre})] == [
        "posture.shove", "posture.both",
    ]  # fmt: skip


def test_plain_numbers_are_not_judged(tmp_path: Path) -> None:
    made = hand(tmp_path)
    np.testing.assert_allclose(posture(made, made.synergy_sets["joints"], {"push": 0.01, "turn": 0.2})[:2], [0.01, 0.2])
    assert misfits([("k", "push", 1.0)], {"push": "slide"}) == []
    assert misfits([("k", "push", Measured(1.0, "angle", "1 rad"))], {}) == []


def test_a_synergy_slides_if_all_that_it_moves_slides() -> None:
    S = frozen([[1.0, 0.0, 2.0, 0.0], [0.0, 3.0, 1e-9, 0.0], [4.0, 0.0, 0.0, 0.0]])
    names = ("slides", "turns", "both", "nothing")
    chosen = SynergySet(
        name="", title="", synergies=names, S=S, offset=frozen(np.zeros(3)), effort_limits=frozen(np.full(4, np.inf))
    )
    kinds = synergy_kinds(chosen, ["slide", "hinge", "slide"])
    assert kinds == {"slides": "slide", "turns": "hinge", "both": "hinge", "nothing": "hinge"}


def test_a_list_is_judged_entry_by_entry_and_one_value_for_all_once() -> None:
    kinds = {"a": "slide", "b": "hinge", "c": "slide"}
    turning, sliding = Measured(1.0, "torque", "1 N m"), Measured(1.0, "force", "1 N")
    assert list_misfits("k", (sliding, turning, 2.0), kinds) == []
    assert [issue.key for issue in list_misfits("k", (turning, sliding, turning), kinds)] == ["k[0]", "k[1]", "k[2]"]
    (issue,) = list_misfits("k", turning, kinds)
    assert issue.key == "k"
    assert "joint 'a' slides" in issue.message
    assert issue.message.endswith("give a list")
    assert "'b' turns" in list_misfits("k", sliding, kinds)[0].message
    (alike,) = list_misfits("k", turning, {"a": "slide", "c": "slide"})
    assert "list" not in alike.message


@pytest.mark.parametrize(
    ("kinds", "unit"), [(["hinge"] * 2, "N m"), (["slide"] * 2, "N"), (["hinge", "slide"], ""), ([], "")]
)
def test_joints_of_one_kind_have_one_unit(kinds: list[str], unit: str) -> None:
    assert unit_of(kinds, "N m", "N") == unit


def test_a_measured_value_is_its_number_and_survives_copies() -> None:
    value = either("angle", "length")(" 30  mm")
    assert value == 0.03
    assert value.kind == "length"
    for same in (copy.deepcopy(value), pickle.loads(pickle.dumps(value))):
        assert (same, same.kind, same.text) == (value, "length", value.text)


def test_the_schema_allows_both_units_and_no_third() -> None:
    schema = unit_schema("angle", "length")
    assert all(re.search(schema["pattern"], text) for text in ("1 deg", "2 mm", *schema["examples"]))
    assert not re.search(schema["pattern"], "1 N")
