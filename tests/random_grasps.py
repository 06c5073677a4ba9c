"""Random grasps for tests: contacts around an object, random fingers, any mixture of compliances."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from made_kinds import made_kind, spin_of

from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import Array, frozen


def random_contacts(rng: np.random.Generator, kinds: list[str], radius: float = 0.04) -> tuple[Contact, ...]:
    """Contacts on a sphere, normals inward but tilted a little."""
    contacts = []
    for i, kind in enumerate(kinds):
        direction = rng.normal(size=3)
        direction /= np.linalg.norm(direction)
        normal = -direction + 0.1 * rng.normal(size=3)
        friction = 0.0 if kind == "frictionless" else float(rng.uniform(0.4, 1.0))
        spin = float(rng.uniform(0.002, 0.01)) if kind == "soft" else 0.0
        frame = contact_frame(normal)
        contacts.append(
            Contact(
                name=f"C{i + 1}", kind=made_kind(kind, friction, spin), point=frozen(radius * direction), frame=frame
            )
        )
    return tuple(contacts)


def compliance(rng: np.random.Generator, size: int, scale: float, kind: str) -> Array:
    """A compliance matrix: "zero", "scalar", "diagonal", "full" or "singular" (half of its directions rigid)."""
    if kind == "zero" or size == 0:
        return frozen(np.zeros((size, size)))
    if kind == "scalar":
        return frozen(scale * np.eye(size))
    values = scale * rng.uniform(0.3, 3.0, size)
    if kind == "diagonal":
        return frozen(np.diag(values))
    if kind == "singular":
        values[: size // 2] = 0.0
    basis = np.linalg.qr(rng.normal(size=(size, size)))[0]
    full = (basis * values) @ basis.T
    return frozen((full + full.T) / 2)


def random_grasp(
    rng: np.random.Generator,
    kinds: list[str] | None = None,
    n_q: int | None = None,
    n_z: int | None = None,
    compliances: tuple[str, str, str] | None = None,
    degenerate: bool = False,
) -> Grasp:
    """A random restrained grasp; `degenerate` adds joints that move nothing or move two contacts alike."""
    kinds = kinds or [str(k) for k in rng.choice(["hard", "soft"], size=int(rng.integers(3, 5)))]
    contacts = random_contacts(rng, kinds)
    G = grasp_matrix(contacts)
    n_l = G.shape[1]
    n_q = n_q or int(rng.integers(4, 10))
    n_z = n_z or int(rng.integers(2, min(6, n_q) + 1))
    spin = np.array([1.0 if c == "m" else 0.08 for contact in contacts for c in contact.kind.components])
    J = spin[:, None] * rng.normal(size=(n_l, n_q))
    S = rng.normal(size=(n_q, n_z))
    if degenerate:
        J[:, 0] = 0.0  # a joint that moves no contact
        J[:, 1] = G.T @ (np.array([1, 1, 1, 20, 20, 20]) * rng.normal(size=6)) * 0.05  # one that carries the object
        S[:] = 0.0
        S[:n_z, :] = np.eye(n_z)
        S[n_z - 1 :, n_z - 1] = rng.normal(size=n_q - n_z + 1)
    kinds_of = compliances or tuple(
        str(rng.choice(options))
        for options in (
            ["scalar", "diagonal", "full"],
            ["zero", "scalar", "diagonal", "full", "singular"],
            ["zero", "scalar", "diagonal", "full", "singular"],
        )
    )
    return Grasp(
        title="random",
        contacts=contacts,
        G=G,
        J=frozen(J),
        S=frozen(S),
        C_s=compliance(rng, n_l, 1e-3, kinds_of[0]),
        C_q=compliance(rng, n_q, 0.02, kinds_of[1]),
        C_z=compliance(rng, n_z, 0.02, kinds_of[2]),
        lambda_0=None,
        w_0=frozen(np.zeros(6)),
        joints=tuple(f"q{i + 1}" for i in range(n_q)),
        synergies=tuple(f"z{i + 1}" for i in range(n_z)),
    )


def moved_frame(grasp: Grasp, shift: np.ndarray, length: float, force: float) -> Grasp:
    """The same grasp with another origin of B and other units of length and force."""
    contacts = tuple(
        replace(
            c, point=frozen(length * (c.point + shift)), kind=made_kind(c.kind.name, c.friction, length * spin_of(c))
        )
        for c in grasp.contacts
    )
    unit = np.array(
        [1.0 if c != "m" else 1.0 / length for _, c in grasp.components]
    )  # spin rows turn, they do not move
    J = length * unit[:, None] * grasp.J
    size = length / force * np.outer(unit, unit)
    return replace(
        grasp,
        contacts=contacts,
        G=grasp_matrix(contacts),
        J=frozen(J),
        C_s=frozen(size * grasp.C_s),
        C_q=frozen(grasp.C_q / (force * length)),
        C_z=frozen(grasp.C_z / (force * length)),
    )
