"""Recordings as loggers, spreadsheets and numerical tools write them: understood, or refused where they stand."""

import numpy as np
import pytest
from logged import written

from synergrip.hands.folder import load_hand

POSTURES = np.array([[0.42, 0.11, -0.3], [0.1, 0.52, 0.25], [0.33, 0.18, 0.61], [0.71, 0.29, 0.12]])


# What parts cells and decimals


WAYS = [
    (mark, decimal, quotes)
    for mark in (",", ";", "\t", " ", "   ", " , ", "; ")
    for decimal in ".,"
    for quotes in ("", '"')
    if decimal != mark.strip() or quotes
]


@pytest.mark.parametrize(("mark", "decimal", "quotes"), WAYS)
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("before", ["", "\ufeff", "# a glove\n\n", "% a glove\n", "sep=SEP\n"])
def test_cells_and_decimals_are_parted_in_many_ways(read, mark, decimal, end, before, quotes):
    header = [f"{quotes}{name}{quotes}" for name in ("thumb", "index", "middle")]
    rows = [[f"{quotes}{value:.2f}{quotes}".replace(".", decimal) for value in row] for row in POSTURES]
    start = before.replace("SEP", mark.strip() or mark[0]).replace("\n", end)
    found = read(start + written(header, rows, mark, end))
    assert found.joints == ("thumb", "index", "middle")
    np.testing.assert_array_equal(found.postures, POSTURES)
    assert found.left_out == found.notes == ()


def test_a_line_may_end_in_a_delimiter_and_columns_may_be_empty(read):
    found = read("a,b,\n1,2,\n2,5,\n")
    assert (found.joints, found.notes) == (("a", "b"), ())
    found = read("a,void,b\n1,,2\n2,,5\n")
    assert (found.joints, found.left_out) == (("a", "b"), ("void",))
    assert found.notes == ("left out as empty: 'void'",)


def test_a_single_joint_may_have_decimal_commas(read):
    np.testing.assert_array_equal(read("thumb\n0,1\n0,25\n").postures, [[0.1], [0.25]])


# Numbers are no names


@pytest.mark.parametrize(("mark", "decimal"), [way[:2] for way in WAYS if not way[2] and way[0] in ",;\t "])
def test_numbers_in_the_first_line_are_no_names(refused, mark, decimal):
    rows = [[f"{value:.2f}".replace(".", decimal) for value in row] for row in POSTURES]
    (issue,) = refused(written(rows[0], rows[1:], mark))
    assert (issue.line, issue.column) == (1, 1)
    assert f"'{rows[0][0]}' is a number, not the name of a joint" in issue.message
    assert "write their names above the first posture, such as index_mcp" in issue.message


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("1,2\n3,4\n5,6\n", 1, 1),
        (",0,1\n0,0.1,0.2\n1,0.3,0.1\n", 1, 2),  # pandas without names
        ("thumb,2\n3,4\n5,6\n", 1, 7),
        ("2024-05-01 12:00,0.1,0.2\n2024-05-01 12:01,0.3,0.1\n2024-05-01 12:02,0.3,0.1\n", 1, 18),
        ("-1e-3, .5\n3,4\n5,6\n", 1, 1),
        ("# a glove\n\n  1.0e+00 2.0e+00\n 3.0e+00 1.0e+00\n", 3, 3),  # MATLAB
    ],
)
def test_wherever_they_stand(refused, text, line, column):
    (issue,) = refused(text)
    assert (issue.line, issue.column) == (line, column)
    assert "is a number, not the name of a joint" in issue.message


def test_names_in_a_comment_are_found(refused, tmp_path):
    np.savetxt(tmp_path / "np.csv", POSTURES, "%.3f", ",", header="thumb,index,middle")
    (issue,) = refused((tmp_path / "np.csv").read_text(encoding="utf-8"))
    assert issue.line == 2
    assert "if the comment above it names them (thumb, index, middle), remove the mark in front" in issue.message


def test_the_joints_of_the_hand_are_named(refused, barrett):
    (issue,) = refused(written(["0.1"] * 5, [["0.2"] * 5] * 2), barrett)
    assert "such as finger1_inner,finger2_spread,finger2_inner" in issue.message


# Columns that are no joints

TIMES = [
    "time", "Time", "TIME", "t", "T", "t_s", "ts", "timestamp", "Timestamp", "timeStamp", "time_stamp", "stamp", "secs",
    "nsecs", "sec", "nanosec", "header.stamp.sec", "header.stamp.nanosec", "/joint_states/header/stamp/sec", "%time",
    "__time", "Time (s)", "Time [ms]", "time_ms", "t_ms", "t [s]", "elapsed", "Elapsed Time", "elapsed_s", "date",
    "datetime", "Date", "clock", "rosbagTimestamp", "unix_time", "capture_time_s", "frametime", "Zeit", "epoch", "ms",
    "time since start (s)", "System Timestamp",
]  # fmt: skip
COUNTERS = ["frame", "Frame", "seq", "header.seq", "sample", "Sample Number", "frame_no", "row", "counter", "Sub Frame",
            "frame_index", "tick", "count"]  # fmt: skip
LABELS = ["subject", "trial", "object_id", "grasp type", "label", "header.frame_id", "session", "repetition"]
RATES = ["/joint_states/thumb/velocity", "thumb_vel", "thumb_effort", "thumb.torque", "field.velocity0"]


@pytest.mark.parametrize("place", [0, 1, 2])
@pytest.mark.parametrize("header", [*TIMES, *COUNTERS, *LABELS, *RATES])
def test_columns_are_left_out_by_their_names_with_a_note(read, header, place):
    rows = np.insert(POSTURES[:, :2], place, [17.0, 17.25, 16.0, 19.0], axis=1)  # not even in order
    found = read(written(np.insert(np.array(["thumb", "index"], dtype=object), place, header), rows))
    assert (found.joints, found.left_out) == (("thumb", "index"), (header,))
    np.testing.assert_array_equal(found.postures, POSTURES[:, :2])
    notes = [note for note in found.notes if f"'{header}'" in note]
    assert len(notes) == (header != "t_s")
    assert all(note.startswith("left out as ") for note in notes)


JOINTS = ["index", "index_deg", "ring", "thumb_mcp", "second_mcp", "flex_joint", "wrist", "temple", "s1", "t1",
          "middle.pip", "WRJ2", "rh_FFJ3", "index finger", "finger_joint", "position", "stamper", "framed"]  # fmt: skip


@pytest.mark.parametrize("name", JOINTS)
def test_joints_are_not_left_out(read, name):
    assert len(read(written([name, "thumb"], POSTURES[:, :2])).joints) == 2


@pytest.mark.parametrize("name", ["index", "id", "no", "n", "", "Unnamed: 0"])
def test_what_may_be_a_joint_is_left_out_when_it_counts(read, name):
    rows = [[count, *row] for count, row in zip([0, 1, 4, 5], POSTURES, strict=True)]
    found = read(written([name, "a", "b", "c"], rows))
    assert (found.joints, found.left_out) == (("a", "b", "c"), (name or "column 1",))
    assert found.notes == (f"left out as a counter: '{name or 'column 1'}'",)


@pytest.mark.parametrize(
    "instants",
    [
        ["2024-05-01T12:00:00.1Z", "2024-05-01T12:00:00.2Z"], ["01.05.2024 12:00:00", "01.05.2024 12:00:01"],
        ["5/1/2024", "5/2/2024"], ["12:00:00.5 PM", "12:00:01.5 PM"], ["1 May 2024", "2 May 2024"],
    ],
)  # fmt: skip
@pytest.mark.parametrize("name", ["date", "time", "Timestamp", ""])
def test_times_may_be_dates(read, name, instants):
    found = read(written([name, "a", "b"], [[instants[0], 1, 2], [instants[1], 2, 5]]))
    assert found.joints == ("a", "b")
    np.testing.assert_array_equal(found.postures, [[1, 2], [2, 5]])


def test_a_hand_knows_its_joints_whatever_they_are_called(read, tmp_path):
    joints = "".join(
        f'<joint name="{name}" type="revolute"><parent link="p"/><child link="{name}"/>'
        '<limit lower="-1" upper="2"/></joint>'
        for name in ("t", "frame", "index_deg", "7")
    )
    links = "".join(f'<link name="{name}"/>' for name in ("p", "t", "frame", "index_deg", "7"))
    (tmp_path / "h.urdf").write_text(f'<robot name="h">{links}{joints}</robot>', encoding="utf-8")
    found = read("t,frame,index_deg,7,time\n0,1,0.1,1,0\n1,2,0.3,2,0.1\n", load_hand(tmp_path / "h.urdf"))
    assert (found.joints, found.left_out) == (("t", "frame", "index_deg", "7"), ("time",))
    np.testing.assert_array_equal(found.postures, [[0, 1, 0.1, 1], [1, 2, 0.3, 2]])


def test_many_columns_are_told_in_few_words(read):
    header = ["__time", *(f"/joint_states/j{i}/{what}" for what in ("position", "velocity") for i in range(6))]
    rows = [[17 + k, *(0.1 * np.sin(k + np.arange(12.0)))] for k in range(5)]
    found = read(written(header, rows))
    assert found.joints == tuple(f"j{i}" for i in range(6))
    assert found.notes[1].endswith("'/joint_states/j2/velocity' and 3 more")
    assert len(found.left_out) == 7


def test_what_plotjuggler_writes_finds_the_joints_of_a_hand(read, barrett):
    names = [name for name in barrett.joint_names if name not in barrett.couplings]
    header = ["__time", *(f"/hand/joint_states/{name}/position" for name in names)]
    found = read(written(header, [[1, 0, 0.1, 0, -0.1, 0], [2, 0.1, 0.2, 0.3, -0.4, 0.6]]), barrett)
    assert found.joints == tuple(names)


def test_a_column_that_never_turns_back_is_doubted(read, refused):
    values = POSTURES[:, :2].tolist()
    (note,) = read(written(["run1", "a", "b"], [[0.5 * i, *row] for i, row in enumerate(values)])).notes
    assert "'run1' goes from 0 to 1.5 without turning back by equal steps: if it tells the time" in note
    rows = [[value, *row] for value, row in zip([0, 2.5, 6, 7], values, strict=True)]
    assert any(
        "'run1' goes from 0 to 7 without turning back:" in note
        for note in read(written(["run1", "a", "b"], rows)).notes
    )
    assert (
        read(written(["run1", "a", "b"], [[v, *row] for v, row in zip([0, 2, 1, 3], values, strict=True)])).notes == ()
    )
    (issue,) = refused(written(["run1", "a", "b"], [[1.7e9 + i * i, *row] for i, row in enumerate(values)]))
    assert (issue.line, issue.column) == (1, 1)
    assert "as a time or a counter does and no joint; take it out" in issue.message


def test_a_joint_that_stands_still_is_told(read):
    assert read("a,b,c\n1,2,0\n1,3,0\n1,2,1\n").notes == ("the same in all postures: 'a'",)


# Cells and lines that are no postures


@pytest.mark.parametrize(
    ("text", "places", "fragment"),
    [
        ("a,grip\n1,power\n2,pinch\n", [(1, 3)], "column 'grip' holds text such as 'power', no joint values"),
        ("a,b\n[deg],[deg]\n1,2\n2,5\n", [(2, 1)], "a line of units"),
        ("a;b\nrad;rad\n1;2\n2;5\n", [(2, 1)], "a line of units"),
        ("a,b\n1,2\na,b\n2,5\n", [(3, 1)], "the header once more"),
        ("a,b\n1,NaN\n2,5\n", [(2, 3)], "'NaN' is not a finite number (column 'b'); fill it in, or leave out"),
        ("a;b\n1;n/a\n2;5\n", [(2, 3)], "expected a number, got 'n/a' (column 'b'); fill it in, or leave out"),
        ("a\tb\n1\t\n2\t5\n", [(2, 3)], "expected a number, got nothing (column 'b'); fill it in, or leave out"),
        ("a,b\n0,1,0,2\n0,3,0,4\n", [(2, 1), (3, 1)], "got 4; numbers with decimal commas need cells parted by"),
        ("a;b\n1,2\n2,3\n", [(2, 1), (3, 1)], "got 1; the header has its cells parted by semicolons"),
        ("a;b\n1.234,5;2\n1;2\n", [(2, 1)], "expected a number, got '1.234,5' (column 'a')"),
        ("my log\na,b\n1,2\n2,3\n3,1\n", [(1, 1)], "a header of one cell, where most lines have 2"),
        ("Coordinates\nversion=1\nendheader\ntime\ta\n0\t1\n1\t2\n2\t1\n3\t4\n", [(1, 1)], "where most lines have 2"),
        ("\n\n", [(1, 1)], "the file is empty"),
        ("# only a comment\n", [(1, 1)], "the file is empty"),
        (written([f"j{i}" for i in range(3000)], [range(3000)]), [(1, 1)], "3000 columns"),
    ],
)
def test_what_is_no_posture_is_refused_by_name(refused, text, places, fragment):
    issues = refused(text)
    assert [(issue.line, issue.column) for issue in issues] == places
    assert all(fragment in issue.message for issue in issues)


def test_the_line_of_the_file_is_shown_as_it_stands(refused):
    (issue,) = refused("a;b\n1,5;x\n2;5\n")
    assert (issue.source, issue.column) == ("1,5;x", 5)
