"""What a sum of squares is worth before anything is known of it, so that its value in a program is near 1."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from synergrip.conic.goals.goal import Squares
from synergrip.conic.question import Question
from synergrip.linalg import Array


def weighed(question: Question) -> Question:
    """Return the question with a first guess of what a weighted sum is worth, for its weights are anybody's."""
    if question.goal.in_natural_units or question.goal.has_scalar:
        return question
    parts = question.goal.objective(question.formulation).squares
    worth = max((size for part in parts for size in _sizes(part)), default=1.0)
    return replace(question, worth=worth) if worth > 0 else question


def _sizes(part: Squares) -> Iterator[float]:
    """Yield sums of squares over the knots: of what is known, and of what unknowns of size 1 add to it."""
    yield float((part.constant**2).sum())
    yield len(part.constant) * _square(part.matrix)
    for earlier in part.earlier:
        yield float((earlier.weights**2).sum()) * _square(earlier.matrix)


def _square(matrix: Array) -> float:
    """Return the sum of squares of a matrix, or the mean of these over the knots."""
    return float((matrix**2).sum()) / (len(matrix) if matrix.ndim > 2 else 1)
