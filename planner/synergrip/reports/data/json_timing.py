"""The fastest timing along the path of a palm, in JSON."""

from __future__ import annotations

from typing import Any

from synergrip.margin.timing.fastest_timing import FastestTiming


def timing_document(found: FastestTiming) -> dict[str, Any]:
    """Return the fastest timing, or why there is none; times [s], poses as in a path of the palm."""
    if found.value is None or found.path is None or found.share is None:
        return {"value": None, "why": found.why}
    return {
        "value": found.value, "lower": found.lower, "upper": found.upper, "proven": found.proven, "local": found.local,
        "unit": "s", "given_s": found.given_s, "why": found.why, "time_s": list(found.path.times),
        "share": found.share.tolist(),
        "given_share": None if found.given_share is None else found.given_share.tolist(),
        "path": [list(pose) for pose in found.path.poses],
    }  # fmt: skip
