"""``synergrip analyse``: Theorem 1 accounting of a grasp."""

from __future__ import annotations

import typer

from synergrip.cli.running import Format, FormatOption, ProblemArgument, SetOption, answering, color, show


def analyse(problem: ProblemArgument, form: FormatOption = Format.TEXT, overrides: SetOption = None) -> None:
    """Show what the synergies control: internal forces, rigid motions, redundancy. Nothing is optimised."""
    code = 0
    with answering(form):
        from synergrip.errors import NotRestrainedError, SynergripError
        from synergrip.plans.analysis import analyse as work_out
        from synergrip.plans.problem import load_problem, located
        from synergrip.reports.json_analysis import analysis_document, unrestrained_document
        from synergrip.reports.text_analysis import analysis_text
        from synergrip.reports.text_check import refused_text

        loaded = load_problem(problem, overrides or [])
        try:
            analysis = work_out(loaded.grasp, loaded.task.wrench)
            show(form, lambda: analysis_text(loaded, analysis, color()), lambda: analysis_document(analysis))
        except NotRestrainedError as error:
            refusal, code = error, error.exit_code
            document = unrestrained_document(loaded.grasp, refusal)
            show(form, lambda: refused_text(loaded, refusal, color()), lambda: document)
        except SynergripError as error:
            raise located(loaded, error) from None
    raise typer.Exit(code)
