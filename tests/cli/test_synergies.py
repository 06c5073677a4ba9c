"""The verbs ``synergrip synergies``: answers, exit codes, files; and what a rank-deficient S costs."""

from __future__ import annotations

import io
import math
import re
import subprocess
import sys
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import command_line
import numpy as np
import pytest
from scipy.linalg import subspace_angles

from synergrip.hands.folder import bundled_hands, load_hand
from synergrip.hands.synergies.synergy_file import SynergyFile, read_synergy_file
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.reports.pictures import synergies as drawn_synergies
from synergrip.reports.pictures import variance as drawn_variance
from synergrip.statics.analysis import analyse

DEG = math.pi / 180
PAGE = Path(__file__).parent.parent.parent / "docs" / "synergies.md"
BLOCKS = re.findall(r"```(\w+)\n(.*?)\n```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
FREE = ("finger1_inner", "finger2_spread", "finger2_inner", "finger3_spread", "finger3_inner")


run = partial(command_line.run, "synergies")


def document(*arguments: str, code: int = 0) -> dict[str, Any]:
    """The one JSON document on standard output, with nothing beside it."""
    result = run(*arguments, "--format", "json")
    found = command_line.document_of(result, code)
    assert result.stderr == ""
    return found


def record(path: str = "postures.csv", count: int = 12, header: tuple[str, ...] = FREE) -> np.ndarray:
    """Two directions and a little noise, 0.3 to 1.3 rad."""
    rng = np.random.default_rng(5)
    q = (
        0.8
        + rng.uniform(-0.5, 0.5, (count, 2)) @ rng.normal(size=(2, len(header)))
        + 0.01 * rng.normal(size=(count, 5))
    )
    np.savetxt(path, q, "%.17g", ",", header=",".join(header), comments="")
    return q


def synergies(path: str, joints: tuple[str, ...], S: np.ndarray) -> str:
    names = [f"s{i}" for i in range(S.shape[1])]
    text = f"schema = 1\njoints = {list(joints)}\nsynergies = {names}\nS = {S.tolist()}\n"
    Path(path).write_text(text, encoding="utf-8")
    return str(Path(path).absolute())


# fit


def test_fit_writes_a_file_that_a_problem_can_use() -> None:
    q = record()
    found = document("fit", "postures.csv", "-n", "2", "--hand", "barrett", "-o", "pca.toml", "--name", "mine")
    assert (found["written"], found["title"], found["rank"], found["postures"]) == ("pca.toml", "mine", 5, 12)
    assert (found["joints"], found["synergies"], found["unit"]) == (list(FREE), ["pc1", "pc2"], "rad")
    S, offset = np.array(found["S"]), np.array(found["offset"])
    file = read_synergy_file(Path("pca.toml"))
    np.testing.assert_array_equal(file.S, S)
    np.testing.assert_array_equal(file.offset, offset)
    assert list(file.explained_variance or ()) == found["explained_variance"]
    assert list(file.standard_deviation or ()) == found["standard_deviation"]
    np.testing.assert_allclose(offset, q.mean(axis=0), rtol=1e-14)
    left = (q - offset) - (q - offset) @ S @ S.T
    assert found["reconstruction_rms"] == pytest.approx(np.sqrt(np.mean(left**2)), rel=1e-10)
    np.testing.assert_allclose(found["cumulative_variance"], np.cumsum(found["explained_variance"]))
    path = Path("pca.toml").absolute()
    problem = load_problem("barrett-ball-hold", [f"hand.synergies={path}"])
    assert problem.grasp.synergies == ("pc1", "pc2")
    rows = [problem.grasp.joints.index(name) for name in FREE]
    np.testing.assert_array_equal(problem.grasp.S[rows], S)
    np.testing.assert_allclose(problem.grasp.S[1], S[0] / 3)  # finger1_outer follows


def test_fit_in_degrees_is_fit_in_radians() -> None:
    q = record()
    np.savetxt("deg.csv", q / DEG, "%.17g", ",", header=",".join(f"{name}_deg" for name in FREE), comments="")
    np.savetxt("bare.csv", q / DEG, "%.17g", ",", header=",".join(FREE), comments="")
    expected = document("fit", "postures.csv", "-n", "2")
    for arguments in (("deg.csv",), ("bare.csv", "--degrees")):
        found = document("fit", *arguments, "-n", "2")
        np.testing.assert_allclose(found["S"], expected["S"], atol=1e-12)
        np.testing.assert_allclose(found["standard_deviation"], expected["standard_deviation"], rtol=1e-12)
    assert "if they are degrees, say --degrees" in " ".join(run("fit", "bare.csv", "-n", "2").stdout.split())
    assert "--degrees" not in run("fit", "postures.csv", "-n", "2").stdout


def test_fit_as_text_and_without_a_file() -> None:
    q = record()
    lines = run("fit", "postures.csv", "-n", "1").stdout.splitlines()
    shares = np.linalg.svd(q - q.mean(axis=0), compute_uv=False) ** 2
    assert lines[0] == "read     postures.csv · 12 postures of 5 joints"
    assert lines[1].startswith("fit      1 of 5 principal directions · reconstruction error ")
    deviation = math.sqrt(shares[0] / 11) / DEG
    assert lines[4].split() == ["pc1", *[f"{100 * shares[0] / shares.sum():.2f}", "%"] * 2, f"{deviation:.3g}", "deg"]
    assert lines[-1].startswith("nothing was written")
    assert {path.name for path in Path().iterdir()} == {"postures.csv"}


def test_fit_tells_how_far_a_follower_is_from_its_coupling() -> None:
    Path("postures.csv").write_text(
        f"{','.join(FREE)},finger3_outer\n0,0,0,0,0.3,0.1\n0.1,0.2,0.3,0.4,0.6,0.25\n0.3,0,0.1,0,0,0\n",
        encoding="utf-8",
    )
    (follower,) = document("fit", "postures.csv", "-n", "1", "--hand", "barrett")["followers"]
    assert follower == {
        "joint": "finger3_outer", "follows": "'finger3_inner'", "deviation": pytest.approx(0.05), "line": 3,
    }  # fmt: skip
    text = run("fit", "postures.csv", "-n", "1", "--hand", "barrett").stdout
    assert "at most 2.86 deg from its coupling (line 3)" in " ".join(text.split())


def test_equal_variances_and_slides_are_told() -> None:
    Path("cross.csv").write_text("a,b,c\n1,0,0\n-1,0,0\n0,1,0\n0,-1,0\n0,0,1e-6\n0,0,-1e-6\n", encoding="utf-8")
    assert document("fit", "cross.csv", "-n", "1")["equal_variance"] == [[0, 1]]
    text = run("fit", "cross.csv", "-n", "3").stdout
    assert "principal directions 1 to 2 have equal variance" in text
    assert "AMBIGUOUS" in text
    assert document("fit", "cross.csv", "-n", "3")["ambiguous"] is True


def test_fit_draws_the_variance_of_all_directions(monkeypatch: pytest.MonkeyPatch) -> None:
    record()
    drawn: list[tuple[Any, ...]] = []
    monkeypatch.setattr(drawn_variance, "draw_variance", lambda *arguments: drawn.append(arguments))
    found = document("fit", "postures.csv", "-n", "2", "--picture", "v.svg")
    ((shares, path, title),) = drawn
    assert (path, title, found["picture"]) == (Path("v.svg"), found["title"], "v.svg")
    np.testing.assert_array_equal(shares, found["variance_shares"])
    assert run("fit", "postures.csv", "-n", "2", "--picture", "v.svg").stdout.endswith("drawn    v.svg\n")


@pytest.mark.parametrize(
    ("arguments", "key", "fragment"),
    [
        (("postures.csv", "-n", "6"), "-n", "expected 1 to 5, the rank of the postures"),
        (("postures.csv", "-n", "0"), "-n", "got 0"),
        (("none.csv", "-n", "1"), "", "not found"),
        (("postures.csv", "-n", "1", "--hand", "baret"), "--hand", "did you mean 'barrett'?"),
        (("postures.csv", "-n", "1", "--hand", "gripper"), "", "is not one of"),
        (("postures.csv", "-n", "1", "-o", "postures.csv"), "--output", "ends in .toml"),
        (("postures.csv", "-n", "1", "-o", "problem.toml"), "--output", "is there and is no synergy file"),
        (("postures.csv", "-n", "1", "--picture", "v.xyz", "-o", "new.toml"), "--picture", "says no format"),
    ],
)
def test_fits_that_cannot_be(arguments: tuple[str, ...], key: str, fragment: str) -> None:
    record()
    Path("problem.toml").write_text("schema = 1\n", encoding="utf-8")
    error = document("fit", *arguments, code=2)["error"]
    assert (error["key"] or "") == key
    assert fragment in error["message"]
    assert {path.name for path in Path().iterdir()} == {"postures.csv", "problem.toml"}
    text = run("fit", *arguments)
    assert (text.exit_code, text.stdout) == (2, "")
    assert "exit code 2" in text.stderr


def test_a_picture_that_cannot_be_written_is_exit_code_5_beside_the_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    record()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(drawn_variance, "draw_variance", full)
    monkeypatch.setattr(drawn_synergies, "draw_synergies", full)
    for arguments in (("fit", "postures.csv", "-n", "1"), ("show", "barrett")):
        found = document(*arguments, "--picture", "p.svg", code=5)
        error, answer = found["error"], found["answer"]
        assert answer | {"picture": None} == document(*arguments) | {"picture": None}
        assert (error["key"], error["message"]) == ("--picture", "cannot write 'p.svg': No space left on device")


# list


def test_list_has_every_set_of_every_hand(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    found = document("list")["sets"]
    expected = [(name, each) for name in bundled_hands() for each in load_hand(name).synergy_sets]
    assert [(entry["hand"], entry["set"]) for entry in found] == expected
    for entry in found:
        S = load_hand(entry["hand"]).synergy_sets[entry["set"]].S
        assert (entry["n_z"], entry["rank"]) == (S.shape[1], np.linalg.matrix_rank(S))
        assert entry["orthonormal"] == np.allclose(S.T @ S, np.eye(S.shape[1]), atol=1e-6)
        np.testing.assert_allclose(entry["lengths"], np.sqrt(np.sum(S**2, axis=0)))
    assert len(run("list").stdout.splitlines()) == len(expected) + 1


def test_list_of_one_hand_and_of_a_file() -> None:
    assert [entry["set"] for entry in document("list", "barrett")["sets"]] == ["motors", "close", "joints"]
    (entry,) = document("list", synergies("near.toml", ("a", "b"), np.array([[1.0, 1], [0, 1e-7]])))["sets"]
    assert (entry["hand"], entry["set"], entry["rank"], entry["ambiguous"]) == (None, "near", 2, True)
    text = run("list", "near.toml").stdout.splitlines()
    assert text[0].split() == ["set", "n_z", "rank", "columns"]  # it has no title
    assert text[1].split() == ["near", "2", "2", "AMBIGUOUS", "length", "1"]


# show


def test_show_has_a_row_for_each_joint_and_a_column_for_each_synergy() -> None:
    hand = load_hand("barrett")
    found = document("show", "barrett", "--posture", "ball")
    motors = hand.synergy_sets["motors"]
    np.testing.assert_array_equal(found["S"], motors.S)
    np.testing.assert_array_equal(found["posture"], hand.postures["ball"])
    assert (found["joints"], found["set"], found["rank"], found["repeated"]) == (list(hand.joint_names), "motors", 4, 0)
    lines = run("show", "barrett", "--posture", "ball").stdout.splitlines()
    start = lines.index("joint           posture  spread  finger1  finger2  finger3")
    for row, name in enumerate(hand.joint_names):
        entries = [hand.postures["ball"][row], *motors.S[row]]
        assert lines[start + 1 + row].split() == [name, *(f"{entry:.3f}" for entry in entries)]
    assert lines[start + 9].split() == ["length", "1.414", *["1.054"] * 3]
    assert lines[-1] == "rank     4 of 4"


def test_show_breaks_wide_sets_into_blocks() -> None:
    synergies("wide.toml", FREE[:2], np.arange(18.0).reshape(2, 9) - 9.00001)
    lines = run("show", "barrett", "--set", "wide.toml").stdout.splitlines()
    heads = [line.split() for line in lines if line.startswith("joint")]
    assert heads == [["joint", *(f"s{i}" for i in range(8))], ["joint", "s8"]]
    assert "-0.000" not in "\n".join(lines)
    assert document("show", "barrett", "--set", "wide.toml", "--first", "3")["synergies"] == ["s0", "s1", "s2"]


def test_show_says_what_repeats_and_what_moves_nothing() -> None:
    synergies("repeated.toml", FREE[:2], np.array([[1.0, 2, 0, 1], [1, 2, 0, 0]]))
    found = document("show", "barrett", "--set", "repeated.toml")
    assert (found["rank"], found["repeated"]) == (2, 2)
    lines = run("show", "barrett", "--set", "repeated.toml").stdout.splitlines()
    assert lines[-3:] == [
        "rank     2 of 4",
        "         no joint is moved by s2",
        "         2 synergies repeat what the others do; they become redundancy (Γ_zr)",
    ]
    assert "1 synergy repeats what" in run("show", "barrett", "--set", "repeated.toml", "--first", "2").stdout


@pytest.mark.parametrize("posture", [None, "ball"])
def test_show_draws_at_the_posture_or_at_rest(posture: str | None, monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[tuple[Any, ...]] = []
    monkeypatch.setattr(drawn_synergies, "draw_synergies", lambda *arguments: drawn.append(arguments))
    wish = ("--posture", posture) if posture else ()
    found = document("show", "barrett", "--set", "close", "--first", "1", "--picture", "a.png", *wish)
    ((hand, chosen, q, path),) = drawn
    assert (hand.name, chosen.synergies, path, found["picture"]) == ("barrett", ("spread",), Path("a.png"), "a.png")
    np.testing.assert_array_equal(q, hand.postures["ball"] if posture else np.zeros(8))


# compare


def test_compare_two_sets_of_a_hand() -> None:
    found = document("compare", "barrett", "close", "motors")
    np.testing.assert_allclose(found["principal_angles"], [0, 0], atol=1e-12)
    assert (found["A"]["inside_other"], found["B"]["inside_other"]) == (True, False)
    assert (found["A"]["share_in_other"], found["B"]["share_in_other"]) == (pytest.approx(1), pytest.approx(0.5))
    np.testing.assert_allclose(found["B"]["synergy_shares"], [1, 1 / 3, 1 / 3, 1 / 3])
    text = run("compare", "barrett", "close", "motors").stdout
    assert "principal angles   0, 0 deg" in text
    assert "A lies in B" in text
    assert "spread 100 %, finger1 33.33 %, finger2 33.33 %, finger3 33.33 %" in " ".join(text.split())


def test_compare_two_files_without_a_hand() -> None:
    synergies("a.toml", ("x", "y", "z"), np.array([[1.0, 0], [0, 0], [0, 0]]))
    synergies("b.toml", ("w", "y", "x"), np.array([[0.0], [math.sin(0.5)], [math.cos(0.5)]]))
    found = document("compare", "a.toml", "b.toml")
    assert found["principal_angles"] == [pytest.approx(0.5)]
    assert (found["smallest_angle"], found["largest_angle"]) == (pytest.approx(0.5), pytest.approx(0.5))
    assert (found["only_in_A"], found["only_in_B"]) == (["z"], ["w"])
    assert found["A"]["synergy_shares"] == [pytest.approx(math.cos(0.5) ** 2), None]
    text = run("compare", "a.toml", "b.toml").stdout
    assert "principal angles   28.65 deg" in text
    assert "only A names       z" in text
    synergies("still.toml", ("x",), np.zeros((1, 2)))
    found = document("compare", "still.toml", "a.toml")
    assert (found["principal_angles"], found["largest_angle"], found["A"]["share_in_other"]) == ([], None, None)
    assert "a set that moves no joint" in run("compare", "still.toml", "a.toml").stdout


@pytest.mark.parametrize(
    ("arguments", "key", "fragment"),
    [
        (("compare", "barrett"), "A B", "a hand and two of its sets, or two synergy files; got 1"),
        (("compare", "barrett", "motors", "close", "all"), "A B", "got 4"),
        (("compare", "barrett", "motors"), "A", "files that end in .toml, got 'barrett'"),
        (("compare", "barrett", "motors", "clos"), "B", "did you mean 'close'?"),
        (("compare", "barrett", "motors", "close", "--first", "3"), "--first", "of 'close', got 3"),
        (("show", "baret"), "HAND", "did you mean 'barrett'?"),
        (("show", "barrett", "--set", "none.toml"), "--set", "not found"),
        (("show", "barrett", "--first", "5"), "--first", "expected 1 to 4"),
        (("show", "barrett", "--posture", "bal"), "--posture", "did you mean 'ball'?"),
        (("show", "barrett", "--picture", "a.txt"), "--picture", "says no format"),
        (("list", "baret"), "HAND", "did you mean 'barrett'?"),
        (("list", "none.toml"), "FILE.toml", "not found"),
    ],
)
def test_arguments_that_cannot_be(arguments: tuple[str, ...], key: str, fragment: str) -> None:
    error = document(*arguments, code=2)["error"]
    assert error["key"] == key
    assert fragment in error["message"]


@pytest.mark.parametrize(
    "arguments", [(), ("bogus",), ("fit",), ("fit", "a.csv"), ("fit", "a.csv", "-n", "x"), ("show",)]
)
def test_wrong_usage_is_exit_code_2(arguments: tuple[str, ...]) -> None:
    assert run(*arguments).exit_code == 2


def test_the_help_shows_the_verbs_and_imports_little() -> None:
    for option in ("--help", "-h"):
        text = run(option)
        assert text.exit_code == 0
        assert all(verb in text.stdout for verb in ("fit", "list", "show", "compare"))
    code = "import sys; from synergrip.cli import main\ntry: main()\nfinally: print(*sys.modules, file=sys.stderr)"
    arguments = [sys.executable, "-c", code, "synergies", "--help"]
    done = subprocess.run(arguments, capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert not set(done.stderr.split()) & {"numpy", "mujoco", "matplotlib"}


# What a rank-deficient S costs


MOTORS = np.array([[0.0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
"""The motors of the Barrett hand, rows as in FREE."""
DEFICIENT = {
    "a duplicate": MOTORS[:, [0, 1, 2, 3, 1]],
    "a zero column": np.column_stack([MOTORS, np.zeros(5)]),
    "a combination": np.column_stack([MOTORS, MOTORS @ [0.3, -1, 2, 0.5], MOTORS @ [1, 1, 1, 1]]),
}


def held(S: np.ndarray, name: str) -> Any:
    path = synergies(f"{name}.toml", FREE, S)
    return load_problem("barrett-ball-hold", [f"hand.synergies={path}", "goal={maximise='margin'}"])


@pytest.mark.parametrize("case", DEFICIENT)
def test_a_rank_deficient_S_costs_redundancy_and_nothing_else(case: str) -> None:
    S = DEFICIENT[case]
    full, deficient = held(MOTORS, "full"), held(S, "deficient")
    expected, spaces = analyse(full.grasp).spaces, analyse(deficient.grasp).spaces
    forces, motions, redundant = spaces.dimensions
    assert (forces, motions) == expected.dimensions[:2] == (3, 1)
    assert forces + motions + redundant == S.shape[1]
    assert redundant == S.shape[1] - 4 + expected.dimensions[2]
    np.testing.assert_allclose(deficient.grasp.S @ spaces.Gamma_zr, 0, atol=1e-12)
    for name in ("E_s", "Gamma_ucs"):
        assert subspace_angles(getattr(spaces, name), getattr(expected, name)).max() < 1e-7
    one, other = plan(full.grasp, full.task), plan(deficient.grasp, deficient.task)
    assert (one.verdict, other.verdict) == ("feasible", "feasible")
    assert other.margins.min() == pytest.approx(one.margins.min(), rel=1e-6)


def test_fewer_motors_than_the_columns_say_control_less() -> None:
    """Four columns of rank 2 control what two columns do, and no more."""
    S = MOTORS[:, [0, 1, 0, 1]]
    spaces, expected = (analyse(held(each, "s").grasp).spaces for each in (S, MOTORS[:, :2]))
    assert spaces.dimensions == (*expected.dimensions[:2], expected.dimensions[2] + 2)


# The page


def test_the_page_shows_what_the_commands_print(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdout", io.StringIO())
    for kind, code in BLOCKS:
        if kind == "python":
            exec(compile(code, "synergies.md", "exec"), {})
    pairs = [(code, shown) for (kind, code), (after, shown) in pairwise(BLOCKS) if (kind, after) == ("bash", "text")]
    assert len(pairs) == 4
    for code, shown in pairs:
        result = run(*code.removeprefix("synergrip synergies ").split())
        assert result.exit_code == 0
        assert result.stdout.rstrip("\n") == shown
    (written,) = (code for kind, code in BLOCKS if kind == "toml")
    Path("shown.toml").write_text(written, encoding="utf-8")
    shown_file, file = read_synergy_file(Path("shown.toml")), read_synergy_file(Path("grasps.toml"))
    assert (shown_file.joints, shown_file.title) == (file.joints, file.title)
    np.testing.assert_allclose(shown_file.S, file.S, atol=1e-12)  # the last digits are the machine's


def test_the_page_describes_every_key_of_the_file() -> None:
    text = PAGE.read_text(encoding="utf-8")
    for key, field in SynergyFile.model_fields.items():
        assert f"`{field.alias or key}`" in text
