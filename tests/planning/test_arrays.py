"""The arrays of a plan: one table feeds every file, the check of a plan and the documentation."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from synergrip.planning.arrays import ARRAYS, arrays_of, columns_of, documentation, table_of
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.reports.data.json_plan import outcome_document

DOCUMENTED = Path(__file__).parents[2] / "docs" / "answers.md"
ONE_MORE = """
import dataclasses, json, sys
from pathlib import Path
import synergrip.planning.arrays as arrays

twice = arrays.PlanArray("twice", ("T", "n_z"), "rad", "twice dz_r", lambda p: 2 * p.motion.dz_r, "references",
                         arrays.Columns("twice_SYNERGY", lambda grasp: [f"twice_{name}" for name in grasp.synergies]))
arrays.ARRAYS = (*arrays.ARRAYS, twice)  # the one line

import numpy as np
from synergrip import load_problem, plan
from synergrip.planning.check import judge_references
from synergrip.planning.references import read_references

folder = Path(sys.argv[1])
problem = load_problem("tripod")
answer = plan(problem.grasp, problem.task)
files = answer.save(folder, problem=problem)
document = json.loads((folder / "plan.json").read_text(encoding="utf-8"))
assert document["twice"] == (2 * answer.dz_r).tolist()
assert np.array_equal(np.load(folder / "plan.npz")["twice"], 2 * answer.dz_r)
assert "twice_z1" in (folder / "plan.csv").read_text(encoding="utf-8").splitlines()[0].split(",")
assert "| `twice` |" in arrays.documentation()
for path in files:
    judged = judge_references(problem.grasp, problem.timed, read_references(path, problem.grasp))
    assert judged.verdict == "feasible" and not judged.claims.differences, path
    assert ("columns" if path.suffix == ".csv" else "twice") in judged.claims.right, path
document["twice"][3][0] += 0.01
del document["digest"]
(folder / "plan.json").write_text(json.dumps(document), encoding="utf-8")
wrong = judge_references(problem.grasp, problem.timed, read_references(folder, problem.grasp)).claims.differences
assert [each.key for each in wrong] == ["twice[3][0]"], wrong
"""


def test_the_documentation_has_the_table() -> None:
    written, table = DOCUMENTED.read_text(encoding="utf-8"), documentation()
    assert table in written, f"put this table into docs/answers.md:\n{table}"


def test_one_line_adds_an_output_array(tmp_path: Path) -> None:
    command = (sys.executable, "-c", ONE_MORE, str(tmp_path))
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name", ["tripod", "barrett-ball-carry"])
def test_arrays_have_the_shapes_that_the_table_states(name: str) -> None:
    problem = load_problem(name)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    grasp, spaces = answer.grasp, answer.analysis.spaces
    sizes = {"T": len(answer.time), "6": 6, "n_z": grasp.n_z, "n_q": grasp.n_q, "n_l": grasp.n_l, "n_c": grasp.n_c}
    names = ("dim E_s", "dim Gamma_ucs", "dim Gamma_zr")
    sizes |= dict(zip(names, spaces.dimensions, strict=True))
    found = arrays_of(answer.moved)
    assert {each.key: found[each.key].shape for each in ARRAYS} == {
        each.key: tuple(sizes[word] for word in each.shape) for each in ARRAYS
    }
    columns = columns_of(grasp)
    assert table_of(answer.moved).shape == (len(answer.time), sum(map(len, columns.values())))
    for key, each in columns.items():
        assert len(each) == found[key].size // len(answer.time)


def test_all_values_of_every_limit_are_told() -> None:
    problem = load_problem("barrett-ball-carry")
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    document = json.loads(json.dumps(outcome_document("", problem.grasp, answer), allow_nan=False))
    assert len(document["limits"]) == len(answer.usages)
    for told, usage in zip(document["limits"], answer.usages, strict=True):
        series = told["series"]
        values = np.array(series["values"])
        assert values.shape == (len(answer.time), len(series["items"]))
        assert np.array_equal(values, usage.value)
        k, i = list(document["time_s"]).index(told["time_s"]), series["items"].index(told["item"])
        assert (values[k, i], series["lower"][i], series["upper"][i]) == (told["value"], told["lower"], told["upper"])


@pytest.mark.parametrize("name", ["tripod", "dlr-ball-turn"])
def test_the_elastic_motion_of_the_file_is_that_of_the_answer(name: str) -> None:
    problem = load_problem(name)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    told = outcome_document(problem.title, problem.grasp, answer)
    assert np.array_equal(told["elastic_motion"], answer.elastic_motion)
    rigid = answer.motion.du - answer.elastic_motion - answer.motion.sag
    if answer.executed is None:
        assert np.allclose(rigid, answer.beta @ answer.analysis.spaces.Gamma_ucs.T, atol=1e-9)
    else:  # a motion that nothing squeezes is not elastic, however far it goes
        assert np.abs(rigid - answer.formulation.target)[:, :3].max() < 1e-3 * np.abs(answer.formulation.target).max()
