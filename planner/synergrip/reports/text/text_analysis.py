"""The analysis of a grasp as text for people."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from synergrip.documents.quantities import plain
from synergrip.linalg import GREY_CEILING, GREY_FLOOR, RANK_TOLERANCE, frozen
from synergrip.planning.accuracy import accuracy_notes
from synergrip.planning.free import free_dimensions
from synergrip.problems.problem import Problem
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_problem import problem_lines
from synergrip.reports.text.unbroken import TIED
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.twists import describe_twist

WIDTH = 120
"""Longest line."""
_DECISIONS = {
    "restraint": "G': contacts restrain the object",
    "redundancy": "J S: synergies that move contacts",
    "rigid": "part of J S that no rigid motion follows",
    "forces": "internal forces from synergies",
}


def analysis_text(problem: Problem, analysis: Analysis, color: bool = False) -> str:
    """Return the dimensions for the synergies and for all joints, the rigid motions, and the rank decisions."""
    grasp = analysis.grasp
    header = ("inputs", "n_z", "internal forces E_s", "rigid motions Γ_ucs", "redundant Γ_zr")
    rows = [(f"{grasp.n_z} synergies", *_dimensions(analysis))]
    if grasp.S.shape[0] != grasp.S.shape[1] or not np.array_equal(grasp.S, np.eye(grasp.n_q)):
        every = replace(grasp, S=frozen(np.eye(grasp.n_q)), C_z=frozen(np.zeros((grasp.n_q, grasp.n_q))),
                        synergies=grasp.joints)  # fmt: skip
        rows.append((f"all {grasp.n_q} joints", *_dimensions(analyse(every))))
    lines = [*problem_lines(problem), "", table(header, rows, right=(1, 2, 3, 4)), ""]
    lines += ["n_z = dim E_s + dim Γ_ucs + dim Γ_zr (34) holds in every row."]
    return "\n".join([*lines, *_motions(analysis), *_redundancy(analysis), "", *_values(analysis)])


def _dimensions(analysis: Analysis) -> tuple[str, ...]:
    return str(analysis.grasp.n_z), *(str(d) for d in analysis.spaces.dimensions)


def _motions(analysis: Analysis) -> Iterator[str]:
    length = analysis.response.scale.length
    for i, motion in enumerate(analysis.spaces.Gamma_ucs.T):
        synergies = combination(analysis.spaces.Gamma_zcs[:, i], analysis.grasp.synergies)
        twist = describe_twist(motion, analysis.grasp.contacts, length)
        yield from wrapped(f"Γ_ucs {i + 1}  ", f"{twist}; by {synergies}", WIDTH)


def _redundancy(analysis: Analysis) -> Iterator[str]:
    for i, column in enumerate(analysis.spaces.Gamma_zr.T):
        text = f"{combination(column, analysis.grasp.synergies)} moves no contact"
        yield from wrapped(f"Γ_zr {i + 1}   ", text, WIDTH)


def combination(column: np.ndarray, names: tuple[str, ...]) -> str:
    """Return references as a sum of synergies by name, the largest with the factor 1."""
    largest = float(np.abs(column).max())
    kept = [(value / largest, name) for value, name in zip(column, names, strict=True) if abs(value) > 1e-6 * largest]
    terms = [f"{'-' if v < 0 else '+'} {'' if abs(abs(v) - 1) < 5e-4 else f'{abs(v):.3g} '}{n}" for v, n in kept]
    return " ".join(term.replace(" ", TIED) for term in terms).removeprefix(f"+{TIED}")


def _values(analysis: Analysis) -> Iterator[str]:
    grey = f"{GREY_FLOOR:.0e} to {GREY_CEILING:.0e}"
    told = f"singular values, relative; counted above {RANK_TOLERANCE:.0e}, ambiguous from {grey}"
    rows = []
    for name, decision in analysis.spaces.decisions.items():
        shown = " ".join(f"{value:.2g}" if value > GREY_FLOOR else "0" for value in decision.singular_values)
        flag = "  AMBIGUOUS" if decision.ambiguous else ""
        rows.append((_DECISIONS[name], str(decision.rank), f"[{shown}]{flag}"))
    yield from wrapped("", told, inset=2)
    yield table(("", "rank", "values"), rows, right=(1,))
    length, condition = 1e3 * analysis.response.scale.length, analysis.coordinates.condition
    yield f"characteristic length {plain(length)} mm, condition of M {plain(condition, 3)}"
    for note in (*free_dimensions(analysis), *accuracy_notes(analysis.response)):
        yield from wrapped("note     ", note, WIDTH)
