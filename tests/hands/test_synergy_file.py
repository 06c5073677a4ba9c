"""Synergy files: read for a hand, written and read back, refused with the place."""

import math
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from synergrip.documents.documents import Document, parse
from synergrip.errors import InputError, OutputError
from synergrip.files import bundled
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import Coupling
from synergrip.hands.synergies.synergy_file import (
    SynergyFile,
    read_synergies,
    read_synergy_file,
    synergy_text,
    write_synergy_file,
)

TEXT = """schema = 1
title = "two of four"
joints = ["c", "a"]
synergies = ["close", "spread"]
S = [
    [1, 0.5],
    [2, 0],
]
offset = [0.1, 0.2]
explained_variance = [0.9, 0.05]
standard_deviation = [0.3, 0.1]
"""
JOINTS = ("a", "b", "c", "d")


@pytest.fixture
def path(tmp_path):
    found = tmp_path / "two.toml"
    found.write_text(TEXT, encoding="utf-8")
    return found


def test_rows_find_their_joints_and_the_others_do_not_move(path):
    found = read_synergies(path, JOINTS, {})
    assert (found.name, found.title, found.synergies) == ("two", "two of four", ("close", "spread"))
    np.testing.assert_array_equal(found.S, [[2, 0], [0, 0], [1, 0.5], [0, 0]])
    np.testing.assert_array_equal(found.offset, [0.2, 0, 0.1, 0])
    np.testing.assert_array_equal(found.effort_limits, [math.inf, math.inf])
    assert read_synergies(path, JOINTS, {}, name="mine").name == "mine"
    assert not found.S.flags.writeable


def test_followers_are_added_through_their_couplings(path):
    couplings = {"d": Coupling({"a": 0.5, "c": 1}, 0.25), "b": Coupling({"d": 2})}
    found = read_synergies(path, JOINTS, couplings)
    np.testing.assert_allclose(found.S, [[2, 0], [4, 1], [1, 0.5], [2, 0.5]])
    np.testing.assert_allclose(found.offset, [0.2, 0.9, 0.1, 0.45])


def test_a_row_of_a_follower_agrees_with_its_coupling_or_is_refused(path):
    agreeing = Coupling({"c": 2}, 0.2 - 2 * 0.1)
    path.write_text(TEXT.replace("[2, 0]", "[2, 1]"), encoding="utf-8")
    np.testing.assert_allclose(read_synergies(path, JOINTS, {"a": agreeing}).S[0], [2, 1])
    for wrong in (Coupling({"c": 2.001}, 0), Coupling({"c": 2}, 0.01)):
        with pytest.raises(InputError) as caught:
            read_synergies(path, JOINTS, {"a": wrong})
        (issue,) = caught.value.issues
        assert issue.key == "joints[1]"
        assert "not what its coupling to 'c' says" in issue.message
        assert (issue.line, issue.file) == (3, str(path))


BAD = [
    ("schema = 1", "schema = 2", "schema", "upgrade"),
    ('"c", "a"]', '"c", "x"]', "joints[1]", "'x' is not one of"),
    ('"c", "a"]', '"c", "c"]', "joints[1]", "listed twice"),
    ('"close", "spread"', '"close", "close"', "synergies[1]", "listed twice"),
    ('"close", "spread"', '"close"', "S[0]", "2 numbers for 1 synergies"),
    ('"c", "a"]', '"c"]', "S", "2 rows for 1 joints"),
    ('"c", "a"]', '"c", "a,b"]', "joints[1]", "commas"),
    ("[1, 0.5]", "[1, true]", "S[0][1]", "expected a number"),
    ("[1, 0.5]", "[1, inf]", "S[0][1]", "not a finite number"),
    ("[1, 0.5]", "[1]", "S[0]", "1 numbers for 2 synergies"),
    ("[1, 0.5]", "[]", "S[0]", "0 numbers for 2 synergies"),
    ("[1, 0.5]", "0.5", "S[0]", "expected a list"),
    ("[0.1, 0.2]", "[0.1]", "offset", "1 numbers for 2 joints"),
    ("[0.9, 0.05]", "[0.9]", "explained_variance", "1 numbers for 2 synergies"),
    ("[0.3, 0.1]", "[0.3]", "standard_deviation", "1 numbers for 2 synergies"),
    ("offset =", "ofset =", "ofset", "did you mean 'offset'?"),
    ('joints = ["c", "a"]\n', "", "joints", "missing"),
]


@pytest.mark.parametrize(("old", "new", "key", "fragment"), BAD)
def test_what_is_wrong_is_told_where_it_stands(path, old, new, key, fragment):
    assert TEXT.count(old) == 1
    path.write_text(TEXT.replace(old, new), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_synergies(path, JOINTS, {})
    issue = caught.value.issues[0]
    assert issue.key == key
    assert fragment in issue.message
    assert issue.file == str(path)
    assert issue.line > 0


def test_any_real_matrix_is_a_synergy_matrix(path):
    for row in ("[1, 1]", "[1, 0]", "[0, 0]"):
        path.write_text(TEXT.replace("[1, 0.5]", row).replace("[2, 0]", row), encoding="utf-8")
        assert read_synergies(path, JOINTS, {}).S.shape == (4, 2)


# Writing

NAMES = st.text(st.characters(exclude_categories=["C"], exclude_characters=',"\u2028\u2029'), min_size=1, max_size=6)
NUMBERS = st.floats(-1e100, 1e100) | st.sampled_from([0.1, -0.0, 5e-324, sys.float_info.min, 1 / 3])


@st.composite
def files(draw):
    joints, synergies = (draw(st.lists(NAMES, min_size=1, max_size=4, unique=True)) for _ in "ab")
    numbers = lambda count: tuple(draw(NUMBERS) for _ in range(count))  # noqa: E731
    values = {"schema": 1, "joints": joints, "synergies": synergies, "S": [numbers(len(synergies)) for _ in joints]}
    values["title"] = draw(st.text(st.characters(exclude_categories=["Cs"]), max_size=8))
    for key, count in (("offset", len(joints)), ("explained_variance", len(synergies)),
                       ("standard_deviation", len(synergies))):  # fmt: skip
        if draw(st.booleans()):
            values[key] = numbers(count)
    return SynergyFile.model_validate(values)


@given(files())
def test_what_is_written_is_read_back_to_the_last_digit(tmp_path_factory, file):
    path = tmp_path_factory.mktemp("written") / "set.toml"
    write_synergy_file(path, file)
    again = read_synergy_file(path)
    assert again == file
    assert [math.copysign(1, x) for row in again.S for x in row] == [math.copysign(1, x) for r in file.S for x in r]


def test_a_title_that_is_no_text_does_not_break_the_file(path):
    file = read_synergy_file(path).model_copy(update={"title": 'a "b" \\ \udcff \x7f\n'})
    write_synergy_file(path, file)
    assert read_synergy_file(path).title == 'a "b" \\ ? \x7f\n'


def test_a_synergy_file_is_replaced_and_nothing_else_is(path, tmp_path):
    file = parse(Document(path, {**read_synergy_file(path).model_dump(by_alias=True), "title": "new"}), SynergyFile)
    write_synergy_file(path, file, "-o")
    assert read_synergy_file(path).title == "new"
    other = tmp_path / "problem.toml"
    for content in ("schema = 1\n[task]\n", "not TOML at all"):
        other.write_text(content, encoding="utf-8")
        with pytest.raises(InputError, match="is there and is no synergy file") as caught:
            write_synergy_file(other, file, "-o")
        assert caught.value.issues[0].key == "-o"
        assert caught.value.issues[0].file == ""
        assert other.read_text(encoding="utf-8") == content
    with pytest.raises(InputError, match=r"ends in \.toml"):
        write_synergy_file(tmp_path / "postures.csv", file, "-o")
    with pytest.raises(InputError, match="cannot write"):
        write_synergy_file(other / "below.toml", file, "-o")
    with pytest.raises(InputError, match="cannot write"):
        write_synergy_file(tmp_path / ("long" * 100 + ".toml"), file, "-o")
    (tmp_path / "folder.toml").mkdir()
    with pytest.raises(InputError, match="is a directory"):
        write_synergy_file(tmp_path / "folder.toml", file, "-o")
    assert {entry.name for entry in tmp_path.iterdir()} == {"two.toml", "problem.toml", "folder.toml"}


def test_a_disk_that_is_full_leaves_the_old_file(path, monkeypatch):
    file = read_synergy_file(path)

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(type(path), "write_text", full)
    with pytest.raises(OutputError, match="No space left on device") as caught:
        write_synergy_file(path, file, "-o")
    assert (caught.value.key, caught.value.exit_code) == ("-o", 5)
    assert path.read_text(encoding="utf-8") == TEXT
    assert len(list(path.parent.iterdir())) == 1


def test_the_text_names_the_joint_of_each_row(path):
    lines = synergy_text(read_synergy_file(path)).splitlines()
    assert lines[5:7] == ["    [1.0, 0.5],  # c", "    [2.0, 0.0],  # a"]


# In hand.toml


def test_a_hand_may_have_its_sets_in_files(tmp_path):
    source = bundled("models") / "hands" / "barrett"
    text = (source / "hand.toml").read_text(encoding="utf-8")
    start, end = text.index("[synergies.motors]"), text.index("[synergies.close]")
    table = '[synergies.pca]\nfile = "pca.toml"\neffort_limits = { close = "2 N m" }\n\n'
    postures = text[text.index("[postures.open]") :]
    (tmp_path / "hand.toml").write_text(text[:start] + table + text[end:].replace(postures, ""), encoding="utf-8")
    (tmp_path / "hand.urdf").write_bytes((source / "hand.urdf").read_bytes())
    synergies = 'synergies = ["close", "still"]\nS = [[1, 0], [0.5, 0]]\n'
    (tmp_path / "pca.toml").write_text(
        f'schema = 1\njoints = ["finger1_inner", "finger2_inner"]\n{synergies}', encoding="utf-8"
    )
    found = next(iter(load_hand(tmp_path).synergy_sets.values()))
    assert (found.name, found.synergies) == ("pca", ("close", "still"))
    np.testing.assert_allclose(found.S[:, 0], [1, 1 / 3, 0, 0.5, 1 / 6, 0, 0, 0])
    np.testing.assert_array_equal(found.S[:, 1], 0)
    np.testing.assert_array_equal(found.effort_limits, [2, math.inf])
