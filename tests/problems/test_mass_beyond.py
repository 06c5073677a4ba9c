"""A mug by its handle, a pan, a hammer: a bare mass with stated normals is a load, wherever it is."""

from __future__ import annotations

import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.problems.problem import Problem, load_problem

SOFT = "model='soft', friction=0.6, spin_friction='8 mm', stiffness='8 N/mm', spin_stiffness='2 N m/rad'"
PADS = f"contacts={{{SOFT}, normals='pad', at=['left/tip', 'right/tip']}}"
LIMITS = ("limits={margin='0.1 N', normal_force='400 N'}", "goal={minimise='effort'}", "task={gravity=[0, 0, -9.81]}")


def bar(x: float, *overrides: str, y: float = 40.0, z: float = 120.0) -> Problem:
    """The gripper's two pads, 28 mm to the left and right of the palm's axis, and a mass at (x, y, z) mm."""
    body = f"object={{mass='100 g', position=['{x} mm', '{y} mm', '{z} mm']}}"
    return load_problem("gripper-box", [body, PADS, *LIMITS, *overrides])


def squeeze(problem: Problem) -> tuple[float, np.ndarray]:
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    forces = outcome.motion.forces[0]
    wrench = problem.grasp.G @ forces + outcome.motion.wrench[0]
    assert np.abs(wrench).max() < 1e-9
    return float(forces[problem.grasp.normal_rows].max()), forces


def test_the_answer_is_continuous_where_the_mass_passes_the_plane_of_a_pad() -> None:
    """Nothing happens at 28 mm: the moments about the pads grow with the arm, and the squeeze with them."""
    at = np.array([-60.0, -35, -28.1, -27.9, -10, 0, 10, 27.9, 28.1, 35, 60, 150])
    found = np.array([squeeze(bar(x))[0] for x in at])
    assert found == pytest.approx(np.array([squeeze(bar(-x))[0] for x in at]), rel=1e-6)  # the gripper is symmetric
    order = np.argsort(np.abs(at), kind="stable")
    assert np.all(np.diff(found[order]) > -1e-6)
    assert abs(found[7] - found[8]) < 0.05


@pytest.mark.parametrize(("y", "z"), [(0.0, 120.0), (0.0, 300.0), (-200.0, 0.0), (0.0, -100.0)])
def test_a_mass_anywhere_is_held_or_proven_too_heavy(y: float, z: float) -> None:
    for x in (0.0, 28.0, 35.0, 200.0):
        problem = bar(x, y=y, z=z)
        assert isinstance(plan(problem.grasp, problem.task), Plan | Infeasible)
        assert [contact.frame[:, 0].tolist() for contact in problem.grasp.contacts] == [
            contact.frame[:, 0].tolist() for contact in bar(0.0).grasp.contacts
        ]


def test_normals_toward_the_mass_are_still_judged_and_the_error_says_what_to_write() -> None:
    toward = PADS.replace("normals='pad'", "normals='object'")
    with pytest.raises(InputError) as caught:
        bar(35, toward)
    (issue,) = caught.value.issues
    assert issue.key == "contacts.at[0]"
    assert 'write normals = "pad"' in issue.message
    bar(35, toward, 'contacts.normals="pad"')  # the advice, followed


def test_a_shape_has_a_surface_and_pads_must_face_it() -> None:
    with pytest.raises(InputError, match=r"faces away|outside the surface"):
        bar(35, "object.shape={box={size=['10 mm', '40 mm', '40 mm']}}")


def test_a_normal_stated_on_a_link_is_one_with_or_without_the_word_pad() -> None:
    """The same places and normals as the gripper's pads, told by link."""
    problem = bar(35)
    held = problem.held
    assert held is not None
    entries = []
    for touch in held.touches:
        point = ", ".join(f"'{1e3 * value!r} mm'" for value in touch.pad.point.tolist())
        place = f"link='{touch.pad.link}', point=[{point}], radius='{1e3 * touch.pad.radius} mm'"
        entries.append(f"{{name='{touch.name}', {place}, normal={touch.pad.normal.tolist()!r}}}")
    own = f"contacts={{{SOFT}}}"
    for word in ("", "contacts.normals=pad"):
        by_link = bar(35, own, f"contact=[{', '.join(entries)}]", *([word] if word else []))
        assert np.allclose(by_link.grasp.G, problem.grasp.G, atol=1e-12)
        assert squeeze(by_link)[0] == pytest.approx(squeeze(problem)[0], rel=1e-6)
    with pytest.raises(InputError, match="faces away"):
        bar(35, own, f"contact=[{', '.join(entries)}]", "contacts.normals=object")
