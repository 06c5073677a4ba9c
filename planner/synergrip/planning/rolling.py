"""What a plan relies on where its pads roll, and what somebody may do who is not sure of them."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import compress

from synergrip.documents.quantities import plain
from synergrip.documents.words import listed
from synergrip.equilibrium.execution import Execution


def rolling_notes(executed: Execution, fixed: Execution | None) -> Iterator[str]:
    """Yield a note where contacts would slip if pads did not roll.

    Args:
        executed: the references of a plan.
        fixed: the same if pads stayed where they are on link and object; None where nothing rolls.
    """
    if fixed is None or (fixed.whole and float(fixed.margins.min()) >= 0):
        return
    own = executed.setting
    radii = sorted({touch.pad.radius for touch in compress(own.held.touches, own.rolls)})
    sizes = listed([plain(1e3 * radius) for radius in radii])
    what = f"a contact would slip ({plain(fixed.margins.min())} N)" if fixed.whole else "the hand would not get through"
    yield (
        f"if pads did not roll, {what}: the plan relies on their radius ({sizes} mm), which says how far they roll. "
        "Check 'radius' of the pads; a larger limits.margin or allow.contact_gap leaves it more room"
    )
