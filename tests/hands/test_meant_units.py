"""Whether the values of a recording can be in the unit they are read in."""

import math

import numpy as np
import pytest
from logged import written

from synergrip.hands.folder import load_hand

FREE = ("finger1_inner", "finger2_spread", "finger2_inner", "finger3_spread", "finger3_inner")


def grasps(count, seed=0):
    """Return joint values [rad] of the Barrett hand that use most of its ranges."""
    q = np.random.default_rng(seed).uniform(0.05, 2.2, (count, 5))
    return q * [1, 1, 1, -1, 1]


@pytest.mark.parametrize("seed", range(5))
def test_degrees_taken_for_radians_leave_the_ranges_of_the_hand(read, refused, barrett, seed):
    degrees = np.degrees(grasps(6, seed)).round(2)
    (issue,) = refused(written(FREE, degrees), barrett)
    assert "read in radians" in issue.message
    assert "in degrees 100 % do: say --degrees, or name the columns" in issue.message
    assert f"{np.abs(degrees).max():.4g} rad in line" in issue.message
    (issue,) = refused(written([f"{name}_rad" for name in FREE], degrees), barrett)
    assert "name the column finger" in issue.message
    assert "--degrees" not in issue.message
    np.testing.assert_allclose(read(written(FREE, degrees), barrett, degrees=True).postures, np.radians(degrees))


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("with_hand", [True, False])
def test_radians_taken_for_degrees_hardly_move_the_hand(read, barrett, seed, with_hand):
    radians, hand = grasps(6, seed).round(4), barrett if with_hand else None
    (note,) = read(written(FREE, radians), hand, degrees=True).notes
    assert f"are within {np.abs(radians).max():.4g} deg of 0" in note
    assert "if they are radians, leave out --degrees" in note
    (note,) = read(written([f"{name} [deg]" for name in FREE], radians), hand).notes
    assert "if they are radians, name the columns finger1_inner_rad and so on" in note


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("with_hand", [True, False])
def test_no_false_alarm(read, barrett, seed, with_hand):
    radians, hand = grasps(6, seed), barrett if with_hand else None
    assert read(written(FREE, radians), hand).notes == ()
    assert read(written([f"{name}_deg" for name in FREE], np.degrees(radians)), hand).notes == ()
    assert read(written(FREE, np.degrees(radians)), hand, degrees=True).notes == ()
    beyond = radians * [1.1, 1, 1, 1, 1] + [0.1, 0, 0, 0, 0]  # a glove is not calibrated that well
    assert read(written(FREE, beyond), hand).notes == ()


def test_more_than_a_turn_is_told_with_its_place(read):
    (note,) = read("a,b\n0.1,40\n0.3,-80\n0.2,50\n").notes
    assert note == "values up to 80 rad ('b' in line 3) are more than a turn; if they are degrees, say --degrees"
    (note,) = read("a_rad,b_rad\n0.1,40\n0.3,-80\n0.2,50\n").notes
    assert note.endswith("if they are degrees, name the column b_deg")


def test_millimetres_taken_for_metres_leave_the_ranges_of_slides(read, refused, tmp_path):
    (tmp_path / "h.urdf").write_text(
        """<robot name="h"><link name="p"/><link name="a"/><link name="b"/>
        <joint name="a" type="prismatic"><parent link="p"/><child link="a"/><limit lower="0" upper="0.05"/></joint>
        <joint name="b" type="prismatic"><parent link="p"/><child link="b"/><limit lower="0" upper="0.05"/></joint>
        </robot>""", encoding="utf-8",
    )  # fmt: skip
    hand = load_hand(tmp_path / "h.urdf")
    (issue,) = refused("a,b\n10,20\n40,30\n", hand)
    assert "read in m, 0 % of the values keep to the ranges" in issue.message
    assert issue.message.endswith("in mm 100 % do: name the columns a_mm")
    np.testing.assert_allclose(read("a_mm,b [mm]\n10,20\n40,30\n", hand).postures, [[0.01, 0.02], [0.04, 0.03]])
    assert math.isclose(read("a,b\n0.01,0.02\n0.04,0.03\n", hand).postures[1, 0], 0.04)


def test_units_stand_in_names_in_several_ways(read):
    found = read("a_deg,b [deg],c (deg),d_degrees,e (°),f_rad,g[rad],h\n" + "90," * 5 + "1,1,1\n" + "0," * 7 + "0\n")
    assert found.joints == tuple("abcdefgh")
    np.testing.assert_allclose(found.postures[0], [math.pi / 2] * 5 + [1] * 3)
