"""``synergrip view``: on this machine alone, moved by its dials, ended by Ctrl-C; and pictures of what is no grasp."""

from __future__ import annotations

import html
import importlib.util
import json
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from browser import browser_path, browsing
from command_line import document, run

from synergrip.batch import best_place, place_judge
from synergrip.batch.placed_object import PlacedObject
from synergrip.errors import InputError
from synergrip.grasps import place_search
from synergrip.problems.problem import load_problem
from synergrip.reports.html.page import report_text

PLACES = "[...document.querySelectorAll('table tr')].map(each => each.innerText).join('\\n')"
HOSTILE = "export default {a: 1} <img src=x onerror=boom()> ${7 * 7} **b** | c"
DIALS = "document.querySelectorAll('[role=slider]')"


@pytest.fixture
def served() -> Iterator[subprocess.Popen[str]]:
    """The view of a problem whose contacts do not touch, in a process of its own."""
    sets = ["--set", "hand.posture=open", "--set", f"title={HOSTILE}"]
    command = [sys.executable, "-m", "synergrip", "view", "gripper-box", *sets, "--port", "0"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    yield process
    process.kill()
    process.communicate()


def address_of(process: subprocess.Popen[str]) -> str:
    assert process.stdout is not None
    found = re.search(r"http://127\.0\.0\.1:\d+", process.stdout.readline())
    assert found is not None
    return found[0]


def listened_at(process: subprocess.Popen[str]) -> list[str]:
    """Return the addresses at which a process listens, as the kernel has them."""
    held = {each.readlink().name for each in Path(f"/proc/{process.pid}/fd").iterdir() if each.is_symlink()}
    found = []
    for table in ("tcp", "tcp6"):
        for line in Path(f"/proc/{process.pid}/net/{table}").read_text().splitlines()[1:]:
            _, local, _, state, *_, inode = line.split()[:10]
            if state == "0A" and f"socket:[{inode}]" in held:
                found.append(local)
    return found


@pytest.mark.parametrize("ended_by", [signal.SIGINT, signal.SIGTERM])
def test_a_view_is_for_this_machine_alone_and_ends_with_a_word(
    served: subprocess.Popen[str], ended_by: signal.Signals
) -> None:
    port = int(address_of(served).rpartition(":")[2])
    if Path("/proc/net/tcp").exists():
        assert listened_at(served) == [f"0100007F:{port:04X}"]
    served.send_signal(ended_by)
    out, told = served.communicate(timeout=20)
    assert (served.returncode, out.split()) == (0, ["closed"])
    assert "Traceback" not in told
    assert "outside the surface" in told  # why it is no grasp yet


@pytest.mark.skipif(browser_path() is None, reason="there is no Chromium to open the view with")
def test_dials_move_the_hand(served: subprocess.Popen[str]) -> None:
    with browsing(400, 300, this_machine=True) as page:
        page.go(address_of(served))
        page.until(f"{PLACES}.includes('link left_tip')")
        assert "contact left/tip 58 mm away" in page.value(PLACES)
        assert HOSTILE in page.value("document.body.innerText")
        for turned in (0, 2):  # the first synergy, the first joint
            first = page.value(PLACES)
            page.value(f"{DIALS}[{turned}].focus()")
            page.call("Input.dispatchKeyEvent", type="keyDown", key="ArrowRight", code="ArrowRight",
                      windowsVirtualKeyCode=39)  # fmt: skip
            page.until(f"{PLACES} !== {first!r}")
        assert not page.errors
        assert all(each.startswith(address_of_page(page.asked[0])) for each in page.asked)


def address_of_page(asked: str) -> str:
    return "/".join(asked.split("/")[:3])


def test_what_is_shown_goes_by_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    for arguments, told in (
        (("gripper-box", "--posture", "open"), "error --posture: is for a hand"),
        (("gripper", "--set", "task.knots=2"), "error --set: overrides keys of a problem"),
        (("gripper", "--posture", "shut"), "error --posture: posture 'shut' is not"),
        (("tripod",), "given as matrices: there is no hand to be seen"),
        (("baret",), "no such file, and no such bundled hand or problem: 'baret'; did you mean 'barrett'?"),
        (("n" * 5000,), "no such bundled hand or problem"),
        (("nothing.toml",), "problem file 'nothing.toml' not found"),
        (("plan.json",), "'plan.json' not found"),
    ):
        result = run("view", *arguments)
        assert (result.exit_code, told in " ".join(result.stderr.split())) == (2, True), result.stderr
    real = importlib.util.find_spec
    monkeypatch.setattr("synergrip.reports.libraries.find_spec", lambda name: None if name == "viser" else real(name))
    refused = run("view", "gripper")
    assert refused.exit_code == 2
    assert "pip install 'synergrip[view]'" in refused.stderr


def test_one_hand_tells_where_its_pads_are(tmp_path: Path) -> None:
    found = document("hands", "barrett", "--posture", "ball", "--picture", str(tmp_path / "hand.svg"))
    places = {each["name"]: each["position_m"] for each in found["places"]}
    assert places["finger1/tip"] == pytest.approx([0, 0.04585, 0.17517], abs=1e-5)
    assert found["posture"]["finger2_inner"] == pytest.approx(1.2915, abs=1e-4)
    table = document("hands", "barrett", "--posture", '{ spread = "10 deg", finger1 = "30 deg" }')
    assert table["posture"]["finger2_spread"] == pytest.approx(0.1745, abs=1e-4)
    for posture, told in (("{ spread = 10 }", "--posture.spread: 10 has no unit"),
                          ("{ spread = 10 deg }", "--posture: '{ spread = 10 deg }' is no table"),
                          ('{ spred = "1 deg" }', "--posture.spred: synergy or joint 'spred'")):  # fmt: skip
        refused = run("hands", "barrett", "--posture", posture)
        assert (refused.exit_code, told in " ".join(refused.stderr.split())) == (2, True), refused.stderr
    assert "finger3/pad (48.4, -13.5, 176.5)" in (tmp_path / "hand.svg").read_text(encoding="utf-8")
    assert "finger1/tip  finger1_tip" in run("hands", "barrett").stdout
    assert "is for one hand" in run("hands", "--posture", "ball").stderr


JAWS = """<robot name="jaws"><link name="palm"/><link name="l"/><link name="r"/>
<joint name="jl" type="prismatic"><parent link="palm"/><child link="l"/><origin xyz="0.05 0 0.1"/><axis xyz="-1 0 0"/>
<limit lower="0" upper="0.05" effort="20" velocity="1"/></joint>
<joint name="jr" type="prismatic"><parent link="palm"/><child link="r"/><origin xyz="-0.05 0 0.1"/><axis xyz="1 0 0"/>
<limit lower="0" upper="0.05" effort="20" velocity="1"/></joint></robot>"""


def test_what_touches_is_no_other_pad_and_no_pads_are_told_as_none(tmp_path: Path) -> None:
    (tmp_path / "jaws.urdf").write_text(JAWS, encoding="utf-8")
    assert "pads none" in " ".join(run("hands", str(tmp_path / "jaws.urdf")).stdout.split())
    contact = {"model": "hard", "friction": 0.6, "stiffness": "8 N/mm", "radius": "1 mm",
               "point": ["0 mm", "0 mm", "0 mm"]}  # fmt: skip
    problem = {
        "schema": 1, "hand": {"model": "jaws.urdf", "posture": "zero", "close": {"jl": 1, "jr": 1}},
        "object": {"shape": {"box": {"size": 3 * ["20 mm"]}}, "mass": "10 g",
                   "position": ["0 mm", "0 mm", "100 mm"]},
        "contact": [contact | {"link": link, "name": f"at {link}"} for link in ("l", "r")],
        "task": {"gravity": [0, 0, 0]}, "limits": {"normal_force": "20 N"},
    }  # fmt: skip
    (tmp_path / "jaws.json").write_text(json.dumps(problem), encoding="utf-8")
    told = run("validate", str(tmp_path / "jaws.json"))
    assert told.exit_code == 0, told.stderr
    assert "at r" in told.stdout
    assert "fingertip" not in told.stdout
    places = document("validate", str(tmp_path / "jaws.json"))["places"]
    assert not [each for each in places if not each["is_pad"]]


def test_what_does_not_touch_is_drawn_and_told_all_the_same(tmp_path: Path) -> None:
    apart = ("validate", "human-ball", "--set", "hand.posture=open", "--picture", str(tmp_path / "apart.svg"))
    found = document(*apart, code=2)
    assert found["error"]["key"] == "contacts.at[0]"
    assert len(found["places"]) > 5
    drawn = (tmp_path / "apart.svg").read_text(encoding="utf-8")
    assert "0 of 5 contacts touch" in drawn
    assert "2 index/tip 61.2 mm away" in drawn
    text = run(*apart)
    assert (text.exit_code, "thumb/tip" in text.stdout, "error contacts.at[0]" in text.stderr) == (2, True, True)
    assert document("validate", "human-ball", "--picture", str(tmp_path / "near.svg"))["valid"] is True
    assert "5 of 5 contacts touch" in (tmp_path / "near.svg").read_text(encoding="utf-8")


def test_an_object_without_a_place_gets_one_that_can_be_written_into_the_file(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(place_search, "ACROSS", 8)
    monkeypatch.setattr(best_place, "FINE", 0.01)
    monkeypatch.setattr(place_judge, "JUDGED", 8)
    sets = ("hand.posture=open", "hand.close=close", "task.knots=2", "task.between=report")
    asked = ("barrett-ball-hold", *(part for each in sets for part in ("--set", each)))
    monkeypatch.setattr(PlacedObject, "inside", 0.0176)
    deep = "but links of the hand run up to 17.6 mm deep through the object: without that none was found"
    (note,) = document("validate", *asked, "--set", "object.position=auto")["notes"]
    assert f"(a plan holds there, {deep}; slip margin" in note
    monkeypatch.setattr(PlacedObject, "inside", 0.002)
    auto = document("plan", *asked, "--set", "object.position=auto", "-o", "auto")
    (note,) = auto["notes"]
    line = re.search(
        r"placed   (position = \[.*\])  \(a plan holds there; slip margin up to [\d.]+ N at the start posture; all",
        note,
    )
    assert line is not None
    written = document("plan", *asked, "--set", f"object.{line[1]}")
    assert (written["notes"], written["dz_r"]) == ([], auto["dz_r"])
    saved = json.loads(Path("auto/plan.json").read_text(encoding="utf-8"))
    put = f"object.{line[1]}".replace(" = ", "=")
    assert saved["provenance"]["overrides"][-1] == f'{put}  # found by object.position = "auto"'
    told = html.unescape(report_text(saved))
    assert f'found by <code>object.position = "auto"</code>: <code>{put}</code></p>' in told
    assert "<code>object.position=auto</code></p>" in told  # what was changed on the command line, to the last one
    with pytest.raises(InputError, match='"auto" is looked for by the command line'):
        load_problem("barrett-ball-hold", [*sets, "object.position=auto"])
    far = run("validate", *asked, "--set", "object.position=auto", "--set", "object.shape.sphere.radius=1 mm")
    assert far.exit_code == 2
    assert "error object.position: nowhere do all contacts touch" in far.stderr
    assert run("validate", "barrett-ball-hold", "--set", "object.position=auto").exit_code == 2  # it does not close
