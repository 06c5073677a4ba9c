"""Response maps of grasps with very different stiffnesses judged against decimal arithmetic of 80 digits.

    python tests/judged_response.py [COUNT]

judges COUNT (1,000) random grasps and prints what is wrong, the largest error and how many are said to be inaccurate.
"""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
from decimal_response import decimal_maps, yields_everywhere
from elastic_grasp import held_motions, length_of
from random_grasps import random_grasp

from synergrip.errors import RigidContactError
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import Array, frozen
from synergrip.statics import respond

RIGHT = 1e-8
"""Relative error of a map that is right, or said to be inaccurate."""
WITHIN = 10.0
"""An error that is estimated may be exceeded by less than a power of ten."""


def stiff_grasp(seed: int) -> Grasp:
    """Return a random grasp whose stiffnesses differ by up to 1e9, and by as much again from contacts to joints.

    Sizes from 4 mm to 4 m; contacts, joints or synergies may be rigid, wholly or in some directions.
    """
    rng = np.random.default_rng(seed)
    kinds = [
        str(kind) for kind in rng.choice(["hard", "soft", "frictionless"], int(rng.integers(3, 6)), p=[0.5, 0.35, 0.15])
    ]
    n_q = int(rng.integers(4, 21))
    n_z = int(rng.integers(2, min(n_q, 12) + 1))
    grasp = random_grasp(rng, kinds, n_q=n_q, n_z=n_z, degenerate=seed % 3 == 0)
    size = 10.0 ** rng.uniform(-1, 2)
    away = 3 * size * rng.normal(size=3) if seed % 2 else np.zeros(3)
    contacts = tuple(replace(contact, point=frozen(size * contact.point + away)) for contact in grasp.contacts)
    decades = float(rng.uniform(0, 9))
    of_contacts = str(rng.choice(["diagonal", "full", "some", "rigid"], p=[0.4, 0.2, 0.15, 0.25]))
    of_joints = str(
        rng.choice(["diagonal", "full"] if of_contacts == "rigid" else ["diagonal", "full", "some", "rigid"])
    )
    of_synergies = str(rng.choice(["diagonal", "full", "rigid"]))
    middle = 10.0 ** rng.uniform([-12, -6, -6], [-2, 1, 1])
    return replace(
        grasp, contacts=contacts, G=grasp_matrix(contacts),
        C_s=_compliance(rng, grasp.n_l, middle[0], decades, of_contacts),
        C_q=_compliance(rng, n_q, middle[1], decades, of_joints),
        C_z=_compliance(rng, n_z, middle[2], decades, of_synergies),
    )  # fmt: skip


def _compliance(rng: np.random.Generator, size: int, middle: float, decades: float, kind: str) -> Array:
    """Return a compliance of values within `decades` powers of ten around `middle`; "some" has rigid directions."""
    values = middle * 10.0 ** rng.uniform(-decades / 2, decades / 2, size)
    if kind == "rigid":
        values[:] = 0.0
    if kind == "some":
        values[rng.random(size) < 0.3] = 0.0
    if kind != "full":
        return frozen(np.diag(values))
    basis = np.linalg.qr(rng.normal(size=(size, size)))[0]
    whole = (basis * values) @ basis.T
    return frozen((whole + whole.T) / 2)


@dataclass
class Judged:
    """What became of one grasp."""

    verdict: str
    """"right", "inaccurate" or "rigid"."""
    wrong: list[str]
    error: float = 0.0
    """The largest of any map, relative to its largest entry."""
    digits: str = ""
    """Whether float64 was enough."""


def judged(seed: int) -> Judged:
    """Judge the response of a random grasp."""
    grasp = stiff_grasp(seed)
    try:
        response = respond(grasp)
    except RigidContactError as error:
        return Judged("rigid", [f"refused although it yields: {error}"] * yields_everywhere(grasp))
    wrong = [] if yields_everywhere(grasp) else ["some direction is rigid"]
    errors, maps = {}, decimal_maps(grasp, held_motions(grasp))
    for name, true in maps.items():
        errors[name] = _error(grasp, name, getattr(response, name), true, _natural(grasp, maps))
        said = response.accuracy[name].error
        if errors[name] > WITHIN * said + 1e-14:
            wrong.append(f"{name} is wrong by {errors[name]:.1e}, said {said:.1e}")
    worst = max(errors.values())
    inaccurate = max(each.error for each in response.accuracy.values()) > RIGHT
    if inaccurate and worst <= RIGHT:
        wrong.append(f"said to be inaccurate, wrong by {worst:.1e} only")
    if not inaccurate and worst > RIGHT:
        wrong.append(f"wrong by {worst:.1e}")
    enough = all(each.changed == each.lost for each in response.accuracy.values())  # it tells no other change
    return Judged("inaccurate" if inaccurate else "right", wrong, worst, "float64" if enough else "doubled")


def _natural(grasp: Grasp, maps: dict[str, Array]) -> float:
    """Return the force that the references would cause if the object could not move, to a power of ten or so [N]."""
    moved = float(np.abs(grasp.J @ grasp.S).max())
    return moved * float(np.abs(maps["dlambda_dw"]).max() / np.abs(maps["du_dw"]).max())


def _error(grasp: Grasp, name: str, found: Array, true: Array, natural: float) -> float:
    """Return the largest difference relative to the largest entry, in SI units and with the grasp's length as unit.

    A map of forces that is no force at all, because the forces are statically determined, is so relative to `natural`.
    """
    motion = np.repeat([1.0, length_of(grasp)[0]], 3)
    spins = np.array([1 / motion[-1] if component == "m" else 1.0 for _, component in grasp.components])
    rows = spins if "lambda" in name else motion if "du" in name else np.ones(len(true))
    columns = motion if name.endswith("dw") else np.ones(true.shape[1])
    worst = 0.0
    for unit in (np.ones(true.shape), np.outer(rows, columns)):
        size, difference = float(np.abs(unit * true).max()), float(np.abs(unit * (found - true)).max())
        size = size if size > 1e-30 * natural else natural
        worst = max(worst, difference / size)
    return worst


def main() -> None:
    """Judge many grasps and print figures."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    found = []
    for seed in range(count):
        found.append(judged(seed))
        for line in found[-1].wrong:
            print(f"seed {seed}, {found[-1].verdict}: {line}", flush=True)
    for key in ("verdict", "digits"):
        counted = Counter(getattr(each, key) for each in found)
        print(", ".join(f"{name or 'none'} {times}" for name, times in counted.most_common()))
    print(f"largest relative error of a map {max(each.error for each in found):.1e}")
    answered = [each for each in found if each.digits]
    share = sum(each.verdict == "inaccurate" for each in answered) / len(answered)
    print(f"said to be inaccurate {share:.2%} of {len(answered)} answers")


if __name__ == "__main__":
    main()
