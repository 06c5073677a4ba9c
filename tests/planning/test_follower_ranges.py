"""Followers whose own range contradicts what their coupling makes of the range of their driver."""

from pathlib import Path

import numpy as np
import pytest
from linkage_gripper import (
    EQUALITY_LINE,
    HAND_TOML,
    LEAST_FORCE,
    MIMIC_LINE,
    MJCF_RANGE_LINE,
    RANGE_LINE,
    mjcf,
    problem,
    urdf,
)

from synergrip import InputError, load_problem, plan
from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.matrix import ranges_of_followers

REPAIR = 'hand.follower_ranges = "ignore"'
IGNORED = ['hand.follower_ranges="ignore"']


def written(folder: Path, model: str, text: str) -> Path:
    (folder / model).write_text(text, encoding="utf-8")
    (folder / "problem.toml").write_text(problem(model), encoding="utf-8")
    return folder / "problem.toml"


def messages(path: Path, overrides: list[str] | None = None) -> list[str]:
    with pytest.raises(InputError) as caught:
        load_problem(path, overrides or [])
    return [issue.message for issue in caught.value.issues]


@pytest.mark.parametrize("own", [(0.0, 0.9), (0.2, 0.9), (-0.05, 0.05), (-0.3, 0.0)])
@pytest.mark.parametrize("kind", ["urdf", "xml"])
def test_both_statements_are_named_and_one_key_repairs_them(tmp_path, kind, own):
    """The tips turn by 25 mm / 60 mm: asin(25/60) = 0.43 rad, more than their own range allows."""
    path = written(tmp_path, f"hand.{kind}", urdf(*own) if kind == "urdf" else mjcf(*own))
    range_line, coupling_line = (RANGE_LINE, MIMIC_LINE) if kind == "urdf" else (MJCF_RANGE_LINE, EQUALITY_LINE)
    found = messages(path)
    assert f"the range of 'l_tip' is {own[0] * 180 / np.pi:.4g} to" in found[0]
    assert f"hand.{kind}:{range_line})" in found[0]
    assert f"hand.{kind}:{coupling_line})" in found[0]
    for message in found:
        assert "-45.84 to 0 deg with 'motor' at 0 to 45.84 deg" in message
        assert REPAIR in message
        assert "another hand.posture" not in message
    loaded = load_problem(path, IGNORED)
    assert loaded.notes == ()
    answer = plan(loaded.grasp, loaded.task)
    assert answer.verdict == "feasible"
    assert answer.motion.forces[0, [0, 4]] == pytest.approx([LEAST_FORCE] * 2, rel=1e-6)


def test_the_right_range_needs_no_key_and_gives_the_same_plan(tmp_path):
    path = written(tmp_path, "hand.urdf", urdf(-0.9, 0.1))
    held, ignored = load_problem(path).held, load_problem(path, IGNORED).held
    assert held.notes == ()
    np.testing.assert_array_equal(held.q, ignored.q)


def test_a_hand_toml_may_say_it_too_and_a_problem_comes_first(tmp_path):
    (tmp_path / "hand.urdf").write_text(urdf(0.0, 0.9), encoding="utf-8")
    (tmp_path / "hand.toml").write_text('follower_ranges = "ignore"\n' + HAND_TOML, encoding="utf-8")
    (tmp_path / "problem.toml").write_text(problem("hand.toml"), encoding="utf-8")
    assert load_problem(tmp_path / "problem.toml").held.notes == ()
    assert REPAIR in messages(tmp_path / "problem.toml", ['hand.follower_ranges="keep"'])[0]
    (tmp_path / "hand.toml").write_text(HAND_TOML, encoding="utf-8")
    assert REPAIR in messages(tmp_path / "problem.toml")[0]
    load_problem(tmp_path / "problem.toml", IGNORED)


def test_a_coupling_in_a_hand_toml_is_named_there(tmp_path):
    (tmp_path / "hand.urdf").write_text(urdf(0.0, 0.9), encoding="utf-8")
    lines = '\n[couplings]\n\nl_tip = { joint = "motor", ratio = -1 }\n'
    (tmp_path / "hand.toml").write_text(HAND_TOML + lines, encoding="utf-8")
    (tmp_path / "problem.toml").write_text(problem("hand.toml"), encoding="utf-8")
    assert "hand.toml:10)" in messages(tmp_path / "problem.toml")[0]


def test_a_posture_that_a_follower_cannot_take_says_which_statements_forbid_it(tmp_path):
    path = written(tmp_path, "hand.urdf", urdf(0.0, 0.9))
    asked = ['hand.posture={ motor = "20 deg" }']
    found = messages(path, asked)
    assert len(found) == 2
    assert "joint 'l_tip' would be at -20 deg, outside 0 to 51.57 deg" in found[0]
    assert f"hand.urdf:{MIMIC_LINE})" in found[0]
    assert REPAIR in found[0]
    load_problem(path, [*asked, *IGNORED])
    (named,) = messages(path, ['hand.posture={ motor = "20 deg", l_tip = "-5 deg", r_tip = "0 deg" }'])
    assert REPAIR not in named  # the user put it there, not the coupling
    beyond = messages(path, ['hand.posture={ motor = "60 deg" }', *IGNORED])
    assert not any(REPAIR in message for message in beyond)
    assert "joint 'motor' would be at 60 deg, outside 0 to 45.84 deg" in beyond[0]


def test_a_plan_that_needs_no_closing_carries_a_note(tmp_path):
    path = written(tmp_path, "hand.urdf", urdf(0.0, 0.9))
    text = path.read_text(encoding="utf-8").replace('close = "motor"\n', "").replace('40 mm", "60 mm', '90 mm", "60 mm')
    path.write_text(text, encoding="utf-8")
    (note,) = load_problem(path).held.notes
    assert f"hand.urdf:{RANGE_LINE})" in note
    assert "(likewise 'r_tip'" in note
    assert load_problem(path, IGNORED).held.notes == ()


def ranges(lower, upper, coupling, model="urdf", driver=(0.0, 0.8), tmp_path=None):
    (tmp_path / "h.urdf").write_text(
        f"""<robot name="h"><link name="p"/><link name="a"/><link name="b"/>
        <joint name="a" type="{"revolute" if driver else "continuous"}"><parent link="p"/><child link="a"/>
        <limit lower="{(driver or (0, 0))[0]}" upper="{(driver or (0, 0))[1]}"/></joint>
        <joint name="b" type="revolute"><parent link="p"/><child link="b"/>
        <limit lower="{lower}" upper="{upper}"/><mimic joint="a" {coupling}/></joint></robot>""", encoding="utf-8"
    )  # fmt: skip
    return load_hand(tmp_path / "h.urdf")


@pytest.mark.parametrize(
    ("own", "coupling", "driver", "contradicts"),
    [
        ((0.0, 0.8), 'multiplier="1"', (0, 0.8), False),
        ((0.0, 0.7857), 'multiplier="0.98252"', (0, 0.8), False),  # rounded
        ((-1.0, 1.0), 'multiplier="-1"', (0, 0.8), False),
        ((0.0, 0.4), 'multiplier="1"', (0, 0.8), True),
        ((0.0, 0.8), 'multiplier="-1"', (0, 0.8), True),
        ((0.9, 1.0), 'multiplier="1"', (0, 0.8), True),
        ((0.0, 0.8), 'multiplier="1" offset="0.5"', (0, 0.8), True),
        ((0.0, 0.4), 'multiplier="0" offset="0.5"', (0, 0.8), True),  # locked outside
        ((0.0, 0.4), 'multiplier="0" offset="0.3"', (0, 0.8), False),
        ((0.0, 0.4), 'multiplier="1"', None, False),  # a driver without limits asks for nothing
    ],
)
def test_what_contradicts_what(tmp_path, own, coupling, driver, contradicts):
    (found,) = ranges_of_followers(ranges(*own, coupling, driver=driver, tmp_path=tmp_path))
    assert found.contradicts == contradicts


@pytest.mark.parametrize("seed", range(20))
def test_followers_of_followers_reach_as_far_as_sampling_says(tmp_path, seed):
    """With the key, no posture of the driver inside its range puts a follower outside, and the ends are reached."""
    rng = np.random.default_rng(seed)
    names, ratios, offsets = "abcd", rng.uniform(-2, 2, 3), rng.normal(size=3)
    joints = (
        '<joint name="a" type="revolute"><parent link="p"/><child link="a"/><limit lower="-0.3" upper="0.9"/></joint>'
    )
    for before, name, ratio, offset in zip(names, names[1:], ratios, offsets, strict=False):
        joints += f"""<joint name="{name}" type="revolute"><parent link="{before}"/><child link="{name}"/>
        <limit lower="-0.1" upper="0.1"/><mimic joint="{before}" multiplier="{ratio}" offset="{offset}"/></joint>"""
    links = "".join(f'<link name="{name}"/>' for name in "pabcd")
    (tmp_path / "h.urdf").write_text(f'<robot name="h">{links}{joints}</robot>', encoding="utf-8")
    hand = load_hand(tmp_path / "h.urdf", follower_ranges="ignore")
    q = np.linspace(-0.3, 0.9, 50)
    for joint, ratio, offset in zip(hand.joints[1:], ratios, offsets, strict=True):
        q = ratio * q + offset
        assert (joint.lower, joint.upper) == pytest.approx((q.min(), q.max()), abs=1e-12)


def test_a_follower_that_may_part_keeps_what_its_own_range_allows(tmp_path):
    (tmp_path / "hand.urdf").write_text(urdf(0.0, 0.9), encoding="utf-8")
    told = (
        '[couplings]\nl_tip = { joint = "motor", ratio = -1 }\nr_tip = { joint = "motor", ratio = -1, rigid = true }\n'
    )
    (tmp_path / "hand.toml").write_text(HAND_TOML + told, encoding="utf-8")
    joints = {joint.name: joint for joint in load_hand(tmp_path, follower_ranges="ignore").joints}
    assert (joints["l_tip"].lower, joints["l_tip"].upper) == (-0.8, 0.9)
    assert (joints["r_tip"].lower, joints["r_tip"].upper) == (-0.8, 0.0)
    assert (joints["motor"].lower, joints["motor"].upper) == (0, 0.8)


def test_a_hand_without_followers_has_no_use_for_the_key(tmp_path):
    with pytest.raises(InputError, match="no joint of this hand follows another one") as caught:
        load_hand("gripper", follower_ranges="ignore")
    assert caught.value.issues[0].key == "follower_ranges"


def test_a_coupling_of_the_problem_is_named_by_its_key(tmp_path):
    path = written(tmp_path, "hand.urdf", urdf(-0.9, 0.9))
    assert load_problem(path).notes == ()
    assert "(hand.coupling.l_tip)" in messages(path, ["hand.coupling.l_tip=-3", "hand.coupling.r_tip=-3"])[0]
