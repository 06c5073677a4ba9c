"""Quantities as people write them ("10 mm", "0.5 N"), in SI units inside.

One closed table of units. Angles count as dimensionless radians, except that a key
that wants an angle says so and refuses a length.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Sequence

from synergrip.errors import InputError, shortened, suggest

UNITS: dict[str, dict[str, float]] = {
    "length": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6},
    "angle": {"rad": 1.0, "mrad": 1e-3, "deg": math.pi / 180},
    "mass": {"kg": 1.0, "g": 1e-3},
    "time": {"s": 1.0, "ms": 1e-3, "min": 60.0},
    "force": {"N": 1.0, "mN": 1e-3, "kN": 1e3},
    "torque": {"N m": 1.0, "N mm": 1e-3, "mN m": 1e-3},
    "stiffness": {"N/m": 1.0, "N/mm": 1e3},
    "spin stiffness": {"N m/rad": 1.0, "N mm/rad": 1e-3},
    "joint compliance": {"rad/(N m)": 1.0, "deg/(N m)": math.pi / 180, "mrad/(N m)": 1e-3},
    "slide compliance": {"m/N": 1.0, "mm/N": 1e-3},
    "acceleration": {"m/s^2": 1.0, "m/s²": 1.0, "mm/s^2": 1e-3},
}
"""Unit -> factor to SI, for each kind of quantity; the SI unit first."""

USUAL: dict[str, tuple[float, float]] = {
    "length": (1e-6, 3.0), "angle": (1e-3, 7.0), "mass": (1e-4, 50.0), "time": (1e-4, 3600.0), "force": (1e-4, 1e4),
    "torque": (1e-5, 1e3), "stiffness": (50.0, 1e9), "spin stiffness": (1e-3, 1e5), "joint compliance": (1e-6, 10.0),
    "slide compliance": (1e-9, 0.1), "acceleration": (1e-2, 1e3),
}  # fmt: skip
"""Sizes in SI that a hand and what it holds have. A number without a unit beyond them is hardly meant in SI."""

SHOWN_IN = {"rad": (180 / math.pi, "deg"), "m": (1e3, "mm"), "N": (1.0, "N"), "N m": (1.0, "N m")}
"""SI unit -> the factor and the unit in which people read it."""

RESOLUTION = 1e-12
"""[m, rad, N, N m] Values that are less are noise of the arithmetic, and told as 0."""

PLAIN = 1e7
"""Size from which on a number is written with an exponent."""
METRE, KILOGRAM = 1.0, 1.0
"""[m, kg] from which on a length or a mass is not told in mm or g."""

EXAMPLES = {
    "length": "10 mm", "angle": "5 deg", "mass": "200 g", "time": "2 s", "force": "0.5 N", "torque": "1.5 N m",
    "stiffness": "8 N/mm", "spin stiffness": "2 N m/rad", "joint compliance": "0.025 rad/(N m)",
    "slide compliance": "0.1 mm/N", "acceleration": "9.81 m/s^2",
}  # fmt: skip

LONGEST = 400
"""Characters of a number with its unit; the pattern takes time that grows with their square."""

_NUMBER = re.compile(r"\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)\s*(.*?)\s*\Z")


def quantity(text: object, kind: str, key: str = "") -> float:
    """Return the SI value of a quantity such as ``"10 mm"``.

    Args:
        text: number and unit in one string.
        kind: a key of `UNITS`.
        key: where it stands, for the error.

    Raises:
        InputError: no number, no unit, an unknown unit or a unit of another kind.
    """
    units = UNITS[kind]
    listed = ", ".join(units)
    article = "an" if kind[0] in "aeiou" else "a"
    if isinstance(text, bool) or not isinstance(text, str):
        plain = isinstance(text, int | float) and not isinstance(text, bool)
        wrote, shown = f"{text!r} has no unit; " if plain else "", without_unit(text, kind)
        raise InputError.at(key, f"{wrote}expected {article} {kind} such as {shown} (units: {listed})")
    match = _NUMBER.match(text) if len(text) <= LONGEST else None
    if match is None:
        raise InputError.at(
            key,
            f'{shortened(repr(text))} is not {article} {kind}; write for example "{EXAMPLES[kind]}" (units: {listed})',
        )
    number, unit = float(match[1]), " ".join(match[2].split())
    if not unit:
        raise InputError.at(key, f"missing unit; write {without_unit(match[1], kind)} (units: {listed})")
    if unit not in units:
        other = next((name for name, table in UNITS.items() if unit in table), "")
        why = f"'{unit}' is a unit of {other}" if other else f"unknown unit '{unit}'"
        raise InputError.at(key, f"{why}; expected {article} {kind} (units: {listed}){suggest(unit, units)}")
    value = number * units[unit]
    if not math.isfinite(value):
        raise InputError.at(key, f"{shortened(text)!r} is not finite")
    return value


def without_unit(value: object, kind: str) -> str:
    """Return how a number without a unit is written as a quantity, in quotes; an example of the kind for anything else.

    A plain number is one in SI. When that is no usual size of the kind, a unit in which the same number is one comes
    before it.
    """
    text = "" if isinstance(value, bool) or not isinstance(value, int | float | str) else str(value)
    match = _NUMBER.match(text) if len(text) <= LONGEST else None
    if match is None or match[2]:
        return f'"{EXAMPLES[kind]}"'
    units = UNITS[kind]
    size, (least, most) = abs(float(match[1])), USUAL[kind]
    example = EXAMPLES[kind].partition(" ")[2]
    others = [unit for unit in (example, *units) if least <= size * units[unit] <= most]
    meant = [*([] if size == 0 or least <= size <= most else others[:1]), next(iter(units))]
    return " or ".join(f'"{match[1]} {unit}"' for unit in meant)


def kind_of(text: object, kinds: Sequence[str]) -> str | None:
    """Return the one of `kinds` that has the unit of a quantity such as ``"10 mm"``; None if none of them has."""
    match = _NUMBER.match(text) if isinstance(text, str) and len(text) <= LONGEST else None
    unit = " ".join(match[2].split()) if match else ""
    return next((kind for kind in kinds if unit in UNITS[kind]), None)


def ratio(value: object, key: str = "") -> float:
    """Return a plain number, given as a number or as a fraction in a string such as ``"1/3"``."""
    if isinstance(value, str):
        text = value if value.isascii() and "_" not in value else ""
        parts = text.split("/")
        try:
            result = float(parts[0]) / float(parts[1]) if len(parts) == 2 else float(text)
        except (ValueError, ZeroDivisionError):
            raise InputError.at(key, f'{shortened(repr(value))} is not a number or a fraction such as "1/3"') from None
    elif isinstance(value, int | float) and not isinstance(value, bool):
        result = float(value) if abs(value) < sys.float_info.max else math.inf
    else:
        raise InputError.at(key, f'{shortened(repr(value))} is not a number or a fraction such as "1/3"')
    if not math.isfinite(result):
        raise InputError.at(key, f"{shortened(repr(value))} is not finite")
    return result


def apart(one: float, other: float, digits: int = 4) -> tuple[str, str]:
    """Return two numbers as text, with as many digits as it takes to tell them apart (at most 17)."""
    while digits < 17 and one != other and f"{one:.{digits}g}" == f"{other:.{digits}g}":
        digits += 1
    return plain(one, digits), plain(other, digits)


def plain(value: float, digits: int = 4) -> str:
    """Return a number with as many digits, and without an exponent unless it is far from 1: 10000, not 1e+04."""
    text = f"{value:.{digits}g}"
    return f"{float(text):.0f}" if "e+" in text and abs(value) < PLAIN else text


def in_mm(value: float, digits: int = 3) -> str:
    """Return a length [m] as people read it: 2.6 mm, but 10 m; 0 mm for what is less than `RESOLUTION`."""
    value = _without_noise(value)
    return f"{plain(value, digits)} m" if abs(value) >= METRE else f"{plain(1e3 * value, digits)} mm"


def in_g(value: float, digits: int = 4) -> str:
    """Return a mass [kg] as people read it: 200 g, but 20 kg."""
    return f"{plain(value, digits)} kg" if abs(value) >= KILOGRAM else f"{plain(1e3 * value, digits)} g"


def read_as(value: float, unit: str, digits: int = 4) -> str:
    """Return a value [`unit`] with the unit in which people read it."""
    factor, name = SHOWN_IN.get(unit, (1.0, unit))
    value = _without_noise(value) if unit in SHOWN_IN else value
    return f"{plain(factor * value, digits)} {name}".rstrip()


def both_apart(one: float, other: float, unit: str) -> tuple[str, str]:
    """Return two values [`unit`] with the units that people read, and digits that tell them apart."""
    if unit in SHOWN_IN:
        one, other = _without_noise(one), _without_noise(other)
    far = [unit == "m" and abs(value) >= METRE for value in (one, other)]
    if any(far) and not all(far):
        return in_mm(one, 4), in_mm(other, 4)
    factor, name = (1.0, unit) if any(far) else SHOWN_IN.get(unit, (1.0, ""))
    first, second = (f"{number} {name}".rstrip() for number in apart(factor * one, factor * other))
    return first, second


def _without_noise(value: float) -> float:
    """Return a value in SI; 0 for one that is less than `RESOLUTION`."""
    return 0.0 if abs(value) < RESOLUTION else value
