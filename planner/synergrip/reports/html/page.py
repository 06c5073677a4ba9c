"""The report of an answer: one file (HTML) that opens in a browser without a network.

It is made from the document of the answer (plan.json), the hand file that this names, and what a simulation and the
margins of this very plan have written beside it, so that the report of a saved answer is that of a new one. What comes
from the user is escaped by the template.
"""

from __future__ import annotations

import gzip
from base64 import b64encode
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.batch.placed_object import FOUND
from synergrip.documents.quantities import read_as
from synergrip.files import atomic_path
from synergrip.linalg import Array
from synergrip.reports.data.margins_files import FILE as MARGINS
from synergrip.reports.data.plan_files import to_json
from synergrip.reports.data.saved_margins import KnownMargins, saved_margins
from synergrip.reports.html.charts import charts_of
from synergrip.reports.html.margins import margins_of
from synergrip.reports.html.physics import physics_of
from synergrip.reports.html.playback import playback_of
from synergrip.reports.html.synergies import synergies_of
from synergrip.reports.html.tables import in_order, tables_of, usage_told
from synergrip.reports.html.why import headline_of, missing_of, why_of
from synergrip.reports.libraries import refuse_without
from synergrip.reports.pictures.lines import lines_of
from synergrip.reports.text.text_usages import as_little, worst_of

LIBRARIES = {"jinja2": "Jinja2", "viser": "viser"}
"""What it takes beside synergrip itself: how it is imported, and how it is called."""


def write_report(
    path: Path, document: Mapping[str, Any], csv: str = "", folder: Path | None = None, beside: Path | None = None,
    margins: KnownMargins | None = None,
) -> None:  # fmt: skip
    """Write the report of an answer, whole or not at all.

    Args:
        path: of the file.
        document: of the answer, as in plan.json.
        csv: of the plan, as in plan.csv, to be downloaded.
        folder: of plan.json, where the hand file is looked for when it is not a bundled one; None where nobody knows.
        beside: folder in which a simulation and the margins of the plan are looked for, if any.
        margins: of this very plan, where they are at hand.

    Raises:
        InputError: Jinja or viser is not installed, or the hand file has changed.
        OSError: it cannot be written.
    """
    text = report_text(document, csv, folder, beside, margins)
    with atomic_path(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def refuse_without_libraries() -> None:
    """Raise an `InputError` where a library that the report needs is not installed, before anything is planned."""
    refuse_without(LIBRARIES, "report")


def report_text(
    document: Mapping[str, Any], csv: str = "", folder: Path | None = None, beside: Path | None = None,
    margins: KnownMargins | None = None,
) -> str:  # fmt: skip
    """Return the report of an answer as `write_report` writes it."""
    refuse_without_libraries()
    playback = playback_of(document, folder or Path())
    end = float(document["time_s"][-1])
    charts = charts_of(_known_times(document), lines_of(document), missing_of(document), end)
    found = margins if margins is not None or beside is None else saved_margins(beside, document)
    tables = in_order([
        *tables_of(document), *synergies_of(document), margins_of(document, found, folder),
        *physics_of(document, beside, folder),
    ])  # fmt: skip
    no = why_of(document)
    proven = document.get("provenance") or {}
    problem, overrides = proven.get("problem") or {}, proven.get("overrides") or ()
    contents = [("why", "Why not")] * (no is not None) + [("playback", "Playback")] * bool(charts or playback)
    contents += [(table.anchor, table.title) for table in tables] + [("inputs", "Inputs"), ("downloads", "Downloads")]
    files = {"plan.json": to_json(dict(document)), "plan.csv": csv}
    if isinstance(found, KnownMargins):
        files[MARGINS] = to_json(dict(found.document))
    return str(
        _template().render(
            title=document["title"], under=_under(document), asked=" · ".join(document.get("asked") or ()),
            verdict=document["verdict"],
            headline=_headline(document), contents=contents, no=no, playback=playback, charts=charts,
            tables=tables, overrides=[each for each in overrides if not each.endswith(FOUND)],
            found=[each.removesuffix(FOUND) for each in overrides if each.endswith(FOUND)], inputs=_inputs(problem),
            files=[{"name": name, "packed": _packed(text)} for name, text in files.items() if text],
        )
    )  # fmt: skip


def _known_times(document: Mapping[str, Any]) -> Array:
    """Return the knots at which something is known [s]: of a motion that is not reached the first ones."""
    true = document.get("true") or {}
    return np.array(true.get("time_s") or document["time_s"])


def _template() -> Any:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    rooms = Environment(
        loader=PackageLoader("synergrip.reports.html", ""), autoescape=True, undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    rooms.filters["typed"] = _typed
    return rooms.get_template("report.html.jinja")


def _typed(sentence: str) -> Any:
    """Return a sentence, escaped, in which what stands between backquotes is set as what is typed."""
    from markupsafe import Markup, escape

    parts = sentence.split("`")
    if len(parts) % 2 == 0:
        return escape(sentence)
    return Markup("").join(
        Markup("<code>{}</code>").format(part) if k % 2 else escape(part) for k, part in enumerate(parts)
    )


def _under(document: Mapping[str, Any]) -> str:
    """Return from what, by what and how finely the answer was made."""
    proven, times = document.get("provenance") or {}, document["time_s"]
    problem = proven.get("problem") or {}
    parts = [str(problem.get("name") or "made in code")]
    if problem.get("sha256"):
        parts.append(f"sha256 {problem['sha256'][:12]}…")
    parts += [f"synergrip {proven.get('version', '')}", str(proven.get("solver") or "")]
    parts.append(f"{len(times)} knot{'s' * (len(times) != 1)}, {times[-1] - times[0]:.4g} s")
    return " · ".join(part for part in parts if part.strip())


def _headline(document: Mapping[str, Any]) -> list[str]:
    """Return what stands beside the verdict."""
    if document["verdict"] != "feasible":
        return headline_of(document)
    margin, told = document["margin"], []
    asked = next((each["lower"] for each in document["limits"] if each["name"] == "slip margin"), None)
    wanted = f" (asked: {read_as(asked, 'N')} or more)" if asked is not None else ""
    told.append(
        f"least slip margin {margin['worst_N']:.4g} N at {margin['contact']}, t = {margin['time_s']:.3g} s"
        f"{as_little(np.array(margin['per_contact_N']))}{wanted}"
    )
    if document.get("allowances"):
        least = read_as(document["allowances"]["worst_N"], "N")
        told.append(f"{least} in the worst case of all that is allowed for")
    rows = (row for each in document["limits"] for row in worst_of(usage_told(each, document)))
    named = [row for row in rows if row[0] in ("largest normal force", "joint torque")]
    return told + [f"{title} {shown.lstrip('-')} at {item}" for title, shown, item, *_ in named]


def _inputs(problem: Mapping[str, Any]) -> str:
    if problem.get("text"):
        return str(problem["text"])
    return to_json(problem["dict"]) if problem.get("dict") else "made in code: there is no problem file"


def _packed(text: str) -> str:
    return b64encode(gzip.compress(text.encode("utf-8"), mtime=0)).decode("ascii")
