from typing import Literal

import pytest
from pydantic import Field

from synergrip.documents.documents import parse, read_document
from synergrip.documents.fields import Length, Table, Whole
from synergrip.documents.overrides import parse_override
from synergrip.errors import InputError, Issue
from synergrip.plain_file import read_text

TOML = """\
# a comment
title = "ü" # unicode
task.knots = 3
"quoted key" = [1, [2,
  3], { deep = 4 }]

[hand.compliance]
joint = 1

[hand]
model = "x"

[[contact]]
at = "a"

[[contact]]
at = "b"
[[contact.mark]]
x = 1
"""

JSON = """{
  "G": [[1, 2],
        [3, "four"]],
  "a": {"b": true}
}
"""


@pytest.fixture
def write(tmp_path):
    def written(text, name="file.toml"):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return written


def refused(call, *args):
    with pytest.raises(InputError) as caught:
        call(*args)
    return caught.value.issues


@pytest.mark.parametrize(
    ("text", "name", "place"),
    [
        ("a = 1\nb = 1" + "0" * 5000, "file.toml", (2, 5)),
        ("a = 1_000" + "_000" * 2000, "file.toml", (1, 5)),
        ('{"a": 1,\n "b": -1' + "0" * 5000 + "}", "file.json", (2, 8)),
    ],
)
def test_a_number_with_too_many_digits_is_told_in_plain_words(write, text, name, place):
    (issue,) = refused(read_document, write(text, name))
    assert issue.message == "a number with too many digits"
    assert (issue.line, issue.column) == place
    assert issue.file.endswith(name)


@pytest.mark.parametrize(
    ("key", "on_key", "underlined"),
    [
        ("title", False, (2, '"ü"')),
        ("title", True, (2, "title")),
        ("task.knots", False, (3, "3")),
        ("task.knots", True, (3, "task.knots")),
        ("quoted key[1][1]", False, (5, "3")),
        ("quoted key[2].deep", True, (5, "deep")),
        ("hand", False, (10, "hand")),
        ("hand.compliance.joint", False, (8, "1")),
        ("contact[1].at", False, (17, '"b"')),
        ("contact[1]", False, (16, "contact")),
        ("contact[1].mark[0].x", False, (19, "1")),
        ("contact[0].friction", True, (13, "contact")),
        ("contact[0].at.missing[3]", False, (14, "at")),
    ],
)
def test_a_key_of_toml_is_found_in_the_file(write, key, on_key, underlined):
    issue = read_document(write(TOML)).locate(Issue("wrong", key=key, on_key=on_key))
    start = issue.column - 1
    assert (issue.line, issue.source[start : start + issue.length]) == underlined
    assert issue.source == TOML.split("\n")[issue.line - 1]


@pytest.mark.parametrize(
    ("key", "on_key", "underlined"),
    [
        ("G[1][1]", False, (3, '"four"')),
        ("a.b", False, (4, "true")),
        ("a.b", True, (4, '"b"')),
        ("G[0]", False, (2, "[1, 2]")),
    ],
)
def test_a_key_of_json_is_found_in_the_file(write, key, on_key, underlined):
    issue = read_document(write(JSON, "file.json")).locate(Issue("wrong", key=key, on_key=on_key))
    start = issue.column - 1
    assert (issue.line, issue.source[start : start + issue.length]) == underlined


def test_an_issue_that_has_its_place_keeps_it(write):
    issue = Issue("wrong", key="title", file="other.csv", line=7)
    assert read_document(write(TOML)).locate(issue) == issue


def test_windows_line_ends_and_a_byte_order_mark_change_nothing(write):
    plain = read_document(write(TOML)).locate(Issue("wrong", key="contact[1].at"))
    other = read_document(write(b"\xef\xbb\xbf" + TOML.replace("\n", "\r\n").encode()))
    assert other.locate(Issue("wrong", key="contact[1].at")) == plain


def test_duplicate_keys_of_json_are_all_named(write):
    issues = refused(read_document, write('{"a": 1,\n "b": {"c": 1, "c": 2}, "a": 3}', "x.json"))
    assert [(issue.key, issue.line, issue.column) for issue in issues] == [("b.c", 2, 16), ("a", 2, 25)]


def test_numbers_that_are_not_finite_are_all_found_in_json(write):
    text = '{"a": [1, NaN, "NaN", -Infinity], "b": {"c": 1e999, "d": 2}}'
    issues = refused(read_document, write(text, "x.json"))
    assert [(issue.key, issue.column, issue.length) for issue in issues] == [
        ("a[1]", 11, 3),
        ("a[3]", 23, 9),
        ("b.c", 46, 5),
    ]


@pytest.mark.parametrize(
    ("text", "line", "column"), [("a = \n", 1, 5), ("a = 1\nb = 2 3\n", 2, 7), ("a = 1\nb = [1,\n", 2, 8)]
)
def test_a_syntax_error_of_toml_has_its_place(write, text, line, column):
    (issue,) = refused(read_document, write(text))
    assert issue.message.startswith("not valid TOML: ")
    assert "line" not in issue.message.split(":")[1].split()[-2:]
    assert (issue.line, issue.column) == (line, column)


def test_an_integer_of_thousands_of_digits_is_refused(write):
    (issue,) = refused(read_document, write('{"a": ' + "1" * 5000 + "}", "x.json"))
    assert "too many digits" in issue.message


def test_a_missing_file_suggests_its_neighbour(write):
    path = write("", "problem.toml")
    (issue,) = refused(read_document, path.with_name("problm.toml"), "problem file")
    assert issue.message.endswith("not found; did you mean 'problem.toml'?")
    (issue,) = refused(read_document, path.parent / "nowhere" / "x.toml")
    assert "there is no directory" in issue.message
    (issue,) = refused(read_document, path.with_name("nul\0l.toml"))
    assert "cannot be read" in issue.message


def test_the_suffix_must_be_known(write):
    (issue,) = refused(read_document, write("", "problem.yaml"), "problem file")
    assert issue.message == "the name of a problem file ends in .toml or .json"


def test_a_file_named_by_a_key_leaves_its_place_to_the_document(tmp_path):
    (issue,) = refused(read_text, tmp_path / "wrench.csv", "CSV file", "task.wrench")
    assert (issue.key, issue.file) == ("task.wrench", "")


class Contact(Table):
    model: Literal["hard", "soft"] = "hard"
    friction: float = Field(gt=0, description="coefficient of friction")


class Model(Table):
    knots: Whole = 3
    size: Length = 0.0
    contact: tuple[Contact, ...] = ()


def test_all_objections_to_a_file_come_at_once_and_in_file_order(write):
    text = """\
knots = 1.5
size = "3 kg"
[[contact]]
model = "hrad"
[[contact]]
fricton = 0.5
[[contact]]
friction = -1
"""
    issues = refused(parse, read_document(write(text)), Model)
    assert [(issue.line, issue.key, issue.message) for issue in issues] == [
        (1, "knots", "expected a whole number, got 1.5"),
        (2, "size", "'kg' is a unit of mass; expected a length (units: m, cm, mm, um)"),
        (3, "contact[0].friction", "missing key 'friction' (coefficient of friction)"),
        (4, "contact[0].model", "'hrad' is not one of 'hard' or 'soft'; did you mean 'hard'?"),
        (6, "contact[1].fricton", "unknown key 'fricton'; did you mean 'friction'?"),
        (8, "contact[2].friction", "must be greater than 0, got -1"),
    ]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("contact = 3", "expected a list, got 3"),
        ("contact = [3]", "expected a table, got 3"),
        ("contact = [{ friction = 'x' }]", "expected a number, got 'x'"),
        ("contact = [{ friction = 1, model = 2 }]", "expected 'hard' or 'soft', got 2"),
        ("knots = true", "expected a whole number, got true"),
        ("knots = 2024-01-01", "expected a whole number, got datetime.date(2024, 1, 1)"),
    ],
)
def test_a_wrong_type_says_what_is_wanted(write, text, message):
    (issue,) = refused(parse, read_document(write(text)), Model)
    assert issue.message == message


def test_overrides_change_values_and_create_tables(write):
    document = read_document(write(TOML))
    changed = document.with_overrides(
        ["task.knots=21", "limits.margin=0.3 N", "contact[1].at='c'", 'limits.range=["0 N", "2 N"]', 'hand."a.b"=true']
    )
    assert changed.data["task"]["knots"] == 21
    assert changed.data["limits"] == {"margin": "0.3 N", "range": ["0 N", "2 N"]}
    assert [contact["at"] for contact in changed.data["contact"]] == ["a", "c"]
    assert changed.data["hand"]["a.b"] is True
    assert document.data["task"]["knots"] == 3


def test_an_issue_of_an_override_shows_the_override(write):
    document = read_document(write("knots = 1\n")).with_overrides(["knots=one", "contact=[{friction=0}]"])
    issues = refused(parse, document, Model)
    assert [(issue.key, issue.file) for issue in issues] == [
        ("contact[0].friction", "--set contact=[{friction=0}]"),
        ("knots", "--set knots=one"),
    ]


@pytest.mark.parametrize(
    ("text", "fragment"),
    [
        ("knots", "expected KEY=VALUE"),
        ("=3", "is not a key"),
        ("a..b=3", "is not a key"),
        ("a.=3", "is not a key"),
        ("contact.at=3", "'contact' is a list; write contact[0].at"),
        ("contact[2].at=3", "'contact' has 2 entries, counted from 0; there is no [2]"),
        ("title[0]=3", "'title' is not a list"),
        ("title.x=3", "'title' is a value and not a table"),
        ("task.knots=nan", "nan is not a finite number"),
    ],
)
def test_an_override_that_cannot_be_applied_is_named(write, text, fragment):
    (issue,) = refused(read_document(write(TOML)).with_overrides, [text])
    assert fragment in issue.message
    assert issue.file == f"--set {text}"


def test_a_value_of_an_override_cannot_smuggle_in_another_key():
    assert parse_override("a=1\nb=2").value == "1\nb=2"
