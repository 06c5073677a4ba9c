"""The tables of docs/export.md have a row for each format and column."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import synergrip as sg
from synergrip.reports.data.exports.exporting import EXPORTERS

TEXT = (Path(__file__).parents[2] / "docs" / "export.md").read_text(encoding="utf-8")


def test_each_format_has_a_row_with_its_files_and_its_package() -> None:
    rows = {row[0].strip("` "): row for row in (line.split("|")[1:] for line in TEXT.splitlines() if line[:1] == "|")}
    for name, exporter in EXPORTERS.items():
        _, files, package, matrices, _, _ = rows[name]
        assert re.findall(r"`([^`]+)`", files) == list(exporter.files)
        assert package.strip() == exporter.package
        assert matrices.strip() == ("no" if exporter.of_hand else "synergies" if exporter.joints_of_hand else "yes")


@pytest.mark.parametrize("name", ["gripper-box", "tripod"])
def test_each_column_has_a_row(name: str, tmp_path: Path) -> None:
    problem = sg.load_problem(name, ["task.knots=3"] if name == "gripper-box" else [])
    answer = sg.plan(problem.grasp, problem.task)
    assert isinstance(answer, sg.Plan)
    (file,) = answer.export(tmp_path, to="csv")
    told = re.findall(r"^\| `(\w+)` \|", TEXT.partition("## Columns")[2], re.MULTILINE)
    keys = {re.sub(r"_(SYNERGY|JOINT|CONTACT|x|w|fx|s)(_.*)?$", "", each).removeprefix("true_") for each in told}
    header = file.read_text(encoding="utf-8").splitlines()[0].split(",")
    found = {re.match(r"(?:true_)?(object_quaternion|[a-z]+)_", column)[1] for column in header}  # type: ignore[index]
    assert found <= keys
