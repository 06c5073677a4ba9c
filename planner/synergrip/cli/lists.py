"""``synergrip problems``, ``hands``, ``schema`` and ``docs``: what there is."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from synergrip.cli.pictures import PictureOption, draw_shown
from synergrip.cli.running import Format, FormatOption, answering, picture_place, say, show

if TYPE_CHECKING:
    from synergrip.hands.hand import Hand


def problems(form: FormatOption = Format.TEXT) -> None:
    """List the bundled problems."""
    with answering(form):
        from synergrip.files import bundled
        from synergrip.problems.finding import bundled_problems
        from synergrip.problems.problem_file import read_problem_file
        from synergrip.reports.text.tables import table

        rows = []
        for name in bundled_problems():
            file, _ = read_problem_file(bundled("problems") / f"{name}.toml")
            verdict = (file.expect.verdict if file.expect else None) or ""
            rows.append((name, verdict, file.title))
        keys = ("name", "expected", "title")
        show(form, lambda: table(keys, rows), lambda: {"problems": [dict(zip(keys, r, strict=True)) for r in rows]})


def hands(
    which: Annotated[
        str | None,
        typer.Argument(metavar="HAND", help="One hand (bundled name, folder, .urdf, .xml, .mjcf), with its pads."),
    ] = None,
    posture: Annotated[
        str | None,
        typer.Option(
            "--posture",
            metavar="P",
            help="Posture of that hand: a name, or values such as '{ joint = \"60 deg\" }'; at rest when absent.",
        ),
    ] = None,
    picture: PictureOption = None,
    form: FormatOption = Format.TEXT,
) -> None:
    """List the bundled hands; or tell of one where its pads and fingertips are in a posture."""
    with answering(form):
        from synergrip.errors import InputError
        from synergrip.hands.folder import bundled_hands, load_hand

        picture_place(picture)
        if which is not None:
            return _one(load_hand(which, key="HAND"), posture, picture, form)
        for option, given in (("--posture", posture), ("--picture", picture)):
            if given is not None:
                raise InputError.at(option, "is for one hand; name it: synergrip hands HAND")
        loaded = [load_hand(name, relative_to=None) for name in bundled_hands()]
        show(form, lambda: "\n\n".join(_text(each) for each in loaded), lambda: {"hands": list(map(_names, loaded))})


def _one(hand: Hand, posture: str | None, picture: Path | None, form: Format) -> None:
    """Tell of one hand, in a posture."""
    from synergrip.hands.models.urdf_balls import balls_of
    from synergrip.hands.spots import spots_of
    from synergrip.problems.hand_table import posture_written
    from synergrip.reports.data.json_spots import posture_document
    from synergrip.reports.text.text_grasp import posture_lines
    from synergrip.reports.text.text_spots import balls_lines, spots_table
    from synergrip.reports.view.shown import hand_shown

    shown = hand_shown(hand, posture and posture_written(posture, "--posture"))
    spots, q = spots_of(hand, shown.begin.q), shown.begin.q
    balls = balls_of(hand.file, [spot.link for spot in spots if not spot.pad])
    round_ = {link: {"radius_m": ball.radius, "point_m": list(ball.point)} for link, ball in balls.items()}
    written = [*balls_lines(balls), *draw_shown(shown, picture)]
    show(
        form, lambda: "\n".join([_text(hand), "", *posture_lines(hand, q), "", spots_table(spots), *written]),
        lambda: _names(hand) | posture_document(hand, q, spots) | {"balls": round_}
        | ({"picture": str(picture)} if picture else {}),
    )  # fmt: skip


def _names(hand: Hand) -> dict[str, Any]:
    """Return the names that a problem file may use of a hand."""
    return {
        "name": hand.name, "title": hand.title, "joints": list(hand.joint_names),
        "synergy_sets": {s.name: list(s.synergies) for s in hand.synergy_sets.values()},
        "pads": list(hand.pads), "postures": list(hand.postures),
    }  # fmt: skip


def _text(hand: Hand) -> str:
    """Return a hand with all the names that a problem file may use of it."""
    from synergrip.reports.text.tables import wrapped

    sets = hand.synergy_sets.values()
    parts = {
        "joints": hand.joint_names,
        "synergy sets": [s.name if s.name == "joints" else f"{s.name} ({', '.join(s.synergies)})" for s in sets],
        "postures": hand.postures,
        "pads": hand.pads,
    }
    named = [line for key, names in parts.items() for line in wrapped(f"  {key:14}", ", ".join(names) or "none")]
    return "\n".join([*wrapped(f"{hand.name}  ", hand.title), *named])


def schema() -> None:
    """Print the JSON Schema of the problem file, for editors."""
    with answering(Format.TEXT):
        from synergrip.problems.problem_file import problem_schema

        say(json.dumps(problem_schema(), indent=2))


def docs(form: FormatOption = Format.TEXT) -> None:
    """Say where the documentation is, and list its pages."""
    with answering(form):
        from synergrip.files import bundled
        from synergrip.plain_file import read_text
        from synergrip.reports.text.tables import table

        start, folder = bundled("README.md"), bundled("docs")
        pages = {path: read_text(path, "page").partition("\n")[0].lstrip("# ") for path in sorted(folder.rglob("*.md"))}
        rows = [(str(path.relative_to(start.parent)), title) for path, title in pages.items()]
        show(
            form, lambda: f"Documentation: {start}\n\n{table(('page', 'about'), rows)}",
            lambda: {"documentation": str(start),
                     "pages": [{"file": str(path), "title": told} for path, told in pages.items()]},
        )  # fmt: skip
