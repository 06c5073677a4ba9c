"""The command line: verbs, exit codes, what stands on standard output, what is written and when it is not."""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bad_inputs as bad
import numpy as np
import pytest
from command_line import document, run

from synergrip import __version__
from synergrip.cli import ending, main
from synergrip.conic.decide import judge
from synergrip.conic.program import Program
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.conic.solvers import clarabel_
from synergrip.files import bundled
from synergrip.planning import planning, solvers, verified
from synergrip.problems.finding import bundled_problems
from synergrip.reports.data import plan_files

TOO_MUCH = "limits.margin=100 N"
"""More than any bundled grasp can hold."""
FILES = {"plan.json", "plan.csv", "plan.npz"}


def command(*arguments: str, **options: Any) -> subprocess.CompletedProcess[str]:
    code = (
        "import sys; from synergrip.cli import main\ntry: main()\nfinally: print(*sorted(sys.modules), file=sys.stderr)"
    )
    return subprocess.run(
        [sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=False, **options
    )


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def shape(value: Any) -> tuple[int, ...]:
    return np.array(value, dtype=float).shape


# Verbs and their documents


ANALYSE = {
    "maps": ("dlambda_dzr", "du_dzr", "dq_dzr", "dtau_dzr", "dlambda_dw", "du_dw"),
    "bases": ("E_s", "Gamma_ucs", "Gamma_zcs", "Gamma_zr"),
}
STRUCTURE = {"n_c", "n_l", "n_q", "n_z", "dim_E_s", "dim_Gamma_ucs", "dim_Gamma_zr", "singular_values", "ambiguous"}


@pytest.mark.parametrize(
    ("name", "n_c", "n_q", "dims"), [("tripod", 3, 9, (2, 2, 0)), ("table2-soft-joints", 3, 8, (6, 1, 1))]
)
def test_analyse_has_the_keys_of_the_contract(name: str, n_c: int, n_q: int, dims: tuple[int, int, int]) -> None:
    found = document("analyse", name)
    structure = found["structure"]
    assert set(structure) >= STRUCTURE
    n_l, n_z, (forces, motions, redundant) = structure["n_l"], sum(dims), dims
    assert (structure["n_c"], structure["n_q"], structure["n_z"]) == (n_c, n_q, n_z)
    assert (structure["dim_E_s"], structure["dim_Gamma_ucs"], structure["dim_Gamma_zr"]) == dims
    assert structure["ambiguous"] is False
    assert structure["singular_values"]
    sizes = {
        "dlambda_dzr": (n_l, n_z), "du_dzr": (6, n_z), "dq_dzr": (n_q, n_z), "dtau_dzr": (n_q, n_z),
        "dlambda_dw": (n_l, 6), "du_dw": (6, 6), "E_s": (n_l, forces), "Gamma_ucs": (6, motions),
        "Gamma_zcs": (n_z, motions), "Gamma_zr": (n_z, redundant),
    }  # fmt: skip
    for table, keys in ANALYSE.items():
        for key in keys:
            assert shape(found[table][key]) == sizes[key], key
    assert shape(found["theorem1"]["M"]) == (n_z, n_z)
    assert found["theorem1"]["condition"] >= 1


@pytest.mark.parametrize(
    ("name", "n_z", "knots"), [("tripod", 4, 11), ("barrett-ball-roll", 4, 41), ("pinch-soft", 1, 1)]
)
def test_a_feasible_plan_has_the_keys_of_the_contract(name: str, n_z: int, knots: int) -> None:
    found = document("plan", name)
    assert (found["verdict"], found["exit_code"]) == ("feasible", 0)
    structure = found["structure"]
    assert set(structure) >= STRUCTURE
    n_c, n_l, n_q = structure["n_c"], structure["n_l"], structure["n_q"]
    sizes = {
        "time_s": (knots,), "dz_r": (knots, n_z), "alpha": (knots, structure["dim_E_s"]),
        "beta": (knots, structure["dim_Gamma_ucs"]), "gamma": (knots, structure["dim_Gamma_zr"]),
        "lambda": (knots, n_l), "du": (knots, 6), "dq": (knots, n_q), "tau": (knots, n_q), "elastic_motion": (knots, 6),
    }  # fmt: skip
    for key, size in sizes.items():
        assert shape(found[key]) == size, key
    margin = found["margin"]
    assert shape(margin["per_contact_N"]) == (knots, n_c)
    assert margin["worst_N"] == np.min(margin["per_contact_N"])
    assert margin["contact"] in found["contacts"]
    assert margin["time_s"] in found["time_s"]
    certificate = found["certificate"]
    assert (certificate["kind"], certificate["verified"]) == ("optimal", True)
    assert all(0 <= certificate[key] < 1e-6 for key in ("primal_residual", "dual_residual", "gap"))
    assert certificate["solver"].startswith("Clarabel")
    assert json.loads(Path("out", name, "plan.json").read_text(encoding="utf-8")) == found


@pytest.mark.parametrize(
    ("arguments", "stage"),
    [
        (("pinch-hard",), "restraint"),
        (("barrett-ball-lift",), "direction"),
        (("pinch-soft", "--set", TOO_MUCH), "magnitude"),
    ],
)
def test_an_infeasible_plan_has_the_keys_of_the_contract(arguments: tuple[str, ...], stage: str) -> None:
    found = document("plan", *arguments, code=1)
    assert (found["verdict"], found["exit_code"], found["stage"]) == ("infeasible", 1, stage)
    assert set(found["structure"]) >= STRUCTURE
    assert (found["certificate"]["kind"], found["certificate"]["verified"]) == ("infeasible", True)
    assert found["why"]
    assert isinstance(found["repairs"], list)
    assert found["time_s"]
    assert names(Path("out", arguments[0])) == {"plan.json"}


def test_the_repair_that_the_text_names_is_enough() -> None:
    """The largest margin is 8.9857 N, which rounds to more than it is."""
    force = ("--set", "limits.normal_force=20.011 N")
    result = run("plan", "pinch-soft", "--set", TOO_MUCH, *force)
    assert result.exit_code == 1
    repairs = re.findall(r"--set (.+)$", result.stdout.partition("What would help")[2], re.MULTILINE)
    assert any("limits.margin" in repair for repair in repairs)
    for repair in repairs:
        (changed,) = shlex.split(repair)
        limits = () if "normal_force" in changed else force
        found = document("plan", "pinch-soft", "--set", TOO_MUCH, *limits, "--set", changed)
        assert found["verdict"] == "feasible"


def test_check_judges_a_plan() -> None:
    run("plan", "tripod", "-o", "there")
    found = document("check", "there", "tripod")
    assert (found["verdict"], found["exit_code"]) == ("feasible", 0)
    assert found["margin"]["worst_N"] == pytest.approx(7, abs=1e-5)
    assert all(check["passed"] for check in found["checks"])
    worse = document("check", "there/plan.csv", "tripod", "--set", "limits.margin=8 N", code=1)
    assert [check["name"] for check in worse["checks"] if not check["passed"]] == ["slip margin"]
    assert "feasible  this plan keeps every limit" in run("check", "there/plan.npz", "tripod").stdout
    text = run("check", "there", "tripod", "--set", "limits.margin=8 N")
    assert text.exit_code == 1
    assert "this plan fails  it breaks: slip margin" in text.stdout


def test_check_and_analyse_refuse_what_plan_refuses() -> None:
    Path("still.csv").write_text("t_s,zr_1,zr_2,zr_3,zr_4\n0,0,0,0,0\n2,0,0,0,0\n", encoding="utf-8")
    found = document("check", "still.csv", "barrett-ball-lift", code=1)
    assert (found["verdict"], found["exit_code"], found["stage"]) == ("infeasible", 1, "direction")
    assert run("check", "still.csv", "barrett-ball-lift").stdout.count("(stage: direction)") == 1
    found = document("analyse", "pinch-hard", code=1)
    assert (found["stage"], found["structure"]["n_c"]) == ("restraint", 2)
    assert shape(found["refusal"]["free_twists"]) == (1, 6)
    text = run("analyse", "pinch-hard")
    assert text.exit_code == 1
    assert "rotation about the line through left and right" in " ".join(text.stdout.split())


def test_validate_problems_and_hands_list_what_there_is() -> None:
    assert document("validate", "tripod")["valid"] is True
    assert "(2 contacts, 6 joints, 1 synergy, 1 knot)" in run("validate", "pinch-hard").stdout
    listed = document("problems")["problems"]
    assert [entry["name"] for entry in listed] == list(bundled_problems())
    assert all(entry["title"] for entry in listed)
    hands = {entry["name"]: entry for entry in document("hands")["hands"]}
    assert len(hands["barrett"]["joints"]) == 8
    assert "motors (spread, finger1, finger2, finger3)" in run("hands").stdout
    for verb in ("problems", "hands"):
        assert "barrett" in run(verb).stdout


def test_a_grasp_file_stands_for_the_problem_of_holding_it() -> None:
    found = document("analyse", str(bundled("problems") / "tripod.json"))
    assert found["bases"] == document("analyse", "tripod")["bases"]


def test_schema_is_one_json_document() -> None:
    result = run("schema")
    assert result.exit_code == 0
    assert json.loads(result.stdout)["properties"]["task"]


def test_text_says_what_was_read_solved_checked_and_written() -> None:
    result = run("plan", "barrett-ball-hold")
    assert result.exit_code == 0
    assert result.stderr == ""
    lines = result.stdout.splitlines()
    labels = [label for line in lines if (label := line[:9].strip())]
    assert labels[:5] == ["read", "task", "solve", "check", "true"]
    assert any(line.startswith("feasible  smallest slip margin 0.5 N") for line in lines)
    assert any(line.startswith("between  ") for line in lines)
    assert lines[-1] == f"wrote {Path('out/barrett-ball-hold')}/  plan.json  plan.csv  plan.npz"
    for verb in (("analyse", "barrett-ball-hold"), ("validate", "barrett-ball-hold")):
        assert run(*verb).exit_code == 0
    assert "\x1b" not in result.stdout


def test_version_and_usage() -> None:
    assert run("--version").stdout == f"synergrip {__version__}\n"
    for arguments in (("bogus",), ("plan",), ("plan", "tripod", "--format", "xml"), ("check", "x")):
        assert run(*arguments).exit_code == 2


# Options


def test_set_overrides_any_key() -> None:
    found = document("plan", "pinch-soft", "--set", "limits.margin=0.3 N", "--set", "contact={}", code=2)
    assert found["error"]["file"].startswith("--set contact")
    found = document("plan", "pinch-soft", "--set", "limits.margin=0.3 N", "--set", "task.knots=3")
    assert found["margin"]["worst_N"] == pytest.approx(0.3, abs=1e-6)
    assert len(found["time_s"]) == 3


@pytest.mark.parametrize("option", ["-o", "--output"])
def test_output_chooses_the_folder(option: str) -> None:
    run("plan", "pinch-soft", option, "a/b")
    assert names(Path("a/b")) == FILES
    assert not Path("out").exists()
    run("plan", "pinch-soft")
    assert names(Path("out/pinch-soft")) == FILES


@pytest.mark.parametrize("formats", [["csv"], ["json", "npz"]])
def test_the_file_chooses_what_is_written_and_nothing_old_stays(formats: list[str]) -> None:
    run("plan", "pinch-soft", "-o", "here")
    Path("here/mine.txt").touch()
    run("plan", "pinch-soft", "-o", "here", "--set", f"output.write={formats}")
    assert names(Path("here")) == {"mine.txt", *(f"plan.{suffix}" for suffix in formats)}


@pytest.mark.parametrize("formats", [["json", "csv", "npz"], ["csv"]])
def test_an_infeasible_run_leaves_no_plan_of_an_earlier_one(formats: list[str]) -> None:
    run("plan", "pinch-soft", "-o", "here")
    run("plan", "pinch-soft", "-o", "here", "--set", TOO_MUCH, "--set", f"output.write={formats}")
    assert names(Path("here")) <= {"plan.json"}
    for path in Path("here").iterdir():
        assert json.loads(path.read_text(encoding="utf-8"))["verdict"] == "infeasible"


def test_the_csv_file_has_a_line_per_knot_that_agrees_with_the_document() -> None:
    found = document("plan", "tripod", "-o", "here")
    lines = Path("here/plan.csv").read_text(encoding="utf-8").splitlines()
    header, values = lines[0].split(","), np.loadtxt(lines[1:], delimiter=",")
    parts = ("time_s", "dz_r", "lambda", "tau", "du")
    expected = np.column_stack([*(found[part] for part in parts), found["margin"]["per_contact_N"]])
    assert np.array_equal(values, expected)
    assert len(header) == values.shape[1]
    assert header[:6] == ["t_s", "zr_z1", "zr_z2", "zr_z3", "zr_z4", "lambda_C1_n_N"]
    with np.load("here/plan.npz", allow_pickle=False) as stored:
        assert np.array_equal(stored["dz_r"], found["dz_r"])
        assert np.array_equal(stored["margin"], found["margin"]["per_contact_N"])


@pytest.mark.parametrize(
    ("override", "code", "kind"), [("limits.margin=0.5 N", 0, "optimal"), (TOO_MUCH, 1, "infeasible")]
)
def test_the_saved_program_is_the_one_the_answer_rests_on(override: str, code: int, kind: str) -> None:
    found = document("plan", "pinch-soft", "--set", override, "--save-program", "programs/last.npz", code=code)
    program = Program.load(Path("programs/last.npz"))
    certificate = judge(program, clarabel_.solve(program, Settings()))
    assert (certificate.kind, certificate.verified) == (kind, True) == (found["certificate"]["kind"], True)


def test_where_no_program_was_solved_none_is_saved_and_it_is_said() -> None:
    result = run("plan", "pinch-hard", "--save-program", "none.npz", "--format", "json")
    assert result.exit_code == 1
    told = json.loads(result.stdout)
    assert told["stage"] == "restraint"
    assert "'none.npz' was not written" in " ".join(told["notes"])  # nothing but the document is printed
    assert result.stderr == ""
    assert not Path("none.npz").exists()


# Exit codes


def _says_nothing(*_: object) -> Solution:
    return Solution(Claim.NOTHING, np.full(1, np.nan), np.zeros(1), "Silent 1.0", "Tired", 0, 0.0)


def test_a_solver_that_gives_up_is_exit_code_3(monkeypatch: pytest.MonkeyPatch) -> None:
    run("plan", "pinch-soft", "-o", "here")
    monkeypatch.setitem(solvers.SOLVERS, "clarabel", _says_nothing)
    found = document("plan", "pinch-soft", "-o", "here", code=3)
    assert (found["verdict"], found["exit_code"]) == ("unknown", 3)
    assert found["certificate"] == {"kind": "none", "verified": False}
    assert "Silent 1.0 says 'Tired'" in found["why"]["text"]
    assert set(found["structure"]) >= STRUCTURE
    assert names(Path("here")) == {"plan.json"}
    text = run("plan", "pinch-soft")
    assert text.exit_code == 3
    assert "unknown  Silent 1.0" in text.stdout


def test_a_plan_that_fails_its_own_check_is_exit_code_4(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(verified, "EXACT", -1.0)
    error = document("plan", "pinch-soft", code=4)["error"]
    assert error["type"] == "SelfCheckError"
    assert "equilibrium" in error["message"]
    text = run("plan", "pinch-soft")
    assert (text.exit_code, text.stdout) == (4, "")
    assert "please report this problem" in text.stderr
    assert not Path("out/pinch-soft/plan.json").exists()


def _raising(error: BaseException) -> Callable[..., None]:
    def raises(*_: object, **__: object) -> None:
        raise error

    return raises


def test_what_nobody_foresaw_is_exit_code_4_and_not_1(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(planning, "plan", _raising(RuntimeError("surprise")))
    monkeypatch.setattr(sys, "argv", ["synergrip", "plan", "pinch-soft", "--format", "json"])
    monkeypatch.setattr(ending, "watch", lambda: None)  # signals go on being pytest's
    with pytest.raises(SystemExit) as caught:
        main()
    assert caught.value.code == 4
    out, err = capsys.readouterr()
    assert "defect of synergrip" in json.loads(out)["error"]["message"]
    assert "Traceback" in err
    assert "surprise" in err


def test_an_interrupt_is_exit_code_130(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planning, "plan", _raising(KeyboardInterrupt()))
    result = run("plan", "pinch-soft", "--format", "json")
    assert result.exit_code == 130
    assert json.loads(result.stdout)["error"]["type"] == "InterruptError"
    text = run("plan", "pinch-soft")
    assert (text.exit_code, text.stdout) == (130, "")
    assert "interrupted" in text.stderr


# Writing


def _half_text(path: Path, text: str, **_: object) -> None:
    path.write_bytes(text[: len(text) // 2].encode())
    raise KeyboardInterrupt


def _half_archive(stream: Any, **_: object) -> None:
    stream.write(b"PK")
    raise KeyboardInterrupt


@pytest.mark.parametrize(("name", "format_"), [("plan.json", "json"), ("plan.csv", "csv"), ("plan.npz", "npz")])
def test_an_interrupted_write_leaves_the_old_file_and_no_other(
    name: str, format_: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    run("plan", "pinch-soft", "-o", "here")
    before = Path("here", name).read_bytes()
    with monkeypatch.context() as patched:
        patched.setattr(Path, "write_text", _half_text)
        patched.setattr(plan_files.np, "savez", _half_archive)
        arguments = ("plan", "pinch-soft", "-o", "here", "--set", "limits.margin=1 N")
        assert run(*arguments, "--set", f"output.write=['{format_}']").exit_code == 130
    assert Path("here", name).read_bytes() == before
    assert names(Path("here")) == FILES
    run("plan", "pinch-soft", "-o", "here", "--set", "limits.margin=1 N")
    assert Path("here", name).read_bytes() != before


@pytest.mark.parametrize("option", ["--output", "--save-program"])
def test_a_place_that_cannot_be_written_is_bad_input(option: str) -> None:
    Path("taken").touch()
    found = document("plan", "pinch-soft", option, "taken/there", code=2)
    assert found["error"]["key"] == option
    assert "cannot write 'taken/there'" in found["error"]["message"]


def test_a_disk_that_is_full_is_exit_code_5_leaves_nothing_and_the_answer_is_shown(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(Path, "write_text", _raising(OSError(28, "No space left on device")))
    found = document("plan", "pinch-soft", "-o", "here", code=5)
    error = found["error"]
    assert error["type"] == "OutputError"
    assert (error["key"], error["message"]) == ("--output", "cannot write 'here': No space left on device")
    assert found["answer"]["verdict"] == "feasible"
    assert names(Path()) == set()
    text = run("plan", "pinch-soft", "-o", "here")
    assert text.exit_code == 5
    assert "feasible  smallest slip margin" in text.stdout
    assert "wrote" not in text.stdout
    assert "error --output: cannot write 'here': No space left on device" in text.stderr
    assert text.stderr.endswith("nothing was written      exit code 5\n")


# Bad input


@pytest.mark.parametrize("case", bad.CASES, ids=lambda case: case.name)
def test_every_bad_input_is_one_error_document_with_its_place(case: bad.BadInput, tmp_path: Path) -> None:
    for name, content in case.files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    result = run("plan", str(tmp_path / "problem.toml"), "--format", "json")
    assert result.exit_code == 2
    assert result.stderr == ""
    found = json.loads(result.stdout)
    assert set(found) == {"error"}
    error = found["error"]
    assert {"type", "message", "file", "line", "column", "key"} <= set(error)
    assert (error["key"] or "") == case.key
    assert case.fragment in error["message"]
    assert error["file"] == str(tmp_path / case.file)
    assert "Traceback" not in result.stdout
    assert not (tmp_path / "out").exists()


def test_bad_input_as_text_is_on_standard_error_with_the_line_at_fault(tmp_path: Path) -> None:
    (tmp_path / "problem.toml").write_text(bad.HAND.replace("friction =", "fricton ="), encoding="utf-8")
    result = run("plan", "problem.toml")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "error contacts.fricton: unknown key 'fricton'; did you mean 'friction'?" in result.stderr
    assert "^^^^^^^" in result.stderr
    assert result.stderr.rstrip().endswith("nothing was solved.      exit code 2")


@pytest.mark.parametrize("verb", ["plan", "analyse", "validate"])
def test_a_misspelt_problem_is_answered_with_a_suggestion(verb: str) -> None:
    error = document(verb, "barrett-ball-hould", code=2)["error"]
    assert error["key"] == "PROBLEM"
    assert "did you mean 'barrett-ball-hold'?" in error["message"]
    assert "no such file" in error["message"]


@pytest.mark.parametrize(
    ("arguments", "key", "fragment"),
    [
        (("plan", "tripod", "--solver", "claribel"), "--solver", "did you mean 'clarabel'?"),
        (("plan", "tripod", "--set", "limits.margn=1 N"), "limits.margn", "did you mean 'margin'?"),
        (("plan", "tripod", "--set", "limits.margin"), "", "expected KEY=VALUE"),
        (("plan", "barrett-ball-hold", "--set", "hand.model=barett"), "hand.model", "did you mean 'barrett'?"),
        (("plan", "barrett-ball-hold", "--set", "hand.posture=bal"), "hand.posture", "did you mean 'ball'?"),
        (
            ("plan", "barrett-ball-hold", "--set", "limits.joint_torque=[1]"),
            "limits.joint_torque",
            "expected 8 numbers",
        ),
        (("plan", "barrett-ball-roll", "--set", "task.move[0].mode=2"), "task.move", "dimension 1"),
        (("plan", "tripod", "--set", "task.tracking=compliant"), "task.tracking", "tolerance"),
        (("plan", "tripod", "--set", "limits={}"), "goal.maximise", "nothing bounds the largest margin"),
        (("plan", "tripod", "--set", "task.duration=2 s"), "task.wrench", "the table covers 0 s to 1 s"),
        (("check", "nothing.csv", "tripod"), "PLAN", "there is no file 'nothing.csv'"),
    ],
)
def test_options_that_cannot_be(arguments: tuple[str, ...], key: str, fragment: str) -> None:
    error = document(*arguments, code=2)["error"]
    assert (error["key"] or "") == key
    assert fragment in error["message"]


def test_a_rigid_contact_of_a_grasp_file_is_shown_in_that_file(tmp_path: Path) -> None:
    for suffix in ("toml", "json"):
        text = (bundled("problems") / f"pinch-soft.{suffix}").read_text(encoding="utf-8")
        Path(tmp_path, f"pinch-soft.{suffix}").write_text(text.replace('"C_s": 0.001', '"C_s": 0'), encoding="utf-8")
    for problem in ("pinch-soft.toml", "pinch-soft.json"):
        error = document("plan", problem, code=2)["error"]
        assert (error["type"], error["key"], Path(error["file"]).name) == (
            "RigidContactError",
            "C_s",
            "pinch-soft.json",
        )
        line = Path("pinch-soft.json").read_text(encoding="utf-8").split("\n")[error["line"] - 1]
        assert line[error["column"] - 1 :].startswith("0")
        assert '"C_s"' in line


@pytest.mark.parametrize(
    ("changes", "key", "value"),
    [
        ({'"8 N/mm"': '"rigid"'}, "contacts.stiffness", '"rigid"'),
        ({'"8 N/mm"': '"8 N/mm"\ntangential_stiffness = "rigid"'}, "contacts.tangential_stiffness", '"rigid"'),
        ({"[task]": '[[contact]]\nat = "finger2/tip"\nstiffness = "rigid"\n[task]'}, "contact[0].stiffness", '"rigid"'),
    ],
)
def test_a_rigid_contact_of_a_hand_is_shown_at_its_stiffness(changes: dict[str, str], key: str, value: str) -> None:
    text = (bundled("problems") / "barrett-ball-hold.toml").read_text(encoding="utf-8")
    text = text.replace("[object]", 'compliance = { joint = "0 rad/(N m)" }\n[object]')
    for old, new in changes.items():
        assert text.count(old) == 1
        text = text.replace(old, new)
    Path("hold.toml").write_text(text, encoding="utf-8")
    error = document("plan", "hold.toml", code=2)["error"]
    assert (error["type"], error["key"], error["file"]) == ("RigidContactError", key, "hold.toml")
    assert text.split("\n")[error["line"] - 1][error["column"] - 1 :].startswith(value)


def test_points_that_contradict_the_grasp_matrix_are_refused_in_the_grasp_file() -> None:
    text = (bundled("problems") / "pinch-soft.json").read_text(encoding="utf-8")
    Path("pinch.json").write_text(text.replace("[0.02, 0.0, 0.0]", "[0.02, 0.01, 0.0]"), encoding="utf-8")
    error = document("plan", "pinch.json", code=2)["error"]
    assert error["key"].endswith(".point_m")
    assert error["file"] == "pinch.json"
    assert error["line"] > 1


def test_every_pad_that_misses_and_every_name_that_is_unknown_is_told_at_once() -> None:
    found = document("plan", "barrett-ball-hold", "--set", "object.position=['0 m', '0 m', '0 m']", code=2)
    keys = ["contacts.at[0]", "contacts.at[1]", "contacts.at[2]"]
    assert [error["key"] for error in found["error"]["errors"]] == keys
    assert all("mm in the palm frame" in error["message"] for error in found["error"]["errors"])
    arguments = ("--set", "hand.posture=bal", "--set", "contacts.at=['a', 'finger2/tip', 'b']")
    found = document("plan", "barrett-ball-hold", *arguments, code=2)
    assert [error["key"] for error in found["error"]["errors"]] == ["hand.posture", "contacts.at[0]", "contacts.at[2]"]


def test_an_unknown_hand_does_not_hide_a_csv_file_that_is_missing() -> None:
    arguments = ("--set", "hand.model=barett", "--set", "task.wrench=none.csv")
    found = document("plan", "barrett-ball-hold", *arguments, code=2)
    assert [error["key"] for error in found["error"]["errors"]] == ["hand.model", "task.wrench"]


def test_a_soft_hand_is_refused_at_its_compliance() -> None:
    error = document("plan", "barrett-ball-hold", "--set", "hand.compliance.joint=1e50 rad/(N m)", code=2)["error"]
    assert (error["key"], error["message"]) == ("hand.compliance.joint", "a compliance of 1e+50 is too large")


# Processes


def test_a_plan_is_one_json_document_on_the_stream_itself_and_imports_nothing_heavy() -> None:
    done = command("plan", "barrett-ball-hold", "--format", "json")
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["verdict"] == "feasible"
    loaded = set(done.stderr.split())
    assert {"clarabel", "mujoco", "numpy"} <= loaded
    assert not loaded & {"cvxpy", "matplotlib", "pandas", "viser"}
    assert not loaded & {f"scipy.{part}" for part in ("linalg", "optimize", "spatial", "special", "sparse.linalg")}
    assert not loaded & {"synergrip.explain.explanation", "synergrip.conic.solvers.banded_"}  # of a no, of long motions


@pytest.mark.parametrize(
    ("arguments", "absent"),
    [
        (("validate", "tripod"), {"mujoco", "clarabel", "cvxpy"}),
        (("--help",), {"numpy", "pydantic", "mujoco", "clarabel", "cvxpy"}),
    ],
)
def test_light_verbs_import_little(arguments: tuple[str, ...], absent: set[str]) -> None:
    done = command(*arguments)
    assert done.returncode == 0, done.stderr
    loaded = set(done.stderr.split())
    assert "synergrip.cli.app" in loaded
    assert not loaded & absent


def test_a_terminal_without_greek_letters_gets_its_answer() -> None:
    arguments = [sys.executable, "-m", "synergrip", "analyse", "tripod"]
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = subprocess.run(arguments, capture_output=True, text=True, env=environment, check=False)
    assert done.returncode == 0, done.stderr
    assert "internal forces E_s" in done.stdout
