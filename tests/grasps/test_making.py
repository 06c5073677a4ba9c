"""Grasps made in code: the same values as from a file, and arguments judged by name."""

from __future__ import annotations

import math
import pickle
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from random_grasps import random_grasp

import synergrip as sg
from synergrip.errors import InputError
from synergrip.grasps.objects import turn
from synergrip.hands.hand import Hand, Joint, Pad, SynergySet
from synergrip.linalg import frozen

HARD = sg.HardFinger(friction=0.6)
TIPS = ("finger1/tip", "finger2/tip", "finger3/tip")
BALL = sg.Object(mass=0.2, shape=sg.Sphere(radius=0.05))
BARRETT = sg.load_hand("barrett")


def tips(kind: sg.ContactKind = HARD, **stiffness: float) -> list[sg.ContactAt]:
    return [sg.ContactAt(tip, kind, **({"stiffness": 8e3} | stiffness)) for tip in TIPS]


def ball(**changes: Any) -> sg.Grasp:
    given: dict[str, Any] = {"hand": BARRETT, "object": BALL, "posture": "ball", "synergies": "motors"}
    return sg.make_grasp(**(given | {"contacts": tips()} | changes))


def loaded(name: str, *overrides: str) -> sg.Grasp:
    """The grasp of a file, before a task puts its load on it."""
    return replace(sg.load_problem(name, overrides).grasp, w_0=np.zeros(6))


def equal(made: sg.Grasp, expected: sg.Grasp) -> bool:
    """Arrays to the last digit, and everything else but the title."""
    return replace(made, title="") == replace(expected, title="")


def test_a_hold_with_fingertips() -> None:
    assert equal(ball(), loaded("barrett-ball-hold"))
    assert equal(ball(hand="barrett"), loaded("barrett-ball-hold"))
    assert equal(ball(posture=BARRETT.postures["ball"]), loaded("barrett-ball-hold"))
    assert not equal(ball(contacts=tips(sg.HardFinger(friction=0.61))), loaded("barrett-ball-hold"))


def test_a_hand_that_closes_on_what_it_is_told_to() -> None:
    overrides = [
        "hand.posture=open", "hand.close=close", "object.position=['0 mm','0 mm','110 mm']",
        "hand.compliance={joint='0.01 rad/(N m)', synergy=[0.1, 0.2, 0.3, 0.4]}",
    ]  # fmt: skip
    made = ball(
        posture="open", close="close", object=replace(BALL, position=np.array([0, 0, 0.11])), joint_compliance=0.01,
        synergy_compliance=[0.1, 0.2, 0.3, 0.4],
    )  # fmt: skip
    assert equal(made, loaded("barrett-ball-hold", *overrides))


def test_a_bar_that_lies_across_between_five_contacts() -> None:
    shape = sg.Turned(sg.Cylinder(radius=0.035, height=0.12), turn((1, 0, 0), math.radians(90)))
    bar = sg.Object(title="bar", shape=shape, mass=0.5, position=np.array([0, 0, 0.05504]))
    pads = ("palm", "left/tip", "right/tip", "left/proximal", "right/proximal")
    contacts = [sg.ContactAt(p, sg.HardFinger(friction=0.8), stiffness=8e3, tangential_stiffness=4e3) for p in pads]
    made = sg.make_grasp("gripper", bar, posture="bar", synergies="synergies", contacts=contacts)
    assert equal(made, loaded("gripper-bar"))


def test_a_peg_between_soft_fingers() -> None:
    peg = sg.Object(title="peg", mass=0.1, shape=sg.Box(size=(0.04, 0.03, 0.06)), position=np.array([0, 0, 0.12]))
    soft = sg.SoftFinger(friction=0.6, spin_friction=0.005)
    contacts = [sg.ContactAt(f"{side}/tip", soft, stiffness=8e3, spin_stiffness=2.0) for side in ("left", "right")]
    assert equal(
        sg.make_grasp("gripper", peg, posture="box", synergies="synergies", contacts=contacts), loaded("gripper-peg")
    )


def test_a_place_on_a_link_rigid_and_with_a_tangent() -> None:
    pad = BARRETT.pads[TIPS[2]]
    place = sg.LinkPlace(pad.link, tuple(pad.point), tuple(pad.normal), pad.radius)
    ridged = sg.EllipticSoftFinger(friction=0.6, cross_friction=0.4, spin_friction=0.005)
    third = sg.ContactAt(place, ridged, stiffness=math.inf, tangential_stiffness=8e3, spin_stiffness=2.0,
                         tangent=(0.0, 3.0, 4.0), normals="object", name="third")  # fmt: skip
    entry = (
        f"{{link='{pad.link}', point=[{', '.join(repr(f'{1e3 * x!r} mm') for x in pad.point.tolist())}], "
        f"normal={pad.normal.tolist()}, radius='{1e3 * pad.radius!r} mm', tangent=[0, 3, 4], name='third', "
        "model='soft-elliptic', cross_friction=0.4, spin_friction='5 mm', stiffness='rigid', normals='object', "
        "tangential_stiffness='8 N/mm', spin_stiffness='2 N m/rad'}"
    )
    if not pad.radius:
        entry = entry.replace("radius='0.0 mm', ", "")
    expected = loaded("barrett-ball-hold", f"contacts.at=['{TIPS[0]}','{TIPS[1]}']", f"contact=[{entry}]")
    made = ball(contacts=[*tips()[:2], third])
    assert made.components == expected.components
    for name in ("G", "J", "C_s"):
        np.testing.assert_allclose(getattr(made, name), getattr(expected, name), rtol=0, atol=1e-12)
    frame, held = made.contacts[2].frame, made.held
    assert held is not None
    motion = BARRETT.kinematics.at(held.q, [(pad.link, pad.point)])[0]
    wish = motion.rotation @ [0, 0.6, 0.8]
    across = wish - (wish @ frame[:, 0]) * frame[:, 0]
    np.testing.assert_allclose(frame[:, 1], across / np.linalg.norm(across), atol=1e-12)
    assert made.C_s[6, 6] == 0


def matrices(grasp: sg.Grasp) -> dict[str, Any]:
    names = ("G", "J", "S", "C_s", "C_q", "C_z", "joints", "synergies")
    return {name: getattr(grasp, name) for name in names} | {"contacts": [(c.name, c.kind) for c in grasp.contacts]}


@pytest.mark.parametrize("name", ["pinch-soft", "tripod"])
def test_matrices_of_a_file(name: str) -> None:
    expected = loaded(name)
    told = sg.read_matrices(Path(sg.load_problem(name).path).parent / sg.load_problem(name).file.grasp.file)  # type: ignore[union-attr]
    made = sg.grasp_from_matrices(
        G=told.G, J=told.J, S=told.S, C_s=told.C_s, C_q=told.C_q, C_z=told.C_z, contacts=told.contacts
    )
    assert equal(made, expected)
    assert sg.read_matrices.__module__ == "synergrip.grasps.matrices"


@pytest.mark.parametrize("seed", range(10))
def test_matrices_alone_say_where_contacts_are(seed: int) -> None:
    grasp = random_grasp(np.random.default_rng(seed))
    made = sg.grasp_from_matrices(**matrices(grasp))
    assert [contact.kind for contact in made.contacts] == [contact.kind for contact in grasp.contacts]
    np.testing.assert_allclose(
        [c.frame[:, 0] for c in made.contacts], [c.frame[:, 0] for c in grasp.contacts], atol=1e-9
    )
    listed = {name: v.tolist() if isinstance(v, np.ndarray) else v for name, v in matrices(grasp).items()}
    assert sg.grasp_from_matrices(**listed) == made


def test_a_load_at_the_start_is_what_the_forces_balance() -> None:
    grasp = random_grasp(np.random.default_rng(3))
    forces = np.arange(grasp.n_l, dtype=float)
    made = sg.grasp_from_matrices(**matrices(grasp), lambda_0=forces)
    np.testing.assert_allclose(made.w_0, -grasp.G @ forces)
    with pytest.raises(InputError, match="does not hold") as caught:
        sg.grasp_from_matrices(**matrices(grasp), lambda_0=forces, w_0=np.ones(6))
    assert caught.value.issues[0].key == "w_0"
    with pytest.raises(InputError, match="does not hold") as caught:
        replace(grasp, lambda_0=forces)
    assert caught.value.issues[0].key == "Grasp.w_0"


# mistakes

NAN = float("nan")
EYE = np.eye(3)


@pytest.mark.parametrize(
    ("changes", "key", "fragment"),
    [
        ({"hand": "barett"}, "hand", "did you mean 'barrett'?"),
        ({"hand": 3}, "hand", "expected a Hand"),
        ({"hand": None}, "hand", "expected a Hand"),
        ({"object": sg.Sphere(radius=0.05)}, "object", "expected an Object such as"),
        ({"object": sg.Object}, "object", "the class Object itself"),
        ({"object": sg.Object(mass=0.2, shape=sg.Sphere(radius=0.02))}, "object.shape.radius", "cannot touch all pads"),
        ({"posture": "bal"}, "posture", "did you mean 'ball'?"),
        ({"posture": None}, "posture", "missing; name one of open, ball"),
        ({"posture": np.zeros(3)}, "posture", "expected shape (8,)"),
        ({"posture": {"finger1": NAN}}, "posture.finger1", "that is finite"),
        ({"posture": {"finger9": 1.0}}, "posture.finger9", "did you mean"),
        ({"posture": {"finger1": "60 deg"}}, "posture.finger1", "expected a number in rad or m, got '60 deg'"),
        ({"posture": np.full(8, 50.0)}, "posture", "joint"),
        ({"posture": 3.0}, "posture", "expected shape (8,)"),
        ({"synergies": "motor"}, "synergies", "did you mean 'motors'?"),
        ({"synergies": 9}, "synergies", "expected 1 to"),
        ({"synergies": 2.5}, "synergies", "expected a number of synergies"),
        ({"synergies": True}, "synergies", "expected a number of synergies"),
        ({"synergies": ["finger1", "nothing"]}, "synergies[1]", "'nothing' is not one of"),
        ({"contacts": []}, "contacts", "no contacts"),
        ({"contacts": TIPS}, "contacts[0]", "expected a ContactAt such as"),
        ({"contacts": TIPS[0]}, "contacts", "expected a list"),
        ({"contacts": [*tips(), *tips()[:1]]}, "contacts[3].name", "two contacts have the name"),
        (
            {"contacts": [sg.ContactAt("finger1/tp", HARD, stiffness=1e3)]},
            "contacts[0].at",
            "did you mean 'finger1/tip'",
        ),
        ({"contacts": [sg.ContactAt(sg.LinkPlace("plam"), HARD, stiffness=1e3)]}, "contacts[0].at", "is not one of"),
        ({"close": "clsoe"}, "object.position", "it must be known where the object is"),
        ({"close": 3}, "close", "expected the name of a synergy or joint"),
        ({"close": {"close": "a"}}, "close.close", "expected a number, got 'a'"),
        ({"joint_compliance": -1.0}, "joint_compliance", "must not be negative"),
        ({"joint_compliance": [1.0, 2.0]}, "joint_compliance", "2 values for 8 joints"),
        ({"joint_compliance": np.eye(8)}, "joint_compliance", "expected a number or 8 numbers"),
        ({"joint_compliance": "soft"}, "joint_compliance", "expected a number"),
        ({"synergy_compliance": NAN}, "synergy_compliance", "finite numbers, got nan"),
        ({"synergy_compliance": 1e12}, "synergy_compliance", "is too large"),
        ({"title": 3}, "title", "expected a text"),
    ],
)
def test_mistakes_in_make_grasp(changes: dict[str, Any], key: str, fragment: str) -> None:
    with pytest.raises(InputError) as caught:
        ball(**changes)
    assert any(issue.key == key and fragment in issue.message for issue in caught.value.issues), caught.value


@pytest.mark.parametrize(
    ("make", "key", "fragment"),
    [
        (lambda: sg.Sphere(radius=-1), "Sphere.radius", "must be greater than 0, got -1"),
        (lambda: sg.Sphere(radius="50 mm"), "Sphere.radius", "expected a number in m, got '50 mm'"),
        (lambda: sg.Box(size=(1, 2)), "Box.size", "expected shape (3,): three edge lengths, got (2,)"),
        (lambda: sg.Box(size=(1, 2, 0)), "Box.size", "greater than 0, got 0"),
        (lambda: sg.Box(size=3), "Box.size", "got ()"),
        (lambda: sg.Cylinder(radius=0.1, height=NAN), "Cylinder.height", "that is finite, got nan"),
        (lambda: sg.Turned(sg.Sphere(radius=1), 2 * EYE), "Turned.rotation", "is no rotation matrix"),
        (lambda: sg.Turned(sg.Sphere(radius=1), -EYE), "Turned.rotation", "is no rotation matrix"),
        (lambda: sg.Turned("ball", EYE), "Turned.shape", "expected a Shape"),
        (lambda: sg.Object(mass=-0.1), "Object.mass", "must be 0 or more, got -0.1"),
        (lambda: sg.Object(mass=None), "Object.mass", "expected a number in kg, got null"),
        (lambda: sg.Object(mass=1, shape="ball"), "Object.shape", "expected a Shape"),
        (lambda: sg.Object(mass=1, position=(0, 0)), "Object.position", "expected shape (3,)"),
        (lambda: sg.Object(mass=1, position=(0, 0, NAN)), "Object.position", "finite numbers, got nan"),
        (
            lambda: sg.ContactAt(3, HARD, stiffness=1e3),
            "ContactAt.at",
            "expected the name of a pad or a LinkPlace, got 3",
        ),
        (lambda: sg.ContactAt("a", "hard", stiffness=1e3), "ContactAt.kind", "got 'hard'"),
        (lambda: sg.ContactAt("a", sg.HardFinger, stiffness=1e3), "ContactAt.kind", "the class HardFinger itself"),
        (lambda: sg.ContactAt("a", HARD), "ContactAt.stiffness", "missing; a hard contact needs it, in N/m"),
        (lambda: sg.ContactAt("a", HARD, stiffness=0), "ContactAt.stiffness", "must be 1e-06 or more"),
        (lambda: sg.ContactAt("a", HARD, stiffness="8 N/mm"), "ContactAt.stiffness", "expected a number in N/m"),
        (lambda: sg.ContactAt("a", HARD, stiffness=1, spin_stiffness=1), "ContactAt.spin_stiffness", "has no spin"),
        (lambda: sg.ContactAt("a", HARD, stiffness=1, normals="pads"), "ContactAt.normals", "did you mean 'pad'"),
        (lambda: sg.ContactAt("a", HARD, stiffness=1, tangent=(0, 0, 0)), "ContactAt.tangent", "must not be zero"),
        (lambda: sg.ContactAt("a", HARD, stiffness=1, name=3), "ContactAt.name", "expected a text"),
        (lambda: sg.LinkPlace(""), "LinkPlace.link", "expected a name"),
        (lambda: sg.LinkPlace("a", (0, 0)), "LinkPlace.point", "expected shape (3,)"),
        (lambda: sg.LinkPlace("a", radius=-1), "LinkPlace.radius", "must be 0 or more"),
        (lambda: sg.Contact(name="", kind=HARD, point=EYE[0], frame=EYE), "Contact.name", "expected a name"),
        (lambda: sg.Contact(name="C", kind="hard", point=EYE[0], frame=EYE), "Contact.kind", "got 'hard'"),
        (lambda: sg.Contact(name="C", kind=HARD, point=(0, 1), frame=EYE), "Contact.point", "expected shape (3,)"),
        (lambda: sg.Contact(name="C", kind=HARD, point=EYE[0], frame=2 * EYE), "Contact.frame", "unit vectors"),
        (lambda: Joint(name="j", kind="ball"), "Joint.kind", "'ball' is not one of 'hinge' or 'slide'"),
        (lambda: Joint(name="j", kind="hinge", lower=1, upper=0), "Joint.upper", "must not be below lower"),
        (lambda: Joint(name="j", kind="hinge", torque_limit=0), "Joint.torque_limit", "must be greater than 0"),
        (lambda: Pad(name="p", link="l", point=(0, 0), normal=EYE[0]), "Pad.point", "expected shape (3,)"),
        (lambda: Pad(name="p", link="l", point=EYE[0], normal=2 * EYE[0]), "Pad.normal", "got length 2"),
        (lambda: SynergySet(name="s", synergies=("a",), S=np.eye(2)), "SynergySet.synergies", "expected 2 names"),
        (lambda: SynergySet(name="s", synergies=("a", "a"), S=np.eye(2)), "SynergySet.synergies[1]", "name of two"),
        (lambda: SynergySet(name="s", synergies=("a",), S=[1, 2]), "SynergySet.S", "expected shape (0, 0)"),
        (lambda: replace(BARRETT, joints=BARRETT.joints[1:]), "Hand.C_q", "expected shape (7, 7)"),
        (lambda: replace(BARRETT, C_q=NAN), "Hand.C_q", "finite numbers, got nan"),
        (lambda: replace(BARRETT, synergy_sets={}), "Hand.synergy_sets", "expected at least one"),
        (lambda: replace(BARRETT, pads={"a": 3}), "Hand.pads['a']", "expected a Pad"),
    ],
)
def test_mistakes_in_values(make: Any, key: str, fragment: str) -> None:
    with pytest.raises(InputError) as caught:
        make()
    assert any(issue.key == key and fragment in issue.message for issue in caught.value.issues), caught.value


@pytest.mark.parametrize(
    ("changes", "key", "fragment"),
    [
        ({"G": np.zeros((6, 5))}, "G", "expected shape (6, 12)"),
        ({"J": np.zeros((3, 4))}, "J", "expected shape (12, n_q)"),
        ({"S": np.ones((2, 2))}, "S", "expected shape"),
        ({"C_s": None}, "C_s", "got null"),
        ({"C_s": -1e-4}, "C_s", "must not be negative"),
        ({"C_s": np.ones(12)}, "C_s", "np.diag"),
        ({"C_s": 1e12}, "C_s", "is too large"),
        ({"C_q": NAN}, "C_q", "finite numbers"),
        ({"G": 1j * np.ones((6, 12))}, "G", "expected an array of shape (6, 12), got an array"),
        ({"G": [[1, 2], [3]]}, "G", "expected an array of shape (6, 12), got a list"),
        ({"contacts": []}, "contacts", "expected a list such as"),
        ({"contacts": ["C1", "C2"]}, "contacts[0]", "expected a pair such as"),
        ({"contacts": [("C1", HARD), ("C2", "hard")]}, "contacts[1][1]", "expected a ContactKind"),
        ({"contacts": [("", HARD)]}, "contacts[0][0]", "expected a name"),
        ({"contacts": [("C", HARD)] * 4}, "contacts[1]", "'C' is the name of two"),
        ({"contacts": HARD}, "contacts", "expected a list such as"),
        ({"joints": ["a"]}, "joints", "names, one for each joint"),
        ({"synergies": "ab"}, "synergies", "names, one for each synergy"),
        ({"lambda_0": np.zeros(3)}, "lambda_0", "expected shape (12,)"),
        ({"w_0": [1, 2, 3]}, "w_0", "expected shape (6,)"),
        ({"title": None}, "title", "expected a text"),
    ],
)
def test_mistakes_in_grasp_from_matrices(changes: dict[str, Any], key: str, fragment: str) -> None:
    grasp = random_grasp(np.random.default_rng(0), kinds=["hard"] * 4)
    with pytest.raises(InputError) as caught:
        sg.grasp_from_matrices(**(matrices(grasp) | changes))
    assert any(issue.key == key and fragment in issue.message for issue in caught.value.issues), caught.value


@pytest.mark.parametrize(
    ("make", "key", "fragment"),
    [
        (lambda: sg.HardFinger(), "HardFinger.friction", "missing"),
        (lambda: sg.HardFinger(fricton=0.6), "HardFinger.fricton", "did you mean 'friction'?"),
        (lambda: sg.HardFinger(0.6), "HardFinger", "a value without a name; write friction=..."),
        (lambda: sg.SoftFinger(friction=0.6), "SoftFinger.spin_friction", "missing"),
        (lambda: sg.Frictionless(friction=0.6), "Frictionless.friction", "no such argument"),
        (lambda: sg.Sphere(), "Sphere.radius", "missing"),
        (lambda: sg.Sphere(0.05, radius=0.05), "Sphere.radius", "given twice"),
        (lambda: sg.Object(weight=2.0), "Object.weight", "there are mass, shape, position, title"),
        (lambda: sg.ContactAt("a"), "ContactAt.kind", "missing"),
        (lambda: sg.ContactAt("a", HARD, stifness=1e3), "ContactAt.stifness", "did you mean 'stiffness'?"),
        (lambda: sg.make_grasp(BARRETT, BALL, contacts=tips()), "posture", "missing"),
        (lambda: sg.make_grasp(BARRETT, BALL, postur="ball", contacts=tips()), "postur", "did you mean 'posture'?"),
        (lambda: sg.grasp_from_matrices(G=EYE), "C_s", "missing"),
        (lambda: sg.Grasp("title"), "Grasp", "a value without a name"),
        (lambda: replace(BALL, mas=3.0), "Object.mas", "did you mean 'mass'?"),
    ],
)
def test_arguments_that_are_missing_misspelt_or_without_a_name(make: Any, key: str, fragment: str) -> None:
    with pytest.raises(InputError) as caught:
        make()
    assert any(issue.key == key and fragment in issue.message for issue in caught.value.issues), caught.value


def test_a_type_error_from_further_inside_is_not_hidden() -> None:
    class Odd(sg.HardFinger):
        @property
        def least_friction(self) -> float:
            raise TypeError("odd")

    with pytest.raises(TypeError, match="odd"):
        sg.make_grasp(BARRETT, BALL, posture="ball", contacts=tips(Odd(friction=0.5))).contacts[0].friction  # noqa: B018


# values


def test_values_compare_by_content_hash_pickle_and_are_told_in_a_line() -> None:
    grasp = ball()
    again = ball(hand=sg.load_hand("barrett"))
    values: list[tuple[Any, Any]] = [
        (grasp, again), (grasp.held, again.held), (grasp.contacts[0], again.contacts[0]), (BALL, replace(BALL)),
        (BARRETT, sg.load_hand("barrett")), (tips()[0], tips()[0]),
        (BARRETT.synergy_sets["motors"], replace(BARRETT.synergy_sets["motors"])),
        (sg.Turned(sg.Box(size=(1, 2, 3)), EYE), sg.Turned(sg.Box(size=(1, 2, 3)), EYE.copy())),
    ]  # fmt: skip
    for one, other in values:
        assert one == other
        assert hash(one) == hash(other)
        copy = pickle.loads(pickle.dumps(one))
        assert copy == one
        assert one != 3
        assert len({one, other, copy}) == 1
    for value in (grasp, BARRETT, grasp.held, grasp.contacts[0], BARRETT.synergy_sets["motors"], BALL, tips()[0]):
        assert len(repr(value)) < 700
        assert "\n" not in repr(value)
    assert "9 x 8 x 4" in repr(grasp)
    assert grasp != replace(grasp, C_s=2e-4)
    assert replace(BALL, position=np.zeros(3)) != BALL


def test_hands_of_other_geometry_are_other_hands() -> None:
    """Names, ranges and compliance may all be the same: where links are decides."""
    from small_hands import hand_of, hinge

    def finger(length: float) -> Hand:
        return hand_of([hinge("a", "palm", (0, 0, 0)), hinge("b", "a_link", (length, 0, 0))])

    assert finger(0.05) == finger(0.05)
    assert finger(0.05) != finger(0.06)


def test_a_pickled_hand_still_moves() -> None:
    hand = pickle.loads(pickle.dumps(BARRETT))
    q = BARRETT.postures["ball"]
    place = [(BARRETT.pads[TIPS[0]].link, np.zeros(3))]
    assert hand.kinematics.at(q, place) == BARRETT.kinematics.at(q, place)
    assert equal(ball(hand=hand), ball())


# variations


def test_friction_of_all_and_of_one() -> None:
    grasp = ball()
    assert equal(grasp.replace(friction=0.4), ball(contacts=tips(sg.HardFinger(friction=0.4))))
    one = grasp.replace(friction=0.4, contact={TIPS[1]: sg.HardFinger(friction=0.9)})
    assert [contact.friction for contact in one.contacts] == [0.4, 0.9, 0.4]
    assert [touch.kind.least_friction for touch in one.held.touches] == [0.4, 0.9, 0.4]  # type: ignore[union-attr]
    ridged = sg.EllipticSoftFinger(friction=0.8, cross_friction=0.4, spin_friction=0.01)
    assert ridged.with_friction(0.4) == sg.EllipticSoftFinger(friction=0.4, cross_friction=0.2, spin_friction=0.01)


def test_another_kind_has_other_rows() -> None:
    soft = sg.SoftFinger(friction=0.5, spin_friction=0.004)
    grasp = ball(contacts=tips(soft, spin_stiffness=2.0))
    changed = grasp.replace(contact=dict.fromkeys(TIPS, HARD))
    for name in ("G", "J", "C_s"):
        np.testing.assert_allclose(getattr(changed, name), getattr(ball(), name), rtol=0, atol=1e-15)
    mixed = grasp.replace(contact={TIPS[0]: sg.Frictionless()})
    assert [contact.n_rows for contact in mixed.contacts] == [1, 4, 4]
    with pytest.raises(InputError, match="needs spin_stiffness, which contact 'finger1/tip' has not"):
        ball().replace(contact={TIPS[0]: soft})
    given = sg.grasp_from_matrices(**matrices(grasp))
    fewer = given.replace(contact=dict.fromkeys(TIPS, HARD))
    np.testing.assert_allclose(fewer.J, ball().J, atol=1e-15)
    with pytest.raises(InputError, match="the matrices say nothing of m of this hard contact"):
        fewer.replace(contact={TIPS[0]: soft})


def test_mass_and_compliance() -> None:
    grasp = ball().replace(mass=0.5, C_s=1e-4, C_q=0.01, title="heavy")
    assert grasp.held is not None
    assert (grasp.held.body.mass, grasp.title) == (0.5, "heavy")
    assert np.array_equal(grasp.held.C_q, 0.01 * np.eye(8))
    assert np.array_equal(grasp.C_s, 1e-4 * np.eye(9))
    assert grasp.held.body.position is not None


@pytest.mark.parametrize(
    ("changes", "key", "fragment"),
    [
        ({"friction": 0}, "friction", "must be greater than 0"),
        ({"friction": NAN}, "friction", "that is finite"),
        ({"frction": 0.5}, "frction", "did you mean 'friction'?"),
        ({"contact": {"finger1": HARD}}, "contact['finger1']", "is not one of"),
        ({"contact": {TIPS[0]: 0.4}}, "contact['finger1/tip']", "expected a ContactKind"),
        ({"contact": HARD}, "contact", "expected kinds by name of contact"),
        ({"mass": -1.0}, "Object.mass", "must be 0 or more"),
        ({"C_s": "soft"}, "Grasp.C_s", "expected a number"),
    ],
)
def test_mistakes_in_variations(changes: dict[str, Any], key: str, fragment: str) -> None:
    with pytest.raises(InputError) as caught:
        ball().replace(**changes)
    assert any(issue.key == key and fragment in issue.message for issue in caught.value.issues), caught.value


def test_a_grasp_of_matrices_has_no_mass_to_change() -> None:
    with pytest.raises(InputError, match="is given as matrices, and has no object"):
        random_grasp(np.random.default_rng(0)).replace(mass=1.0)


def test_arrays_of_values_cannot_be_changed() -> None:
    mine = np.eye(9) * 1e-4
    grasp = replace(ball(), C_s=mine)
    mine[0, 0] = 5.0
    assert grasp.C_s[0, 0] == 1e-4
    with pytest.raises(ValueError, match="read-only"):
        grasp.C_s[0, 0] = 1.0
    assert frozen(mine)[0, 0] == 5.0


def test_all_six_rows_of_a_patch_are_motions_of_the_link_and_of_the_object() -> None:
    """Finite differences: of the joints for J, of a moved object for G."""
    patch = sg.PatchContact(friction=0.6, spin_friction=0.004, patch_radius=0.007)
    grasp = ball(contacts=tips(patch, spin_stiffness=2.0, tilt_stiffness=3.0))
    held, step = grasp.held, 1e-6
    assert held is not None
    assert grasp.components[:6] == tuple((TIPS[0], c) for c in ("n", "t", "o", "m", "m_t", "m_o"))
    assert np.diag(grasp.C_s)[:6] == pytest.approx([1 / 8e3] * 3 + [1 / 2, 1 / 3, 1 / 3])
    links = [(touch.pad.link, touch.pad.point) for touch in held.touches]
    start = BARRETT.kinematics.at(held.q, links)
    for joint in range(grasp.n_q):
        ahead, behind = (BARRETT.kinematics.at(held.q + s * step * np.eye(8)[joint], links) for s in (1, -1))
        for contact, rows, now, a, b in zip(grasp.contacts, grasp.rows, start, ahead, behind, strict=True):
            arm = now.rotation.T @ (contact.point + held.body.position - now.position)
            velocity = (a.position + a.rotation @ arm - b.position - b.rotation @ arm) / (2 * step)
            spin = (a.rotation - b.rotation) @ now.rotation.T / (2 * step)
            omega = np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
            expected = np.concatenate([contact.frame.T @ velocity, contact.frame.T @ omega])
            np.testing.assert_allclose(grasp.J[rows, joint], expected, atol=1e-8)
    twist = np.array([0.3, -0.2, 0.5, 1.0, -2.0, 0.7])
    for contact, rows in zip(grasp.contacts, grasp.rows, strict=True):
        moved = contact.frame.T @ (twist[:3] + np.cross(twist[3:], contact.point))
        np.testing.assert_allclose(grasp.G[:, rows].T @ twist, [*moved, *(contact.frame.T @ twist[3:])], atol=1e-12)
