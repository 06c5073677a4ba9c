"""What every verb prints fits the terminal, with no word and no number split, and has colours only where wanted."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
import typer
from command_line import run
from pseudo_terminal import WIDE, apart, broken, plain, run_in_terminal, shown, too_long
from rich.markup import render

from synergrip.cli import beside, running
from synergrip.cli.app import app

WIDTHS = (60, 80, 120)
PROBLEMS = {
    "gripper-box": ("--set", "task.knots=3"),
    "human-ball": ("--set", "task.knots=3"),
    "robonaut-handle": ("--set", "task.knots=2"),
    "barrett-ball-lift": ("--set", "task.knots=3"),
    "tripod": (),
    "dlr-ball-turn": ("--set", "task.knots=5"),
}
"""Bundled problems, with knots that take little time: the words are the same."""
TOO_MUCH = ("--set", "limits.margin=100 N")
ON_EACH = (("plan", "-v"), ("validate",), ("analyse",), ("synergies", "needed", "--up-to", "1", "--most", "1"))
COMMANDS = [(*verb, name, *few) for verb in ON_EACH for name, few in PROBLEMS.items()]
COMMANDS += [("margins", name, "--only", "shortest_duration_s", *few) for name, few in PROBLEMS.items() if few]
COMMANDS += [("analyse", "--quality", name, *PROBLEMS[name]) for name in ("tripod", "gripper-box", "robonaut-handle")]
COMMANDS += [
    ("analyse", "--table", "human-ball"), ("explain", "tripod", *TOO_MUCH), ("explain", "tripod"),
    ("plan", "gripper-box", *PROBLEMS["gripper-box"]), ("plan", "pinch-hard"), ("plan", "tripod", *TOO_MUCH),
    ("plan", "tripod", "--pyramids", "8"),
    ("margins", "tripod", "--only", "least_peak_N", "--only", "sensitivities", "--only", "disturbance", "--all"),
    ("margins", "tripod", "--only", "quality"),
    ("front", "tripod", "-n", "3"), ("front", "tripod", "-n", "2", "--against", "friction"),
    ("figure", "margin", "tripod", "-o", "margin.svg"), ("figure", "synergies", "gripper-box", "-o", "synergies.svg"),
    ("problems",), ("hands",), ("hands", "human-graspit"), ("synergies", "list"),
    ("synergies", "show", "human", "--posture", "ball"),
    ("synergies", "compare", "dlr-hand-ii", "eigengrasps", "actuators"),
]  # fmt: skip
"""Each verb; those that take seconds on hands are asked for little of them, and for all of smaller grasps."""


@pytest.fixture(autouse=True)
def _terminal_with_colours(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.delenv("COLUMNS", raising=False)
    monkeypatch.setenv("TERM", "xterm")


def holds(arguments: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    told = shown(arguments, (*WIDTHS, WIDE), monkeypatch)
    for width in WIDTHS:
        assert not too_long(told[width], width)
        assert not broken(told[width], told[WIDE]), told[width]
        assert not apart(told[width]), told[width]


@pytest.mark.parametrize("arguments", COMMANDS, ids=" ".join)
def test_lines_fit_and_nothing_is_split(arguments: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    holds(arguments, monkeypatch)


@pytest.mark.parametrize("name", ["gripper-box", "tripod", "dlr-ball-turn"])
def test_a_plan_that_is_checked_fits(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    run("plan", name, "-o", "there", *PROBLEMS[name])
    holds(("check", "there", name, *PROBLEMS[name]), monkeypatch)


def test_a_plan_that_is_played_fits(monkeypatch: pytest.MonkeyPatch) -> None:
    run("plan", "gripper-box", "-o", "there", "--set", "task.knots=2", "--set", "task.move=[]")
    holds(("simulate", "there", "--once", "--step", "2e-3"), monkeypatch)


def test_how_far_it_is_stands_on_one_line_that_is_wiped(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    for told in ("11 of 20 subsets", "2 of 3", "", ""):
        beside.over(told)
    written = capsys.readouterr().err
    assert written == "\r11 of 20 subsets\r2 of 3          \r      \r"
    running.show(running.Format.TEXT, lambda: "answer", dict)
    assert capsys.readouterr() == ("answer\n", "")


def test_colours_are_there_unless_nobody_wants_them(tmp_path: Path) -> None:
    colored = run_in_terminal(("plan", "tripod"), 80, tmp_path)
    bare = run_in_terminal(("plan", "tripod"), 80, tmp_path, NO_COLOR="1")
    piped = run("plan", "tripod").output
    assert "\x1b[1;32mfeasible" in colored
    assert "\x1b" not in bare + piped
    assert not too_long(bare, 80)
    for line, other, third in zip(plain(colored).split("\n"), bare.split("\n"), piped.split("\n"), strict=True):
        assert line.startswith("solve") or line == other == third


def test_what_is_wrong_fits_the_terminal_and_is_one_line_in_a_pipe(tmp_path: Path) -> None:
    wrong = ("plan", "tripod", "--set", 'limits.margin="a number in many words, none of which has a meaning"')
    told = run_in_terminal(wrong, 60, tmp_path, NO_COLOR="1")
    assert told.startswith("error limits.margin: ")
    assert "\x1b" not in told
    assert not too_long(told, 60)
    assert not apart(told)
    (line, *_) = run(*wrong).stderr.splitlines()
    assert " ".join(told.split()).startswith(line)


def test_no_words_of_the_help_are_taken_for_markup() -> None:
    """Of "On paper [mm]" a terminal shows "On paper "."""
    root = typer.main.get_command(app)
    verbs = [root, *getattr(root, "commands", {}).values()]
    verbs += [each for verb in verbs[1:] for each in getattr(verb, "commands", {}).values()]
    told = [text for verb in verbs for text in (verb.help, *(getattr(each, "help", None) for each in verb.params))]
    assert len([text for text in told if text]) > 100
    assert [text for text in told if text and str(render(text)) != text] == []
