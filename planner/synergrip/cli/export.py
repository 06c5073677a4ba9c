"""``synergrip export``: a saved plan in the formats of other programs."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from synergrip.cli import ending
from synergrip.cli.running import Format, FormatOption, answering, possible, show, writing
from synergrip.errors import InputError

FORMATS = "csv, npz, parquet, ros2-yaml, mcap, isaac_grasp, moveit_grasp, mjcf"


def export(
    plan: Annotated[Path, typer.Argument(metavar="PLAN", help="The folder of a saved plan, or its plan.json.")],
    to: Annotated[list[str], typer.Option("--to", metavar="FORMAT", help=f"{FORMATS}; may be given several times.")],
    form: FormatOption = Format.TEXT,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="DIR", help="Where to write; else PLAN/export.")
    ] = None,
) -> None:
    """Write a saved plan for other programs: on a hand the equilibria that it really comes to, at the knots."""
    with answering(form):
        from synergrip.reports.data.exports.exported_plan import exported_plan, folder_of
        from synergrip.reports.data.exports.exporting import formats_of, refuse_export_place, write_exports
        from synergrip.reports.data.exports.told import export_document, export_text, left_empty

        with _of_options():
            chosen, folder = formats_of(to), output or folder_of(plan)
            read = exported_plan(plan)
            possible("--output", folder, lambda place: refuse_export_place(place, chosen))
            with writing("--output", folder):
                found = write_exports(read, folder, chosen)
        ending.keep(*(file for each in found for file in each.files))
        for line in left_empty(read, found):
            print(line, file=sys.stderr, flush=True)
        show(form, lambda: export_text(read, found), lambda: export_document(read, found))


@contextmanager
def _of_options() -> Iterator[None]:
    """Let errors name the option where the library names its argument."""
    try:
        yield
    except InputError as error:
        raise error.located(lambda issue: replace(issue, key="--to") if issue.key == "to" else issue) from None
