"""``synergrip report``: the page of an answer that was written before."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from synergrip.cli import ending
from synergrip.cli.running import Format, FormatOption, answering, possible, show, writing


def report(
    plan: Annotated[Path, typer.Argument(metavar="PLAN", help="The folder of a saved answer, or its plan.json.")],
    form: FormatOption = Format.TEXT,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="The page (default report.html beside it).")
    ] = None,
) -> None:
    """Write the report of a saved answer: one HTML file with playback, charts and tables that opens offline."""
    with answering(form):
        from synergrip.files import refuse_unwritable
        from synergrip.planning.references import plan_file
        from synergrip.reports.data.plan_files import REPORT
        from synergrip.reports.html import page
        from synergrip.reports.html.saved_answer import read_answer, shown

        page.refuse_without_libraries()
        file = plan_file(plan)
        document, csv = read_answer(file)
        place = output or file.parent / REPORT
        possible("--output", place, refuse_unwritable)
        with shown(file), writing("--output", place):
            page.write_report(place, document, csv, file.parent, file.parent)
        ending.keep(place)
        told: dict[str, Any] = {"report": str(place), "verdict": document["verdict"], "exit_code": 0}
        show(form, lambda: f"wrote {place}", lambda: told)
