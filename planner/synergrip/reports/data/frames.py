"""A plan as a pandas table. Pandas is not needed for anything else, and imported here alone."""

from __future__ import annotations

from typing import Any

from synergrip.errors import InputError
from synergrip.planning.arrays import table_of
from synergrip.planning.outcome import Plan
from synergrip.reports.data.plan_files import header_of


def frame(plan: Plan) -> Any:
    """Return a `DataFrame`; see `Tabled.frame`."""
    try:
        import pandas
    except ImportError:
        message = (
            "a table needs pandas, which is not installed: pip install pandas; .save(folder) writes it as plan.csv"
        )
        raise InputError.at("Plan.frame", message) from None
    return pandas.DataFrame(table_of(plan.moved), columns=header_of(plan.grasp))
