"""What the verbs share: options, the answer on standard output, errors with their exit codes."""

from __future__ import annotations

import json
import signal
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer

from synergrip.cli import beside, ending
from synergrip.cli.streams import PrintError, colored, columns
from synergrip.errors import InputError, InterruptError, OutputError, SelfCheckError, SynergripError

if TYPE_CHECKING:
    from synergrip.planning.outcome import Infeasible, Unknown
    from synergrip.problems.problem import Problem


class Format(StrEnum):
    """How an answer is printed."""

    TEXT = "text"
    JSON = "json"


FormatOption = Annotated[Format, typer.Option("--format", help="How to print: text, or one JSON document.")]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help='Override a key of the problem, e.g. --set "limits.margin=0.3 N".'),
]
DetailsOption = Annotated[
    bool, typer.Option("-v", "--verbose", help="Show every program that was solved and every check with its error.")
]
ProblemArgument = Annotated[
    str, typer.Argument(metavar="PROBLEM", help="A problem file, or the name of a bundled problem.")
]


@contextmanager
def answering(form: Format) -> Iterator[None]:
    """Turn errors into their text or document and their exit code; an interrupt into 130, a defect into 4."""
    ending.begin(_interrupted if form is Format.JSON else None)
    beside.begin()
    try:
        yield
    except SynergripError as error:
        _print_error(error, form)
        raise typer.Exit(error.exit_code) from None
    except KeyboardInterrupt as interrupt:
        come = f"{interrupt}; " if str(interrupt) else ""  # how far it had come, where the library knows
        _print_error(InterruptError(f"interrupted; {come}{ending.standing()}"), form)
        raise typer.Exit(InterruptError.exit_code) from None
    except (typer.Exit, typer.Abort):
        raise
    except Exception as defect:  # must not leave with 1, which would say "proven infeasible"
        if _of_an_interrupt(defect):
            _print_error(InterruptError(f"interrupted; {ending.standing()}"), form)
            raise typer.Exit(InterruptError.exit_code) from None
        traceback.print_exc()
        message = f"{type(defect).__name__}: {defect}; this is a defect of synergrip, please report it with the problem"
        _print_error(SelfCheckError(message), form)
        raise typer.Exit(SelfCheckError.exit_code) from None


@contextmanager
def heard() -> Iterator[None]:
    """Let an interrupt be a KeyboardInterrupt in this block, for those who keep what is finished.

    Elsewhere the command line leaves at once. A program that handles signals itself is left alone.
    """
    outside = signal.getsignal(signal.SIGINT)
    if not ending.watching() or outside == signal.SIG_IGN:
        yield
        return
    with as_interrupt(signal.SIGINT):
        yield


@contextmanager
def as_interrupt(number: signal.Signals) -> Iterator[None]:
    """Let a signal be a KeyboardInterrupt in this block, whoever hears it outside."""
    outside = signal.signal(number, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(number, outside)


@contextmanager
def placed(problem: Problem) -> Iterator[None]:
    """Let an error of what is asked say where its key stands in the problem file."""
    from synergrip.problems.problem import located

    try:
        yield
    except SynergripError as error:
        raise located(problem, error) from None


def end_without_plan(form: Format, problem: Problem, outcome: Infeasible | Unknown) -> NoReturn:
    """Print why there is no plan, and leave with the exit code that says so."""
    from synergrip.reports.data.json_plan import outcome_document
    from synergrip.reports.text.text_plan import verdict_lines

    document = outcome_document(problem.title, problem.grasp, outcome, problem.notes, problem.source)
    show(form, lambda: "\n".join(verdict_lines(problem, outcome, color())), lambda: document)
    raise typer.Exit(outcome.exit_code)


@contextmanager
def writing(option: str, path: Path) -> Iterator[None]:
    """Turn what the file system refuses into an error at an option."""
    try:
        yield
    except OSError as error:
        raise OutputError(_unwritable(path, error), option) from None


def possible(option: str, path: Path, refuse: Callable[[Path], None]) -> None:
    """Refuse a place where nothing can be written, which `refuse` finds, before anything is solved.

    Raises:
        InputError: no file can have that name.
        OutputError: it could, but not now.
    """
    from synergrip.files import IMPOSSIBLE

    try:
        refuse(path)
    except OSError as error:
        if error.errno in IMPOSSIBLE:
            raise InputError.at(option, _unwritable(path, error)) from None
        raise OutputError(_unwritable(path, error), option) from None


@contextmanager
def shown_anyway(form: Format, text: Callable[[], str], document: Callable[[], dict[str, Any]]) -> Iterator[None]:
    """Print an answer also when it cannot be written; in JSON beside the error."""
    try:
        yield
    except OutputError as error:
        if form is Format.JSON:
            say(json.dumps(_plain(error) | {"answer": document()}, allow_nan=False))
        else:
            say(_fitting(text))
            _print_error(error, form)
        raise typer.Exit(error.exit_code) from None


def refuse_with(form: Format, error: InputError, text: Callable[[], str], more: dict[str, Any]) -> NoReturn:
    """Leave with an error of the file, and what is known all the same: before it, or beside it in its document."""
    if form is Format.TEXT:
        say(_fitting(text))
        raise error
    from synergrip.reports.text.refusal_text import error_json

    say(json.dumps(error_json(error) | more, allow_nan=False))
    raise typer.Exit(error.exit_code)


def _unwritable(path: Path, error: OSError) -> str:
    return f"cannot write '{path}': {error.strerror or error}"


def picture_place(picture: Path | None) -> None:
    """Refuse a picture whose suffix says no format, or that cannot be written, before anything is done."""
    if picture is not None:
        from synergrip.files import refuse_unwritable
        from synergrip.reports.pictures.sheet import picture_suffix

        picture_suffix(picture, "--picture")
        possible("--picture", picture, refuse_unwritable)


def draw_at(picture: Path, draw: Callable[[Path], object]) -> None:
    """Draw a picture, and keep it whatever ends the program after that."""
    with writing("--picture", picture):
        draw(picture)
    ending.keep(picture)


def show(form: Format, text: Callable[[], str], document: Callable[[], dict[str, Any]]) -> None:
    """Print the answer, as text that fits where it is shown or as one JSON document, on standard output."""
    say(json.dumps(_noted(document()), allow_nan=False) if form is Format.JSON else _fitting(text))


def _noted(document: dict[str, Any]) -> dict[str, Any]:
    """Return the document with what would be told beside a text."""
    more = beside.notes()
    return document | {"notes": [*document.get("notes", ()), *more]} if more else document


def _fitting(text: Callable[[], str]) -> str:
    from synergrip.reports.text.screen import Screen, shown_on
    from synergrip.reports.text.tables import fitted

    with shown_on(Screen(columns(sys.stdout), color())):
        return fitted(text())


def say(text: str) -> None:
    """Print on standard output."""
    beside.over("")  # how far it is counts no longer
    ending.printing()
    print(text, flush=True)


def color() -> bool:
    """Return whether standard output wants colour."""
    return colored(sys.stdout)


def _print_error(error: SynergripError, form: Format) -> None:
    from synergrip.reports.text.refusal_text import error_json, error_text
    from synergrip.reports.text.screen import UNFOLDED, Screen, shown_on
    from synergrip.reports.text.tables import fitted

    if form is Format.JSON and not isinstance(error, PrintError):
        document = error_json(error) if isinstance(error, InputError) else _plain(error)
        say(json.dumps(document, allow_nan=False))
    else:
        with shown_on(Screen(columns(sys.stderr)) if sys.stderr.isatty() else UNFOLDED):
            said = error_text(error, colored(sys.stderr)) if isinstance(error, InputError) else _line(error)
            print(fitted(said) if sys.stderr.isatty() else said, file=sys.stderr)


def _line(error: SynergripError) -> str:
    """Return an error without a place in a file as text; one of output says what stands."""
    if isinstance(error, OutputError):
        key = f" {error.key}" if error.key else ""
        return f"error{key}: {error}\n\n{ending.standing()}      exit code {error.exit_code}"
    return str(error) if isinstance(error, InterruptError) else f"error: {error}"


def _plain(error: SynergripError) -> dict[str, Any]:
    place = {"file": None, "line": None, "column": None, "key": getattr(error, "key", None) or None}
    return {"error": {"type": type(error).__name__, "message": str(error), **place}}


def _interrupted(message: str) -> str:
    return json.dumps(_plain(InterruptError(message)))


def _of_an_interrupt(error: BaseException | None) -> bool:
    """Return whether an interrupt was turned into this error on its way, as some libraries do while they load."""
    return error is not None and (
        isinstance(error, KeyboardInterrupt) or _of_an_interrupt(error.__cause__ or error.__context__)
    )
