"""The report: one page that opens offline, tells what plan.json tells, and that nobody's title can break out of."""

from __future__ import annotations

import json
import re
from functools import cache
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from shlex import quote
from typing import Any

import browser
import numpy as np
import pytest
from browser import Page, browser_path, browsing
from command_line import run

from synergrip.errors import InputError
from synergrip.planning.digest import with_digest
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.reports import libraries
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.data.viewer import viewer_of
from synergrip.reports.html import page
from synergrip.reports.html.charts import charts_of
from synergrip.reports.html.page import report_text
from synergrip.reports.html.saved_answer import read_answer
from synergrip.reports.html.synergies import synergies_of
from synergrip.reports.html.tables import tables_of, usage_told
from synergrip.reports.html.why import NOT_YET, missing_of, why_of
from synergrip.reports.pictures.lines import Lines, lines_of
from synergrip.reports.text.text_usages import worst_of
from synergrip.reports.view.planned import scene_of
from synergrip.statics.analysis import analyse

HOSTILE = (
    "<script>boom()</script>",
    '"><img src=x onerror=boom()>',
    "\u202eright to left",
    "{{ 7 * 7 }}",
    "n" * 10_000,
)
MOST_BYTES = 1.5e6
IN_ONE_LINE = """[...document.querySelectorAll("td:not(.c)")].filter(cell => {
  if (/\\s/.test(cell.innerText)) return false;
  const range = document.createRange();
  range.selectNodeContents(cell);
  return new Set([...range.getClientRects()].map(each => Math.round(each.top))).size > 1;
}).map(cell => cell.innerText)"""
"""Which names of tables are split over lines."""
ASKED = {
    "gripper-box": (),
    "robonaut-handle": ("limits.margin=20 N",),
    "human-ball": ("task.move[0].lift=120 mm", "task.knots=5"),
}


@cache
def document_of(name: str, *overrides: str) -> dict[str, Any]:
    problem = load_problem(name, list(overrides))
    answer = plan(problem.grasp, problem.task)
    found = outcome_document(problem.title, problem.grasp, answer, problem.notes, problem.source)
    return dict(json.loads(json.dumps(found)))


class Tags(HTMLParser):
    """The elements of a page outside the scene, and what they refer to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.names, self.links = list[str](), list[str]()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names.append(tag)
        self.links += [value or "" for name, value in attrs if name in ("src", "href", "action") and tag != "iframe"]
        assert not [name for name, _ in attrs if name.startswith("on")]


def test_a_report_refers_to_nothing_outside_itself_and_is_small() -> None:
    text = report_text(document_of("gripper-box"), "t_s\n0\n")
    assert len(text.encode()) < MOST_BYTES
    assert all(link.startswith("#") for link in Tags(text).links)


def test_the_table_of_limits_has_the_rows_of_the_text() -> None:
    """What is bounded on both sides by itself has a row for each."""
    problem = load_problem("gripper-box")
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    own = [row for usage in answer.usages for row in worst_of(usage)]
    (table,) = (each for each in tables_of(document_of("gripper-box")) if each.anchor == "limits")
    told = [tuple(cell.text for cell in row) for row in table.rows]
    assert [row[:3] + row[4:5] for row in told] == [(*row[:3], row[4]) for row in own]
    sides = [row for row in told if row[0].endswith("normal force")]
    assert [(row[0], row[4][0]) for row in sides] == [("largest normal force", "≤"), ("smallest normal force", "≥")]
    assert sum(row[5] != "–" for row in sides) == 1  # between the knots the worse of both is known


@pytest.mark.parametrize("name", ["human-glass", "human-ball-near"])
def test_what_is_a_little_beyond_its_bound_is_told_as_the_text_tells_it(name: str) -> None:
    """Which value is the worst, and which is on its bound, is a question of sizes that plan.json tells."""
    problem, document = load_problem(name), document_of(name)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    own = [row for usage in answer.usages for row in worst_of(usage)]
    assert [row for each in document["limits"] for row in worst_of(usage_told(each, document))] == own
    for each in document["limits"]:  # as it was written before it told them
        series = {key: value for key, value in each["series"].items() if key not in ("scale", "allowance")}
        assert np.array_equal(usage_told(each | {"series": series}, document).value, series["values"])


def test_what_is_allowed_for_is_told_with_the_worst_case_on_top() -> None:
    cases = [
        {"case": "as stated", "worst_N": 0.9, "by_maps": False},
        {"case": "least <i>", "worst_N": 0.5, "by_maps": True},
    ]
    told = {"worst_N": 0.5, "contact": "left/tip", "time_s": 1.0, "case": "least", "cases": cases, "scenarios": None}
    document = document_of("tripod") | {"allowances": told}
    (table,) = (each for each in tables_of(document) if each.anchor == "allowed")
    assert [tuple(cell.text for cell in row) for row in table.rows] == [("least <i>", "0.5 N"), ("as stated", "0.9 N")]
    assert "0.5 N in the worst case of all that is allowed for" in report_text(document)


def test_a_change_that_no_plan_was_found_with_has_no_command() -> None:
    document = document_of("robonaut-handle", *ASKED["robonaut-handle"])
    first = document["repairs"][0]
    for known, again, command in ((True, "a plan", f"--set {quote(first['set'])}"), (False, "no plan found", "")):
        why = why_of(document | {"repairs": [first | {"verified": known}]})
        assert why is not None
        part = next(each for each in why.parts if each.title == ("What would help" if known else NOT_YET))
        (row,) = part.rows
        assert [cell.text for cell in row[3:]] == [again, command]
        assert ("`synergrip explain PROBLEM` tries more." in part.after) == (not known)
    alone = why_of(document | {"repairs": [], "others": [first | {"verified": True}]})
    assert alone is not None
    assert "What would help, tried and planned, and not the least there is" in [part.title for part in alone.parts]


def test_hostile_titles_and_names_stay_text() -> None:
    document, title = document_of("tripod"), " ".join(HOSTILE)
    names = [*HOSTILE[:3], *document["contacts"][3:]][: len(document["contacts"])]
    text = report_text(document | {"title": title, "contacts": names, "notes": [title]})
    told = Tags(text)
    assert told.names.count("script") == 1
    assert told.names.count("img") == 0
    assert unescape(text[text.index("<h1>") + 4 : text.index("</h1>")]) == title


@pytest.mark.skipif(browser_path() is None, reason="there is no Chromium to open the report with")
def test_a_long_name_makes_no_page_wider(tmp_path: Path) -> None:
    document = document_of("tripod")
    told = json.dumps(document).replace(document["contacts"][0], 480 * "W")
    (tmp_path / "long.html").write_text(report_text(json.loads(told)), encoding="utf-8")
    with browsing(1000, 300) as seen:
        seen.open(tmp_path / "long.html")
        assert seen.value("document.documentElement.scrollWidth <= innerWidth")


def test_charts_have_the_numbers_of_the_plan_in_units_that_people_read() -> None:
    document = document_of("gripper-box")
    found = {each.title: each for each in lines_of(document)}
    assert np.allclose(found["slip margin"].values, document["true"]["margin"]["per_contact_N"])
    assert np.allclose(found["object displacement"].values, 1e3 * np.array(document["du"])[:, :3])
    assert found["object displacement"].unit == "mm"
    forces = np.linalg.norm(np.array(document["true"]["force_N"]), axis=2)
    assert np.allclose(found["contact force"].values, forces)
    assert found["slip margin"].names == tuple(document["contacts"])


def test_a_chart_of_many_instants_has_what_is_wanted_at_those_that_are_drawn() -> None:
    times, ramp = np.linspace(0, 1, 500), np.linspace(0, 2, 500)[:, None]
    lines = Lines("slip margin", "N", ("left",), ramp, target=ramp, of_contacts=True)
    (chart,) = charts_of(times, [lines])
    assert chart.svg.startswith("<svg")


def test_of_a_no_the_hand_is_seen_at_its_start_and_what_would_repair_it_is_told() -> None:
    document = document_of("robonaut-handle", *ASKED["robonaut-handle"])
    assert document["verdict"] == "infeasible"
    scene = scene_of(document)
    assert len(scene.times) == 1
    assert scene.margins is None
    assert not scene.forces.any()
    names = [each["name"] for each in document["execution"]["contacts"]]
    assert list(scene.contacts) == names
    text = report_text(document)
    assert "the hand at the start" in text
    assert Tags(text).names.count("iframe") == 1


def test_of_a_motion_that_is_not_reached_what_is_known_is_seen_until_then() -> None:
    document = document_of("gripper-box", "task.move[0].lift=10 mm", "task.knots=11")
    assert document["stage"] == "reach"
    scene = scene_of(document)
    assert 1 < len(scene.times) < len(document["time_s"])
    assert scene.times[-1] <= document["reached"]["until_s"]
    found = {each.title: each for each in lines_of(document)}
    assert len(found["slip margin"].values) == len(found["synergy reference"].values) == len(scene.times)
    assert "as far as the motion is followed" in report_text(document)


def test_what_is_not_reached_is_shaded_to_the_end_of_the_task() -> None:
    document = document_of("gripper-box", "task.move[0].lift=10 mm", "task.knots=11")
    ((begin, end),) = missing_of(document)
    assert begin == document["reached"]["until_s"]
    assert end == document["time_s"][-1]
    known = np.array(document["true"]["time_s"])
    (chart,) = charts_of(known, lines_of(document)[:1], [(begin, end)], end)
    assert (chart.end, chart.last) == (end, known[-1])
    assert f"not reached from t = {begin:.3g} s on" in report_text(document)
    lost = document | {"reached": None, "stage": "execution"}
    assert missing_of(lost) == ((known[-1], end),)
    assert f"does not keep what was planned; followed until t = {known[-1]:.3g} s" in report_text(lost)


def test_a_no_tells_what_the_terminal_tells() -> None:
    """What clashes, from and to in their units, in which model, what is left undone, and what is missing."""
    clashes, missing = document_of("robonaut-handle", *ASKED["robonaut-handle"]), document_of("barrett-ball-lift")
    told = [why_of(each) for each in (clashes, missing)]
    cells = [[cell.text for part in why.parts for row in part.rows for cell in row] for why in told if why is not None]
    first = clashes["conflicts"][0]
    assert f"{first['share']:.0%}" in cells[0]
    assert ", ".join(each["name"] for each in first["items"]) in cells[0]
    assert {"0 mm", "11.135 mm", "99% of the motion undone"} <= set(cells[1])
    assert " + ".join(missing["missing_synergies"]["candidates"][0]["names"]) in cells[1]
    assert told[1] is not None
    assert "in the linear model of the start posture" in told[1].before[1]


def test_each_synergy_is_told_with_what_it_does_by_itself() -> None:
    """One degree alone moves the object and presses as the response of the grasp has it, and some of it is free."""
    problem, document = load_problem("gripper-box"), document_of("gripper-box")
    response = analyse(problem.grasp, problem.timed.wrench[0]).response
    each = document["control"]["each"][0]
    assert each["unit"] == "deg"
    assert np.allclose(each["motion"], np.radians(1) * response.du_dzr[:, 0], atol=1e-12)
    rows = problem.grasp.rows[0]
    force = np.linalg.norm(np.radians(1) * response.dlambda_dzr[rows, 0][:3])
    assert each["internal_N"][0] == pytest.approx(force)
    (table,) = synergies_of(document)
    assert [part.title for part in table.parts][-1] == "What each synergy does by itself"
    assert table.parts[0].rows[0][1].text == document["control"]["motions"][0]["text"]


def test_torques_are_in_percent_of_what_each_joint_may_do() -> None:
    document = document_of("human-ball")
    (lines,) = (each for each in lines_of(document) if each.title == "joint torque")
    limits = dict(zip(document["joints"], document["execution"]["joint_torque"], strict=True))
    name = lines.names[0]
    torque = np.array(document["tau"])[:, document["joints"].index(name)]
    assert np.allclose(lines.values[:, 0], 100 * torque / limits[name])


def test_the_command_writes_it_with_the_answer_and_again_from_the_file(tmp_path: Path) -> None:
    made = run("plan", "tripod", "-o", str(tmp_path), "--report")
    assert made.exit_code == 0
    assert "report.html" in made.stdout
    first = (tmp_path / "report.html").read_bytes()
    (tmp_path / "report.html").unlink()
    again = run("report", str(tmp_path), "--format", "json")
    assert json.loads(again.stdout) == {
        "report": str(tmp_path / "report.html"), "verdict": "feasible", "exit_code": 0
    }  # fmt: skip
    assert (tmp_path / "report.html").read_bytes() == first
    assert run("plan", "tripod", "-o", str(tmp_path)).exit_code == 0
    assert not (tmp_path / "report.html").exists()  # of another answer


def test_code_writes_the_page_of_the_command_line(tmp_path: Path) -> None:
    problem = load_problem("tripod")
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    path = answer.report(tmp_path / "ours.html", problem=problem)
    assert run("plan", "tripod", "-o", str(tmp_path), "--report").exit_code == 0
    ours, theirs = (
        re.sub(r'data-packed="[^"]*"', "", each.read_text(encoding="utf-8"))
        for each in (path, tmp_path / "report.html")
    )  # the packed document has its date
    assert "(FOLDER is that of plan.json)" in ours  # code does not know whether there is one
    assert ours.replace(" (FOLDER is that of plan.json)", "") == theirs.replace(str(tmp_path), "FOLDER")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda told: told.pop("digest"), "has no digest"),
        (lambda told: told["margin"].update(worst_N=9.0), "is not as it was written"),
        (lambda told: told.pop("verdict"), "holds no answer"),
    ],
    ids=["no digest", "changed", "no answer"],
)
def test_an_answer_that_is_not_as_it_was_written_has_no_report(tmp_path: Path, change: Any, said: str) -> None:
    told = json.loads(json.dumps(document_of("tripod")))
    change(told)
    (tmp_path / "plan.json").write_text(json.dumps(told), encoding="utf-8")
    with pytest.raises(InputError, match=said):
        read_answer(tmp_path / "plan.json")


@pytest.mark.parametrize(
    ("provenance", "key"),
    [
        (3, "provenance"),
        ([], "provenance"),
        ({"overrides": 3}, "provenance.overrides"),
        ({"overrides": [3]}, "provenance.overrides"),
        ({"version": 3}, "provenance.version"),
        ({"problem": "ball"}, "provenance.problem"),
        ({"problem": {"sha256": True}}, "provenance.problem.sha256"),
        ({"problem": {"dict": [3]}}, "provenance.problem.dict"),
    ],
)
def test_where_an_answer_says_it_comes_from_is_judged_as_no_digest_guards_it(
    tmp_path: Path, provenance: object, key: str
) -> None:
    told = dict(document_of("tripod")) | {"provenance": provenance}
    (tmp_path / "plan.json").write_text(json.dumps(told), encoding="utf-8")
    with pytest.raises(InputError) as refused:
        read_answer(tmp_path / "plan.json")
    assert refused.value.issues[0].key == key


@pytest.mark.parametrize(
    "change",
    [{"title": None}, {"title": "\ud800"}, {"limits": 3}, {"time_s": []}, {"structure": 3}, {"margin": {}}],
    ids=["no title", "half a letter", "limits", "times", "structure", "margin"],
)
def test_of_an_answer_with_something_else_in_it_a_page_is_refused_with_a_reason(
    tmp_path: Path, change: dict[str, Any]
) -> None:
    told = {key: value for key, value in document_of("tripod").items() if change.get(key, key) is not None} | {
        key: value for key, value in change.items() if value is not None
    }
    (tmp_path / "plan.json").write_text(json.dumps(with_digest(told)), encoding="utf-8")
    done = run("report", str(tmp_path))
    assert done.exit_code == 2
    assert "or has something else in its place" in " ".join(done.output.split())
    assert not (tmp_path / "report.html").exists()


def test_what_is_not_installed_is_said_before_anything_is_planned(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(libraries, "find_spec", lambda name: None if name == "viser" else object())
    with pytest.raises(InputError, match=r"needs viser, which is not installed: pip install 'synergrip\[view\]'"):
        page.refuse_without_libraries()
    with pytest.raises(InputError, match="needs viser, which is not installed"):
        viewer_of(scene_of(document_of("gripper-box")), 400)


@pytest.mark.skipif(browser_path() is None, reason="there is no Chromium to open the report with")
def test_reports_open_without_a_network_or_an_error_and_their_cursors_follow(tmp_path: Path) -> None:
    with browsing(400, 300) as seen:
        for name, overrides in ASKED.items():
            document = document_of(name, *overrides)
            path = tmp_path / f"{name}.html"
            path.write_text(report_text(document), encoding="utf-8")
            seen.open(path)
            assert document["verdict"] in seen.value("document.querySelector('.verdict').className")
            if document["verdict"] == "infeasible":
                assert document["repairs"][0]["set"] in seen.value("document.getElementById('why').innerText")
            if "true" in document:
                _follows(seen)
            assert not seen.errors
            assert not seen.asked


@pytest.mark.skipif(browser_path() is None, reason="there is no Chromium to open the report with")
def test_without_webgl_a_still_picture_is_seen_and_what_to_do_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(browser, "QUIET", ("--headless=new", "--disable-gpu", "--disable-3d-apis"))
    (tmp_path / "box.html").write_text(report_text(document_of("gripper-box")), encoding="utf-8")
    with browsing(400, 300) as seen:
        seen.open(tmp_path / "box.html")
        assert seen.value("document.querySelector('.still svg').getBoundingClientRect().height > 50")
        assert "hardware acceleration" in seen.value("document.getElementById('playback').innerText")
        assert seen.value("document.querySelector('iframe') === null")
        seen.call("Emulation.setEmulatedMedia", media="print")
        assert seen.value(IN_ONE_LINE) == []
        assert seen.value("getComputedStyle(document.querySelector('.wide')).overflowX") == "visible"
        assert not seen.errors


def _follows(seen: Page) -> None:
    """Wait until the playback has moved the cursors of the charts, twice."""
    cursor = "document.querySelector('.cursor').style.left"
    first = seen.until(cursor)
    seen.until(f"{cursor} !== '{first}'")
    lefts = seen.value("[...document.querySelectorAll('.cursor')].map(each => each.style.left)")
    assert len(lefts) > 3
    assert len(set(lefts)) == 1  # all charts have the same time
