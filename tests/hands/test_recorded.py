"""Recorded postures: what a CSV file says, and where it is wrong."""

import math

import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.recorded import read_postures

DEG = math.pi / 180
FREE = ("finger1_inner", "finger2_spread", "finger2_inner", "finger3_spread", "finger3_inner")
URDF = """<robot name="r"><link name="palm"/><link name="one"/><link name="two"/><link name="rail"/>
<joint name="near" type="{near}"><parent link="palm"/><child link="one"/><limit lower="-1" upper="2"/></joint>
<joint name="far" type="{far}"><parent link="one"/><child link="two"/><limit lower="-1" upper="1"/></joint>
<joint name="push" type="prismatic"><parent link="palm"/><child link="rail"/><limit lower="0" upper="1"/></joint>
</robot>"""
TOML = 'schema = 1\ntitle = "r"\nmodel = "r.urdf"\n' + "".join(
    f'[[joint]]\nname = "{name}"\n' for name in ("near", "far", "push")
)


@pytest.fixture(scope="module")
def barrett():
    return load_hand("barrett")


@pytest.fixture
def made(tmp_path):
    """A hand of three joints of given types, and tables beside hand.toml."""

    def make(near="revolute", far="revolute", more=""):
        (tmp_path / "hand.toml").write_text(TOML + more, encoding="utf-8")
        (tmp_path / "r.urdf").write_text(URDF.format(near=near, far=far), encoding="utf-8")
        return load_hand(tmp_path)

    return make


@pytest.fixture
def read(tmp_path):
    def read(text, hand=None, **options):
        path = tmp_path / "postures.csv"
        path.write_text(text, encoding="utf-8")
        return read_postures(path, hand, **options)

    return read


def test_without_a_hand_the_header_names_the_joints(read):
    found = read("# a glove\nt_s, thumb ,index_deg,middle_rad\n0,1,90,0.5\n\n1,2,180,0.25\n")
    assert (found.joints, found.kind, found.lines, found.followed) == (
        ("thumb", "index", "middle"), "hinge", (3, 5), (),
    )  # fmt: skip
    np.testing.assert_allclose(found.postures, [[1, math.pi / 2, 0.5], [2, math.pi, 0.25]], rtol=1e-15)
    assert not found.postures.flags.writeable


def test_degrees_are_what_the_header_leaves_open(read):
    found = read("thumb,index_deg,middle_rad\n90,90,1\n45,45,2\n", degrees=True)
    np.testing.assert_allclose(found.postures, [[math.pi / 2, math.pi / 2, 1], [math.pi / 4, math.pi / 4, 2]])


def test_columns_find_their_joints_in_any_order(read, barrett):
    rows = np.arange(10.0).reshape(2, 5) / 10
    given = read(",".join(FREE) + "".join("\n" + ",".join(map(str, row)) for row in rows), barrett)
    assert given.joints == FREE
    order = [3, 0, 4, 1, 2]
    header = ",".join([FREE[i] for i in order] + ["t_s"])
    mixed = read(header + "".join("\n" + ",".join(map(str, [*row[order], 7])) for row in rows), barrett)
    assert mixed.joints == FREE
    np.testing.assert_array_equal(mixed.postures, rows)
    np.testing.assert_array_equal(given.postures, rows)


def test_a_follower_is_left_out_and_measured_against_its_coupling(read, barrett):
    text = f"{','.join(FREE)},finger2_outer_deg,finger1_outer\n0,0,0.3,0,0,0,0\n0.6,0,0,0,0,0,0.2\n0,0,0.3,0,0.1,3,0\n"
    found = read(text, barrett)
    assert found.joints == FREE
    assert [each.joint for each in found.followed] == ["finger1_outer", "finger2_outer"]
    first, second = found.followed
    assert (first.deviation, first.drivers) == (pytest.approx(0, abs=1e-16), "'finger1_inner'")
    assert (second.deviation, second.line) == (pytest.approx(0.1), 2)


def test_an_offset_of_a_coupling_counts(read, made):
    """far = 2 near + 0.5 by coupling, recorded 0.25 lower in line 3."""
    hand = made(more='[couplings]\nfar = { joint = "near", ratio = 2, offset = "0.5 rad" }\n')
    with pytest.raises(InputError, match="sliding joints"):
        read("near,far,push\n0,0.5,0\n0.1,0.45,0\n", hand)
    slide = made("prismatic", "prismatic", '[couplings]\nfar = { joint = "near", ratio = 2, offset = "0.5 m" }\n')
    found = read("near,far,push_mm\n0,0.5,100\n0.1,0.45,200\n", slide)
    assert (found.joints, found.kind) == (("near", "push"), "slide")
    np.testing.assert_allclose(found.postures, [[0, 0.1], [0.1, 0.2]])
    (each,) = found.followed
    assert (each.deviation, each.line) == (pytest.approx(0.25), 3)


def test_a_follower_need_not_be_there(read, barrett):
    assert read(f"{','.join(FREE)}\n0,0,0,0,0\n1,1,1,1,1\n", barrett).followed == ()


def test_a_joint_that_is_named_like_a_unit_is_that_joint(read, tmp_path):
    text = TOML.replace("push", "push_deg")
    (tmp_path / "hand.toml").write_text(text, encoding="utf-8")
    urdf = URDF.format(near="revolute", far="revolute").replace("push", "push_deg").replace("prismatic", "revolute")
    (tmp_path / "r.urdf").write_text(urdf, encoding="utf-8")
    found = read("near_deg,far_deg,push_deg\n90,90,1\n0,0,0\n", load_hand(tmp_path))
    np.testing.assert_allclose(found.postures[0], [math.pi / 2, math.pi / 2, 1])


BAD = [
    ("", 1, 1, "the file is empty"),
    ("a,b\n", 1, 1, "at least 2 postures below the header, got 0"),
    ("a,b\n1,2\n", 1, 1, "at least 2 postures below the header, got 1"),
    ("t_s\n1\n2\n", 1, 1, "names no joint"),
    ("a,b,a\n1,2,3\n4,5,6\n", 1, 5, "joint 'a' is there twice"),
    ("a,b,a_deg\n1,2,3\n4,5,6\n", 1, 5, "joint 'a' is there twice"),
    ("a,,b\n1,2,3\n4,5,6\n", 1, 3, "expected the name of a joint"),
    ("a,_deg\n1,2\n4,5\n", 1, 3, "expected the name of a joint"),
    ('a,b"c\n1,2\n4,5\n', 1, 3, "expected the name of a joint"),
    ("a,b\n1,2\n3,x\n5,6\n", 3, 3, "expected a number, got 'x'"),
    ("a,b\n1,2\n3,\n5,6\n", 3, 3, "expected a number, got nothing"),
    ("a,b\n1,2\n3, nan\n5,6\n", 3, 4, "'nan' is not a finite number"),
    ("a,b\n1,2\ninf,3\n5,6\n", 3, 1, "'inf' is not a finite number"),
    ("a,b\n1,2\n1e200,3\n5,6\n", 3, 1, "too large"),
    ("a,b\n1,2\n1_0,3\n5,6\n", 3, 1, "expected a number"),
    ("a,b\n1,2\n3,4,5\n5,6\n", 3, 1, "expected 2 cells as in the header, got 3"),
    ("t_s,a\n0,2\nlater,4\n5,6\n", 3, 1, "expected a number, got 'later'"),
]


@pytest.mark.parametrize(("text", "line", "column", "fragment"), BAD)
def test_what_is_wrong_is_told_with_line_and_column(read, text, line, column, fragment):
    with pytest.raises(InputError) as caught:
        read(text)
    (issue,) = caught.value.issues
    assert (issue.line, issue.column) == (line, column)
    assert fragment in issue.message
    assert issue.file.endswith("postures.csv")


def test_all_cells_that_are_wrong_are_told_at_once_and_not_more_than_anybody_reads(read):
    with pytest.raises(InputError) as caught:
        read("a,b\nx,1\n2,y\n")
    assert [(issue.line, issue.column) for issue in caught.value.issues] == [(2, 1), (3, 3)]
    with pytest.raises(InputError) as caught:
        read("a,b\n0,1\n" + "x,1\n" * 100)
    assert len(caught.value.issues) == 20
    assert "and 80 more" in caught.value.issues[-1].message


def test_names_that_the_hand_does_not_have_or_that_are_missing(read, barrett):
    with pytest.raises(InputError) as caught:
        read("finger1_inner,finger2_inner_deg,finger3_iner_deg\n1,2,3\n4,5,6\n", barrett)
    (issue,) = caught.value.issues
    assert "did you mean 'finger3_inner'?" in issue.message
    assert issue.column == 33
    with pytest.raises(InputError) as caught:
        read("finger1_inner,finger1_outer,finger2_inner_deg,finger3_spread\n1,2,3,4\n4,5,6,7\n", barrett)
    (issue,) = caught.value.issues
    assert issue.message == "missing columns 'finger2_spread', 'finger3_inner'"


@pytest.mark.parametrize(
    ("header", "column", "fragment"),
    [
        ("near,far,push", 10, "sliding joints ('push') and hinges have no common unit"),
        ("near,far,push_deg", 10, "joint 'push' slides: give it in m or mm"),
        ("near_mm,far,push", 1, "joint 'near' turns: give it in rad or deg"),
    ],
)
def test_units_that_do_not_fit_the_joints(read, made, header, column, fragment):
    with pytest.raises(InputError) as caught:
        read(f"{header}\n1,2,3\n4,5,6\n", made())
    (issue,) = caught.value.issues
    assert fragment in issue.message
    assert (issue.line, issue.column) == (1, column)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match="not found"):
        read_postures(tmp_path / "none.csv")
