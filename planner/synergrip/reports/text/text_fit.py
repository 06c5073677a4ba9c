"""Synergies fitted to recorded postures, as text for people."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from synergrip.documents.quantities import SHOWN_IN, plain
from synergrip.hands.synergies.fitting import Fit
from synergrip.hands.units import SI_UNITS
from synergrip.problems.in_short import many
from synergrip.reports.text.tables import table, wrapped

NOTHING = 1e-12
"""[rad or m] What is smaller is rounding."""
INDENT = " " * 9


def fit_text(fit: Fit, written: Path | None, picture: Path | None = None) -> str:
    """Return what was read, what each synergy explains, how well all of them do, and what was written."""
    recorded, found = fit.recorded, fit.principal
    count = len(fit.file.synergies)
    postures = f"{many(len(recorded.postures), 'posture')} of {many(len(recorded.joints), 'joint')}"
    directions = many(found.decision.rank, "principal direction")
    error = _size(found.rms, recorded.kind) + (" RMS" if found.rms > NOTHING else "")
    told = f'wrote    {written}; use it as hand.synergies = "{written}"'
    lines = [
        f"read     {recorded.path} · {postures}",
        *(line for note in _records(fit) for line in wrapped(INDENT, note)),
        f"fit      {count} of {directions} · reconstruction error {error}",
        *(line for note in _directions(fit) for line in wrapped(INDENT, note)),
        "",
        _table(fit),
        "",
        told if written else "nothing was written; -o FILE.toml writes a synergy file",
        *([f"drawn    {picture}"] if picture else []),
    ]
    return "\n".join(lines)


def _table(fit: Fit) -> str:
    found = fit.principal
    shares = found.shares[: len(fit.file.synergies)]
    values = zip(fit.file.synergies, shares, np.cumsum(shares), found.deviations, strict=True)
    rows = [
        (name, f"{100 * share:.2f} %", f"{100 * total:.2f} %", _size(deviation, fit.recorded.kind))
        for name, share, total, deviation in values
    ]
    return table(("synergy", "variance", "cumulative", "std"), rows, right=(1, 2, 3))


def _records(fit: Fit) -> Iterator[str]:
    for each in fit.recorded.followed:
        far = f"at most {_size(each.deviation, fit.recorded.kind)} from its coupling (line {each.line})"
        where = far if each.deviation > NOTHING else "on its coupling"
        yield f"'{each.joint}' follows {each.drivers} and is left out; its records are {where}"
    yield from fit.recorded.notes


def _directions(fit: Fit) -> Iterator[str]:
    found = fit.principal
    if found.decision.ambiguous:
        yield "AMBIGUOUS: some directions hardly vary; whether they count depends on the last digits of the records"
    for group in found.alike:
        names = f"principal directions {group[0] + 1} to {group[-1] + 1}"
        yield f"{names} have equal variance: any others in their span would do as well"


def _size(value: float, kind: str) -> str:
    factor, unit = SHOWN_IN[SI_UNITS[kind]]
    return f"{plain(factor * value, 3)} {unit}" if value > NOTHING else f"0 {unit}"
