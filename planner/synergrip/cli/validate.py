"""``synergrip validate``: is the file in order?"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from synergrip.cli.loading import load_placed
from synergrip.cli.pictures import PictureOption, draw_shown
from synergrip.cli.running import (
    Format,
    FormatOption,
    ProblemArgument,
    SetOption,
    answering,
    picture_place,
    refuse_with,
    show,
)

if TYPE_CHECKING:
    from synergrip.errors import InputError
    from synergrip.grasps.held import Held
    from synergrip.reports.view.shown import Shown


def validate(
    problem: ProblemArgument,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
    picture: PictureOption = None,
) -> None:
    """Check a problem file and everything it names, without planning it; show posture, contacts and pads.

    Where contacts do not touch, pads and picture are shown with what is wrong. Where object.position = "auto" the place
    is looked for, which takes plans.
    """
    with answering(form):
        from synergrip.errors import InputError
        from synergrip.reports.data.json_grasp import in_order_document
        from synergrip.reports.text.text_grasp import in_order_text

        picture_place(picture)
        try:
            loaded = load_placed(problem, overrides)
        except InputError as error:
            _refuse(problem, overrides or [], picture, error, form)
        written = draw_shown(_shown(problem, overrides or [], loaded.held), picture) if picture else []
        show(
            form, lambda: "\n".join([in_order_text(loaded), *written]),
            lambda: in_order_document(loaded) | ({"picture": str(picture)} if picture else {}),
        )  # fmt: skip


def _refuse(name: str, overrides: list[str], picture: Path | None, error: InputError, form: Format) -> NoReturn:
    """Tell what is wrong, with pads and picture where hand, object and contacts are in order each by itself."""
    from synergrip.errors import InputError
    from synergrip.hands.spots import spots_of
    from synergrip.reports.data.json_spots import posture_document
    from synergrip.reports.text.text_grasp import posture_lines
    from synergrip.reports.text.text_spots import spots_table
    from synergrip.reports.view.shown import reasons

    try:
        shown = _shown(name, overrides, None, reasons(error))
    except InputError:
        raise error from None
    hand, q = shown.posed.hand, shown.begin.q
    spots, written = spots_of(hand, q, shown.posed.pads), draw_shown(shown, picture)
    refuse_with(
        form, error, lambda: "\n".join([*posture_lines(hand, q), "", spots_table(spots), *written]),
        posture_document(hand, q, spots) | ({"picture": str(picture)} if picture else {}),
    )  # fmt: skip


def _shown(name: str, overrides: list[str], held: Held | None, refused: Sequence[str] = ()) -> Shown:
    from synergrip.problems.unplaced import unplaced_problem
    from synergrip.reports.view.shown import problem_shown

    problem = unplaced_problem(name, overrides)
    return problem_shown(problem.asked, held, problem.file.task.gravity, refused)
