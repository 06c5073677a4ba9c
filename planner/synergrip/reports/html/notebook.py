"""A plan as a notebook shows it: verdict, the worst of every limit, and the slip margins over time."""

from __future__ import annotations

from html import escape

from synergrip.documents.quantities import plain, read_as
from synergrip.errors import shortened
from synergrip.planning.outcome import Plan
from synergrip.problems.in_short import many
from synergrip.reports.html.charts import charts_of
from synergrip.reports.pictures.lines import plan_lines
from synergrip.reports.text.text_usages import WITHIN, as_little, worst_of

HEAD = ("limit", "worst", "where", "when", "bound")
WIDE = "max-width: 34em"


def plan_html(plan: Plan) -> str:
    """Return a plan as HTML; what comes from the user is escaped, nothing is fetched."""
    times, worst = plan.time, plan.usages[0]
    k, i = worst.worst()
    span = f" over {plain(times[-1] - times[0])} s" if len(times) > 1 else ""
    told = ", ".join(many(*each) for each in ((plan.grasp.n_z, "synergy"), (plan.grasp.n_c, "contact"),
                                             (len(times), "knot")))  # fmt: skip
    least = f"least slip margin {read_as(float(worst.value[k, i]), 'N')} at {_short(worst.items[i])}"
    when = f"t = {worst.times[k]:.3g} s{as_little(worst.value)}"
    shown = f"<p><b>{escape(plan.verdict)}</b>: {escape(least)}, {when} · {escape(told + span)}</p>"
    chart = charts_of(times, plan_lines(plan)[:1])[0].svg
    return f'{shown}{_table(plan)}<div style="{WIDE}">{chart}</div>'


def _table(plan: Plan) -> str:
    """Return the value of every limit that is nearest to its bound, on each side that is bounded by itself."""
    each = (row for usage in plan.usages for row in worst_of(usage, mark=WITHIN))
    rows = [(title, shown, _short(item), f"{time:.3g} s", bound) for title, shown, item, time, bound in each]
    head = "".join(f"<th>{cell}</th>" for cell in HEAD)
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table><tr>{head}</tr>{body}</table>"


def _short(item: object) -> str:
    return shortened(str(item))
