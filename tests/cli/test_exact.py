"""``plan --exact``: the file, the line, the document, and what there is to say where there is no proof."""

from __future__ import annotations

import json
import subprocess
import sys
from functools import partial
from pathlib import Path

import command_line
from command_line import run

from synergrip.explain.exact import check_proof
from synergrip.planning.digest import unchanged

document = partial(command_line.document, "plan")
TIGHT = ("pinch-soft", "--set", "limits.margin=50 N", "--exact")


def test_the_proof_is_written_beside_the_answer_and_holds() -> None:
    result = run("plan", *TIGHT)
    assert "proof.json" in result.stdout
    assert "proof re-checked in exact arithmetic: sum = -" in result.stdout
    checked = subprocess.run(
        [sys.executable, "-I", check_proof.__file__, "out/pinch-soft/proof.json"],
        capture_output=True,
        text=True,
        check=True,
    )
    found = document(*TIGHT, code=1)["certificate"]["exact"]
    assert found["problem_sha256"] in checked.stdout
    assert found["sum"] < 0
    assert found["why"] is None
    told = json.loads(Path("out/pinch-soft/plan.json").read_text(encoding="utf-8"))
    assert told["certificate"]["exact"] == found
    assert unchanged(told)  # and so has a report


def test_an_answer_without_a_proof_removes_that_of_an_earlier_one() -> None:
    run("plan", *TIGHT)
    assert Path("out/pinch-soft/proof.json").exists()
    result = run("plan", "pinch-soft", "--exact")
    assert result.exit_code == 0
    assert "only a no has an exact proof" in result.stderr
    assert not Path("out/pinch-soft/proof.json").exists()


def test_a_no_of_rank_says_why_it_has_none() -> None:
    found = document("pinch-hard", "--exact", code=1)["certificate"]["exact"]
    assert (found["sum"], found["problem_sha256"]) == (None, None)
    assert "rank" in found["why"]
    assert not Path("out/pinch-hard/proof.json").exists()


def test_nothing_is_said_of_it_unasked() -> None:
    assert "exact" not in document(*TIGHT[:-1], code=1)["certificate"]
