"""What every verb prints fits the terminal, with no word and no number split, and has colours only where wanted."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import run
from pseudo_terminal import WIDE, apart, broken, plain, run_in_terminal, shown, too_long

WIDTHS = (60, 80, 120)
PROBLEMS = {
    "gripper-box": ("--set", "task.knots=3"),
    "human-ball": ("--set", "task.knots=3"),
    "robonaut-handle": ("--set", "task.knots=3"),
    "barrett-ball-lift": ("--set", "task.knots=3"),
    "tripod": (),
    "dlr-ball-turn": ("--set", "task.knots=5"),
}
"""Bundled problems, with knots that take little time: the words are the same."""
TOO_MUCH = ("--set", "limits.margin=100 N")
ON_EACH = (("plan",), ("plan", "-v"), ("validate",), ("analyse",), ("analyse", "--table"), ("analyse", "--quality"))
COMMANDS = [(verb, name, *options, *few) for verb, *options in ON_EACH for name, few in PROBLEMS.items()]
COMMANDS += [("synergies", "needed", name, "--up-to", "1", "--most", "1", *few) for name, few in PROBLEMS.items()]
COMMANDS += [("margins", name, "--only", "least_peak_N", *few) for name, few in PROBLEMS.items()]
COMMANDS += [("explain", name, *few) for name, few in PROBLEMS.items() if name != "barrett-ball-lift"]
COMMANDS += [
    ("explain", "tripod", *TOO_MUCH), ("plan", "gripper-box", "--set", "task.knots=3", *TOO_MUCH),
    ("margins", "tripod", "--all"), ("front", "tripod", "-n", "3"),
    ("front", "tripod", "-n", "2", "--against", "friction"), ("problems",), ("hands",), ("synergies", "list"),
    ("synergies", "show", "human", "--posture", "ball"), ("synergies", "show", "robonaut"),
    ("synergies", "compare", "dlr-hand-ii", "eigengrasps", "actuators"),
    ("plan", "tripod", "--pyramids", "8"),
]  # fmt: skip


@pytest.mark.parametrize("arguments", COMMANDS, ids=" ".join)
def test_lines_fit_and_nothing_is_split(arguments: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.delenv("COLUMNS", raising=False)
    monkeypatch.setenv("TERM", "xterm")
    told = shown(arguments, (*WIDTHS, WIDE), monkeypatch)
    for width in WIDTHS:
        assert not too_long(told[width], width)
        assert not broken(told[width], told[WIDE]), told[width]
        assert not apart(told[width]), told[width]


@pytest.mark.parametrize("name", PROBLEMS)
def test_a_plan_that_is_checked_and_played_fits(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    run("plan", name, "-o", "there", *PROBLEMS[name])
    told = [shown(("check", "there", name, *PROBLEMS[name]), (*WIDTHS, WIDE), monkeypatch)]
    if name == "gripper-box":
        monkeypatch.undo()
        told.append(shown(("simulate", "there", "--once", "--step", "1e-3"), (*WIDTHS, WIDE), monkeypatch))
    for each in told:
        for width in WIDTHS:
            assert not too_long(each[width], width)
            assert not broken(each[width], each[WIDE]), each[width]


def test_colours_are_there_unless_nobody_wants_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.delenv("COLUMNS", raising=False)
    plan = ("plan", "gripper-box", "--set", "task.knots=3")
    colored = run_in_terminal(plan, 80, tmp_path, TERM="xterm")
    assert "\x1b[1;32mfeasible" in colored
    for environment in ({"NO_COLOR": "1", "TERM": "xterm"}, {"TERM": "dumb"}):
        assert "\x1b" not in run_in_terminal(plan, 80, tmp_path, **environment)
    assert not too_long(colored, 80)
    piped = run(*plan)
    assert "\x1b" not in piped.output
    assert not too_long(piped.output, 80)
    assert plain(colored).split()[:20] == piped.output.split()[:20]


def test_what_is_wrong_fits_and_is_without_colours_where_none_are_wanted(tmp_path: Path) -> None:
    long = 'limits.margin="this is a number in many words, none of which has a meaning to anybody"'
    for arguments in (("plan", "tripod", "--set", long), ("plan", "no-such-problem"), ("check", "none", "tripod")):
        told = run_in_terminal(arguments, 80, tmp_path, NO_COLOR="1", TERM="xterm")
        assert "error" in told
        assert "\x1b" not in told
        assert not too_long(told, 80)
