"""Numbers are told as people read them: without exponents, in units of their size, with digits that tell them apart."""

from __future__ import annotations

import pytest

from synergrip.documents.quantities import both_apart, in_g, in_mm, plain, read_as


@pytest.mark.parametrize(
    ("value", "digits", "said"),
    [
        (1e4, 4, "10000"), (12345.6, 3, "12300"), (-2e5, 4, "-200000"), (0.30412, 3, "0.304"), (0.0, 4, "0"),
        (3e9, 4, "3e+09"), (2e-6, 2, "2e-06"), (float("inf"), 4, "inf"),
    ],
)  # fmt: skip
def test_numbers_have_no_exponent_unless_they_are_far_from_one(value: float, digits: int, said: str) -> None:
    assert plain(value, digits) == said


def test_lengths_and_masses_are_in_the_unit_of_their_size() -> None:
    assert [in_mm(value) for value in (10.0, 1.0, 0.9, 0.0026, 0.0, -2.0)] == [
        "10 m", "1 m", "900 mm", "2.6 mm", "0 mm", "-2 m",
    ]  # fmt: skip
    assert [in_g(value) for value in (20.0, 1.0, 0.2)] == ["20 kg", "1 kg", "200 g"]


def test_a_value_and_its_limit_have_their_units_and_digits_that_tell_them_apart() -> None:
    assert both_apart(0.00013, 10.0, "m") == ("0.13 mm", "10 m")
    assert both_apart(10.00001, 10.0, "m") == ("10.00001 m", "10 m")
    assert both_apart(0.00200001, 0.002, "m") == ("2.00001 mm", "2 mm")
    assert both_apart(20000.0, 30000.0, "N") == ("20000 N", "30000 N")
    assert both_apart(0.5, 1.0, "") == ("0.5", "1")


def test_noise_of_the_arithmetic_is_told_as_zero() -> None:
    assert in_mm(2e-34) == in_mm(-3e-19) == "0 mm"
    assert in_mm(2e-12) == "2e-09 mm"
    assert both_apart(-4e-17, 0.0, "N") == ("0 N", "0 N")
    assert both_apart(2e-34, 1e-3, "m") == ("0 mm", "1 mm")
    assert read_as(1e-15, "rad") == "0 deg"
    assert read_as(1e-15, "") == "1e-15", "what is no quantity is told as it is"
