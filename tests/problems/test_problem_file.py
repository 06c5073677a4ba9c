import json
import math
import re
import subprocess
import sys
from pathlib import Path

import pytest

from synergrip.errors import InputError
from synergrip.grasps.contact_at import LinkPlace
from synergrip.grasps.contacts.frictionless import Frictionless
from synergrip.grasps.contacts.soft_finger import SoftFinger
from synergrip.problems.problem_file import problem_schema, read_problem_file

DATA = Path(__file__).parent.parent / "data" / "bad_inputs"
HAND = DATA / "hand.toml"


def read(*overrides):
    return read_problem_file(HAND, overrides)[0]


def issues(*overrides):
    with pytest.raises(InputError) as caught:
        read(*overrides)
    return [(issue.key, issue.message) for issue in caught.value.issues]


def test_quantities_are_in_si():
    problem = read(
        "hand.posture={close='60 deg'}", "hand.compliance.joint='0.025 rad/(N m)'", "task.move[0].roll='90 deg'"
    )
    assert problem.object.shape.sphere.radius == pytest.approx(0.045)
    assert problem.object.mass == pytest.approx(0.2)
    assert problem.hand.posture == {"close": pytest.approx(math.pi / 3)}
    assert problem.hand.compliance.joint == 0.025
    assert problem.task.duration == 2.0
    assert problem.task.gravity == (0.0, 0.0, -9.81)
    assert problem.task.move[0].axis == (0.0, 0.0, 1.0)
    assert problem.task.move[0].lift == pytest.approx(0.01)
    assert problem.task.move[0].roll == pytest.approx(math.pi / 2)
    assert problem.limits.margin == 0.5
    assert problem.limits.normal_force == (0.0, 20.0)


def test_defaults():
    problem, document = read_problem_file(DATA / "matrices.toml")
    assert problem.grasp.file == "grasp.json"
    assert problem.task.duration == 1.0
    assert (problem.task.tracking, problem.task.move, problem.task.gravity) == ("rigid", (), None)
    assert problem.limits.margin == 0.0
    assert problem.limits.normal_force is None
    assert problem.goal.names == ("effort",)
    assert problem.output.write == ()
    assert problem.contact_list() == ()
    assert read("goal={}").goal == problem.goal
    assert document.path.name == "matrices.toml"


@pytest.mark.parametrize(
    ("override", "table", "name", "value"),
    [
        ("limits.normal_force=['1 N', '2 N']", "limits", "normal_force", (1.0, 2.0)),
        ("limits.joint_torque=hand", "limits", "joint_torque", "hand"),
        ("limits.joint_torque=1500 N mm", "limits", "joint_torque", 1.5),
        ("limits.actuator_effort=[1, '2 N m']", "limits", "actuator_effort", (1.0, 2.0)),
        ("limits.synergy_reference=0.5", "limits", "synergy_reference", 0.5),
        ("limits.synergy_rate=[1, 2]", "limits", "synergy_rate", (1.0, 2.0)),
        ("goal={maximise='margin'}", "goal", "names", ("margin",)),
        ("hand.synergies=['close', 'spread']", "hand", "synergies", ("close", "spread")),
        ("hand.synergies=all", "hand", "synergies", "all"),
        ("hand.posture=open", "hand", "posture", "open"),
        ("hand.close=close", "hand", "close", "close"),
        ("hand.close=-close", "hand", "close", "-close"),
        ("hand.close={s1=-1, s2=0.2}", "hand", "close", {"s1": -1.0, "s2": 0.2}),
        ("hand.coupling=1/4", "hand", "coupling", 0.25),
        ("hand.coupling={finger1=1, finger2='1/2'}", "hand", "coupling", {"finger1": 1.0, "finger2": 0.5}),
        ("hand.compliance.joint=['1 rad/(N m)', '0 rad/(N m)']", "hand", "compliance.joint", (1.0, 0.0)),
        ("hand.compliance.synergy=0", "hand", "compliance.synergy", 0.0),
        ("object.shape={box={size=['1 m', '2 m', '3 cm']}}", "object", "shape.box.size", (1.0, 2.0, 0.03)),
        ("object.shape={cylinder={radius='1 m',height='2 m'}}", "object", "shape.cylinder.height", 2.0),
        ("object.position=['0 m', '-1 m', '3 cm']", "object", "position", (0.0, -1.0, 0.03)),
        ("object.orientation={axis='y', angle='90 deg'}", "object", "orientation.axis", (0.0, 1.0, 0.0)),
        ("object.orientation={axis=[0, 3, 4], angle='180 deg'}", "object", "orientation.angle", math.pi),
        ("task.palm={axis=[0, 3, 4], turn='-90 deg'}", "task", "palm.axis", (0.0, 0.6, 0.8)),
        ("task.wrench=[1, 2, 3, 4, 5, 6]", "task", "wrench", (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)),
        ("task.wrench=w.csv", "task", "wrench", "w.csv"),
        ("task.tolerance=0.5 mm", "task", "tolerance", 0.0005),
        ("output.write=['json', 'npz']", "output", "write", ("json", "npz")),
        ("expect={verdict='feasible', dims=[3, 1, 2], note='free'}", "expect", "dims", (3, 1, 2)),
    ],
)
def test_every_form_of_a_value(override, table, name, value):
    found = getattr(read(override), table)
    for part in name.split("."):
        found = getattr(found, part)
    assert found == value


def test_moves_along_modes():
    problem = read("task.move=[{mode=2, amplitude='-3 mm', profile='cubic'}]")
    (move,) = problem.task.move
    assert (move.mode, move.amplitude, move.profile, move.axis) == (2, -0.003, "cubic", None)


def test_contacts_take_the_defaults_and_may_differ():
    contacts = read(
        "contacts.tangential_stiffness=4 N/mm",
        "contact=[{at='finger2/tip', name='thumb', friction=0.3, stiffness='rigid'},"
        "{at='palm', model='soft', spin_friction='5 mm', spin_stiffness='2 N m/rad', normals='pad'}]",
    ).contact_list()
    assert [(c.name, c.at, c.kind.name, c.kind.least_friction) for c in contacts] == [
        ("finger1/tip", "finger1/tip", "hard", 0.6),
        ("thumb", "finger2/tip", "hard", 0.3),
        ("finger3/tip", "finger3/tip", "hard", 0.6),
        ("palm", "palm", "soft", 0.6),
    ]
    assert [c.stiffness for c in contacts] == [8000.0, math.inf, 8000.0, 8000.0]
    assert [c.tangential_stiffness for c in contacts] == [4000.0] * 4
    assert [(c.kind.name, c.spin_stiffness) for c in contacts] == [("hard", None)] * 3 + [("soft", 2.0)]
    assert contacts[3].kind == SoftFinger(friction=0.6, spin_friction=0.005)
    assert [c.normals for c in contacts] == ["object"] * 3 + ["pad"]
    assert contacts[1].key == "contacts.at[1]"
    assert contacts[3].key == "contact[1].at"


def test_a_contact_on_a_link_has_a_place_of_its_own():
    contacts = read(
        "contacts.at=['finger1/tip']",
        "contact=[{link='palm', point=['1 mm', '-2 cm', '0 m'], normal=[0, 3, -4], radius='5 mm', friction=0.2},"
        "{link='palm', name='again'}]",
    ).contact_list()
    assert [c.name for c in contacts] == ["finger1/tip", "palm", "again"]
    assert contacts[1].at == LinkPlace("palm", (0.001, -0.02, 0.0), (0.0, 0.6, -0.8), 0.005)
    assert contacts[2].at == LinkPlace("palm", (0.0, 0.0, 0.0), None, 0.0)
    assert [c.kind.least_friction for c in contacts] == [0.6, 0.2, 0.6]
    assert [c.key for c in contacts] == ["contacts.at[0]", "contact[0].link", "contact[1].link"]


def test_the_stiffness_across_follows_the_stiffness_along():
    assert [c.tangential_stiffness for c in read().contact_list()] == [8000.0] * 3


def test_a_frictionless_contact_ignores_the_default_friction_but_has_none_of_its_own():
    palm = "contact=[{at='palm', model='frictionless'%s}]"
    assert read(palm % "").contact_list()[3].kind == Frictionless()
    assert issues(palm % ", friction=1") == [("contact[0].friction", "a frictionless contact has no friction")]


@pytest.mark.parametrize(
    ("contact", "key", "fragment"),
    [
        (
            "{at='finger1/pad'}, {at='finger1/pad'}",
            "contact[1].at",
            "pad 'finger1/pad' is named twice (first in contact[0])",
        ),
        ("{at='finger1/pad', name='x'}, {at='finger2/pad', name='x'}", "contact[1]", "two contacts have the name 'x'"),
        ("{at='a', model='soft', spin_stiffness='rigid'}", "contact[0].spin_friction", "a soft contact needs it"),
        ("{at='a', spin_friction='1 mm'}", "contact[0].spin_friction", "a hard contact has no spin friction"),
        ("{at='a', stiffness='rigit'}", "contact[0].stiffness", "did you mean 'rigid'?"),
        ("{at='a', stiffness='0 N/m'}", "contact[0].stiffness", "must be greater than 0"),
        ("{at='a', stiffness='1e-300 N/mm'}", "contact[0].stiffness", "is too soft to hold anything"),
        (
            "{at='a', tangential_stiffness='9e-7 N/m'}",
            "contact[0].tangential_stiffness",
            "is too soft to hold anything",
        ),
        (
            "{at='a', model='soft', spin_friction='1 m', spin_stiffness='9e-7 N m/rad'}",
            "contact[0].spin_stiffness",
            "is too soft to hold anything",
        ),
        ("{at='a', name='a,b'}", "contact[0].name", "may not hold commas, quotes or control characters, got 'a,b'"),
        ("{at='a', name='a\"b'}", "contact[0].name", "may not hold commas, quotes"),
        ("{at='a', name=\"a\\nb\"}", "contact[0].name", "may not hold commas, quotes or control"),
        ("{at='a,b', name='a'}", "contact[0].at", "may not hold commas, quotes or control"),
        ("{at='a', normals='palm'}", "contact[0].normals", "'palm' is not one of 'object' or 'pad'"),
        ("{at=''}", "contact[0].at", "must not be empty"),
        ("{}", "contact[0].at", "missing key 'at' (name of a pad of the hand) or 'link' (name of a link)"),
        ("{name='x', point=['0 m', '0 m', '0 m']}", "contact[0].at", "missing key 'at'"),
        ("{at='a', link='b'}", "contact[0].link", "at a pad or on a link, not both"),
        ("{at='a', point=['0 m', '0 m', '0 m']}", "contact[0].point", "'point' goes with 'link'; a pad has its own"),
        ("{at='a', normal='z'}", "contact[0].normal", "'normal' goes with 'link'; a pad has its own"),
        ("{at='a', radius='1 mm'}", "contact[0].radius", "'radius' goes with 'link'; a pad has its own"),
        ("{link='palm'}, {link='palm'}", "contact[1]", "two contacts have the name 'palm'; give each of them a name"),
        (
            "{link='palm', name='finger1/pad'}, {at='finger1/pad'}",
            "contact[1]",
            "two contacts have the name 'finger1/pad'",
        ),
        (
            "{at='finger1/pad'}, {link='palm', name='finger1/pad'}",
            "contact[1]",
            "two contacts have the name 'finger1/pad'",
        ),
        ("{link='a', name='finger1/tip'}", "contact[0]", "two contacts have the name 'finger1/tip'"),
        ("{link='a', point=['0 mm', '0 mm']}", "contact[0].point", "expected 3 lengths, got 2"),
        ("{link='a', point=['0 m', 0, '0 m']}", "contact[0].point[1]", "0 has no unit"),
        ("{link='a', normal='w'}", "contact[0].normal", "'w' is not 'x', 'y', 'z' or a list of 3 numbers"),
        ("{link='a', normal=[0, 0, 0]}", "contact[0].normal", "an axis needs a direction"),
        ("{link='a', radius='0 mm'}", "contact[0].radius", "must be greater than 0"),
        ("{link='a', normals='pad'}", "contact[0].normal", "missing key 'normal'; normals = \"pad\" needs it"),
    ],
)
def test_contacts_that_cannot_be(contact, key, fragment):
    ((found, message),) = issues(f"contact=[{contact}]")
    assert found == key
    assert fragment in message


@pytest.mark.parametrize(
    ("override", "key", "fragment"),
    [
        ("task.move=[{mode=1}]", "task.move[0].amplitude", "missing key 'amplitude'"),
        ("task.move=[{mode=1, amplitude='1 m', lift='1 m'}]", "task.move[0].lift", "goes with axis"),
        ("task.move=[{axis='x', lift='1 m', amplitude='1 m'}]", "task.move[0].amplitude", "goes with mode"),
        ("task.move=[{mode=0, amplitude='1 m'}]", "task.move[0].mode", "must be at least 1, got 0"),
        ("task.knots=1", "task.knots", "a task that moves or turns needs at least 2 knots"),
        ("task.duration=0.5 us", "task.duration", "unknown unit 'us'"),
        ("task.duration=0.0005 ms", "task.duration", "must be at least 1 us, got 0.5 us"),
        ("limits.normal_force=0 N", "limits.normal_force", "must be greater than 0 N"),
        ("limits.joint_torque=1 m", "limits.joint_torque", "'m' is a unit of length; expected a torque"),
        ("limits.synergy_rate=[]", "limits.synergy_rate", "expected one or more numbers, got 0"),
        ("limits.margin=1e200 N", "limits.margin", "is too large"),
        ("hand.synergies=[1]", "hand.synergies[0]", "expected a name, got 1"),
        ("hand.close=3", "hand.close", "expected the name of a synergy or joint, with '-' in front"),
        ("hand.close=''", "hand.close", "expected the name of a synergy or joint"),
        ("hand.close={}", "hand.close", "or weights by name such as { s1 = -1, s2 = 0.2 }, got a table"),
        ("hand.close={s1='5 deg'}", "hand.close.s1", "expected a number, got '5 deg'"),
        ("object.orientation={axis='x'}", "object.orientation.angle", "missing key 'angle'"),
        ("object.orientation={axis='x', angle=90}", "object.orientation.angle", "90 has no unit"),
        ("object.orientation={axis=[0,0,0], angle='9 deg'}", "object.orientation.axis", "an axis needs a direction"),
        ("object={mass='1 g', orientation={axis='x', angle='9 deg'}}", "object.orientation", "give object.shape"),
        ("hand.posture=3", "hand.posture", "expected the name of a posture or a table"),
        ("task.wrench=3", "task.wrench", "expected the name of a CSV file or 6 numbers"),
        ("expect.dims=[1, 2]", "expect.dims", "expected at least 3 entries, got 2"),
        ("expect.verdict=maybe", "expect.verdict", "'maybe' is not one of"),
    ],
)
def test_values_that_cannot_be(override, key, fragment):
    ((found, message),) = issues(override)
    assert found == key
    assert fragment in message


def test_a_palm_that_turns_needs_two_knots_and_one_that_holds_needs_one():
    matter = ("task.move=[]", "task.knots=1")
    assert read(*matter).task.knots == 1
    assert issues(*matter, "task.palm={axis='x', turn='1 deg'}") == [
        ("task.knots", "a task that moves or turns needs at least 2 knots")
    ]
    assert read("task.knots=2", "task.duration=1e-6 s").task.duration == 1e-6
    assert read("contacts.stiffness=1e-6 N/m").contacts.stiffness == 1e-6


def test_gravity_on_matrices_asks_for_the_wrench():
    with pytest.raises(InputError) as caught:
        read_problem_file(DATA / "matrices.toml", ["task.gravity=[0, 0, -9.81]"])
    assert "give the weight in task.wrench" in caught.value.issues[0].message


def _properties(node):
    if isinstance(node, dict):
        for name, entry in node.get("properties", {}).items():
            yield name, entry
        for entry in node.values():
            yield from _properties(entry)
    elif isinstance(node, list):
        for entry in node:
            yield from _properties(entry)


def test_the_schema_describes_every_key():
    schema = problem_schema()
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    found = list(_properties(schema))
    assert len(found) > 60
    assert [name for name, entry in found if not entry.get("description")] == []
    assert '"null"' not in json.dumps(schema)
    assert set(schema["required"]) == {"schema"}


def test_the_schema_knows_the_units():
    length = problem_schema()["$defs"]["SphereTable"]["properties"]["radius"]
    compliance = problem_schema()["$defs"]["ComplianceTable"]["properties"]["joint"]["anyOf"][0]
    assert re.search(length["pattern"], "45.8 mm")
    assert not re.search(length["pattern"], "45.8 N")
    assert not re.search(length["pattern"], "45.8")
    assert re.search(compliance["pattern"], compliance["examples"][0])


def test_reading_a_problem_needs_no_heavy_library():
    heavy = "('scipy', 'cvxpy', 'mujoco')"
    code = f"import sys, synergrip.problems.problem_file; print([m for m in {heavy} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
