"""``synergrip validate``: is the file in order?"""

from __future__ import annotations

from synergrip.cli.running import Format, FormatOption, ProblemArgument, SetOption, answering, show


def validate(problem: ProblemArgument, form: FormatOption = Format.TEXT, overrides: SetOption = None) -> None:
    """Check a problem file and everything it names, without solving anything."""
    with answering(form):
        from synergrip.plans.problem import load_problem

        loaded = load_problem(problem, overrides or [])
        grasp, knots = loaded.grasp, len(loaded.task.times)
        text = (
            f"{loaded.path}: in order ({grasp.n_c} contacts, {grasp.n_q} joints, {grasp.n_z} synergies, {knots} knots)"
        )
        show(form, lambda: text, lambda: {"valid": True, "file": str(loaded.path), "title": loaded.title})
