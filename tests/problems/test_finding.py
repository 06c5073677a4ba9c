"""Names that are nearly those of something: problems in the folder, problems that ship, hands."""

from __future__ import annotations

from pathlib import Path

import pytest

from synergrip.errors import InputError
from synergrip.files import bundled
from synergrip.problems.finding import find_problem
from synergrip.problems.problem import load_problem

TEXT = (bundled("problems") / "barrett-ball-hold.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "meant"),
    [("my-lift", "my-lift.toml"), ("my-grasp", "my-grasp.json"), ("my-lift.tml", "my-lift.toml"),
     ("barrett-ball-lift.tml", "barrett-ball-lift"), ("human-bal.toml", "human-ball"),
     ("dlr-ball-mov", "dlr-ball-move")],
)  # fmt: skip
def test_what_was_meant_is_named(name: str, meant: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "my-lift.toml").write_text(TEXT, encoding="utf-8")
    (tmp_path / "my-grasp.json").write_text("{}", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match=f"did you mean '{meant}'"):
        load_problem(name)


def test_what_is_like_nothing_is_not_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert find_problem("zzzz.toml") == Path("zzzz.toml")
    with pytest.raises(InputError, match=r"problem file 'zzzz.toml' not found$"):
        load_problem("zzzz.toml")


def test_a_hand_that_there_is_not_is_told_with_all_that_is_wrong(tmp_path: Path) -> None:
    path = tmp_path / "lift.toml"
    path.write_text(TEXT.replace('model = "barrett"', 'model = "barret"').replace("knots = ", "knots = -"), "utf-8")
    with pytest.raises(InputError) as raised:
        load_problem(path, ["limits.margin=-1 N"])
    assert {issue.key for issue in raised.value.issues} == {"hand.model", "task.knots", "limits.margin"}
    hand = next(issue for issue in raised.value.issues if issue.key == "hand.model")
    assert hand.line
    assert "did you mean 'barrett'?" in hand.message
