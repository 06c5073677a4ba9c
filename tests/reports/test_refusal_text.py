import pytest

from synergrip.errors import InputError, Issue
from synergrip.problems.problem_file import read_problem_file
from synergrip.reports.text.refusal_text import WIDTH, error_json, error_text

BALL = """\
schema = 1
[[contact]]
at = "tip"
model = "hrad"

[task]
move = [{ axis = "z", lift = "1 mm", profle = "linear" }]
[limits]
margin = "0.5"
"""

SHOWN = """\
error contact[0].model: 'hrad' is not one of 'hard', 'soft', 'frictionless', 'soft-elliptic' or \
'patch'; did you mean 'hard'?
  --> {path}:4:9
   4 | model = "hrad"
     |         ^^^^^^

error task.move[0].profle: unknown key 'profle'; did you mean 'profile'?
  --> {path}:7:38
   7 | move = [{{ axis = "z", lift = "1 mm", profle = "linear" }}]
     |                                      ^^^^^^

error limits.margin: missing unit; write "0.5 N" (units: N, mN, kN)
  --> {path}:9:10
   9 | margin = "0.5"
     |          ^^^^^

3 errors in {path}; nothing was solved.      exit code 2"""


@pytest.fixture
def ball(tmp_path):
    path = tmp_path / "ball.toml"
    path.write_text(BALL, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_problem_file(path)
    return path, caught.value


def test_every_issue_is_shown_with_its_line(ball):
    path, error = ball
    assert error_text(error, color=False) == SHOWN.format(path=path)


def test_colour_changes_nothing_but_colour(ball):
    _, error = ball
    text = error_text(error, color=True)
    for code in ("\x1b[31m", "\x1b[34m", "\x1b[1m", "\x1b[0m"):
        assert code in text
        text = text.replace(code, "")
    assert text == error_text(error, color=False)


def test_json_holds_the_first_issue_and_all_of_them(ball):
    path, error = ball
    told = error_json(error)["error"]
    assert told["type"] == "InputError"
    assert [issue["key"] for issue in told["errors"]] == ["contact[0].model", "task.move[0].profle", "limits.margin"]
    first = told["errors"][0]
    assert first == {key: told[key] for key in ("message", "file", "line", "column", "key")}
    assert (first["file"], first["line"], first["column"]) == (str(path), 4, 9)


def test_what_is_unknown_is_null():
    told = error_json(InputError([Issue("no")]))["error"]
    assert told["errors"] == [{"message": "no", "file": None, "line": None, "column": None, "key": None}]
    assert error_text(InputError([Issue("no")])) == "error: no\n\n1 error; nothing was solved.      exit code 2"


def test_a_long_line_is_shown_around_the_issue():
    source = "x" * 500 + "BAD" + "y" * 500
    text = error_text(InputError([Issue("wrong", "k", "f", 1, 501, 3, source)]))
    shown, mark = text.split("\n")[2:4]
    assert len(shown) <= WIDTH + 7
    assert shown[mark.index("^") : mark.rindex("^") + 1] == "BAD"


def test_control_characters_do_not_reach_the_terminal():
    text = error_text(InputError([Issue("a\x1b[2Jb", "k\x07", "f\x1b", 1, 2, 1, "\t\x1b[2J")]))
    assert "\x1b" not in text
    assert "\x07" not in text


def test_several_files_are_counted():
    text = error_text(InputError([Issue("a", file="x"), Issue("b", file="y")]))
    assert text.endswith("2 errors in 2 files; nothing was solved.      exit code 2")
