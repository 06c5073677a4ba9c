"""How a limit is kept between the knots: by rows at the corners there, and by a reserve where the load is curved.

References are linear between knots. Where the load is, too, forces are, and what holds at both ends of a straight piece
holds between them, the cones being convex. So rows at the knots and at the corners between them are all there is to
ask for. What a curved load departs from its chord by, ``dw``, adds ``-G+ dw`` to the forces, whatever the plan; a
reserve at both ends of the piece that is as large keeps every limit in between. It asks for more than is needed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse

from synergrip.conic.beside_knots import beside
from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Intersample, knots_in
from synergrip.conic.rows import Kind, Rows
from synergrip.linalg import Array, frozen


@dataclass(frozen=True)
class Reserve:
    """A formulation between its knots: at the corners, and in curved pieces along their chords and as they bend."""

    intersample: Intersample
    shares: sparse.csr_matrix  # (C, T) of the knots in each corner
    corners: Formulation
    straight: Formulation
    bent: Formulation

    @classmethod
    def of(cls, formulation: Formulation, intersample: Intersample) -> Reserve:
        """Return what lies between the knots of a formulation."""
        corners, chords, curved = (
            beside(formulation, looks) for looks in (intersample.corners, intersample.chords, intersample.curved)
        )
        return cls(intersample, knots_in(corners.times, formulation.times), corners, chords, curved)

    def kept(self, rows_of: Callable[[Formulation], Sequence[Rows]], formulation: Formulation) -> list[Rows]:
        """Return rows at every knot and at every corner, each with the reserve that the curved pieces beside it need.

        Args:
            rows_of: what makes the rows of a limit or goal; none of them may couple knots.
            formulation: at the knots.
        """
        groups = zip(*(rows_of(each) for each in (formulation, self.corners, self.straight, self.bent)), strict=True)
        result = []
        for at, inside, before, after in groups:
            if at.kind is Kind.ZERO:
                result.append(at)
                continue
            needed = _heads(at, self.intersample.needed(lost(at, after.constant - before.constant)))
            result.append(replace(at, constant=frozen(at.constant - needed[~self.intersample.corner])))
            if len(self.corners.times):
                constant = frozen(inside.constant - needed[self.intersample.corner])
                result.append(replace(inside, constant=constant, inside=self.shares))
        return result


def lost(rows: Rows, departure: Array) -> Array:
    """Return what the head of every cone (J, items) loses, and the rest of it gains, by a departure (J, rows)."""
    cones = departure.reshape(len(departure), len(rows.items), rows.dim)
    return np.asarray(np.maximum(-cones[:, :, 0], 0.0) + np.linalg.norm(cones[:, :, 1:], axis=2))


def _heads(rows: Rows, values: Array) -> Array:
    """Return values of cones (G, items) in the place of their heads, 0 in that of the other rows: (G, rows)."""
    found = np.zeros((len(values), len(rows.items) * rows.dim))
    found[:, :: rows.dim] = values
    return found
