"""Figures for papers: sizes, letters and titles as asked, from a problem or a plan at hand; the README's picture."""

from __future__ import annotations

import json
import re
import shutil
import tomllib
import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import document, run

import synergrip
from synergrip.errors import InputError, OutputError
from synergrip.planning.outcome import Plan
from synergrip.reports.figures import figure as door
from synergrip.reports.figures.figure import FIGURES, figure
from synergrip.reports.pictures.sheet import Panel

SVG = "{http://www.w3.org/2000/svg}"

ROOT = Path(__file__).parent.parent.parent
OVERVIEW = ROOT / "docs" / "images" / "overview.svg"
POINTS = 72 / 25.4
"""Of a millimetre."""


@pytest.fixture(scope="module")
def saved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A plan on a hand, written into a folder."""
    folder = tmp_path_factory.mktemp("glass")
    assert run("plan", "human-glass", "-o", str(folder)).exit_code == 0
    return folder


@pytest.fixture(scope="module")
def matrices(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A plan of a grasp given as matrices."""
    folder = tmp_path_factory.mktemp("tripod")
    assert run("plan", "tripod", "-o", str(folder)).exit_code == 0
    return folder


def texts(path: Path) -> list[str]:
    return ["".join(node.itertext()) for node in ElementTree.parse(path).iter(f"{SVG}text")]


def size(path: Path) -> tuple[float, float]:
    """Width and height of an SVG file [mm]."""
    root = ElementTree.parse(path).getroot()
    width, height = (float(root.get(name, "").removesuffix("pt")) / POINTS for name in ("width", "height"))
    return width, height


@pytest.fixture
def no_planning(monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*given: object) -> None:
        raise AssertionError("planned again")

    monkeypatch.setattr("synergrip.planning.planning.plan", refused)
    monkeypatch.setattr(door, "planned", refused)


@pytest.mark.usefixtures("no_planning")
@pytest.mark.parametrize(
    ("what", "told"),
    [
        ("margin", ["slip margin [N]", "required 0.2 N", "thumb/tip", "time [s]"]),
        ("cones", ["thumb/tip", "little/tip", "least 0.2 N, t = 0 s", "start, 0 s", "end, 2 s", "least slip margin"]),
        ("overview", ["slip margin [N]", "normal force [N]", "limit 20 N", "g", "50 mm"]),
        ("synergies", ["pc1  +16 deg", "1 thumb/tip", "5 little/tip", "g"]),
    ],
)
def test_a_saved_plan_is_drawn_as_it_is_and_as_large_as_asked(
    what: str, told: Sequence[str], saved: Path, tmp_path: Path
) -> None:
    path = tmp_path / "figure.svg"
    found = document("figure", what, str(saved), "-o", str(path), "--width", "170", "--title", "A <title>")
    assert found["file"] == str(path)
    assert "Human hand tilts a glass" in found["caption"]
    assert size(path)[0] == pytest.approx(170)
    written = texts(path)
    assert {"A <title>", *told} <= set(written)


def test_letters_are_as_large_as_asked_and_of_the_font_asked_for(saved: Path, tmp_path: Path) -> None:
    plain, large = tmp_path / "plain.svg", tmp_path / "large.svg"
    figure("margin", saved, plain, width_mm=120, height_mm=70)
    figure("margin", saved, large, width_mm=120, height_mm=70, font="serif", font_size=12)
    assert size(plain) == size(large) == pytest.approx((120, 70))
    for path, points, family in ((plain, 8, "sans-serif"), (large, 12, "serif")):
        styles = [node.get("style", "") for node in ElementTree.parse(path).iter(f"{SVG}text")]
        label = next(node for node in ElementTree.parse(path).iter(f"{SVG}text") if node.text == "time [s]")
        assert f"{points}px" in label.get("style", "")
        assert all(family in style for style in styles)
    assert not [text for text in texts(plain) if "glass" in text]  # no title by default


def test_a_png_has_as_many_dots_as_asked_for(matrices: Path, tmp_path: Path) -> None:
    for dpi, across in ((None, 160), (75, 75)):
        figure("margin", matrices, tmp_path / "margin.png", width_mm=76.2, height_mm=60, dpi=dpi)
        header = (tmp_path / "margin.png").read_bytes()[:24]
        assert int.from_bytes(header[16:20], "big") == pytest.approx(across * 76.2 / 25.4, abs=1)
    with pytest.raises(InputError, match="has more than 1e"):
        figure("margin", matrices, tmp_path / "large.png", width_mm=2000, height_mm=2000, dpi=1200)


def test_forces_in_their_cones_begin_at_rings_and_end_at_squares(
    saved: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = list[bool]()
    monkeypatch.setattr(Panel, "outlined", lambda *given, square, **named: drawn.append(square))
    figure("cones", saved, tmp_path / "cones.svg")
    assert sorted(drawn) == [False] * 6 + [True] * 6  # of five contacts and the key
    figure("cones", "pinch-soft", tmp_path / "one.svg", overrides=["task.knots=1"])
    assert len(drawn) == 12
    assert {"the force"} <= set(texts(tmp_path / "one.svg"))
    assert not [text for text in texts(tmp_path / "one.svg") if text.startswith(("start", "end"))]
    figure("cones", "pinch-soft", tmp_path / "still.svg", overrides=["task.knots=2"])
    assert sorted(drawn[12:]) == [False, True]  # of the key alone: what does not move is a dot


def test_a_title_is_no_larger_than_its_figure_bears(saved: Path, tmp_path: Path) -> None:
    long = "A hand that holds a glass of water and turns it over slowly"
    for name, title in (("titled", long), ("plain", "")):
        figure("margin", saved, tmp_path / f"{name}.svg", title=title, width_mm=84)
    assert size(tmp_path / "titled.svg")[1] < size(tmp_path / "plain.svg")[1] + 17  # mm
    lines = [text for text in texts(tmp_path / "titled.svg") if text and text in long]
    assert len(lines) == 2


def test_text_stays_text_in_a_pdf(saved: Path, tmp_path: Path) -> None:
    figure("margin", saved, tmp_path / "margin.pdf")
    data = (tmp_path / "margin.pdf").read_bytes()
    assert b"/FontFile2" in data  # TrueType, embedded
    assert b"/Type3" not in data


def test_of_a_plan_made_in_code_the_grasp_is_at_hand(tmp_path: Path) -> None:
    problem = synergrip.load_problem("tripod")
    answer = synergrip.plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    for what in ("margin", "cones", "synergies"):
        assert figure(what, answer, tmp_path / f"{what}.svg") == tmp_path / f"{what}.svg"
    with pytest.raises(InputError, match="no hand to be seen"):
        figure("overview", answer, tmp_path / "overview.svg")
    answer.save(tmp_path / "plan")
    with pytest.raises(InputError, match="made in code"):
        figure("synergies", tmp_path / "plan", tmp_path / "synergies.svg")


def test_the_problem_of_a_saved_plan_is_read_again(matrices: Path, tmp_path: Path) -> None:
    assert texts(figure("cones", matrices / "plan.json", tmp_path / "cones.svg"))[0] == "t"
    told = run("plan", "pinch-soft", "--set", "limits.margin=0.3 N", "-o", str(tmp_path / "soft"))
    assert told.exit_code == 0
    assert figure("synergies", tmp_path / "soft", tmp_path / "soft.svg").is_file()
    shutil.copy(ROOT / "problems" / "tripod.toml", tmp_path / "own.toml")
    for name in ("tripod.json", "tripod-wrench.csv", "tripod-motion.csv"):
        shutil.copy(ROOT / "problems" / name, tmp_path)
    changed = (tmp_path / "own.toml").read_text().replace("title = ", "title = 'mine'  # ", 1)
    (tmp_path / "own.toml").write_text(changed)
    assert run("plan", str(tmp_path / "own.toml"), "-o", str(tmp_path / "own")).exit_code == 0
    with pytest.raises(InputError, match="give the problem file itself"):
        figure("cones", tmp_path / "own", tmp_path / "cones.svg")  # its files are not here


def test_the_problem_of_a_saved_plan_may_be_json(tmp_path: Path) -> None:
    told = tomllib.loads((ROOT / "problems" / "gripper-box.toml").read_text(encoding="utf-8"))
    told["task"]["knots"] = 2
    (tmp_path / "box.json").write_text(json.dumps(told), encoding="utf-8")
    assert run("plan", str(tmp_path / "box.json"), "-o", str(tmp_path / "box")).exit_code == 0
    figure("synergies", tmp_path / "box", tmp_path / "figure.svg")
    assert "left/tip" in " ".join(texts(tmp_path / "figure.svg"))


def test_a_title_of_what_are_no_characters_leaves_a_file_that_can_be_read(matrices: Path, tmp_path: Path) -> None:
    figure("margin", matrices, tmp_path / "figure.svg", title="a\ufffe\uffff\U0010ffff\udcff\x01b \U0001f600")
    assert "ab \U0001f600" in texts(tmp_path / "figure.svg")


def test_units_are_seen_in_the_help() -> None:
    told = " ".join(run("figure", "--help").stdout.replace("│", " ").split())
    assert told.count("On paper, in mm") == 2
    assert "in points" in told


def test_how_many_synergies_a_task_needs(tmp_path: Path) -> None:
    found = document("figure", "needed", "table2-hard-motors", "-o", str(tmp_path / "needed.svg"), "--height", "90")
    assert "linear model of the start posture" in found["caption"]
    assert {"largest slip margin [N]", "least effort [N]", "first k", "best k"} <= set(texts(tmp_path / "needed.svg"))
    assert size(tmp_path / "needed.svg") == pytest.approx((180, 90))


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["margins", "tripod"], 2, "did you mean 'margin'"),
        (["margin", "tripod", "--font", "Comic Cans"], 2, "--font"),
        (["margin", "tripod", "--font-size", "0.5"], 2, "--font-size"),
        (["margin", "tripod", "--width", "1e9"], 2, "--width"),
        (["margin", "tripod", "--height", "20"], 2, "leave no room"),
        (["cones", "tripod", "--height", "90"], 2, "follows from its width"),
        (["margin", "tripod", "--dpi", "300"], 2, "has lines, no dots"),
        (["margin", "tripod", "--dpi", "1"], 2, "--dpi"),
        (["margin", "pinch-hard"], 1, "infeasible"),
        (["margin", "no-such-problem"], 2, "no-such-problem"),
    ],
)
def test_what_cannot_be_drawn_is_refused_by_its_name(
    arguments: list[str], code: int, said: str, tmp_path: Path
) -> None:
    done = run("figure", *arguments, "-o", str(tmp_path / "figure.svg"))
    assert done.exit_code == code
    assert said in " ".join((done.stdout + done.stderr).split())
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("wrong", "key"),
    [
        ({"what": 3}, "what"), ({"source": 3.5}, "SOURCE"), ({"path": ""}, "path"), ({"width_mm": "wide"}, "width_mm"),
        ({"height_mm": float("nan")}, "height_mm"), ({"font": 3}, "font"), ({"font_size": True}, "font_size"),
        ({"title": None}, "title"), ({"font_size": None}, "font_size"),
    ],
)  # fmt: skip
def test_arguments_in_code_are_refused_by_their_names(wrong: dict[str, Any], key: str, tmp_path: Path) -> None:
    right = {"what": "margin", "source": "tripod", "path": tmp_path / "figure.svg"}
    with pytest.raises(InputError) as error:
        synergrip.figure(**{**right, **wrong})
    assert error.value.issues[0].key == key
    assert not list(tmp_path.iterdir())


def test_a_saved_plan_is_no_problem_to_be_altered_and_a_no_is_no_plan(matrices: Path, tmp_path: Path) -> None:
    done = run("figure", "margin", str(matrices), "--set", "limits.margin=1 N", "-o", str(tmp_path / "figure.svg"))
    assert (done.exit_code, "--set" in done.stderr) == (2, True)
    assert run("plan", "pinch-hard", "-o", str(tmp_path / "no")).exit_code == 1
    with pytest.raises(InputError, match="no plan to draw"):
        figure("margin", tmp_path / "no", tmp_path / "figure.svg")
    wrong = run("figure", "margin", str(matrices), "-o", str(tmp_path / "figure.doc"))
    assert (wrong.exit_code, "--output" in wrong.stderr) == (2, True)


def test_every_figure_is_told_in_the_help_and_in_the_docs() -> None:
    told = run("figure", "--help").stdout
    page = (ROOT / "docs" / "figures.md").read_text(encoding="utf-8")
    for name in FIGURES:
        assert name in told
        assert f"`{name}`" in page


def strokes(path: Path) -> list[np.ndarray]:
    """The corners of every line and area of an SVG file [points]."""
    found = [node.get("d", "") for node in ElementTree.parse(path).iter(f"{SVG}path")]
    return [np.array(re.findall(r"-?\d+(?:\.\d+)?(?:e-?\d+)?", each), dtype=float) for each in found]


def test_the_picture_of_the_readme_is_what_the_command_makes(saved: Path, tmp_path: Path) -> None:
    page = (ROOT / "docs" / "figures.md").read_text(encoding="utf-8")
    assert "synergrip figure overview human-glass -o docs/images/overview.svg" in page
    path = tmp_path / "overview.svg"
    assert run("figure", "overview", str(saved), "-o", str(path)).exit_code == 0
    assert texts(path) == texts(OVERVIEW)
    assert size(path) == pytest.approx(size(OVERVIEW))
    made, kept = strokes(path), strokes(OVERVIEW)
    assert [len(each) for each in made] == [len(each) for each in kept]
    for one, other in zip(made, kept, strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=0.5)  # points; what is seen, not the last digit
    assert OVERVIEW.stat().st_size < 200_000


def test_in_a_narrow_column_the_charts_stand_below_the_hand(saved: Path, tmp_path: Path) -> None:
    found = document("figure", "overview", str(saved), "-o", str(tmp_path / "narrow.svg"), "--width", "88")
    assert "Below: slip margin" in found["caption"]
    width, height = size(tmp_path / "narrow.svg")
    assert height > 1.5 * width


def test_the_viewer_of_a_plan_is_a_frame_with_its_page(saved: Path, tmp_path: Path) -> None:
    pytest.importorskip("viser")
    problem = synergrip.load_problem("gripper-box", ["task.knots=5"])
    viewer = synergrip.plan(problem.grasp, problem.task).viewer(height=300)
    shown = viewer._repr_html_()
    assert shown.startswith("<iframe")
    assert "height: 300px" in shown
    assert "<script" not in shown  # escaped: it belongs to the frame
    assert viewer.save(tmp_path / "view.html").read_text(encoding="utf-8") == viewer.page
    assert "5 frames of a hand with 2 contacts" in repr(viewer)
    with pytest.raises(InputError, match="path"):
        viewer.save("")
    with pytest.raises(OutputError, match="it is a folder"):
        viewer.save(tmp_path)
    with pytest.raises(InputError, match="height"):
        synergrip.plan(problem.grasp, problem.task).viewer(height=0)


def test_a_problem_shows_its_table() -> None:
    problem = synergrip.load_problem("gripper-box", ["title=<b>box</b>"])
    shown = problem._repr_html_()
    assert "<b>box" not in shown
    assert "&lt;b&gt;box" in shown
    for contact in problem.grasp.contacts:
        assert contact.name in shown
    for word in ("limits.normal_force = 20 N", "limits.joint_torque = up to 2 N m", "friction", "knots", "load up to"):
        assert word in shown
    assert "(0, 4, 120) mm in the palm frame" in shown
    assert "(0, 0, -9.81) m/s² in the palm frame at the start" in shown
    assert "array&gt;" not in shown
    matrices = synergrip.load_problem("tripod")
    assert "<td>friction cone<br>limits.normal_force = 10 N" in matrices._repr_html_()
