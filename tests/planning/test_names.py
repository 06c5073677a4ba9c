"""Names are the user's: whatever they hold, they are told apart, and nothing is read out of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from named_goals import goals
from small_grasps import tripod

from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.program import Program
from synergrip.conic.pyramids import inscribed
from synergrip.documents.csv_cells import cells_of
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.planning.formulated import formulated
from synergrip.planning.outcome import Infeasible, Outcome, Plan
from synergrip.planning.planning import plan
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import load_problem
from synergrip.reports.data.plan_files import plan_csv
from synergrip.statics.analysis import analyse
from synergrip.tasks.timed_task import TimedTask, still

TIMES = np.array([0.0, 0.1, 0.2])
WEIGHT = np.array([0, 0, -1.0, 0, 0, 0])

SCHEMES = {
    "parentheses": ["tip (1)", "tip (2)", "tip (3)"],
    "the words for sides": ["x (lowest)", "x (highest)", "x"],
    "the words for changes": ["x (falling)", "x", "x (rising)"],
    "the words for facets": ["x (facet 1)", "x (facet 2)", "x"],
    "words of ours": ["object", "least", "relaxation"],
    "colons and slashes": ["a:b", "a/b", "a::b/"],
    "dots and indices": ["a.b", "a[0].b", "a[1]"],
    "single quotes": ["it's", "'it''s'", "`"],
    "other scripts": ["Daumen ß", "指 1", "指 2"],
    "marks of a format": ["{0}", "%s", "$\\frac$"],
    "very long": ["a" * 3000 + str(i) for i in range(3)],
    "what files refuse": ["a\nb", 'a"b', "a,b"],
}


def named(names: list[str]) -> Grasp:
    """The tripod, with contacts, synergies and joints of these names; nine joints need each of them thrice."""
    grasp = tripod()
    contacts = tuple(replace(c, name=name) for c, name in zip(grasp.contacts, names, strict=True))
    joints = tuple(f"{name}{' ' * i}(j)" for i in range(3) for name in names)
    return replace(grasp, contacts=contacts, synergies=tuple(names), joints=joints)


def asked(grasp: Grasp, margin: float, *limits: Limit, solver: str = "clarabel") -> Outcome:
    wrench = WEIGHT * np.array([0.0, 1.0, 0.5])[:, None]
    task = TimedTask(TIMES, wrench, still(TIMES), margin, limits, goals("effort"))
    return plan(grasp, task, SOLVERS[solver])


LIMITS: tuple[Limit, ...] = (
    NormalForce(0.5, 2.0),
    JointTorque(frozen(np.full(9, 1.5))),
    SynergyRate(frozen(np.full(3, 1e-3))),
)
PLAIN = ["C1", "C2", "C3"]


@pytest.mark.parametrize("solver", ["clarabel", "cvxpy"])
@pytest.mark.parametrize("scheme", SCHEMES)
def test_names_change_neither_plan_nor_proof(scheme: str, solver: str) -> None:
    names, plain = SCHEMES[scheme], named(PLAIN)
    other = named(names)
    translated = dict(zip((*PLAIN, *plain.joints), (*names, *other.joints), strict=True))
    expected, outcome = (asked(grasp, 0.1, *LIMITS, solver=solver) for grasp in (plain, other))
    assert isinstance(expected, Plan)
    assert isinstance(outcome, Plan)
    assert np.array_equal(outcome.motion.dz_r, expected.motion.dz_r)
    no, same_no = (asked(grasp, 9.0, *LIMITS, solver=solver) for grasp in (plain, other))
    assert isinstance(no, Infeasible)
    assert isinstance(same_no, Infeasible)
    assert no.conflicts
    assert [(c.key, c.share) for c in same_no.conflicts] == [(c.key, c.share) for c in no.conflicts]
    assert [c.items for c in same_no.conflicts] == [tuple(translated[i] for i in c.items) for c in no.conflicts]


def test_three_tips_are_three(tmp_path: Path) -> None:
    """Every contact carries a like share of the proof, and each is named."""
    outcome = asked(named(SCHEMES["parentheses"]), 9.0, NormalForce(0.0, 2.0))
    assert isinstance(outcome, Infeasible)
    assert {conflict.key: set(conflict.items) for conflict in outcome.conflicts} == {
        "limits.margin": set(SCHEMES["parentheses"]),
        "limits.normal_force": set(SCHEMES["parentheses"]),
    }
    assert outcome.program is not None
    outcome.program.save(tmp_path / "program.npz")
    assert Program.load(tmp_path / "program.npz").blocks == outcome.program.blocks


def test_a_contact_named_object_is_no_drift_of_the_object() -> None:
    """Facets stand in for the cones of contacts, and for no other cone of three rows."""
    grasp = named(["object", "b", "c"])
    drift = ObjectError(1e-3, ("x", "y"))
    analysis = analyse(grasp, np.zeros((3, 6)))
    task = TimedTask(TIMES, np.zeros((3, 6)), still(TIMES), 0.0, (drift,), goals("effort"))
    formulation = formulated(analysis, task, redundancy=True)
    (rows,) = drift.rows(formulation)
    assert rows.dim == 3
    assert inscribed(rows, 6) is rows


def test_what_two_contacts_are_called_is_refused_in_python() -> None:
    for names, key in ((["a", "b", "a"], "Grasp.contacts[2]"), (["a", "", "c"], "Contact.name")):
        with pytest.raises(InputError) as caught:
            named(names)
        assert caught.value.issues[0].key == key


BAD_NAMES = ['"a\\nb"', '"a,b"', "'a\"b'", '""', '"a\\u0000b"', "3", '"b"']


@pytest.mark.parametrize("name", BAD_NAMES)
def test_names_that_files_cannot_hold_are_refused_where_they_stand(name: str) -> None:
    entries = f'[{{at="finger1/tip", name={name}}}, {{at="finger2/tip", name="b"}}]'
    with pytest.raises(InputError) as caught:
        load_problem("barrett-ball-hold", [f"contact={entries}"])
    assert caught.value.issues[0].key == ("contacts.at[1]" if name == '"b"' else "contact[0].name")


def test_every_column_of_a_table_has_a_name_of_its_own() -> None:
    """Joints of a model file may be called anything: a comma in a name is none between two."""
    outcome = asked(named(SCHEMES["what files refuse"]), 0.1, NormalForce(0.0, 20.0))
    assert isinstance(outcome, Plan)
    header, *lines = plan_csv(outcome).splitlines()
    cells = [cell.text for cell in cells_of(header, 1)]
    assert len(cells) == len(set(cells)) == len(lines[0].split(","))
    assert 'margin_a"b_N' in cells
    assert "margin_a,b_N" in cells
