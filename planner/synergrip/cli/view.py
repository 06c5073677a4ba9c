"""``synergrip view``: a hand, a problem or a plan in three dimensions, on a page for this machine alone."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from os.path import exists  # unlike that of Path, no error for a name that is too long
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from synergrip.cli.beside import tell
from synergrip.cli.loading import load_placed
from synergrip.cli.running import Format, SetOption, answering, as_interrupt, heard, say

if TYPE_CHECKING:
    from synergrip.reports.view.shown import Shown

LOOK = 0.04
"""[s] between two looks at the clock."""
Page = Callable[[Any], Callable[[float], None] | None]
"""Puts a page on a server, and returns what is to be done as time goes by."""


def view(
    what: Annotated[
        str,
        typer.Argument(
            metavar="HAND|PROBLEM|PLAN",
            help="A hand (bundled name, folder, .urdf, .xml, .mjcf), a problem (file or bundled name), or a saved "
            "answer (folder or plan.json).",
        ),
    ],
    posture: Annotated[
        str | None,
        typer.Option(
            "--posture",
            metavar="P",
            help="The posture with which a hand begins: a name, or values such as '{ joint = \"60 deg\" }'.",
        ),
    ] = None,
    overrides: SetOption = None,
    port: Annotated[int, typer.Option("--port", metavar="N", min=0, max=65535, help="First port to try.")] = 8080,
) -> None:
    """Pose a hand, look at a problem before it is planned, or play a plan, in a browser on this machine alone."""
    with answering(Format.TEXT):
        from synergrip.reports.libraries import refuse_without
        from synergrip.reports.view.serving import serving

        refuse_without({"viser": "viser"}, "view")
        page = _page(what, posture, overrides or [])
        with heard(), _heard_to_the_end(), serving(port) as server:
            try:
                as_time_goes = page(server)
                say(f"view     http://{server.get_host()}:{server.get_port()}  (this machine alone; Ctrl-C ends)")
                while True:
                    time.sleep(LOOK)
                    if as_time_goes is not None:
                        as_time_goes(time.monotonic())
            except KeyboardInterrupt:
                pass
        say("closed")


@contextmanager
def _heard_to_the_end() -> Iterator[None]:
    """Let what ends a program from outside end the view as Ctrl-C does, with its last word."""
    if signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL:  # whoever handles it has a reason
        yield
        return
    with as_interrupt(signal.SIGTERM):
        yield


def _page(what: str, posture: str | None, overrides: list[str]) -> Page:
    """Return what is to be seen, by what its name is the name of."""
    from synergrip.errors import InputError, suggest
    from synergrip.hands.folder import bundled_hands
    from synergrip.hands.hand_file import FILE
    from synergrip.hands.models.model_file import SUFFIXES
    from synergrip.problems.finding import bundled_problems
    from synergrip.reports.html.saved_answer import saved_file

    path, names = Path(what), (*bundled_hands(), *bundled_problems())
    if what not in names and not path.suffix and not exists(path):
        said = f"no such file, and no such bundled hand or problem: '{what}'{suggest(what, names)}"
        raise InputError.at("HAND|PROBLEM|PLAN", f"{said}; `synergrip hands` and `synergrip problems` list them")
    file = saved_file(path)
    a_hand = what in bundled_hands() or path.suffix.lower() in SUFFIXES or path.name == FILE or path.is_dir()
    if posture is not None and (file is not None or not a_hand):
        raise InputError.at("--posture", "is for a hand; a problem says its own, and a plan moves")
    if overrides and (file is not None or a_hand):
        raise InputError.at("--set", "overrides keys of a problem; a hand and a plan have none")
    if file is not None:
        return _plan(file)
    return _hand(what, posture) if a_hand else _problem(what, overrides)


def _hand(what: str, posture: str | None) -> Page:
    from synergrip.hands.folder import load_hand
    from synergrip.problems.hand_table import posture_written
    from synergrip.reports.view.shown import hand_shown

    return _posed(hand_shown(load_hand(what, key="HAND"), posture and posture_written(posture, "--posture")))


def _problem(name: str, overrides: list[str]) -> Page:
    """Return the page of a problem; what its contacts lack is told, and shown with it."""
    from synergrip.errors import InputError
    from synergrip.problems.unplaced import unplaced_problem
    from synergrip.reports.view.shown import problem_shown, reasons

    asked = unplaced_problem(name, overrides)
    refused, held = list[str](), None
    try:
        held = load_placed(name, overrides).held
    except InputError as error:
        refused = reasons(error)
        for line in refused:
            tell(f"note     {line}")
    return _posed(problem_shown(asked.asked, held, asked.file.task.gravity, refused))


def _posed(shown: Shown) -> Page:
    def page(server: Any) -> None:
        from synergrip.reports.view.panel import Panel

        Panel(
            server, shown.posed, shown.begin, sets=shown.sets, closed=shown.closed, title=shown.title, notes=shown.notes
        )

    return page


def _plan(file: Path) -> Page:
    from synergrip.reports.html.saved_answer import read_answer, shown
    from synergrip.reports.view.planned import scene_of

    document, _ = read_answer(file)
    with shown(file):
        scene = scene_of(document, file.parent)
        notes = [document["title"], f"verdict: {document['verdict']}"]

    def page(server: Any) -> Callable[[float], None]:
        from synergrip.reports.view.player import Player

        return Player(server, scene, notes).tick

    return page
