"""Broken [task] tables: the key at fault, a piece of the message, and the line it points at."""

from __future__ import annotations

from pathlib import Path

import pytest
from task_tables import loads

from synergrip.errors import InputError
from synergrip.problems.problem_file import read_problem_file
from synergrip.reports.text.refusal_text import error_text

INTACT = (Path(__file__).parents[1] / "data" / "bad_inputs" / "hand.toml").read_text(encoding="utf-8")
BEFORE, AFTER = INTACT[: INTACT.index("[task]")], INTACT[INTACT.index("[limits]") :]

WAY = '[[task.waypoint]]\ntime = "1 s"\n'
PUSH = '[[task.push]]\nforce = "3 N"\ndirection = "x"\n'
PALM = '[task.palm]\naxis = "x"\nturn = "90 deg"\n'
PATH = '[task.palm]\npath = "arm.csv"\ninertia = true\n'
CASES = [
    # name, the [task] table without its head, key, fragment, the line pointed at
    ("no-time", '[[task.waypoint]]\nposition = ["0 m", "0 m", "1 mm"]', "task.waypoint[0].time", "key 'time'", ""),
    ("time-zero", WAY.replace("1 s", "0 s"), "task.waypoint[0].time", "must be greater than 0", 'time = "0 s"'),
    ("time-bare", WAY.replace('"1 s"', "1"), "task.waypoint[0].time", 'such as "1 s"', "time = 1"),
    ("time-back", WAY + WAY.replace("1 s", "0.5 s"), "task.waypoint[1].time", "after the one before, at 1 s", "0.5 s"),
    ("time-again", WAY + WAY, "task.waypoint[1].time", "at least 1 us after the one before, at 1 s, got 1 s", ""),
    ("time-soon", WAY.replace("1 s", "1e-7 s"), "task.waypoint[0].time", "after the start, at 0 s", "1e-7 s"),
    ("way-too-long", 'duration = "0.5 s"\n' + WAY, "task.waypoint[0].time", "after the end of the task at 0.5", "1 s"),
    ("two-lengths", WAY + 'position = ["1 m", "1 m"]', "task.waypoint[0].position", "expected 3 lengths, got 2", "1 m"),
    ("angle-in-m", WAY + 'rotation = ["0 deg", "1 m", "0 deg"]', "task.waypoint[0].rotation[1]", "unit of length", ""),
    ("no-modes", WAY + "modes = []", "task.waypoint[0].modes", "expected one or more lengths, got 0", "modes = []"),
    (
        "pose-and-modes", WAY + 'modes = ["1 mm"]\nposition = ["0 m", "0 m", "0 m"]', "task.waypoint[0].position",
        "leave out 'position'", "position",
    ),
    (
        "modes-in-the-middle", WAY + WAY.replace("1 s", "2 s") + 'modes = ["1 mm"]', "task.waypoint[1]",
        "the first waypoint has position and rotation; give all of them alike", "",
    ),
    (
        "fewer-modes", WAY + 'modes = ["1 mm", "1 mm"]\n' + WAY.replace("1 s", "2 s") + 'modes = ["1 mm"]',
        "task.waypoint[1].modes", "the first waypoint has 2 modes, this one 1", 'modes = ["1 mm"]',
    ),
    (
        "move-and-way", WAY + '[[task.move]]\naxis = "z"\nlift = "1 mm"', "task.waypoint",
        "given already by 'move'; keep one", "",
    ),
    ("motion-and-way", 'motion = "m.csv"\n' + WAY, "task.waypoint", "given already by 'motion'", ""),
    ("profile-of-none", 'profile = "spline"', "task.profile", "there are none; a move has its own", "profile"),
    ("profile", 'profile = "splin"\n' + WAY, "task.profile", "did you mean 'spline'?", "splin"),
    ("way-one-knot", "knots = 1\n" + WAY, "task.knots", "moves or turns needs at least 2 knots", "knots = 1"),
    ("way-off-knots", "knots = 4\n" + WAY + WAY.replace("1 s", "2 s"), "task.waypoint[0].time", "not on a knot", "1 s"),
    ("way-key", WAY + "velocity = 1", "task.waypoint[0].velocity", "unknown key 'velocity'; known keys: time", ""),
    ("mode-seven", '[[task.move]]\nmode = 7\namplitude = "1 mm"', "task.move[0].mode", "must be at most 6, got 7", ""),
    ("palm-of-nothing", '[task.palm]\nprofile = "cubic"', "task.palm", "the palm needs a motion", ""),
    ("turn-no-axis", PALM.replace('axis = "x"\n', ""), "task.palm.axis", "missing key 'axis'", ""),
    (
        "axis-no-turn", '[task.palm]\naxis = "x"\nshift = ["1 m", "0 m", "0 m"]\ninertia = true', "task.palm.axis",
        "'axis' goes with turn", "axis",
    ),
    ("palm-changes-nothing", PALM, "task.palm", "changes nothing without task.gravity or inertia = true", ""),
    (
        "shift-changes-nothing", 'gravity = [0, 0, -9.81]\n[task.palm]\nshift = ["1 m", "0 m", "0 m"]',
        "task.palm.shift", "write inertia = true", "shift",
    ),
    ("shift-of-two", '[task.palm]\nshift = ["1 m", "0 m"]', "task.palm.shift", "expected 3 lengths, got 2", "shift"),
    ("inertia-word", PALM + 'inertia = "yes"', "task.palm.inertia", "expected true or false, got 'yes'", "inertia"),
    ("inertia-number", PALM + "inertia = 1", "task.palm.inertia", "expected true or false, got 1", "inertia"),
    ("path-and-axis", PATH + 'axis = "x"', "task.palm.axis", "leave out 'axis', or path", "axis"),
    ("path-and-turn", PATH + 'turn = "90 deg"', "task.palm.turn", "leave out 'turn', or path", "turn"),
    ("path-and-shift", PATH + 'shift = ["1 m", "0 m", "0 m"]', "task.palm.shift", "leave out 'shift', or", "shift"),
    ("path-and-profile", PATH + 'profile = "linear"', "task.palm.profile", "leave out 'profile', or path", "linear"),
    ("path-changes-nothing", '[task.palm]\npath = "arm.csv"', "task.palm", "changes nothing without", ""),
    ("path-gone", PATH, "task.palm.path", "arm.csv", 'path = "arm.csv"'),
    ("path-number", "[task.palm]\npath = 3", "task.palm.path", "expected a string, got 3", "path"),
    ("path-one-knot", "knots = 1\n" + PATH, "task.knots", "moves or turns needs at least 2 knots", "knots = 1"),
    ("jerk", PALM + 'inertia = true\nprofile = "linear"', "task.palm.profile", "use 'min-jerk' or 'cubic'", "linear"),
    ("no-force", '[[task.push]]\ndirection = "x"', "task.push[0].force", "missing key 'force'", ""),
    ("pull", PUSH.replace("3 N", "-3 N"), "task.push[0].force", "must be at least 0", "force"),
    ("no-direction", '[[task.push]]\nforce = "1 N"', "task.push[0].direction", "missing key 'direction'", ""),
    ("direction", PUSH.replace('"x"', '"-x"'), "task.push[0].direction", "'-x' is not 'x', 'y', 'z' or a list", ""),
    ("direction-zero", PUSH.replace('"x"', "[0, 0, 0]"), "task.push[0].direction", "needs a direction", "direction"),
    ("before-zero", PUSH + 'start = "-1 s"', "task.push[0].start", "must be at least 0", "start"),
    ("no-ramp", PUSH + 'profile = "trapezoid"', "task.push[0].profile", "a trapezoid needs ramp", "profile"),
    ("ramp-of-step", PUSH + 'ramp = "0.1 s"', "task.push[0].ramp", "the profile is 'step'", "ramp"),
    ("push-late", PUSH + 'end = "9 s"', "task.push[0].end", "ends at 9 s, after the task, which ends at 1 s", "9 s"),
    ("push-one-knot", "knots = 1\n" + PUSH + 'end = "0.5 s"', "task.knots", "a push for some time needs at least", ""),
    ("push-off-knots", "knots = 3\n" + PUSH + 'end = "0.7 s"', "task.push[0].end", "not on a knot", 'end = "0.7 s"'),
    ("push-table", "push = 3", "task.push", "expected a list", "push"),
]  # fmt: skip


def _read(folder: Path, task: str) -> None:
    path = folder / "problem.toml"
    path.write_text(f"{BEFORE}[task]\n{task}\n\n{AFTER}", encoding="utf-8")
    problem, document = read_problem_file(path)
    assert problem.object is not None
    try:
        loads(problem.task, folder, problem.object.mass or 0.0)
    except InputError as error:
        raise error.located(document.locate) from None


@pytest.mark.parametrize("task", ["", WAY, PUSH, PALM + "inertia = true", PUSH + PALM + "inertia = true\n" + WAY])
def test_the_intact_tables_are_accepted(task: str, tmp_path: Path) -> None:
    _read(tmp_path, task)


@pytest.mark.parametrize(("task", "key", "fragment", "line"), [case[1:] for case in CASES], ids=[c[0] for c in CASES])
def test_a_bad_task_is_refused_where_it_stands(task: str, key: str, fragment: str, line: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        _read(tmp_path, task)
    (issue,) = caught.value.issues
    assert issue.key == key
    assert fragment in issue.message
    assert line in issue.source
    assert issue.file == str(tmp_path / "problem.toml")
    assert "pydantic" not in str(caught.value)
    assert "nothing was solved" in error_text(caught.value, color=False)
