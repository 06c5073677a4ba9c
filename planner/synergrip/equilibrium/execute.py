"""From references to the equilibria that they lead through."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import numpy as np

from synergrip.documents.judging import Arguments, described
from synergrip.documents.naming import naming_arguments
from synergrip.equilibrium.balance import Balance
from synergrip.equilibrium.execution import Execution
from synergrip.equilibrium.newton import AT_REST, ROUGH, at_rest, on_faces, settled, why_not
from synergrip.equilibrium.setting import ContactModel, Setting, setting
from synergrip.equilibrium.states import Loads, States
from synergrip.equilibrium.way import SQUEEZE, Way, led_states, squeezes, steps_between
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, Places
from synergrip.statics.response import Response

SHORTEST = Fraction(1, 640)
"""Share of a step from one instant to the next below which it is given up."""


@naming_arguments
def execute(
    grasp: Grasp | Setting, times: Array, references: Array, loads: Loads, *, contact_model: ContactModel = "rolling",
    response: Response | None = None, guess: States | Execution | None = None,
) -> Execution:  # fmt: skip
    """Return the equilibria of a hand that synergy references lead through.

    Args:
        grasp: on a hand, as it is before the first reference; or its `setting`, which has a model and forces already.
        times: (T,) [s], increasing; an instant at which the load jumps may stand twice, with the same references.
        references: (T, n_z) of the synergies, from those at the start [rad, m or as the synergies are scaled].
        loads: (T) on the object.
        contact_model: "rolling" or "fixed", see `setting`.
        response: of the grasp, when it is known.
        guess: (T) states near the equilibria, or an execution of references near these; all are then tried at once
            first. What is found is the same, up to the way that tips roll where shorter steps are needed.

    Returns:
        the equilibria; it ends where there is none to be found, and says why.

    Raises:
        InputError: a grasp given as matrices, no such contact model, arguments that do not fit each other.

    Example:
        >>> execute(grasp, [0.0], [[0.0, 0.01, 0.01, 0.01]], Loads.of(np.zeros((1, 6)))).margins.shape
        (1, 3)
    """
    own = grasp if isinstance(grasp, Setting) else setting(grasp, contact_model, response)
    return equilibria(own, *_judged(own, times, references, loads, guess), loads, guess)


def equilibria(
    own: Setting, times: Array, references: Array, loads: Loads, guess: States | Execution | None,
    wrong: Callable[[Array], bool] | None = None, *, finely: bool = True, asked: Places | None = None,
) -> Execution:  # fmt: skip
    """Return the equilibria that references lead through, as `execute` does.

    Args:
        own: the grasp.
        times: (P,) [s].
        references: (P, n_z).
        loads: (P).
        guess: (T) states near the equilibria, or an execution of references near these.
        wrong: says of forces (T, n_l) that are known to `ROUGH` whether they are not those that are looked for, so that
            more digits of them are of no use.
        finely: whether there are as many steps between instants as it takes; else one.
        asked: (T,) which of the instants are asked for, the first among them: the others are gone through. None: all.
    """
    asked = np.arange(len(times)) if asked is None else asked
    parts, found = steps_between(own, references) if finely else np.ones(len(times), dtype=np.intp), None
    if guess is not None:
        way = Way.of(own, references, loads, parts)
        near = _near(own, guess, way, parts, np.searchsorted(times[asked], times), asked)
        found = _at_steps(own, times, references, way, near, asked, wrong)
    return found or _followed(own, times, references, loads, parts, asked)


def _near(
    own: Setting, guess: States | Execution, way: Way, parts: Places, beside: Places, asked: Places
) -> States | Balance:
    """Return the equations at other equilibria of the same steps, where these are known, or else states at all steps.

    Args:
        own: the grasp.
        guess: (T) states, those of the first squeeze before them or not, or an execution.
        way: all steps.
        parts: (P,) how many there are from each instant to the next.
        beside: (P,) the one among those asked for whose state each instant is guessed to have.
        asked: (T,) the instants that are asked for.
    """
    if isinstance(guess, Execution):
        same = guess.setting is own and len(guess.path.states) == len(way.references)
        if same and np.array_equal(guess.kept, way.kept[asked]):
            return guess.path
        guess = guess.states
    lead = len(guess) - len(asked)
    states = guess.taken(slice(lead, None)) if len(beside) == len(asked) else guess.taken(lead + beside)
    if len(states) + lead == len(way.references):
        return States.joined([guess.taken(slice(lead)), states])
    return led_states(own, states, parts)


def _at_steps(
    own: Setting, times: Array, references: Array, way: Way, near: States | Balance, asked: Places,
    wrong: Callable[[Array], bool] | None,
) -> Execution | None:  # fmt: skip
    """Return the equilibria of all steps of a way; None where none are near.

    `near` are the equations at other equilibria of these steps, or states near them.
    """
    known, kept = near if isinstance(near, Balance) else None, way.kept[asked]
    begun = near.states if isinstance(near, Balance) else near
    enough = None if wrong is None else lambda forces: wrong(forces[kept])
    balance, count = settled(own, begun, way.loads, way.references, known, enough)
    if np.all(balance.error <= (AT_REST if wrong is None else ROUGH)) and on_faces(balance) == len(begun):
        return Execution(times[asked], references[asked], balance, kept, count)
    return None


def _judged(
    own: Setting, times: Array, references: Array, loads: Loads, guess: States | Execution | None
) -> tuple[Array, Array]:
    """Return times (T,) and references (T, n_z) as arrays, when all arguments fit each other."""
    judge = Arguments("")
    instants = judge.numbers("times", times, "times (T,)")
    if instants is not None and (instants.ndim != 1 or not len(instants)):
        judge.refuse("times", f"expected times (T,) [s], one at least; got {described(times)}")
    elif instants is not None and np.any(early := np.diff(instants) < 0):
        before, after = instants[int(np.argmax(early)) :][:2]
        judge.refuse("times", f"times must increase: {after:g} s comes after {before:g} s; sort them")
    count = len(instants) if instants is not None and not judge.issues else 0
    if instants is not None and count:
        wanted = (count, own.grasp.n_z)
        references = judge.array("references", references, wanted, ", a row for each time, a column for each synergy")
        twice = (np.diff(instants) == 0) & np.any(np.diff(references, axis=0) != 0, axis=1)
        if np.any(twice):
            at = f"{instants[int(np.argmax(twice))]:g} s stands twice with two references"
            judge.refuse("times", f"{at}; give each instant one, or move one of them (only loads may jump)")
    else:
        judge.numbers("references", references, "references (T, n_z)")
    if judge.one("loads", loads, Loads, "Loads.of(np.zeros((T, 6)))") is not None and count and len(loads) != count:
        judge.refuse("loads", f"expected loads at {count} times, got {len(loads)}")
    states, example = guess.states if isinstance(guess, Execution) else guess, "another execution, or its states"
    if states is not None and judge.one("guess", states, States, example) is not None and count:
        known, start = [(count, own.grasp.n_q), (squeezes(own) + count, own.grasp.n_q)], own.start
        if states.q.shape not in known or states.forces.shape != (len(states), start.forces.shape[1]):
            judge.refuse("guess", f"expected states of this grasp at {count} times, got joints {states.q.shape}")
    judge.finish()
    return np.asarray(instants), references


def _followed(own: Setting, times: Array, references: Array, loads: Loads, parts: Places, asked: Places) -> Execution:
    """Follow the equilibria from the start, in steps as short as it takes; `parts` (P,) from each instant, at least."""
    here, state, z, w = own, own.start, np.zeros((1, references.shape[1])), own.unloaded(loads)
    path, count, kept, why = list[tuple[States, Array, Loads]](), 0, list[int](), ""
    for k in range(len(times)):
        first = SQUEEZE if k == 0 else int(parts[k - 1])
        gone, step = Fraction(0), Fraction(1, first)
        from_z, from_w, to_w = z, w, loads.taken([k])
        while gone < 1 and not why:
            there = float(min(Fraction(1), gone + step))
            z, w = (1 - there) * from_z + there * references[[k]], from_w.between(to_w, there)
            balance, iterations = settled(here, state, w, z)
            count += iterations
            if at_rest(balance)[0] and on_faces(balance):
                here, state, gone = balance.moved_on(), balance.states, gone + step
                path.append((state, z, w))
            elif step / 2 >= SHORTEST:
                step /= 2
            else:
                why = why_not(balance)
        if why:
            break
        if k in asked:
            kept.append(len(path) - 1)
    states, zs, ws = (
        zip(*path[: kept[-1] + 1], strict=True) if kept else ((own.start,), (0 * z,), (own.unloaded(loads),))
    )
    whole = Balance.of(own, States.joined(states), Loads.joined(ws), np.concatenate(zs))
    return Execution(times[asked], references[asked], whole, np.array(kept, dtype=int), count, why)
