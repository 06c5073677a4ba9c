"""Many grasps of one form as arrays with a leading axis, for statics that work on all of them at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from operator import attrgetter
from typing import Any

import numpy as np

from synergrip.documents.judging import Arguments, described
from synergrip.documents.naming import naming_arguments
from synergrip.documents.places import place_of, places_of
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.postures import Postures
from synergrip.grasps.scale import Metric, metric_of
from synergrip.grasps.stacked_kinds import StackedKinds
from synergrip.grasps.varied_arrays import judged_array
from synergrip.linalg import Array, frozen
from synergrip.values import Value

_COMPONENTS = attrgetter("kind.components")
Form = tuple[tuple[tuple[str, ...], ...], tuple[int, ...]]
"""Components of every contact, and the shape of S."""


@dataclass(frozen=True, eq=False, repr=False)
class Matrices(Value):
    """What the statics of one grasp need, or of many (leading axes ...); SI units."""

    G: Array  # (..., 6, n_l)
    J: Array  # (..., n_l, n_q)
    S: Array  # (..., n_q, n_z)
    C_s: Array  # (..., n_l, n_l)
    C_q: Array  # (..., n_q, n_q)
    C_z: Array  # (..., n_z, n_z)

    @classmethod
    @naming_arguments
    def of(cls, grasp: Grasp) -> Matrices:
        """Return those of one grasp, without leading axes."""
        return cls(grasp.G, grasp.J, grasp.S, grasp.C_s, grasp.C_q, grasp.C_z)

    def taken(self, places: Any) -> Matrices:
        """Return those of some grasps of a stack."""
        return Matrices(*(getattr(self, field.name)[places] for field in fields(self)))


@naming_arguments
@dataclass(frozen=True, eq=False, repr=False)
class GraspStack(Value, Sequence[Grasp]):
    """N grasps whose contacts are of the same kinds, with as many joints and synergies each.

    Make one with `of` (from grasps), `varied` (from one grasp and arrays) or `grasps_in_postures`; ``stack[i]`` is the
    grasp at a place.

    Example:
        A thousand compliances: ``GraspStack.varied(grasp, C_s=np.linspace(1, 2, 1000)[:, None, None] * grasp.C_s)``,
        for `analyse_many`.
    """

    matrices: Matrices
    """(N, ...) each."""
    points: Array  # (N, n_c, 3) contact points about B [m]
    w_0: Array  # (N, 6) external wrench on the object at the start [N, N m]
    like: Grasp
    """What all are like but for the arrays."""
    given: tuple[Grasp, ...] = ()
    """The N grasps themselves, where the stack was made of some."""
    postures: Postures | None = None
    """(N) of the hand, where the stack was made of these."""

    def __post_init__(self) -> None:
        """Judge what `of` and `varied` make right."""
        judge = Arguments("GraspStack")
        judge.one("matrices", self.matrices, Matrices, "those that GraspStack.varied(grasp, C_s=...) makes")
        judge.one("like", self.like, Grasp, "the one that make_grasp returns")
        judge.finish()
        count = len(self.matrices.G)
        for name, shape in (("points", (count, self.like.n_c, 3)), ("w_0", (count, 6))):
            if np.shape(value := getattr(self, name)) != shape:
                judge.refuse(name, f"expected shape {shape}, for each of {count} grasps; got {described(value)}")
        judge.finish()

    @classmethod
    @naming_arguments
    def of(cls, grasps: Sequence[Grasp]) -> GraspStack:
        """Return the stack of some grasps.

        Args:
            grasps: at least one; contacts of the same kinds in the same order, as many joints, as many synergies.

        Raises:
            InputError: naming the first grasp that differs from the first one of all.
        """
        if isinstance(grasps, GraspStack):
            return grasps
        if isinstance(grasps, str | np.ndarray) or not isinstance(grasps, Iterable):
            raise InputError.at("grasps", f"expected a list of grasps, got {type(grasps).__name__}")
        given = tuple(grasps)
        if not given:
            raise InputError.at("grasps", "expected at least one grasp, got none")
        _judge_forms(given)
        names = (*(field.name for field in fields(Matrices)), "w_0")
        stacked = [_stacked(list(map(attrgetter(name), given)), len(given)) for name in names]
        points = _stacked([contact.point for grasp in given for contact in grasp.contacts], len(given), given[0].n_c)
        stack = cls(Matrices(*stacked[:-1]), points, stacked[-1], given[0], given)
        stack.__dict__["kinds"] = StackedKinds.of(given)  # with the other arrays
        return stack

    @classmethod
    @naming_arguments
    def varied(cls, grasp: Grasp, **arrays: Array) -> GraspStack:
        """Return a stack of grasps that are like one but for some arrays.

        Args:
            grasp: the grasp, which says all that the arrays do not; of a grasp on a hand the stack keeps the matrices
                and not the hand.
            **arrays: by the names in `VARIED`, with a leading axis of N: points (N, n_c, 3) of the contacts [m],
                G (N, 6, n_l), J (N, n_l, n_q), S (N, n_q, n_z), C_s (N, n_l, n_l), C_q, C_z, w_0 (N, 6).
                G does not follow from `points`: with these it must be given, too.

        Raises:
            InputError: naming the array that is unknown, whose shape does not fit, or that is not finite.
        """
        one = cls.of([grasp])
        own = {**vars(one.matrices), "points": one.points, "w_0": one.w_0}
        found = {name: judged_array(name, value, own) for name, value in arrays.items()}
        if "points" in found and "G" not in found:
            raise InputError.at("G", "missing: it does not follow from points; give both where the contacts move")
        counts = {name: len(value) for name, value in found.items()}
        if len(set(counts.values())) != 1:
            told = ", ".join(f"{name} {count}" for name, count in counts.items()) or "no array at all"
            raise InputError.at("arrays", f"expected arrays of one number of grasps, got {told}")
        count = next(iter(counts.values()))
        every = {name: found.get(name, np.broadcast_to(own[name], (count, *own[name].shape[1:]))) for name in own}
        points, w_0 = every.pop("points"), every.pop("w_0")
        return cls(Matrices(**every), points, w_0, grasp)

    def __len__(self) -> int:
        """Return N."""
        return len(self.points)

    def __iter__(self) -> Iterator[Grasp]:
        """Yield the grasps one by one."""
        return (self[place] for place in range(len(self)))

    def __getitem__(self, place: Any) -> Any:
        """Return the grasp at a place; a stack for a slice."""
        if isinstance(place, slice):
            return self.taken(place)
        place = place_of("place", place, len(self))
        if self.given:
            return self.given[place]
        grasp = self.like
        arrays: dict[str, Any] = {name: frozen(value) for name, value in vars(self.matrices.taken(place)).items()}
        moved = zip(grasp.contacts, self.points[place], strict=True)
        contacts = tuple(replace(contact, point=frozen(point)) for contact, point in moved)
        held = None
        if self.postures is not None:
            contacts, held = self.postures.contacts(contacts, place), self.postures.held(grasp.held, place)
        return replace(grasp, contacts=contacts, w_0=frozen(self.w_0[place]), held=held, **arrays)

    def taken(self, places: Any) -> GraspStack:
        """Return the stack of the grasps at some places (whole numbers, a slice, or True or False for each), in order.

        Raises:
            UnknownPlaceError: there are no such places.
        """
        places = places_of("places", places, len(self))
        if given := self.given:
            each = range(len(self))[places] if isinstance(places, slice) else np.arange(len(self))[places]
            given = tuple(given[i] for i in each)
        postures = None if self.postures is None else self.postures.taken(places)
        stack = GraspStack(
            self.matrices.taken(places), self.points[places], self.w_0[places], self.like, given, postures
        )  # fmt: skip
        for name in ("metric", "of_object", *["kinds"] * bool(self.given)):  # else they would be worked out again
            if name in self.__dict__:
                own = self.__dict__[name]
                stack.__dict__[name] = own[places] if isinstance(own, np.ndarray) else own.taken(places)
        return stack

    @cached_property
    def starts(self) -> Array | None:
        """(N, n_q) joint values of the hand at the start, (1, n_q) if the same in all; None for matrices alone."""
        if self.postures is not None:
            return self.postures.q
        if self.like.held is None:
            return None
        return np.array([each.held.q for each in self.given or (self.like,) if each.held is not None])

    @cached_property
    def stranger(self) -> int | None:
        """Place of the first grasp with other joints, or on another hand, than the first one; None without any."""
        alike = list(map(self.like.joints.__eq__, map(attrgetter("joints"), self.given)))
        held = list(map(attrgetter("held"), self.given))
        if any(each is not None for each in held):
            hand = self.like.held and self.like.held.hand
            alike = [same and (each and each.hand) is hand for same, each in zip(alike, held, strict=True)]
        return None if all(alike) else alike.index(False)

    @cached_property
    def kinds(self) -> StackedKinds:
        """The kinds of contacts of the N grasps, or of the one that all are like."""
        return StackedKinds.of(self.given or (self.like,))

    @cached_property
    def of_object(self) -> Array:
        """(N, n_l, 6) = G', from object motions to contact motions, in scaled coordinates."""
        return self.metric.scaled_grasp(self.matrices.G)

    @cached_property
    def metric(self) -> Metric:
        """The scaled coordinates of every grasp, from its contact points."""
        return metric_of(self.points, [component for _, component in self.like.components])[0]


def _stacked(arrays: Sequence[Array], *leading: int) -> Array:
    """Return arrays of one shape with these leading axes; `numpy.stack` takes longer."""
    whole = np.concatenate(arrays).reshape(*leading, *arrays[0].shape)
    whole.setflags(write=False)
    return whole


def _judge_forms(given: Sequence[Grasp]) -> None:
    """Refuse what is no grasp, or not of the form of the first."""
    for place, grasp in enumerate(given):
        if not isinstance(grasp, Grasp):
            raise InputError.at(f"grasps[{place}]", f"expected a Grasp, got {type(grasp).__name__}")
    first, kinds = _form(given[0]), [type(contact.kind) for contact in given[0].contacts]
    for place, grasp in enumerate(given):
        if [type(contact.kind) for contact in grasp.contacts] == kinds and grasp.S.shape == first[1]:
            continue  # a class has one tuple of components
        if (form := _form(grasp)) != first:
            message = f"{_told(form)}, but grasps[0] has {_told(first)}; put grasps of one form in one batch"
            raise InputError.at(f"grasps[{place}]", f"has {message}")


def _form(grasp: Grasp) -> Form:
    return tuple(map(_COMPONENTS, grasp.contacts)), grasp.S.shape


def _told(form: Form) -> str:
    contacts, (n_q, n_z) = form
    components = ", ".join("".join(each) for each in contacts)
    return f"contacts with components ({components}), {n_q} joints and {n_z} synergies"
