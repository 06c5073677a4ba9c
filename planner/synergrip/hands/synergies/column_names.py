"""What the columns of a recording are by their names: joints, or what loggers write beside them."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

UNITS = {"hinge": {"deg": math.pi / 180, "rad": 1.0}, "slide": {"mm": 1e-3, "m": 1.0}}
"""Unit of a column -> factor to SI, for each kind of joint."""

_TIMES = {
    "sec", "secs", "seconds", "msec", "msecs",
    "millis", "milliseconds", "usec", "usecs", "micros", "microseconds", "nsec", "nsecs", "nanos", "nanosec",
    "nanosecs", "nanoseconds", "elapsed", "date", "datetime", "clock", "epoch", "utc", "uhrzeit", "zeit", "datum",
    "temps", "tiempo", "tempo", "hour", "hours", "minute", "minutes", "day", "month", "year",
}  # fmt: skip
_LEADING_TIMES = {"time", "timestamp", "stamp", "elapsed", "date", "datetime"}
_ENDINGS = ("time", "times", "stamp", "stamps", "timecode")
_SHORT_TIMES = [["t"], ["ts"], ["s"], ["ms"], ["us"], ["ns"]]
_COUNTS = {"seq", "sequence", "frame", "frames", "sample", "samples", "row", "line", "counter", "tick", "ticks",
           "packet", "iteration", "count", "cnt"}  # fmt: skip
_NUMBERS = {"id", "ids", "no", "nr", "num", "number", "index", "idx", "count", "type", "name"}
_LABELS = {
    "subject", "subj", "participant", "trial", "trials", "session", "repetition", "rerepetition", "rep", "run", "label",
    "labels", "class", "object", "grasp", "gesture", "movement", "stimulus", "restimulus", "task", "phase", "event",
    "marker", "comment", "name", "category", "file", "filename", "side",
}  # fmt: skip
_OTHER_QUANTITIES = {
    "velocity", "velocities", "vel", "speed", "effort", "efforts", "torque", "torques", "current", "currents",
    "acceleration", "accelerations", "acc", "accel", "voltage", "temperature", "pwm", "force", "forces",
}  # fmt: skip
_TIME_UNITS = {"s", "ms", "us", "ns", "min", "h"}
_PERHAPS = {"", "n", "i", "k", "step", *_NUMBERS} - {"type", "name"}
"""Names of columns that are no joints when they count: "index" is a finger, too."""

_BRACKETED = re.compile(r"\s*[(\[]\s*([^()\[\]]*?)\s*[)\]]\s*$")
_LONG = {"degree": "deg", "degrees": "deg", "°": "deg", "radian": "rad", "radians": "rad"}
_PLACE = re.compile(r"[/._ ](position|pos)$", re.IGNORECASE)


def beside_joints(text: str) -> str:
    """Return what a column is that is no joint, by its name alone; empty for a joint."""
    words = _words(text)
    plain = [word for word in words if word not in _TIME_UNITS] or words
    if not plain:
        return ""
    if plain in _SHORT_TIMES or plain[0] in _LEADING_TIMES or plain[-1] in _TIMES or plain[-1].endswith(_ENDINGS):
        return "time"
    if plain[-2:] == ["frame", "id"]:
        return "a label"
    if plain[-1] in _COUNTS or (plain[-1] in _NUMBERS and plain[-2:-1] and plain[-2] in _COUNTS):
        return "a counter"
    if set(plain) & _LABELS and set(plain) <= _LABELS | _NUMBERS:
        return "a label"
    return "no position" if plain[-1].rstrip("0123456789") in _OTHER_QUANTITIES else ""


def may_count(text: str) -> bool:
    """Tell whether a column of that name may hold numbers of lines."""
    return text.lower() in _PERHAPS or re.fullmatch(r"Unnamed: \d+(_level_\d+)?", text) is not None


def _words(text: str) -> list[str]:
    """Return the words of a name, without the unit in brackets behind it."""
    bare = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", _BRACKETED.sub("", text))
    return [word.lower() for word in re.split(r"[^A-Za-z0-9]+", bare) if word]


def joint_and_unit(text: str, known: Mapping[str, str] | None) -> tuple[str, str]:
    """Return a column's joint and its unit ("" when it does not say), as in ``index_pip_deg`` or ``index_pip [deg]``.

    Args:
        text: the name of the column. Around the joint may stand what PlotJuggler writes: ``/joint_states/J/position``.
        known: the joints of the hand, to which a name as it stands comes first; None when every name is a joint.
    """
    if known is not None and text in known:
        return text, ""
    name, unit = _bare(text, known is not None)
    if known is not None and name in known:
        return name, unit
    inner = _PLACE.sub("", name)
    last = inner.rsplit("/", 1)[-1]
    if known is not None:
        return next((each for each in (inner, last) if each in known), name), unit
    return (last if "/" in name or name.endswith(".position") else name), unit


def _bare(text: str, slides: bool) -> tuple[str, str]:
    """Return a name without its unit, and that unit in its short form."""
    kinds = UNITS if slides else ("hinge",)
    units = [unit for kind in kinds for unit in UNITS[kind]]
    found = _BRACKETED.search(text)
    unit = _LONG.get(found[1].lower(), found[1].lower()) if found else ""
    if found and unit in units:
        return text[: found.start()], unit
    for ending, short in [*((unit, unit) for unit in units), *_LONG.items()]:
        if text.endswith(f"_{ending}"):
            return text.removesuffix(f"_{ending}"), short
    return text, ""
