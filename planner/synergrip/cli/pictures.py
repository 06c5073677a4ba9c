"""Pictures of a hand in a posture, that several verbs draw."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from synergrip.cli.running import draw_at

if TYPE_CHECKING:
    from synergrip.reports.view.shown import Shown

PictureOption = Annotated[
    Path | None,
    typer.Option("--picture", metavar="FILE", help="Draw the hand, and what it is to hold (.svg, .png or .pdf)."),
]


def draw_shown(shown: Shown, picture: Path | None) -> list[str]:
    """Draw a hand as a view begins with it, if a picture is asked for; return the line that says so."""
    if picture is None:
        return []
    from synergrip.reports.pictures.posture_picture import draw_posture

    begin, posed = shown.begin, shown.posed
    scene, frame = posed.scene(begin.q, begin.position), posed.frame(begin.q, begin.position)
    draw_at(picture, lambda path: draw_posture(scene, frame, shown.title or posed.hand.name, path))
    return ["", f"wrote {picture}"]
