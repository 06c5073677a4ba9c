"""``synergrip check``: judge a plan, from here or from elsewhere."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from synergrip.cli.loading import load_placed
from synergrip.cli.running import (
    DetailsOption,
    Format,
    FormatOption,
    ProblemArgument,
    SetOption,
    answering,
    color,
    placed,
    show,
)


def check(
    plan: Annotated[Path, typer.Argument(metavar="PLAN", help="A plan folder, .json, .npz, or CSV with t_s,zr_...")],
    problem: ProblemArgument,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
    details: DetailsOption = False,
) -> None:
    """Judge a plan against a problem without optimising: equilibrium, cones, limits, tracking."""
    with answering(form):
        from synergrip.errors import Refusal
        from synergrip.planning.references import read_references

        loaded = load_placed(problem, overrides)
        references = read_references(plan, loaded.grasp)  # what is wrong with files is told before the slow imports

        from synergrip.planning.check import judge_references
        from synergrip.reports.data.json_analysis import refused_document
        from synergrip.reports.text.text_check import judgement_document, judgement_text, refused_text

        with placed(loaded):
            try:
                judgement = judge_references(loaded.grasp, loaded.timed, references)
                code = judgement.exit_code
                show(
                    form,
                    lambda: judgement_text(loaded, judgement, color(), details=details),
                    lambda: judgement_document(judgement),
                )
            except Refusal as error:
                refusal, code = error, error.exit_code
                show(form, lambda: refused_text(loaded, refusal, color()), lambda: refused_document(refusal))
    raise typer.Exit(code)
