"""Which way a contact with two frictions slips more easily is told where nobody says it."""

import numpy as np

from synergrip import load_problem, plan

TWO = ('contacts.model="soft-elliptic"', "contacts.friction=0.7", "contacts.cross_friction=0.35")
AT = '{{ at = "{0}/tip", tangent = {1} }}'


QUICK = 'task.linearise="once"'


def notes(*changes):
    problem = load_problem("gripper-peg", [*TWO, QUICK, *changes])
    return problem, [note for note in problem.notes if "tangent" in note]


def test_the_direction_is_told_in_axes_of_the_link_and_writing_it_changes_nothing():
    problem, (note,) = notes()
    assert [each for each in plan(problem.grasp, problem.task).notes if "tangent" in each] == [note]
    directions = []
    for side in ("left", "right"):
        assert f"of link '{side}_tip'" in note
        directions.append(note.partition(f"{side}/tip [")[2].partition("]")[0])
    written = ", ".join(AT.format(side, f"[{each}]") for side, each in zip(("left", "right"), directions, strict=True))
    stated, none = notes("contacts.at=[]", f"contact=[{written}]")
    assert not none
    np.testing.assert_allclose(stated.grasp.G, problem.grasp.G, atol=1e-3)


def test_one_friction_both_ways_needs_no_direction():
    assert not notes("contacts.cross_friction=0.7")[1]


def test_only_contacts_without_a_tangent_are_named():
    _, (note,) = notes('contacts.at=["right/tip"]', f"contact=[{AT.format('left', '[0, 0, 1]')}]")
    assert "left/tip" not in note
    assert "right/tip [" in note
