"""What a motion makes of a limit, in physical terms and from the motion alone: what people read, and checks go by."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from synergrip.conic.limits.ties import BROKEN, ROUNDING, first_largest, first_worst
from synergrip.documents.judging import Arguments, are_floats, are_texts, as_numbers, described
from synergrip.documents.naming import naming_arguments
from synergrip.errors import shortened
from synergrip.linalg import Array, frozen, sealed
from synergrip.values import Value


@lru_cache(maxsize=256)
def alike(count: int, value: float) -> Array:
    """Return (count,) numbers that are all the same, read-only."""
    return sealed(np.full(count, value))


@naming_arguments
@dataclass(frozen=True, eq=False, repr=False)
class Usage(Value):
    """How much of a limit a motion uses, computed from physical quantities and not from the program.

    Args:
        title: of the limit, for tables and pictures.
        unit: of value, lower, upper and scale, such as "N"; for people.
        items: (m) what there is a value of: names of contacts, joints, synergies, or any words.
        value: (T, m) of each item at each of the motion's times.
        lower: (m,) what the value may not fall below; ``-math.inf`` where it may.
        upper: (m,) what it may not exceed; ``math.inf`` where it may.
        scale: (m,) size greater than 0 that an excess is measured against, usually the bound itself: up to 1e-6 of it
            passes for rounding, and the worst item is the one farthest beyond in it.
        times: (T,) ``motion.times``.
        allowance: (T, m) size against which an excess is judged; `scale` when None.

    Raises:
        InputError: names that are none, or arrays that are none or do not fit items and times.

    Example:
        >>> usage = Usage("force", "N", ("thumb",), [[3.0], [4.5]], [0.0], [5.0], [5.0], [0.0, 1.0])
        >>> usage.excess.tolist()
        [[-2.0], [-0.5]]
    """

    title: str
    unit: str
    items: tuple[str, ...]
    value: Array
    lower: Array
    upper: Array
    scale: Array
    times: Array
    allowance: Array | None = None

    def __post_init__(self) -> None:
        """Judge the shapes, which a limit of one's own may get wrong."""
        if self._fits():
            return
        judge = Arguments("Usage")
        judge.text("title", self.title)
        judge.text("unit", self.unit)
        items = judge.several("items", self.items, str, '"thumb"')
        times = as_numbers(self.times)
        if times is None or times.ndim != 1:
            judge.refuse("times", f"expected the times (T,) of the motion, got {described(self.times)}")
        judge.finish()
        T, m = len(np.atleast_1d(np.asarray(times))), len(items)
        wanted = {"value": (T, m), "lower": (m,), "upper": (m,), "scale": (m,), "allowance": (T, m)}
        for name, shape in wanted.items():
            given = getattr(self, name)
            found = as_numbers(given)
            if name == "allowance" and given is None:
                continue
            if found is None or found.shape != shape:
                what = f"expected shape {shape} for {T} instants and {m} items of '{self.title}'"
                judge.refuse(name, f"{what}, got {given.shape if isinstance(given, np.ndarray) else described(given)}")
            elif found is not given:
                object.__setattr__(self, name, frozen(found))
        judge.finish()
        object.__setattr__(self, "items", items)
        object.__setattr__(self, "times", times)

    def _fits(self) -> bool:
        """Return whether all is as that of the library is; then nothing is looked at more closely."""
        arrays = (self.times, self.lower, self.upper, self.scale, self.value)
        more = () if self.allowance is None else (self.allowance,)
        words = (self.title, self.unit, *self.items) if type(self.items) is tuple else ()
        if not words or not are_texts(words) or not are_floats((*arrays, *more)):
            return False
        T, m = self.times.shape, (len(self.items),)
        of_each = all(each.shape == T + m for each in (self.value, *more))
        return len(T) == 1 and of_each and self.lower.shape == self.upper.shape == self.scale.shape == m

    @property
    def excess(self) -> Array:
        """(T, m) how far the value is beyond its bounds; negative inside."""
        return np.maximum(self.value - self.upper, self.lower - self.value)

    @property
    def size(self) -> Array:
        """(T, m) size against which an excess is small or large."""
        return np.broadcast_to(self.scale if self.allowance is None else self.allowance, self.value.shape)

    @property
    def violation(self) -> float:
        """The largest excess, relative to the size it is measured against; negative inside, -inf without a bound."""
        size = self.scale if self.allowance is None else self.allowance
        return float((self.excess / size).max(initial=-np.inf))

    def worst(self, side: int = 0) -> tuple[int, int]:
        """Return knot and item closest to (or farthest beyond) their bound, measured by `scale`.

        Of the upper bounds alone with `side` 1, of the lower ones with -1.
        """
        excess = {1: self.value - self.upper, -1: self.lower - self.value}.get(side, self.excess) / self.scale
        broken = bool(excess.max(initial=-np.inf) > BROKEN)
        return first_largest(excess) if broken else first_worst(excess, self.value / self.scale, ROUNDING)

    def __repr__(self) -> str:
        """Return the value nearest to its bound, where and when."""
        k, i = self.worst()
        place = f"{shortened(str(self.items[i]))}, t = {self.times[k]:.6g} s"
        return f"Usage({self.title}: {self.value[k, i]:.6g} {self.unit} at {place}, the worst of {self.value.size})"
