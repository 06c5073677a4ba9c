"""What docs/export.md shows is what happens, and its tables have a row for each format and column."""

from __future__ import annotations

import contextlib
import io
import re
import shlex
from pathlib import Path

import pytest
from command_line import run
from test_in_code import judge

import synergrip as sg
from synergrip.reports.data.exports.exporting import EXPORTERS

TEXT = (Path(__file__).parents[2] / "docs" / "export.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", TEXT, re.DOTALL | re.MULTILINE)


def test_the_page_prints_what_it_shows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (indented,) = re.findall(r"^    synergrip (plan .*)$", TEXT, re.MULTILINE)
    assert run(*shlex.split(indented)).exit_code == 0
    kinds = [kind for kind, _ in BLOCKS]
    assert kinds == ["bash", "text", "python", "text"]
    command, shown, code, printed = (text for _, text in BLOCKS)
    result = run(*shlex.split(command)[1:])
    assert result.exit_code == 0, result.output
    assert result.stdout.split() == shown.split()
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(code, "export.md", "exec"), {"__name__": "page"})
    judge(out.getvalue(), printed)
    files = {path.name for path in (tmp_path / "out" / "gripper-peg" / "export").iterdir()}
    assert files == {Path(word).name for word in shown.split() if "/" in word}


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
