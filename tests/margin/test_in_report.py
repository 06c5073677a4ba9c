"""Margins in the report of their plan: with the words of the command, of this very plan, and nothing else."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from html import unescape
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import pytest
from browser import browser_path, browsing
from command_line import run

import synergrip as sg
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.found import Margins
from synergrip.margin.margins import Wishes, margins_of
from synergrip.margin.timing.fastest_timing import FastestTiming
from synergrip.planning.digest import with_digest
from synergrip.reports.data.json_margins import margins_document
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.data.margins_files import told_before, write_margins
from synergrip.reports.data.saved_margins import KnownMargins, saved_margins
from synergrip.reports.data.saved_margins import margins_of as read_back
from synergrip.reports.data.saved_problem import problem_of, refuse_another
from synergrip.reports.html.margins import ADDED_BY, ADDED_IN_CODE, THERE_ARE_NONE, UNTIL_THEN
from synergrip.reports.html.margins import margins_of as section_of
from synergrip.reports.html.page import report_text
from synergrip.reports.html.tables import in_folder
from synergrip.reports.text.text_margins import margins_text
from synergrip.reports.text.text_sensitivities import change_of

HOSTILE = ("<script>boom()</script>", '"><img src=x onerror=boom()>')
FEW = ["task.knots=3"]


@pytest.fixture(scope="module")
def problem() -> sg.Problem:
    return sg.load_problem("gripper-box", overrides=FEW)


@pytest.fixture(scope="module")
def made(problem: sg.Problem) -> sg.Plan:
    answer = sg.plan(problem.grasp, problem.task)
    assert isinstance(answer, sg.Plan)
    return answer


@pytest.fixture(scope="module")
def plan(problem: sg.Problem, made: sg.Plan) -> dict[str, Any]:
    told = outcome_document(problem.title, problem.grasp, made, problem.notes, problem.source)
    return dict(json.loads(json.dumps(told)))


@pytest.fixture(scope="module")
def found(problem: sg.Problem, made: sg.Plan) -> Margins:
    names = ("load_factor", "shortest_duration_s", "disturbance", "quality", "sensitivities")
    return margins_of(made, problem.grasp, problem.task, Wishes.of(problem.grasp, problem.task, only=names))


@pytest.fixture(scope="module")
def whole(found: Margins) -> Margins:
    """Return margins with all that may be told, on request, too."""
    number = DirectNumber("friction", "", 0.5, 0.4, 0.5, True, "attained", "contact[0].friction_factor=0.5")
    moved = replace(number, name="mode", unit="m", setting="task.move=1", displacement=(0.0, 0.0, 0.01, 0.0, 0.0, 0.0))
    several = {
        "critical_friction_per_contact": {"left/tip": number, "right/tip": DirectNumber.none("right", "", "none is")},
        "largest_amplitude_per_mode": {"mode 1 forward": moved},
    }
    none = FastestTiming(None, None, None, proven=False, local=False, given_s=1.0, why="the palm stays where it is")
    return replace(found, on_request=MappingProxyType(several), timing=none)


def document_of(problem: sg.Problem, found: Margins) -> dict[str, Any]:
    told = margins_document(problem.title, found, problem.notes, problem.source)
    return dict(json.loads(json.dumps(told)))


def test_what_was_saved_is_read_back(problem: sg.Problem, whole: Margins) -> None:
    """Told again it has the same words: every part of the text comes out of the document alone."""
    for each in (whole, replace(whole, linear=None, disturbance=None, quality=None, sensitivities=None, direct={})):
        told = document_of(problem, each)
        known, own = read_back(told), KnownMargins.of(each, told)
        again = replace(
            each, measures=known.measures, direct=known.direct, on_request=known.on_request, timing=known.timing,
            disturbance=known.disturbance, quality=known.quality, sensitivities=known.sensitivities,
        )  # fmt: skip
        assert margins_text(problem, again, whole=True) == margins_text(problem, each, whole=True)
        assert (known.linear or {}).keys() == (own.linear or {}).keys()
        assert section_of(told | {"execution": None}, known) == section_of(told | {"execution": None}, own)


def test_margins_say_what_they_cover_of_which_plan(problem: sg.Problem, found: Margins, plan: dict[str, Any]) -> None:
    told = document_of(problem, found)
    assert told["plan_sha256"] == plan["digest"]["sha256"]
    assert told["covers"]["found"] == ["load_factor", "shortest_duration_s", "disturbance", "quality", "sensitivities"]
    assert "heaviest_kg" in told["covers"]["left"]
    assert told["covers"]["knots"] == len(plan["time_s"])
    assert told["provenance"]["version"] == sg.__version__
    assert told["provenance"]["problem"]["sha256"] == problem.source.sha256
    assert told == with_digest({key: value for key, value in told.items() if key != "digest"})


def test_the_command_writes_margins_of_a_problem_and_of_its_saved_plan(tmp_path: Path) -> None:
    folder = str(tmp_path / "out")
    assert run("plan", "pinch-soft", "-o", folder).exit_code == 0
    told = []
    for asked in ("pinch-soft", folder):
        done = run("margins", asked, "--only", "quality", "-o", folder)
        assert done.exit_code == 0
        assert "margins.json" in done.stdout
        assert "another plan" not in done.stderr
        told.append(json.loads((tmp_path / "out" / "margins.json").read_text(encoding="utf-8")))
    assert told[0]["plan_sha256"] == told[1]["plan_sha256"]
    assert run("report", folder).exit_code == 0
    text = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "epsilon quality" in text
    assert 'data-name="margins.json"' in text
    done = run("margins", "tripod", "--only", "quality", "-o", folder)
    assert "another plan" in done.stderr
    assert run("margins", folder, "--set", "limits.margin=1 N").exit_code == 2


def test_a_plan_is_made_with_its_margins_at_once_and_its_report_is_that_of_the_file(tmp_path: Path) -> None:
    done = run("plan", "pinch-soft", "--report", "--margins", "-o", str(tmp_path))
    assert done.exit_code == 0
    first = (tmp_path / "report.html").read_bytes()
    assert b"How far it may go" in first
    assert run("report", str(tmp_path)).exit_code == 0
    assert (tmp_path / "report.html").read_bytes() == first
    assert (tmp_path / "margins.json").is_file()
    no = run("plan", "tripod", "--set", 'limits.normal_force="1 N"', "--margins", "-o", str(tmp_path / "no"))
    assert no.exit_code == 1
    assert "there is no plan, so there are no margins" in no.stderr


def test_a_plan_that_its_problem_no_longer_has_is_refused(made: sg.Plan, plan: dict[str, Any]) -> None:
    refuse_another(made, plan, "PLAN")
    altered = np.array(plan["dz_r"]) * (1 + 1e-3)
    for other in (plan | {"dz_r": altered.tolist()}, plan | {"time_s": [0.0]}, {"verdict": "infeasible"}):
        with pytest.raises(sg.InputError, match="planned again, has another plan"):
            refuse_another(made, other, "PLAN")


@pytest.mark.parametrize(
    ("provenance", "said"),
    [
        (None, "made in code"),
        ({"problem": None}, "made in code"),
        (3, "made in code"),
        ({"problem": {"text": "[hand]\nmodel = 3"}, "overrides": 3}, "cannot be read again"),
        (
            {"problem": {"name": "p", "text": "[grasp]\nfile = 'gone.json'", "sha256": 3}},
            "give the problem file itself",
        ),
        ({"problem": {"name": 3, "text": [3]}, "overrides": [3]}, "cannot be read again"),
    ],
)
def test_a_plan_that_does_not_tell_its_problem_is_refused(provenance: object, said: str) -> None:
    with pytest.raises(sg.InputError, match=said):
        problem_of({"provenance": provenance}, "PLAN")


def test_the_report_has_the_words_of_the_command(
    tmp_path: Path, problem: sg.Problem, whole: Margins, plan: dict[str, Any]
) -> None:
    write_margins(tmp_path, document_of(problem, whole))
    text = unescape(report_text(plan, beside=tmp_path))
    part = text[text.index('<section id="margins">') : text.index('<section id="contacts">')]
    assert whole.sensitivities is not None
    assert whole.disturbance is not None
    worth = [change_of(each) for kind in whole.sensitivities.margins for each in whole.sensitivities.worth_most(kind)]
    number = whole.direct["load_factor"]
    said = [*worth, number.setting, number.why, "epsilon quality", "any direction", "the palm stays where it is",
            "contact[0].friction_factor=0.5", "(0, 0, 10) mm", "none is"]  # fmt: skip
    assert [each for each in said if each not in part] == []
    bars = [each for each in part.split("<svg")[1:] if "adds to the slip margin" in each]
    assert len(bars) == 2  # of the largest margin, and with these references
    assert "margins FOLDER" not in part


def test_changes_are_told_with_the_most_on_top(problem: sg.Problem, found: Margins, plan: dict[str, Any]) -> None:
    table = section_of(plan, KnownMargins.of(found, document_of(problem, found)))
    (worth,) = (part for part in table.parts if part.title.startswith("What changes are worth"))
    for part in worth.parts[:2]:
        gains = [0.0 if row[1].text == "-" else float(row[1].text.removesuffix(" N")) for row in part.rows]
        assert gains == sorted(gains, reverse=True)
        assert gains[0] > 0


def _without(told: dict[str, Any], **more: Any) -> dict[str, Any]:
    return with_digest({key: value for key, value in told.items() if key != "digest"} | more)


def _twice(told: dict[str, Any]) -> dict[str, Any]:
    """Return margins in which both contacts of a measure have one name."""
    slip = told["measures"]["slip margin"]
    return _without(told, measures=told["measures"] | {"slip margin": slip | {"items": slip["items"][:1] * 2}})


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda told: _without(told, plan_sha256="0" * 64), "is of another plan"),
        (lambda told: _without(told, plan_sha256=None), "is of another plan"),
        (lambda told: told | {"title": "other"}, "is not as it was written"),
        (lambda told: {key: value for key, value in told.items() if key != "digest"}, "does not say of which plan"),
        (lambda told: _without(told, measures=3), "cannot be read"),
        (lambda told: _without(told, direct={"load_factor": 3}), "cannot be read"),
        (lambda told: _without(told, direct={"<b>": told["direct"]["load_factor"]}), "cannot be read"),
        (lambda told: _without(told, time_s=[0.0]), "cannot be read"),
        (lambda told: _without(told, sensitivities=[{}]), "cannot be read"),
        (lambda told: _without(told, quality={"epsilon": 1}), "cannot be read"),
        (lambda told: _twice(told), "cannot be read: expected different names"),
        (lambda told: _without(told, title="\ud800"), "cannot be read: a text in it is none"),
        (lambda told: [], "cannot be read"),
    ],
)
def test_what_are_no_margins_of_this_plan_is_left_out_and_told(
    tmp_path: Path, problem: sg.Problem, plan: dict[str, Any], found: Margins, change: Callable[[Any], Any], said: str
) -> None:
    (tmp_path / "margins.json").write_text(json.dumps(change(document_of(problem, found))), encoding="utf-8")
    why = saved_margins(tmp_path, plan)
    assert isinstance(why, str)
    assert why.startswith(said)
    table = section_of(plan, why)
    assert f"margins.json beside it {said}" in table.before[0]
    assert ADDED_BY in table.before[-1]


def test_without_margins_it_is_said_what_adds_them_and_of_a_no_why_there_are_none(plan: dict[str, Any]) -> None:
    in_code = plan["provenance"] | {"problem": None}
    for document, said in (
        (plan, in_folder(ADDED_BY, None)), (plan | {"provenance": in_code}, ADDED_IN_CODE),
        ({"verdict": "infeasible"}, THERE_ARE_NONE), (plan | {"verdict": "unknown"}, UNTIL_THEN),
    ):  # fmt: skip
        assert section_of(document).before == (f"{said}.",)
    (known,) = section_of(plan, folder=Path("out/my box")).before
    assert "`synergrip margins 'out/my box' -o 'out/my box'`" in known
    assert "FOLDER" not in known


def test_code_gives_margins_to_the_report_and_only_those_of_its_plan(
    tmp_path: Path, problem: sg.Problem, made: sg.Plan, found: Margins
) -> None:
    text = made.report(tmp_path / "box.html", problem=problem, margins=found).read_text(encoding="utf-8")
    assert "task.load_factor=" in text
    held = sg.load_problem("pinch-soft")
    other = sg.plan(held.grasp, held.task)
    assert isinstance(other, sg.Plan)
    with pytest.raises(sg.InputError, match="are of another plan"):
        other.report(tmp_path / "box.html", margins=found)
    with pytest.raises(sg.InputError, match="expected what margins"):
        made.report(tmp_path / "box.html", margins="margins.json")  # type: ignore[arg-type]


def test_what_margins_had_more_of_the_plan_is_told_when_they_are_replaced(
    tmp_path: Path, problem: sg.Problem, whole: Margins
) -> None:
    told = document_of(problem, whole)
    few = told | {"covers": told["covers"] | {"found": ["quality"]}}
    assert told_before(tmp_path, few) == []
    write_margins(tmp_path, told)
    assert told_before(tmp_path, told) == []
    assert {"load_factor", "sensitivities"} <= set(told_before(tmp_path, few))
    assert told_before(tmp_path, few | {"plan_sha256": "0" * 64}) == []
    (tmp_path / "margins.json").write_text("[1", encoding="utf-8")
    assert told_before(tmp_path, few) == []


def test_hostile_names_stay_text(tmp_path: Path, problem: sg.Problem, whole: Margins, plan: dict[str, Any]) -> None:
    told = json.dumps(document_of(problem, whole)).replace("left/tip", HOSTILE[0]).replace(
        "right/tip", HOSTILE[1].replace('"', '\\"')
    )  # fmt: skip
    (tmp_path / "margins.json").write_text(json.dumps(_without(json.loads(told))), encoding="utf-8")
    text = report_text(plan, beside=tmp_path)
    part = text[text.index('<section id="margins">') : text.index('<section id="contacts">')]
    assert unescape(part).count("boom()") >= 6
    assert "<script" not in part
    assert "<img" not in part


@pytest.mark.skipif(browser_path() is None, reason="there is no Chromium to open the report with")
def test_margins_open_without_an_error_and_make_no_page_wider(
    tmp_path: Path, problem: sg.Problem, whole: Margins, plan: dict[str, Any]
) -> None:
    write_margins(tmp_path, document_of(problem, whole))
    (tmp_path / "box.html").write_text(report_text(plan, beside=tmp_path), encoding="utf-8")
    with browsing(520, 700) as seen:
        seen.open(tmp_path / "box.html")
        assert "How far it may go" in seen.value("document.getElementById('margins').innerText")
        assert seen.value("document.documentElement.scrollWidth <= innerWidth")
        seen.call("Emulation.setEmulatedMedia", media="print")
        assert seen.value("document.querySelector('.still').offsetHeight > 50")
        assert seen.value("document.querySelector('iframe').offsetHeight === 0")
        assert not seen.errors
        assert not seen.asked
