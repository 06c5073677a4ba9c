"""What is to be controlled independently, against the dimensions of Theorem 1."""

from __future__ import annotations

import pytest

import synergrip as sg


def refused(name: str, **control: object) -> sg.Infeasible:
    problem = sg.load_problem(name)
    answer = sg.plan(problem.grasp, problem.task.replace(control=sg.Control(**control)))  # type: ignore[arg-type]
    assert isinstance(answer, sg.Infeasible)
    assert answer.certificate.verified
    return answer


def test_as_much_as_the_synergies_control_changes_nothing() -> None:
    problem = sg.load_problem("tripod")
    forces, motions, redundant = sg.analyse(problem.grasp).spaces.dimensions
    assert (forces, motions, redundant) == (2, 2, 0)
    asked = sg.Control(forces=2, motions=("z", "rz"))
    answer = sg.plan(problem.grasp, problem.task.replace(control=asked))
    assert answer.verdict == "feasible"


def test_more_directions_than_synergies_are_refused_by_count_with_what_competes() -> None:
    answer = refused("tripod", forces=2, motions=("z", "rz", "x"))
    assert answer.stage == "count"
    assert "asks for 5 independent directions, the hand has n_z = 4" in answer.why
    assert "its synergies control 2 of internal force, 2 of motion and 0 of reconfiguration" in answer.why
    assert "2 of internal force and 3 of motion (z, rz, x) compete" in answer.why
    assert answer.explanation.cause == "count"


@pytest.mark.parametrize(
    ("control", "told"),
    [
        ({"forces": 3}, "these synergies control 2 (dim E_s)"),
        ({"reconfiguration": 1}, "these synergies control 0 (dim Gamma_zr)"),
        ({"motions": ("x",)}, "cannot be moved at will along or about x"),
    ],
)
def test_directions_that_are_not_controlled_are_refused_by_direction(control: dict[str, object], told: str) -> None:
    answer = refused("tripod", **control)
    assert answer.stage == "direction"
    assert told in answer.why


def test_a_file_says_the_same() -> None:
    problem = sg.load_problem("tripod", "task.control={ forces = 2, motions = ['z', 'rz', 'x'] }")
    assert problem.task.control == sg.Control(forces=2, motions=("z", "rz", "x"))
    assert sg.plan(problem.grasp, problem.task).verdict == "infeasible"
