"""What every kind of contact is: a value that carries its parameters, and says what they mean.

A kind is one file beside this one and one line in `kinds.KINDS`. It names its force components and its parameters,
and describes what it can hold by cones; everything else follows: rows of G and J, compliance, keys in files, limits.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np

from synergrip.documents.judging import Arguments
from synergrip.documents.naming import Finished
from synergrip.linalg import Array, frozen
from synergrip.values import Kept

COMPONENTS = ("n", "t", "o", "m", "m_t", "m_o")
"""All that a contact can transmit, in row order: forces along n, t, o [N], moments about n, t, o [N m]."""
STIFFNESS_OF = {
    "n": "stiffness", "t": "tangential_stiffness", "o": "tangential_stiffness",
    "m": "spin_stiffness", "m_t": "tilt_stiffness", "m_o": "tilt_stiffness",
}  # fmt: skip
"""The entry of stiffness that belongs to each component [N/m, N m/rad]."""
EXAMPLE_OF = {
    "stiffness": "8 N/mm", "tangential_stiffness": "8 N/mm", "spin_stiffness": "2 N m/rad",
    "tilt_stiffness": "2 N m/rad",
}  # fmt: skip


def is_moment(component: str) -> bool:
    """Tell whether a force component is a moment [N m]."""
    return component.startswith("m")


@dataclass(frozen=True)
class Parameter:
    """A parameter of a kind: the argument in code, and the key in a problem file, of the same name."""

    name: str
    meaning: str
    example: str
    """As a problem file has it."""
    length: bool = False
    """A length [m]; the key in a grasp file ends in ``_m`` then. Else a number."""
    hint: str = ""
    """What to try when it is not greater than 0, or missing."""

    @property
    def key(self) -> str:
        """Key in a grasp file."""
        return f"{self.name}_m" if self.length else self.name


FRICTION = Parameter("friction", "coefficient of friction", "0.6")
SPIN_FRICTION = Parameter("spin_friction", "moment about the normal per normal force", '"5 mm"', length=True)


def diagonal(*entries: Array | float) -> Array:
    """Return diagonal matrices (..., n, n) of n entries, each a number or (...)."""
    every = np.broadcast_arrays(*entries)
    W = np.zeros((*every[0].shape, len(every), len(every)))
    for i, entry in enumerate(every):
        W[..., i, i] = entry
    return W


@dataclass(frozen=True, kw_only=True)
class ContactKind(Finished, Kept, ABC):
    """A kind of contact with its parameters, each greater than 0: what it transmits and withstands.

    Example:
        >>> isinstance(HardFinger(friction=0.6), ContactKind), HardFinger(friction=0.6).components
        (True, ('n', 't', 'o'))
    """

    name: ClassVar[str]
    """Name in files."""
    title: ClassVar[str]
    """Name in text."""
    components: ClassVar[tuple[str, ...]]
    """Those of `COMPONENTS` that it transmits, in that order; "n" first."""
    parameters: ClassVar[tuple[Parameter, ...]] = ()
    """One for each field."""
    frictions: ClassVar[tuple[str, ...]] = ("friction", "spin_friction", "cross_friction")
    """The parameters that are smaller where there is less friction than stated."""
    sides: ClassVar[tuple[str, ...]] = ("",)
    """What each cone is about, where there are several."""

    _example = "HardFinger(friction=0.6)"
    _elsewhere: ClassVar[Mapping[str, str]] = {
        name: f"it is the contact's: ContactAt(..., {name}=...)" for name in EXAMPLE_OF
    }

    @property
    def lies_flat(self) -> bool:
        """Whether it transmits moments about its tangents: it does not roll then, also where the pad is round."""
        return not {"m_t", "m_o"}.isdisjoint(self.components)

    def __post_init__(self) -> None:
        """Judge the parameters.

        Raises:
            InputError: one that is no finite number greater than 0.
        """
        judge, units = Arguments(type(self).__name__), {p.name: p for p in self.parameters}
        for each in fields(self):
            parameter = units.get(each.name)
            unit, hint = ("m" if parameter.length else "", parameter.hint) if parameter else ("", "")
            found = judge.number(each.name, getattr(self, each.name), above=0, unit=unit, hint=hint)
            object.__setattr__(self, each.name, found)
        judge.finish()

    @property
    @abstractmethod
    def cones(self) -> tuple[Array, ...]:
        """Cone matrices W (d, rows), one for each of `sides`; all must hold.

        The slip margin of one is ``(W lambda)_0 - ||(W lambda)_1..||`` in newtons. The first row is a multiple of the
        normal force; the others name every other component at least once, in one cone or another.
        """

    @classmethod
    def cones_with(cls, values: Mapping[str, Array]) -> tuple[Array, ...]:
        """Return the cones W (..., d, rows) of many contacts of this kind, with values (...) of their parameters."""
        shape = np.broadcast_shapes(*(np.shape(value) for value in values.values()))
        columns = [np.broadcast_to(value, shape).ravel().tolist() for value in values.values()]
        rows = zip(*columns, strict=True) if columns else [()]
        each = [cls(**dict(zip(values, row, strict=True))).cones for row in rows]
        return tuple(np.stack(W).reshape(*shape, *W[0].shape) for W in zip(*each, strict=True))

    @classmethod
    def named(cls) -> tuple[str, ...]:
        """Return the names of the parameters."""
        return tuple(each.name for each in fields(cls))

    @property
    def selection(self) -> Array:
        """(rows, 6) selection of the contact twist (v_n, v_t, v_o, w_n, w_t, w_o) that is constrained: H of (3)."""
        return frozen(np.eye(6)[[COMPONENTS.index(component) for component in self.components]])

    @property
    def least_friction(self) -> float:
        """Coefficient of friction in the direction that has the least; 0 without friction."""
        return min((getattr(self, name) for name in ("friction", "cross_friction") if hasattr(self, name)), default=0.0)

    @cached_property
    def most(self) -> Array:
        """(rows,) largest size of each component for each newton of normal force, as the cones have it."""
        head = np.concatenate([np.full(len(W) - 1, W[0, 0]) for W in self.cones])
        rest = np.vstack([W[1:, 1:] for W in self.cones])
        return frozen([1.0, *(np.abs(np.linalg.pinv(rest)) @ head)])

    @classmethod
    def stiffnesses(cls) -> tuple[str, ...]:
        """Return the entries of stiffness that it takes."""
        return tuple(dict.fromkeys(STIFFNESS_OF[component] for component in cls.components))

    def compliance(self, stiffness: Mapping[str, float]) -> Array:
        """Return its block (rows, rows) of C_s: 1 over the stiffness of each component, 0 where that is infinite."""
        return frozen(np.diag([1.0 / stiffness[STIFFNESS_OF[component]] for component in self.components]))

    @classmethod
    def taking(cls, values: Mapping[str, Any]) -> Self:
        """Return the kind with those of `values` that are its parameters."""
        return cls(**{each.name: values[each.name] for each in fields(cls)})

    def slippery(self, ratio: float) -> Self:
        """Return it with a share of its friction, spin friction too."""
        return replace(self, **{n: ratio * getattr(self, n) for n in self.frictions if hasattr(self, n)})

    def with_friction(self, friction: float) -> Self:
        """Return it with another coefficient of friction; the same where it has none."""
        return replace(self, friction=friction) if hasattr(self, "friction") else self  # type: ignore[call-arg]


class ByFormula(ContactKind):
    """A kind whose cones are written down for one contact and for many at once."""

    @classmethod
    @abstractmethod
    def cones_with(cls, values: Mapping[str, Array]) -> tuple[Array, ...]:
        """Return the cones W (..., d, rows) of one contact of this kind or of many, with values (...) of parameters."""

    @cached_property
    def cones(self) -> tuple[Array, ...]:
        """Cone matrices W (d, rows) of this contact, as `cones_with` has them."""
        return tuple(frozen(W) for W in self.cones_with({name: np.array(getattr(self, name)) for name in self.named()}))
