import math

import pytest

from synergrip.documents.quantities import EXAMPLES, UNITS, quantity, ratio
from synergrip.errors import InputError


def message(call, *args):
    with pytest.raises(InputError) as caught:
        call(*args)
    (issue,) = caught.value.issues
    return issue.message


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("10 mm", "length", 0.01),
        ("-2.5e1cm", "length", -0.25),
        (" 180   deg ", "angle", math.pi),
        ("200 g", "mass", 0.2),
        ("2 min", "time", 120.0),
        (".5 kN", "force", 500.0),
        ("1.5 N  m", "torque", 1.5),
        ("8 N/mm", "stiffness", 8000.0),
        ("2 N mm/rad", "spin stiffness", 0.002),
        ("180 deg/(N m)", "joint compliance", math.pi),
        ("0.1 mm/N", "slide compliance", 1e-4),
    ],
)
def test_quantities_become_si(text, kind, value):
    assert quantity(text, kind) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize("kind", UNITS)
def test_every_kind_has_an_example_that_is_accepted(kind):
    assert math.isfinite(quantity(EXAMPLES[kind], kind))


@pytest.mark.parametrize("kind", UNITS)
def test_every_kind_has_an_si_unit(kind):
    assert 1.0 in UNITS[kind].values()


@pytest.mark.parametrize(
    ("text", "kind", "fragment"),
    [
        ("10", "length", 'missing unit; write "10 mm"'),
        (10, "length", '10 has no unit; expected a length such as "10 mm"'),
        (40, "force", 'such as "40 N" (units: N, mN, kN)'),
        (0.2, "mass", 'such as "0.2 kg" (units'),
        (8, "stiffness", 'such as "8 N/mm"'),
        ("2", "joint compliance", 'write "2 rad/(N m)"'),
        ("\u0661\u0660 mm", "length", "is not a length"),
        (True, "angle", "expected an angle such as"),
        ("10 MM", "length", "unknown unit 'MM'"),
        ("10 kg", "length", "'kg' is a unit of mass"),
        ("ten mm", "length", "'ten mm' is not a length"),
        ("1e999 m", "length", "is not finite"),
        ("nan m", "length", "is not a length"),
        ("", "force", "is not a force"),
    ],
)
def test_what_is_no_quantity_is_refused(text, kind, fragment):
    assert fragment in message(quantity, text, kind)


def test_the_key_stands_in_the_issue():
    with pytest.raises(InputError) as caught:
        quantity("1", "force", "limits.margin")
    assert caught.value.issues[0].key == "limits.margin"


@pytest.mark.parametrize(("written", "value"), [(2, 2.0), (0.5, 0.5), ("1/3", 1 / 3), ("0.25", 0.25), ("-1/4", -0.25)])
def test_ratios(written, value):
    assert ratio(written) == value


@pytest.mark.parametrize(
    "written", ["1/0", "a", "1/2/3", "", True, None, [1], "nan", "inf", float("nan"), 10**400, "\u0661", "1_0"]
)
def test_what_is_no_ratio_is_refused(written):
    assert "is not" in message(ratio, written)
