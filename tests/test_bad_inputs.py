import importlib.util
import json
import random
import sys
from pathlib import Path
from types import ModuleType

import pytest

from synergrip.documents.time_table import MODES, MOTION, WRENCH, read_table
from synergrip.errors import InputError
from synergrip.grasps.given import read_given
from synergrip.problems.problem_file import read_problem_file
from synergrip.reports.text.refusal_text import error_json, error_text


def _table() -> ModuleType:
    path = Path(__file__).with_name("bad_inputs.py")
    spec = importlib.util.spec_from_file_location("bad_inputs", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["bad_inputs"] = module
    spec.loader.exec_module(module)
    return module


bad = _table()


def lay_out(folder, files):
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def read_everything(folder):
    """Read a problem and every file it names, as planning it would."""
    problem, document = read_problem_file(folder / "problem.toml")
    try:
        if problem.grasp:
            read_given(document.beside(problem.grasp.file), "grasp.file")
        tables = {"wrench": WRENCH, "motion": MOTION, "modes": MODES}
        for name, columns in tables.items():
            value = getattr(problem.task, name)
            if isinstance(value, str):
                read_table(document.beside(value), columns, f"task.{name}")
    except InputError as error:
        raise error.located(document.locate) from None


def test_there_are_many_cases_with_names_of_their_own():
    names = [case.name for case in bad.CASES]
    assert len(names) >= 70
    assert len(set(names)) == len(names)


def test_the_intact_files_are_accepted(tmp_path):
    lay_out(tmp_path, {"problem.toml": bad.HAND.encode()})
    read_everything(tmp_path)
    texts = {"problem.toml": bad.MATRICES, "wrench.csv": bad.WRENCH, "grasp.json": bad.GRASP}
    lay_out(tmp_path, {name: text.encode() for name, text in texts.items()})
    read_everything(tmp_path)


@pytest.mark.parametrize("case", bad.CASES, ids=lambda case: case.name)
def test_bad_input_is_refused_where_it_stands(case, tmp_path):
    lay_out(tmp_path, case.files)
    with pytest.raises(InputError) as caught:
        read_everything(tmp_path)
    first = caught.value.issues[0]
    assert first.key == case.key
    assert case.fragment in first.message
    assert first.file == str(tmp_path / case.file)
    assert "pydantic" not in str(caught.value)
    assert len(caught.value.issues) == bad.SEVERAL.get(case.name, 1)
    assert "nothing was solved" in error_text(caught.value, color=False)
    told = error_json(caught.value)["error"]
    assert {"type", "message", "file", "line", "column", "key", "errors"} <= set(told)
    json.dumps(told, allow_nan=False)


SPLICES = [
    "",
    "nan",
    "-1",
    "[",
    "]",
    '"',
    "{}",
    "null",
    "true",
    "1e400",
    "\x00",
    "ä",
    "\n",
    "9" * 30,
    ".",
    ",",
    "=",
    "[[a]]",
]


@pytest.mark.parametrize("name", ["problem.toml", "grasp.json", "wrench.csv", "hand"])
@pytest.mark.parametrize("seed", range(25))
def test_damaged_files_are_read_or_refused_and_nothing_else(name, seed, tmp_path):
    texts = {"problem.toml": bad.MATRICES, "wrench.csv": bad.WRENCH, "grasp.json": bad.GRASP}
    if name == "hand":
        name, texts = "problem.toml", {"problem.toml": bad.HAND}
    chance, refusals = random.Random(seed), []
    for _ in range(4):
        text = texts[name]
        start = chance.randrange(len(text))
        damaged = text[:start] + chance.choice(SPLICES) + text[start + chance.choice([0, 1, 1, 5, 40]) :]
        lay_out(tmp_path, {key: value.encode() for key, value in {**texts, name: damaged}.items()})
        try:
            read_everything(tmp_path)
        except InputError as error:
            refusals.append(error)
    assert all(issue.message and issue.file for error in refusals for issue in error.issues)
    assert all("nothing was solved" in error_text(error, color=True) for error in refusals)
