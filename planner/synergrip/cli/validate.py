"""``synergrip validate``: is the file in order?"""

from __future__ import annotations

from synergrip.cli.loading import load_placed
from synergrip.cli.running import Format, FormatOption, ProblemArgument, SetOption, answering, show


def validate(problem: ProblemArgument, form: FormatOption = Format.TEXT, overrides: SetOption = None) -> None:
    """Check a problem file and everything it names, without solving anything; show posture and contacts."""
    with answering(form):
        from synergrip.reports.data.json_grasp import in_order_document
        from synergrip.reports.text.text_grasp import in_order_text

        loaded = load_placed(problem, overrides)
        show(form, lambda: in_order_text(loaded), lambda: in_order_document(loaded))
