"""The verbs, listed. A new verb is one file and one line here."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import typer
from typer.core import TyperGroup

from synergrip import __version__
from synergrip.cli.analyse import analyse
from synergrip.cli.check import check
from synergrip.cli.explain import explain
from synergrip.cli.export import export
from synergrip.cli.figure import figure
from synergrip.cli.front import front
from synergrip.cli.lists import docs, hands, problems, schema
from synergrip.cli.margins import margins
from synergrip.cli.plan import plan
from synergrip.cli.report import report
from synergrip.cli.simulate import simulate
from synergrip.cli.synergies import synergies
from synergrip.cli.validate import validate
from synergrip.cli.view import view
from synergrip.files import bundled


class _Documented(TyperGroup):
    """The verbs; their help ends with the place of the documentation, on a line that no width of a screen splits."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Print the help, or write it into the formatter, and then where more is to be read."""
        super().format_help(ctx, formatter)
        (formatter.write if formatter.getvalue() else typer.echo)(f" Documentation: {bundled('README.md')}")


VERBS = (
    plan,
    report,
    view,
    explain,
    margins,
    simulate,
    export,
    figure,
    front,
    analyse,
    check,
    validate,
    problems,
    hands,
    schema,
    docs,
)


def _version(asked: bool) -> None:
    if asked:
        print(f"synergrip {__version__}")
        raise typer.Exit


def options(
    version: bool = typer.Option(False, "--version", callback=_version, is_eager=True, help="Print the version."),
) -> None:
    """Plans grasp forces and in-hand motion for robot hands driven by postural synergies, and proves its answers."""


def _app(verbs: Iterable[Callable[..., None]], groups: Mapping[str, typer.Typer]) -> typer.Typer:
    made = typer.Typer(
        name="synergrip",
        cls=_Documented,
        help="Plans grasp forces and in-hand motion for robot hands driven by postural synergies, and proves its "
        "answers.",
        epilog="Exit codes: 0 feasible and verified, 1 proven infeasible, 2 bad input, 3 unknown, 4 own check failed, "
        "5 the answer could not be printed or written, 130 interrupted.",
        no_args_is_help=True,
        add_completion=False,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    made.callback()(options)
    for verb in verbs:
        made.command()(verb)
    for name, group in groups.items():
        made.add_typer(group, name=name)
    return made


app = _app(VERBS, {"synergies": synergies})


def app_for(words: Sequence[str]) -> typer.Typer:
    """Return the command line as far as some words need it: what they do not ask for need not be got ready."""
    return next((_app((verb,), {}) for verb in VERBS if words[:1] == [verb.__name__]), app)
