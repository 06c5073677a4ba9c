"""What the verbs share: options, the answer on standard output, errors with their exit codes."""

from __future__ import annotations

import json
import os
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer

from synergrip.errors import InputError, InterruptError, SelfCheckError, SynergripError


class Format(StrEnum):
    """How an answer is printed."""

    TEXT = "text"
    JSON = "json"


FormatOption = Annotated[Format, typer.Option("--format", help="How to print: text, or one JSON document.")]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help='Override a key of the problem, e.g. --set "limits.margin=0.3 N".'),
]
ProblemArgument = Annotated[
    str, typer.Argument(metavar="PROBLEM", help="A problem file, or the name of a bundled problem.")
]


@contextmanager
def answering(form: Format) -> Iterator[None]:
    """Turn errors into their text or document and their exit code; an interrupt into 130, a defect into 4."""
    try:
        yield
    except SynergripError as error:
        _print_error(error, form)
        raise typer.Exit(error.exit_code) from None
    except KeyboardInterrupt:
        _print_error(InterruptError("interrupted; nothing was half-written"), form)
        raise typer.Exit(130) from None
    except (typer.Exit, typer.Abort):
        raise
    except Exception as defect:  # must not leave with 1, which would say "proven infeasible"
        traceback.print_exc()
        message = f"{type(defect).__name__}: {defect}; this is a defect of synergrip, please report it with the problem"
        _print_error(SelfCheckError(message), form)
        raise typer.Exit(SelfCheckError.exit_code) from None


@contextmanager
def writing(option: str, path: Path) -> Iterator[None]:
    """Turn what the file system refuses into bad input at an option."""
    try:
        yield
    except OSError as error:
        raise InputError.at(option, f"cannot write '{path}': {error.strerror or error}") from None


def picture_format(picture: Path | None) -> None:
    """Refuse a picture whose suffix says no format before anything is done."""
    if picture is not None:
        from synergrip.reports.pictures.sheet import picture_suffix

        picture_suffix(picture, "--picture")


def show(form: Format, text: Callable[[], str], document: Callable[[], dict[str, Any]]) -> None:
    """Print the answer, as text or as one JSON document, on standard output."""
    say(json.dumps(document(), allow_nan=False) if form is Format.JSON else text())


def say(text: str) -> None:
    """Print on standard output; a reader who has gone (``| head``) changes nothing about the exit code."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def color() -> bool:
    """Return whether standard output wants colour."""
    return sys.stdout.isatty() and "NO_COLOR" not in os.environ


def _print_error(error: SynergripError, form: Format) -> None:
    from synergrip.reports.refusal_text import error_json, error_text

    if form is Format.JSON:
        document = error_json(error) if isinstance(error, InputError) else _plain(error)
        say(json.dumps(document, allow_nan=False))
    else:
        wants = sys.stderr.isatty() and "NO_COLOR" not in os.environ
        text = error_text(error, wants) if isinstance(error, InputError) else f"error: {error}"
        print(text, file=sys.stderr)


def _plain(error: SynergripError) -> dict[str, Any]:
    place = {"file": None, "line": None, "column": None, "key": None}
    return {"error": {"type": type(error).__name__, "message": str(error), **place}}
