"""From arrays with a row of numbers for each problem into lanes, and back. Imported only where Numba is there."""

from __future__ import annotations

from typing import Any

from synergrip.batch.lanes import LANES, all_of, kept_apart, load_columns, store, store_columns
from synergrip.batch.lanes_algebra import compiled


@compiled
def rows_into_lanes(w: Any, entry: int, rows: Any, first: int, count: int, group: int, here: int) -> int:
    """Write numbers of the rows (N or 1, ...) of a group of eight, from the `first` on; return the next entry.

    Where there are not eight any more but only some, `here`, the last one fills the group up.
    """
    kept_apart()
    columns, top, k = rows.shape[1], group * LANES, 0
    if len(rows) == 1:
        while k < count:
            store(w, entry + k, all_of(rows[0, first + k]))
            k += 1
    if here == LANES and count >= LANES:
        while k < count:
            k = min(k, count - LANES)  # the last eight: some of them once more
            load_columns(w, entry + k, rows, top * columns + first + k, columns)
            k += LANES
    while k < count:
        for lane in range(LANES):
            w[(entry + k) * LANES + lane] = rows[top + min(lane, here - 1), first + k]
        k += 1
    return entry + count


@compiled
def lanes_into_rows(w: Any, entry: int, rows: Any, group: int, here: int) -> None:
    """Write the rows (N, ...) of a group of eight, or of some, `here`, from as many entries."""
    kept_apart()
    top, k, count = group * LANES, 0, rows.shape[1]
    if here == LANES and count >= LANES:
        while k < count:
            k = min(k, count - LANES)
            store_columns(w, entry + k, rows, top * count + k, count)
            k += LANES
    while k < count:
        for lane in range(here):
            rows[top + lane, k] = w[(entry + k) * LANES + lane]
        k += 1
