"""``synergrip export``: places, refusals, hostile names and files."""

from __future__ import annotations

import csv
import errno
import json
import os
import re
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
import pytest
import yaml
from command_line import document, run

import synergrip as sg
from synergrip.cli import export as verb
from synergrip.reports.data.exports import exporting
from synergrip.reports.data.exports.exporting import EXPORTERS

EVERY = [word for each in EXPORTERS for word in ("--to", each)]
OF_MATRICES = [word for each, made in EXPORTERS.items() if not made.of_hand for word in ("--to", each)]
LONG, ODD = "long " * 400 + "end", "=cmd|<script>&; ünï/код\\ --> #: {}[]"
SLIDES = """<robot name="jaws"><link name="base"/><link name="world"/><link name=ODD/>
  <joint name="object" type="prismatic"><parent link="base"/><child link="world"/><origin xyz="0 0.03 0.05"/>
    <axis xyz="0 -1 0"/><limit lower="0" upper="0.02" effort="50"/></joint>
  <joint name=LONG type="prismatic"><parent link="base"/><child link=ODD/><origin xyz="0 -0.03 0.05"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="0.02" effort="50"/></joint>
</robot>"""
PROBLEM: dict[str, Any] = {
    "schema": 1, "title": f"{ODD} {LONG}",
    "hand": {"posture": {"object": "10 mm", LONG: "10 mm"}, "compliance": {"joint": "1e-4 m/N"}},
    "object": {"shape": {"box": {"size": ["30 mm", "40 mm", "30 mm"]}}, "mass": "100 g",
               "position": ["0 mm", "0 mm", "50 mm"]},
    "contacts": {"model": "hard", "friction": 0.6, "stiffness": "20 N/mm"},
    "contact": [{"name": "null", "link": "world", "point": ["0 mm", "0 mm", "0 mm"], "normal": [0, -1, 0]},
                {"name": "1e3", "link": ODD, "point": ["0 mm", "0 mm", "0 mm"], "normal": [0, 1, 0]}],
    "task": {"knots": 2, "gravity": [0, 0, -9.81]}, "limits": {"margin": "0.5 N"},
}  # fmt: skip


@pytest.fixture(scope="module")
def given(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a plan of a grasp given as matrices."""
    folder = tmp_path_factory.mktemp("given")
    problem = sg.load_problem("tripod")
    answer = sg.plan(problem.grasp, problem.task)
    assert isinstance(answer, sg.Plan), answer
    answer.save(folder)
    return folder


def jaws(folder: Path, **contacts: str) -> Path:
    """Return the folder of a plan of two jaws that slide, whose names are those of nobody's friend."""
    model = SLIDES.replace("ODD", quoteattr(ODD)).replace("LONG", quoteattr(LONG))
    (folder / "jaws.urdf").write_text(model, encoding="utf-8")
    problem = PROBLEM | {
        "hand": {"model": str(folder / "jaws.urdf"), **PROBLEM["hand"]},
        "contacts": PROBLEM["contacts"] | contacts,
    }
    loaded = sg.load_problem(problem)
    answer = sg.plan(loaded.grasp, loaded.task)
    assert isinstance(answer, sg.Plan), answer
    answer.save(folder, problem=loaded)
    return folder


@pytest.fixture(scope="module")
def hostile(tmp_path_factory: pytest.TempPathFactory) -> Path:
    soft = {"model": "soft", "spin_friction": "5 mm", "spin_stiffness": "2 N m/rad"}
    return jaws(tmp_path_factory.mktemp("hostile"), **soft)


def changed(folder: Path, new: Path, change: Callable[[dict[str, Any]], object]) -> Path:
    """Return a copy of a plan in which something is changed."""
    data = json.loads((folder / "plan.json").read_text(encoding="utf-8"))
    change(data)
    (new / "plan.json").write_text(json.dumps(data), encoding="utf-8")
    return new


def test_files_go_beside_the_plan_or_where_one_says(given: Path, tmp_path: Path) -> None:
    result = run("export", str(given), "--to", "csv", "--to", "npz")
    assert result.exit_code == 0, result.output
    assert run("check", str(given / "export" / "trajectory.csv"), "tripod").exit_code == 0
    assert {path.name for path in (given / "export").iterdir()} == {"trajectory.csv", "trajectory.npz"}
    assert str(given / "export" / "trajectory.npz") in result.stdout
    found = document("export", str(given / "plan.json"), "--to", "ros2-yaml", "-o", str(tmp_path / "a" / "b"))
    assert found["files"] == [str(tmp_path / "a" / "b" / "synergies.yaml")]
    assert found["exports"][0]["to"] == "ros2-yaml"
    assert "linear model" in found["figures"]


def test_what_stays_empty_is_told_beside_the_answer(given: Path, tmp_path: Path) -> None:
    result = run("export", str(given), "--to", "mcap", "-o", str(tmp_path), "--format", "json")
    told = json.loads(result.stdout)["exports"][0]["left_empty"]
    assert [each["field"] for each in told][-1] == "joints"
    for each in told:
        assert f"mcap: {each['field']} ({each['why']})" in " ".join(result.stderr.split())


def test_of_an_earlier_export_the_same_formats_are_replaced_and_the_rest_stays(given: Path, tmp_path: Path) -> None:
    for name in ("joints.yaml", "synergies.yaml", "mine.txt", "trajectory.csv"):
        (tmp_path / name).write_text("old", encoding="utf-8")
    assert run("export", str(given), "--to", "ros2-yaml", "-o", str(tmp_path)).exit_code == 0
    found = {path.name: path.read_text(encoding="utf-8") for path in tmp_path.iterdir()}
    assert found.keys() == {"synergies.yaml", "mine.txt", "trajectory.csv"}
    assert found["mine.txt"] == found["trajectory.csv"] == "old" != found["synergies.yaml"]


def test_all_is_written_or_nothing(given: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "trajectory.csv").write_text("old", encoding="utf-8")

    def full(plan: object, path: Path) -> None:
        path.write_bytes(b"half")
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setitem(exporting.EXPORTERS, "npz", exporting._one("trajectory.npz", full))
    result = run("export", str(given), "--to", "csv", "--to", "npz", "-o", str(tmp_path))
    assert result.exit_code == 5
    assert "No space left" in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["trajectory.csv"]
    assert (tmp_path / "trajectory.csv").read_text(encoding="utf-8") == "old"
    (tmp_path / "trajectory.npz").mkdir()
    result = run("export", str(given), "--to", "npz", "-o", str(tmp_path))
    assert result.exit_code == 5
    assert "trajectory.npz" in result.stderr
    assert run("export", str(given), "--to", "csv", "-o", str(tmp_path / "trajectory.csv" / "below")).exit_code == 2


def test_a_grasp_of_matrices_is_refused_what_only_a_hand_has(given: Path, tmp_path: Path) -> None:
    result = run("export", str(given), *EVERY, "-o", str(tmp_path / "out"))
    assert result.exit_code == 2
    for name in ("isaac_grasp", "moveit_grasp", "mjcf"):
        assert f"--to: '{name}' holds" in result.stderr
    assert "given as matrices, which has no hand" in " ".join(result.stderr.split())
    assert not (tmp_path / "out").exists()
    assert run("export", str(given), *OF_MATRICES, "-o", str(tmp_path / "out")).exit_code == 0


@pytest.mark.parametrize(("to", "package"), [("parquet", "pyarrow"), ("mcap", "rosbags"), ("ros2-yaml", "PyYAML")])
def test_a_missing_package_is_told_with_how_to_get_it(
    to: str, package: str, given: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, EXPORTERS[to].module, None)
    result = run("export", str(given), "--to", to, "--to", "csv", "-o", str(tmp_path / "out"))
    assert result.exit_code == 2
    assert f"--to: '{to}' needs {package}, which is not installed: pip install 'synergrip[export]'" in result.stderr
    assert not (tmp_path / "out").exists()


def test_the_help_and_the_extra_name_what_there_is() -> None:
    assert verb.FORMATS.split(", ") == list(EXPORTERS)
    text = (Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8")
    extra = tomllib.loads(text)["project"]["optional-dependencies"]["export"]
    packages = {each.package for each in EXPORTERS.values() if each.package}
    assert {re.split("[><=]", each)[0] for each in extra} == packages


def unlike(data: dict[str, Any]) -> None:
    data["execution"] = {"joints": ["a"]}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda data: data.pop("dz_r"), "holds no plan"),
        (lambda data: data.pop("units"), "plan again"),
        (lambda data: data.update(components=[["n"]]), "components"),
        (lambda data: data.update(components=3), "components"),
        (lambda data: data["units"].update(joints=["deg"]), "units.joints"),
        (lambda data: data.update(contacts=["a", "a"]), "contacts"),
        (lambda data: data.update(time_s=[1.0] * len(data["time_s"])), "time_s"),
        (lambda data: data.update({"lambda": [[1.0]]}), "lambda"),
        (unlike, "execution.joints"),
    ],
)
def test_a_file_that_is_none_is_refused_by_its_key(
    change: Callable[[dict[str, Any]], object], said: str, given: Path, tmp_path: Path
) -> None:
    result = run("export", str(changed(given, tmp_path, change)), "--to", "csv")
    assert result.exit_code == 2
    assert said in result.stderr
    assert not (tmp_path / "export").exists()


def test_numbers_that_were_changed_are_told(given: Path, tmp_path: Path) -> None:
    def more(data: dict[str, Any]) -> None:
        data["lambda"][0][0] += 1.0

    result = run("export", str(changed(given, tmp_path, more)), "--to", "csv")
    assert result.exit_code == 0
    assert "not those that were written" in " ".join(result.stderr.split())


def test_bad_arguments_end_with_2(given: Path, tmp_path: Path) -> None:
    assert "did you mean 'mjcf'" in run("export", str(given), "--to", "mjfc").stderr
    assert run("export", str(given)).exit_code == 2
    assert run("export", str(tmp_path / "none"), "--to", "csv").exit_code == 2
    for arguments in ({"to": 3}, {"to": []}, {"to": ["csv", 3]}):
        with pytest.raises(sg.InputError) as error:
            sg.export(given, tmp_path / "out", **arguments)  # type: ignore[arg-type]
        assert error.value.issues[0].key == "to"
    with pytest.raises(sg.InputError, match=r"^plan: "):
        sg.export(3, tmp_path / "out", to="csv")  # type: ignore[arg-type]
    with pytest.raises(sg.InputError, match=r"^folder: "):
        sg.export(given, "a\0b", to="csv")
    assert not (tmp_path / "out").exists()


def test_hostile_names_come_back_from_every_format(hostile: Path) -> None:
    import mujoco
    import pyarrow.parquet as pq

    result = run("export", str(hostile), *EVERY)
    assert result.exit_code == 0, result.output
    folder, plan = hostile / "export", json.loads((hostile / "plan.json").read_text(encoding="utf-8"))
    assert plan["joints"] == ["object", LONG]
    with (folder / "trajectory.csv").open(encoding="utf-8", newline="") as stream:
        header = next(csv.reader(stream))
    assert pq.read_schema(folder / "trajectory.parquet").names == header
    assert {f"true_q_{LONG}_m", f"true_tau_{LONG}_N", "true_lambda_null_n_N", "true_lambda_1e3_t_N"} < set(header)
    assert not [name for name in header if name[0] in "=+-@"]  # which spreadsheets run
    with np.load(folder / "trajectory.npz") as archive:
        assert archive["true_q_m_names"].tolist() == plan["joints"]
        np.testing.assert_allclose(archive["true_q_m"], plan["true"]["q"], rtol=0, atol=1e-9)
    for name in ("joints.yaml", "moveit_grasp.yaml", "isaac_grasp.yaml"):
        found = yaml.safe_load((folder / name).read_text(encoding="utf-8"))
        found = found.get("grasp_posture", found)
        names = (
            found["joint_names"] if "joint_names" in found else list(found["grasps"]["first_knot"]["cspace_position"])
        )
        assert names == plan["joints"]
    assert yaml.safe_load((folder / "moveit_grasp.yaml").read_text(encoding="utf-8"))["id"] == PROBLEM["title"]
    model = mujoco.MjModel.from_xml_path(str(folder / "keyframes.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    joints = [data.joint(name).qpos[0] for name in plan["joints"]]  # the free joint of the object is "object (2)"
    np.testing.assert_allclose(joints, plan["true"]["q"][0], rtol=0, atol=1e-9)
    assert {model.body(i).name for i in range(model.nbody)} == {"world", "base", "world (2)", ODD, "object"}


def test_what_was_not_executed_is_not_called_true(tmp_path: Path) -> None:
    """Two hard fingers let the object turn about the line between them, so that nothing can be executed."""
    folder = jaws(tmp_path)
    result = run("export", str(folder), *EVERY)
    assert result.exit_code == 0, result.output
    assert "was not executed on the hand that moves" in " ".join(result.stderr.split())
    assert "linear model at the start posture" in result.stdout
    plan = json.loads((folder / "plan.json").read_text(encoding="utf-8"))
    with (folder / "export" / "trajectory.csv").open(encoding="utf-8", newline="") as stream:
        header, *lines = csv.reader(stream)
    assert not [name for name in header if name.startswith("true")]
    column = np.array([line[header.index("q_object_m")] for line in lines], dtype=float)
    np.testing.assert_allclose(column, plan["execution"]["q_0"][0] + np.array(plan["dq"])[:, 0], rtol=0, atol=1e-9)
    assert "linear model" in (folder / "export" / "isaac_grasp.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["a\nb", "\ud800", "a\u2028b\x00"])
def test_names_that_no_file_can_hold_are_shown_without(name: str, hostile: Path, tmp_path: Path) -> None:
    def renamed(data: dict[str, Any]) -> None:
        data["contacts"][0] = data["execution"]["contacts"][0]["name"] = data["title"] = name

    result = run("export", str(changed(hostile, tmp_path, renamed)), *EVERY)
    assert result.exit_code == 0, result.output
    header = (tmp_path / "export" / "trajectory.csv").read_text(encoding="utf-8").splitlines()[0]
    shown = "".join(letter if letter.isprintable() else "?" for letter in name)
    assert f"true_lambda_{shown}_n_N" in header
    assert yaml.safe_load((tmp_path / "export" / "moveit_grasp.yaml").read_text(encoding="utf-8"))["id"] == shown


def test_a_hand_file_that_has_changed_is_not_written_as_if_it_had_not(hostile: Path, tmp_path: Path) -> None:
    path = changed(hostile, tmp_path, lambda data: data["execution"].update(sha256="0"))
    assert run("export", str(path), "--to", "csv").exit_code == 0  # needs no links
    result = run("export", str(path), "--to", "mjcf", "-o", str(tmp_path / "out"))
    assert result.exit_code == 2
    assert "has changed since this was planned" in result.stderr
    assert not (tmp_path / "out").exists()
