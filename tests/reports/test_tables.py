"""Tables and paragraphs fit their place; numbers stand with their points below each other."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from synergrip import ActuatorEffort, ElasticMotion, FrictionReserve, Plan, load_problem, plan
from synergrip.conic.decide import Decision
from synergrip.conic.limits.actuator_effort import unit_of_efforts
from synergrip.conic.solution import Claim
from synergrip.documents.quantities import in_mm
from synergrip.reports.text.screen import Screen, shown_on
from synergrip.reports.text.tables import fitted, table, wrapped
from synergrip.reports.text.text_checked import solved_lines
from synergrip.reports.text.text_moved import moved_lines
from synergrip.reports.text.text_plan import verdict_lines

ROWS = [("slip margin", "0.49999 N", "≥ 0.5 N"), ("angle", "-58.84 deg", "≤ 10 deg"), ("torque", "1 N m", "±2 N m")]


def test_points_stand_below_each_other() -> None:
    lines = table(("", "worst", "limit"), ROWS).split("\n")
    assert lines == [
        "             worst        limit",
        "slip margin    0.49999 N  ≥  0.5 N",
        "angle        -58.84 deg   ≤ 10 deg",
        "torque         1 N m      ±  2 N m",
    ]


@pytest.mark.parametrize("width", [40, 50, 64, 80])
def test_what_is_too_wide_stands_below_its_row_and_is_whole(width: int) -> None:
    setting = """--set 'object.mass="1.9285 kg"'"""
    rows = [("how heavy a thing may be held like this", "1.9285 kg", "below 1.958 kg", setting)]
    with shown_on(Screen(width)):
        lines = table(("", "attained", "end", "with"), rows).split("\n")
    assert max(map(len, lines)) <= width
    assert any(line.endswith(setting) for line in lines)
    assert "1.9285 kg" in "\n".join(lines).replace(setting, "")


def test_lists_of_a_command_break_after_commas_alone() -> None:
    names = ", ".join(f'"finger{i} inner"' for i in range(9))
    with shown_on(Screen(60)):
        lines = wrapped("with ", f"--set 'hand.synergies=[{names}]'")
    assert max(map(len, lines)) <= 60
    assert [line[-1] for line in lines[:-1]] == [","] * (len(lines) - 1)


def test_a_word_that_is_too_long_is_whole() -> None:
    path = "/" + "long/" * 30
    with shown_on(Screen(60)):
        assert fitted(f"wrote {path} and more than that in many words") == (
            f"wrote\n  {path}\n  and more than that in many words"
        )


def test_letters_that_are_wide_count_as_two() -> None:
    with shown_on(Screen(40)):
        lines = wrapped("", "手" * 15 + " " + "手" * 15)
        assert len(lines) == 2
        assert table(("a", "b"), [("手手", "x"), ("abcd", "y")]).split("\n")[1:] == ["手手  x", "abcd  y"]


def test_a_place_with_colours_has_bold_heads() -> None:
    with shown_on(Screen(80, color=True)):
        assert table(("a",), [("b",)]) == "\x1b[1ma\x1b[0m\nb"


def test_a_hold_is_told_as_one() -> None:
    problem = load_problem("pinch-soft")
    told = " ".join(" ".join(verdict_lines(problem, plan(problem.grasp, problem.task))).split())
    assert re.search(r"moved the object by up to [\d.]+ mm \(t = 0.00 s\), all of it by change of load \(sag\)", told)
    limited = load_problem("pinch-soft", ['limits.elastic_motion="5 mm"', "limits.safety_factor=1.2"])
    answer = plan(limited.grasp, limited.task)
    assert isinstance(answer, Plan)
    told = "\n".join(verdict_lines(limited, answer))
    assert "slip margin at friction / 1.2" in told
    assert "the squeeze alone" not in told  # a row tells it, beside its limit
    assert any(isinstance(limit, ElasticMotion) for limit in limited.task.limits)
    assert FrictionReserve(angle=0.1745329252).title == "slip margin 10 deg inside the cone"


def test_a_squeeze_and_a_sag_that_cancel_are_told_as_no_motion() -> None:
    problem = load_problem("barrett-ball-hold", ["task.knots=4"])
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    net = np.linalg.norm(answer.analysis.response.scale.twist(answer.elastic_motion + answer.motion.sag), axis=1)
    told = " ".join(" ".join(moved_lines(answer)).split())
    assert told.startswith(f"moved the object by up to {in_mm(net.max())} (t = ")
    assert "the squeeze alone" in told
    cancelled = replace(answer, elastic_motion=-answer.motion.sag)
    told = " ".join(" ".join(moved_lines(cancelled)).split())
    assert told == "moved the object stays within 0.001 mm of where it starts: the squeeze makes up for the sag"
    assert "the squeeze alone" in " ".join(" ".join(moved_lines(cancelled, details=True)).split())
    free = replace(cancelled, task=replace(answer.task, axes=("x", "y", "z")))  # goals choose how it turns
    assert "within 0.001 mm of its rigid motion" in " ".join(" ".join(moved_lines(free)).split())
    one = replace(answer, elastic_motion=0 * answer.motion.sag)
    assert "all of it by change of load" in " ".join(" ".join(moved_lines(one)).split())


def test_details_are_told_to_those_who_ask() -> None:
    problem = load_problem("pinch-soft")
    answer = plan(problem.grasp, problem.task)
    short, long = ("\n".join(verdict_lines(problem, answer, details=details)) for details in (False, True))
    (check,) = (line for line in short.splitlines() if line.startswith("check"))
    assert check.count("✓") >= 2
    assert len(short.splitlines()) < len(long.splitlines())
    for each in answer.checks:
        assert f"\n{each.name} " in long
    assert "certificate: gap" in long
    assert "certificate: gap" not in short


@pytest.mark.parametrize(("name", "unit"), [("barrett-ball-hold", "N m"), ("tripod", "synergy units")])
def test_efforts_are_told_in_the_unit_of_what_synergies_move(name: str, unit: str) -> None:
    grasp = load_problem(name).grasp
    assert unit_of_efforts(grasp) == unit
    assert [dial.unit for dial in ActuatorEffort(2.0).dials(grasp)] == [unit]


def test_what_solvers_come_to_no_end_of_is_told_in_words() -> None:
    problem = load_problem("pinch-soft")
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    one = answer.decisions[-1]
    none = replace(one, solution=replace(one.solution, claim=Claim.NOTHING))
    no = replace(one, solution=replace(one.solution, claim=Claim.INFEASIBLE))

    def told(*decisions: Decision, details: bool = False) -> str:
        return " ".join(" ".join(solved_lines(decisions, details=details)).split())

    assert told(one, one).endswith(": optimal")
    assert told(one, none, none).endswith(": optimal (2 of them without an answer of the solver; -v names them)")
    assert told(one, no, no, none).endswith(
        f": {one.goal} infeasible (1 of them without an answer of the solver; -v names them)"
    )
    assert told(none).endswith(": no answer of the solver")
    assert "-v" not in told(one, none, details=True)
