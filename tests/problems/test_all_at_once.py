"""What is wrong with the hand of a file is told with all else that is wrong in it."""

from __future__ import annotations

import pytest

from synergrip.errors import InputError
from synergrip.problems.problem import load_problem

UNITLESS = "object.mass=3"


def refused(*overrides: str) -> list[tuple[str, str]]:
    with pytest.raises(InputError) as caught:
        load_problem("barrett-ball-hold", overrides)
    return [(issue.key, issue.message) for issue in caught.value.issues]


def test_names_of_hand_and_contacts_are_told_beside_a_missing_unit() -> None:
    told = refused(
        UNITLESS, "contacts.frction=0.7", "hand.close={sprad=1, finger4=1}", "hand.posture={spred='1 deg'}",
        "contact=[{link='finger9', stiffness='8 N/mm'}]", "contacts.at=['finger1/tp']",
    )  # fmt: skip
    assert sorted(key for key, _ in told) == [
        "contact[0].link", "contacts.at[0]", "contacts.frction", "hand.close.finger4", "hand.close.sprad",
        "hand.posture.spred", "object.mass",
    ]  # fmt: skip
    assert all("did you mean" in message for key, message in told if key in ("hand.close.sprad", "hand.posture.spred"))


@pytest.mark.parametrize(
    ("override", "keys"),
    [
        ("hand.close=3", ["hand.close", "object.mass"]),  # refused already: not judged again
        ("hand.posture={}", ["hand.posture", "object.mass"]),
        ("hand.model=baret", ["hand.model", "object.mass"]),  # of another hand nothing is known
        ("hand.colour=3", ["hand.colour", "object.mass"]),
        ("hand=3", ["hand", "object.mass"]),
        ("contact=[{at='finger9', stiffness='rigit'}]", ["contact[0].stiffness", "object.mass"]),
        ("schema=9", ["schema"]),
    ],
)
def test_nothing_is_told_twice_or_of_what_is_not_known(override: str, keys: list[str]) -> None:
    assert sorted(key for key, _ in refused(UNITLESS, override)) == keys


def test_posture_and_closing_are_judged_each_by_itself() -> None:
    told = refused("hand.posture=opn", "hand.close=clse", "object.position=['0 mm', '0 mm', '150 mm']")
    assert [key for key, _ in told] == ["hand.posture", "hand.close"]
