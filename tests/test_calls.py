"""Arguments that a call does not have, lacks, or gets twice."""

from __future__ import annotations

import pickle
from dataclasses import dataclass, replace
from typing import Any

import pytest

from synergrip.calls import spelled
from synergrip.errors import InputError


@spelled
@dataclass(frozen=True, kw_only=True)
class Ball:
    mass: float
    radius: float = 1.0

    def __post_init__(self) -> None:
        if self.radius < 0:
            raise TypeError("of its own")


@spelled
def thrown(ball: Ball, speed: float, *, spin: float = 0.0) -> tuple[Ball, float, float]:
    """Return what is thrown."""
    return ball, speed, spin


def refused(call: Any, *args: Any, **kwargs: Any) -> dict[str, str]:
    with pytest.raises(InputError) as caught:
        call(*args, **kwargs)
    return {issue.key: issue.message for issue in caught.value.issues}


def test_a_misspelt_argument_is_named_with_what_was_meant() -> None:
    found = refused(Ball, mass=1.0, radios=2.0)
    assert found == {"Ball.radios": "no such argument of Ball; it has mass, radius; did you mean 'radius'?"}
    assert "did you mean 'spin'" in refused(thrown, Ball(mass=1.0), 1.0, spine=2.0)["thrown.spine"]
    assert list(refused(replace, Ball(mass=1.0), maas=2.0)) == ["Ball.maas"]


def test_missing_arguments_are_named() -> None:
    assert refused(Ball) == {"Ball.mass": "missing; Ball needs mass"}
    assert list(refused(thrown)) == ["thrown.ball", "thrown.speed"]


def test_arguments_without_a_name_where_there_must_be_one() -> None:
    assert "takes none without a name, got 2" in refused(Ball, 1.0, 2.0)["Ball"]
    assert refused(thrown, Ball(mass=1.0), 1.0, speed=2.0) == {
        "thrown.speed": "is given twice, by its place and by its name"
    }


def test_calls_that_fit_are_what_they_were() -> None:
    ball = Ball(mass=0.2)
    assert (ball, thrown(ball, 2.0, spin=1.0)) == (Ball(mass=0.2, radius=1.0), (ball, 2.0, 1.0))
    assert pickle.loads(pickle.dumps(ball)) == ball
    assert thrown.__doc__ == "Return what is thrown."


def test_errors_inside_stay_what_they_are() -> None:
    with pytest.raises(TypeError, match="of its own"):
        Ball(mass=1.0, radius=-1.0)
    with pytest.raises(TypeError, match="indices"):
        thrown(Ball(mass=1.0), 1.0)[3.5]  # type: ignore[call-overload]
