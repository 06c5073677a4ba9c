"""A grasp given as matrices becomes the same value as one that was placed."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from made_kinds import made_kind
from random_grasps import random_contacts, random_grasp

from synergrip.errors import InputError
from synergrip.grasps.given import given, read_given
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.grasps.matrices import GivenContact, Matrices
from synergrip.linalg import Array, frozen

INTACT = Path(__file__).parent.parent / "data" / "bad_inputs" / "grasp.json"
KINDS = ["hard", "soft", "frictionless", "hard"]


def _matrices(grasp: Grasp, **changes: object) -> Matrices:
    contacts = tuple(
        GivenContact(name=c.name, kind=c.kind, point=c.point, normal=frozen(c.frame[:, 0])) for c in grasp.contacts
    )
    matrices = Matrices(
        title=grasp.title,
        contacts=contacts,
        G=grasp.G,
        J=grasp.J,
        S=grasp.S,
        C_s=grasp.C_s,
        C_q=grasp.C_q,
        C_z=grasp.C_z,
        lambda_0=None,
        w_0=None,
        expect={},
    )
    return replace(matrices, **changes)  # type: ignore[arg-type]


def _grasp(seed: int = 5) -> Grasp:
    return random_grasp(np.random.default_rng(seed), kinds=KINDS)


@pytest.mark.parametrize("seed", range(5))
def test_points_and_frames_come_back_from_the_grasp_matrix_alone(seed: int) -> None:
    grasp = _grasp(seed)
    bare = tuple(replace(c, point=None, normal=None) for c in _matrices(grasp).contacts)
    found = given(_matrices(grasp, contacts=bare))
    for original, contact in zip(grasp.contacts, found.contacts, strict=True):
        assert contact.frame[:, 0] == pytest.approx(original.frame[:, 0], abs=1e-12)
        if contact.kind.name == "frictionless":  # only the line of the force is in G
            assert np.cross(contact.point - original.point, original.frame[:, 0]) == pytest.approx(0, abs=1e-12)
        else:
            assert contact.point == pytest.approx(original.point, abs=1e-12)
            assert contact.frame == pytest.approx(original.frame, abs=1e-12)
    assert grasp_matrix(found.contacts) == pytest.approx(grasp.G, abs=1e-12)


def test_matrices_kinds_friction_and_names_are_passed_on() -> None:
    grasp = _grasp()
    found = given(_matrices(grasp))
    for name in ("G", "J", "S", "C_s", "C_q", "C_z"):
        assert np.array_equal(getattr(found, name), getattr(grasp, name)), name
    assert [(c.name, c.kind) for c in found.contacts] == [(c.name, c.kind) for c in grasp.contacts]
    assert found.joints == tuple(f"q{i + 1}" for i in range(grasp.n_q))
    assert found.synergies == tuple(f"z{i + 1}" for i in range(grasp.n_z))


def test_a_left_handed_contact_frame_is_kept_as_it_is() -> None:
    contact = random_contacts(np.random.default_rng(0), ["hard"])[0]
    mirrored = replace(contact, frame=frozen(contact.frame * [1, 1, -1]))
    grasp = random_grasp(np.random.default_rng(0), kinds=["hard"])
    bare = (GivenContact(name="C1", kind=made_kind("hard", 0.5, 0.0), point=None, normal=None),)
    found = given(_matrices(grasp, contacts=bare, G=grasp_matrix([mirrored])))
    assert found.contacts[0].frame == pytest.approx(mirrored.frame, abs=1e-12)
    assert found.contacts[0].point == pytest.approx(mirrored.point, abs=1e-12)


def test_a_stretched_column_still_gives_the_normal_and_a_frame_of_unit_vectors() -> None:
    grasp = random_grasp(np.random.default_rng(1), kinds=["hard"])
    G = grasp.G * [2.0, 1.0, 1.0]
    bare = (GivenContact(name="C1", kind=made_kind("hard", 0.5, 0.0), point=None, normal=None),)
    frame = given(_matrices(grasp, contacts=bare, G=frozen(G))).contacts[0].frame
    assert frame.T @ frame == pytest.approx(np.eye(3), abs=1e-12)
    assert frame[:, 0] == pytest.approx(grasp.contacts[0].frame[:, 0], abs=1e-12)


def _issues(matrices: Matrices) -> list[tuple[str, str]]:
    with pytest.raises(InputError) as caught:
        given(matrices)
    return [(issue.key, issue.message) for issue in caught.value.issues]


def _changed(matrices: Matrices, k: int, **changes: object) -> Matrices:
    contacts = list(matrices.contacts)
    contacts[k] = replace(contacts[k], **changes)  # type: ignore[arg-type]
    return replace(matrices, contacts=tuple(contacts))


def _moved(matrices: Matrices, offset: Array) -> Matrices:
    contacts = (replace(c, point=frozen(np.asarray(c.point) + offset)) for c in matrices.contacts)
    return replace(matrices, contacts=tuple(contacts))


@pytest.mark.parametrize("k", range(4))
@pytest.mark.parametrize("origin", [0.0, 3.0])
def test_a_point_that_contradicts_the_grasp_matrix_is_refused(k: int, origin: float) -> None:
    matrices = _moved(_matrices(_grasp()), origin * np.array([0.01, 0.02, -0.03]))
    given(matrices)
    wrong = np.asarray(matrices.contacts[k].point) + 0.02 * np.ones(3)
    ((key, message),) = _issues(_changed(matrices, k, point=frozen(wrong)))
    assert key == f"contacts[{k}].point_m"
    assert f"off the moments of contact {matrices.contacts[k].name} in G" in message
    given(_changed(_changed(matrices, k, point=frozen(wrong)), (k + 1) % 4, point=None))  # not all are given


def test_points_in_millimetres_are_refused() -> None:
    matrices = _matrices(_grasp())
    contacts = tuple(replace(c, point=frozen(1e3 * np.asarray(c.point))) for c in matrices.contacts)
    ((key, _),) = _issues(replace(matrices, contacts=contacts))
    assert key.endswith(".point_m")


@pytest.mark.parametrize("k", range(4))
def test_a_normal_that_contradicts_the_grasp_matrix_is_refused(k: int) -> None:
    matrices = _matrices(_grasp())
    normal = np.asarray(matrices.contacts[k].normal)
    across = np.cross(normal, [0.6, 0.0, 0.8])
    across /= np.linalg.norm(across)
    given(_changed(matrices, k, normal=frozen(np.cos(0.009) * normal + np.sin(0.009) * across)))
    tilted = frozen(np.cos(0.011) * normal + np.sin(0.011) * across)
    ((key, message),) = _issues(_changed(matrices, k, normal=tilted))
    assert key == f"contacts[{k}].normal"
    assert message.startswith(f"is 0.63 deg from the normal force of contact {matrices.contacts[k].name} in G")
    both = _changed(_changed(matrices, 0, normal=frozen(-normal)), k, normal=frozen(-normal))
    assert f"contacts[{k}].normal" in [key for key, _ in _issues(both)]


def test_a_grasp_matrix_that_is_not_geometric_contradicts_nothing() -> None:
    grasp = _grasp()
    matrices = _matrices(grasp, G=frozen(grasp.G * 2))
    wrong = _changed(matrices, 0, normal=frozen([0.0, 0.6, 0.8]), point=frozen([1.0, 2.0, 3.0]))
    assert given(wrong).n_c == 4


def test_a_normal_force_that_makes_no_force_on_the_object_is_refused() -> None:
    grasp = _grasp()
    G = np.array(grasp.G)
    G[:3, 3] = 0  # the first column of the second contact
    assert _issues(_matrices(grasp, G=frozen(G))) == [
        ("G", f"the normal force of contact {grasp.contacts[1].name} makes no force on the object")
    ]


def test_a_contradiction_is_shown_in_the_file(tmp_path: Path) -> None:
    data = json.loads(INTACT.read_text(encoding="utf-8"))
    path = tmp_path / "grasp.json"
    path.write_text(json.dumps(data, indent=1), encoding="utf-8")
    assert read_given(path).n_c == 3
    data["contacts"][2]["normal"] = [0, 0, 1]
    path.write_text(json.dumps(data, indent=1), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_given(path)
    (issue,) = caught.value.issues
    assert (issue.key, issue.file) == ("contacts[2].normal", str(path))
    assert path.read_text(encoding="utf-8").split("\n")[issue.line - 1].strip() == '"normal": ['


def test_the_load_at_the_start_is_that_given_or_follows_from_the_forces_or_is_nothing() -> None:
    grasp = _grasp()
    forces = frozen(np.arange(grasp.n_l, dtype=float))
    load = frozen([1.0, 2, 3, 4, 5, 6])
    assert np.array_equal(given(_matrices(grasp)).w_0, np.zeros(6))
    assert given(_matrices(grasp)).lambda_0 is None
    assert np.array_equal(given(_matrices(grasp, w_0=load)).w_0, load)
    assert given(_matrices(grasp, lambda_0=forces)).w_0 == pytest.approx(-grasp.G @ forces, abs=1e-12)
    balanced = frozen(-grasp.G @ forces)
    both = given(_matrices(grasp, lambda_0=forces, w_0=balanced))
    assert np.array_equal(both.w_0, balanced)
    assert both.lambda_0 is forces
    with pytest.raises(InputError, match=r"w_0 = -G lambda_0 does not hold"):
        given(_matrices(grasp, lambda_0=forces, w_0=load))
