"""``synergrip validate``: is the file in order?"""

from __future__ import annotations

from synergrip.cli.running import Format, FormatOption, ProblemArgument, SetOption, answering, show


def validate(problem: ProblemArgument, form: FormatOption = Format.TEXT, overrides: SetOption = None) -> None:
    """Check a problem file and everything it names, without solving anything."""
    with answering(form):
        from synergrip.plans.problem import load_problem
        from synergrip.reports.text_problem import many

        loaded = load_problem(problem, overrides or [])
        grasp = loaded.grasp
        counts = {"contact": grasp.n_c, "joint": grasp.n_q, "synergy": grasp.n_z, "knot": len(loaded.task.times)}
        text = f"{loaded.path}: in order ({', '.join(many(count, noun) for noun, count in counts.items())})"
        show(form, lambda: text, lambda: {"valid": True, "file": str(loaded.path), "title": loaded.title})
