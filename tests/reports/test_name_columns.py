"""Names beside a drawing do not overlap, stay in it, and are those of pads and links."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from command_line import run

from synergrip.reports.pictures.name_columns import LONGEST, ROW, Name, columns_height, columns_width, draw_names


class Recorded:
    """A panel that keeps what is written on it."""

    def __init__(self) -> None:
        self.notes: list[tuple[float, float, str]] = []
        self.lines: list[np.ndarray] = []

    def note(self, point: np.ndarray, text: str, color: str, across: str, bold: bool = False) -> None:
        self.notes.append((float(point[0]), float(point[1]), text))

    def strokes(self, lines: list[np.ndarray], color: str, width: float, near: float) -> None:
        self.lines += lines


@pytest.mark.parametrize("crowded", [1.0, 1e-9])
def test_names_are_apart_inside_the_drawing_and_tied_to_their_places(crowded: float) -> None:
    places = crowded * np.random.default_rng(0).uniform(-1, 1, (31, 2)) + [0.0, 0.9]
    names = [Name(f"link {k}", "#000000") for k in range(31)]
    panel = Recorded()
    half = np.array([3.0, columns_height(names) / 2])
    draw_names(panel, names, places, np.zeros(2), half, inch=1.0)  # type: ignore[arg-type]
    assert sorted(text for *_, text in panel.notes) == sorted(name.text for name in names)
    for side in (-3.0, 3.0):
        highs = np.sort([high for at, high, _ in panel.notes if at == side])
        assert len(highs) in (15, 16)
        assert np.diff(highs).min() > 0.98 * ROW
        assert np.abs(highs).max() <= half[1]
    for (*_, text), line in zip(panel.notes, panel.lines, strict=True):
        assert line[1] == pytest.approx(places[int(text.split()[1])])


def test_a_long_name_is_cut_and_none_take_no_room() -> None:
    assert len(Name("x" * 99, "#000000").short) == LONGEST
    assert columns_width([]) == 0.0


def test_the_picture_of_a_hand_has_the_names_of_its_pads_and_links(tmp_path: Path) -> None:
    file = tmp_path / "hand.svg"
    assert run("hands", "gripper", "--picture", str(file)).exit_code == 0
    drawn = re.findall(r">([^<>]+)</text>", file.read_text(encoding="utf-8"))
    assert {"1 left/tip", "palm", "left_distal_link"} <= set(drawn)
