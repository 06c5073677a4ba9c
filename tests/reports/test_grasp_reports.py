"""What validate shows of a grasp, as text and as a document, and where notes are told."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from synergrip.explain import explained
from synergrip.planning.planning import plan
from synergrip.problems.problem import Problem, load_problem
from synergrip.reports.data.json_grasp import in_order_document
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.text.screen import Screen, shown_on
from synergrip.reports.text.text_grasp import in_order_text
from synergrip.reports.text.text_plan import outcome_text

SUNK = ("hand.posture=open", "hand.close=close", "object.position=['0 m', '3 mm', '109 mm']")
NOTE = "the hand may collide with the ball r 50 mm"


@pytest.fixture(scope="module")
def ball() -> Problem:
    return load_problem("barrett-ball-hold")


@pytest.fixture(scope="module")
def sunk() -> Problem:
    return load_problem("barrett-ball-hold", SUNK)


def columns(text: str, problem: Problem) -> list[list[str]]:
    """The cells of the table of contacts: cells are two spaces apart."""
    lines = text.split("\n")
    start = next(i for i, line in enumerate(lines) if line.startswith("contact "))
    rows = lines[start + 1 : start + 1 + problem.grasp.n_c]
    return [[cell.strip() for cell in row.split("  ") if cell.strip()] for row in rows]


def numbers(cell: str) -> list[float]:
    return [float(part) for part in cell.strip("()").split(",")]


def test_the_document_holds_posture_object_and_contacts_in_the_palm_frame(ball: Problem) -> None:
    document, held = in_order_document(ball), ball.held
    assert held is not None
    assert (document["valid"], document["file"], document["title"]) == (True, str(ball.path), ball.title)
    assert document["posture"] == dict(zip(held.hand.joint_names, held.q, strict=True))
    assert document["object"]["position_m"] == held.body.position.tolist()
    assert document["notes"] == []
    tips = held.hand.kinematics.at(held.q, [(f"finger{i}_tip", np.zeros(3)) for i in (1, 2, 3)])
    for contact, tip in zip(document["contacts"], tips, strict=True):
        inward = (held.body.position - tip.position) / 0.05
        assert contact["point_m"] == pytest.approx(tip.position.tolist(), abs=1e-12)
        assert contact["normal"] == pytest.approx(inward.tolist(), abs=1e-9)
        assert contact["gap_m"] == pytest.approx(0, abs=1e-12)
    about = {key: [contact[key] for contact in document["contacts"]] for key in ("name", "link", "kind", "friction")}
    assert about == {
        "name": ["finger1/tip", "finger2/tip", "finger3/tip"], "link": ["finger1_tip", "finger2_tip", "finger3_tip"],
        "kind": ["hard"] * 3, "friction": [0.6] * 3,
    }  # fmt: skip
    json.dumps(document, allow_nan=False)


@pytest.fixture(autouse=True)
def _wide(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Every row in one line."""
    monkeypatch.setenv("COLUMNS", "200")
    with shown_on(Screen(200)):
        yield


def test_the_text_says_the_same(ball: Problem) -> None:
    text, document, held = in_order_text(ball), in_order_document(ball), ball.held
    assert held is not None
    begins = f"{ball.path}: in order (3 contacts, 8 joints, 4 synergies, 41 knots) posture "  # paths can be long
    assert " ".join(text.split()).startswith(begins)
    posture = text.split("posture  ")[1].split("object   ")[0]
    values = [" ".join(item.split()) for item in posture.replace("\n", " ").split("·")]
    assert values == [f"{name} {math.degrees(value):.4g} deg" for name, value in document["posture"].items()]
    assert "object   ball r 50 mm, 200 g, centre (0, 3.345, 148.8) mm in the palm frame" in text
    for row, contact in zip(columns(text, ball), document["contacts"], strict=True):
        assert [row[0], row[1], row[2]] == [contact["name"], contact["link"], contact["kind"]]
        assert numbers(row[3]) == pytest.approx([1e3 * x for x in contact["point_m"]], rel=1e-3, abs=1e-3)
        assert numbers(row[4]) == pytest.approx(contact["normal"], abs=1e-3)
        assert (float(row[5]), float(row[6])) == (0.0, contact["friction"])
    assert "note" not in text
    assert max(len(line) for line in text.split("\n")[1:]) <= 120


def test_gaps_are_shown_with_their_sign() -> None:
    near = load_problem("barrett-ball-hold", ["object.position=['0 m', '3.345 mm', '148.6 mm']"])
    gaps = [contact["gap_m"] for contact in in_order_document(near)["contacts"]]
    shown = [float(row[5]) for row in columns(in_order_text(near), near)]
    assert shown == pytest.approx([1e3 * gap for gap in gaps], abs=5e-4)
    assert min(abs(gap) for gap in gaps) > 5e-5


def test_an_object_without_a_shape_has_no_gaps_and_its_own_title() -> None:
    bare = load_problem("table2-hard-motors", ["object.title=stone"])
    document, text = in_order_document(bare), in_order_text(bare)
    assert [contact["gap_m"] for contact in document["contacts"]] == [None] * 3
    assert "object   stone, 200 g, centre" in text
    assert all(len(row) == 6 for row in columns(text, bare))
    named = load_problem("barrett-ball-hold", ["object.title=apple"])
    assert "object   apple, ball r 50 mm, 200 g, centre" in in_order_text(named)


def test_a_grasp_of_matrices_has_counts_and_notes_only() -> None:
    tripod = load_problem("tripod")
    told = f"{tripod.path}: in order (3 contacts, 9 joints, 4 synergies, 11 knots)"
    assert in_order_text(tripod).split() == told.split()
    assert set(in_order_document(tripod)) == {"valid", "file", "title", "notes"}


def test_notes_are_told_by_validate(sunk: Problem) -> None:
    (note,) = in_order_document(sunk)["notes"]
    assert note.startswith(NOTE)
    lines = in_order_text(sunk).split("\n")
    first = next(i for i, line in enumerate(lines) if line.startswith("note     "))
    assert " ".join(line[9:] for line in lines[first:]) == note


@pytest.mark.parametrize(
    "more",
    [
        [],
        ["contacts.friction=2", "limits.normal_force=200 N", "limits.joint_torque=50", "limits.joint_range=none",
         "task.knots=3", "task.between=report", "task.linearise=once"],
    ],
)  # fmt: skip
def test_notes_are_told_with_every_outcome_of_a_plan(more: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(explained, "_as_found", lambda repairs: ([], False))  # what would help takes long
    problem = load_problem("barrett-ball-hold", [*SUNK, *more])
    outcome = plan(problem.grasp, problem.task)
    assert outcome.verdict == ("unknown" if more else "infeasible")  # feasible for the start posture, which it leaves
    document = outcome_document(problem.title, problem.grasp, outcome, problem.notes)
    assert document["notes"][-1].startswith(NOTE)
    assert f"note     {NOTE}" in outcome_text(problem, outcome, Path("out"), ["plan.json"])


def test_a_plan_without_notes_says_nothing(ball: Problem) -> None:
    outcome = plan(ball.grasp, ball.task)
    assert outcome_document(ball.title, ball.grasp, outcome, ball.notes)["notes"] == []
    assert "note" not in outcome_text(ball, outcome, Path("out"), [])


def run(*arguments: str) -> str:
    command = [sys.executable, "-m", "synergrip", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def test_the_command_prints_both_and_asks_no_solver(ball: Problem) -> None:
    assert run("validate", "barrett-ball-hold").rstrip("\n") == in_order_text(ball)
    assert json.loads(run("validate", "barrett-ball-hold", "--format", "json")) == in_order_document(ball)
    code = (
        "import sys; from synergrip.cli.app import app\n"
        "try: app(['validate', 'barrett-ball-hold'])\n"
        "except SystemExit: pass\n"
        "print([m for m in ('clarabel', 'cvxpy', 'scipy.optimize') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.rstrip().endswith("[]")


def test_the_plan_command_writes_the_notes(tmp_path: Path) -> None:
    overrides = [part for override in SUNK for part in ("--set", override)]
    command = [sys.executable, "-m", "synergrip", "plan", "barrett-ball-hold", *overrides, "-o", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    assert json.loads((tmp_path / "plan.json").read_text())["notes"][-1].startswith(NOTE)
