"""An exported plan as a table, a row for each knot: csv, npz, parquet."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.reports.data.exports.exported_plan import ExportedPlan
from synergrip.reports.data.exports.quantities import header, quantities


def write_csv(plan: ExportedPlan, path: Path) -> None:
    """Write a CSV file with one header line. Names say units, and what is true begins with ``true_``."""
    found, stream = quantities(plan), io.StringIO()
    csv.writer(stream, lineterminator="\n").writerow(header(found))
    table = np.column_stack([plan.times, *(each.values for each in found)])
    np.savetxt(stream, table, fmt="%.17g", delimiter=",")
    path.write_text(stream.getvalue(), encoding="utf-8")


def write_npz(plan: ExportedPlan, path: Path) -> None:
    """Write an archive of plain arrays: ``time_s``, of each quantity ``KEY_UNIT`` (T, m) and ``KEY_UNIT_names``."""
    arrays: dict[str, Any] = {"time_s": plan.times, "about": np.array(json.dumps(plan.about))}
    for each in quantities(plan):
        for key, names, values in each.by_unit():
            arrays |= {key: values, f"{key}_names": np.array(names)}
    with path.open("wb") as stream:
        np.savez(stream, **arrays)


def write_parquet(plan: ExportedPlan, path: Path) -> None:
    """Write a Parquet file with the columns of the CSV file, each with its meaning; where it comes from in `about`."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    fields, columns = [pa.field("t_s", pa.float64(), False, {"meaning": "time of the knot"})], [plan.times]
    for each in quantities(plan):
        named = zip(each.columns, each.names, each.units, strict=True)
        fields += [
            pa.field(column, pa.float64(), False, {"meaning": each.meaning, "of": name, "unit": unit})
            for column, name, unit in named
        ]
        columns += list(each.values.T)
    schema = pa.schema(fields, {"about": json.dumps(plan.about)})
    pq.write_table(pa.table([pa.array(column) for column in columns], schema=schema), path)
