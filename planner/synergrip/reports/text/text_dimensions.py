"""The dimensions for the first K synergies, as a table for people and as a document."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from synergrip.reports.text.tables import table, wrapped
from synergrip.statics.dimensions import DimensionColumn, Dimensions

_NAMES = ("E_s", "Γ_ucs", "Γ_zr")


def dimensions_text(columns: Sequence[DimensionColumn], synergies: Sequence[str]) -> str:
    """Return one line for each K with the dimensions of every column, and what is to be said of them."""
    header = [
        "K",
        "adds",
        *(f"{column.kind}: {name}" if i == 0 else name for column in columns for i, name in enumerate(_NAMES)),
    ]
    lines = ["dimensions with the first K synergies; every contact taken as hard, then as soft"]
    if any(column.rows for column in columns):
        rows = [
            [str(k + 1), name, *(cell for column in columns for cell in _cells(column, k))]
            for k, name in enumerate(synergies)
        ]
        lines += [table(header, rows, right=(0, *range(2, len(header)))), "Every row sums to K (34)."]
    if any(row.ambiguous for column in columns for row in column.rows):
        lines.append(
            "? ambiguous: a singular value is in the grey zone, where a small change of the data could turn it"
        )
    for column in columns:
        if column.reason:
            lines += wrapped(f"{column.kind}  ", column.reason)
        if column.free:
            lines += wrapped(f"{column.kind}  ", f"{column.free}; the dimensions are those of the rest of its motion")
    return "\n".join(lines)


def _cells(column: DimensionColumn, k: int) -> tuple[str, str, str]:
    if not column.rows:
        return "-", "-", "-"
    row = column.rows[k]
    return str(row.E_s), str(row.Gamma_ucs), f"{row.Gamma_zr}{'?' if row.ambiguous else ''}"


def dimensions_document(columns: Sequence[DimensionColumn], n_z: int) -> list[dict[str, Any]]:
    """Return one entry for each K up to `n_z`: for each kind of contact its dimensions, or null."""
    return [{"n_z": k + 1, **{column.kind: _entry(column, k) for column in columns}} for k in range(n_z)]


def _entry(column: DimensionColumn, k: int) -> dict[str, Any] | None:
    if not column.rows:
        return None
    row: Dimensions = column.rows[k]
    return {
        "dim_E_s": row.E_s,
        "dim_Gamma_ucs": row.Gamma_ucs,
        "dim_Gamma_zr": row.Gamma_zr,
        "ambiguous": row.ambiguous,
    }
