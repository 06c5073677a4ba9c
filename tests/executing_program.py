"""Another program that executes a plan: plan.json, its own reader of URDF files and NumPy, nothing of synergrip."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np


def turned(axis: np.ndarray, angle: float) -> np.ndarray:
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def rpy(angles: list[float]) -> np.ndarray:
    x, y, z = (turned(axis, angle) for axis, angle in zip(np.eye(3), angles, strict=True))
    return z @ y @ x


def numbers(element: ET.Element | None, key: str, default: str) -> np.ndarray:
    return np.array([float(word) for word in (default if element is None else element.get(key, default)).split()])


class Tree:
    """The joints of a URDF, each with the link above it."""

    def __init__(self, path: Path, root: str) -> None:
        self.above = {joint.find("child").get("link"): joint for joint in ET.parse(path).getroot().iter("joint")
                      if joint.find("child") is not None}  # fmt: skip
        self.root = root

    def chain(self, link: str) -> list[ET.Element]:
        """Return the joints from the root to a link."""
        found: list[ET.Element] = []
        while link != self.root:
            found.insert(0, self.above[link])
            link = self.above[link].find("parent").get("link")
        return found

    def pose(self, link: str, q: dict[str, float]) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
        """Return rotation and origin of a link in the root, and of each joint above it axis, place and kind."""
        R, p, axes = np.eye(3), np.zeros(3), {}
        for joint in self.chain(link):
            origin = joint.find("origin")
            p = p + R @ numbers(origin, "xyz", "0 0 0")
            R = R @ rpy(numbers(origin, "rpy", "0 0 0").tolist())
            name = joint.get("name")
            if joint.get("type") == "fixed":
                continue
            axis = numbers(joint.find("axis"), "xyz", "1 0 0")
            axis = axis / np.linalg.norm(axis)
            axes[name] = np.array([R @ axis, p])
            R = R @ turned(axis, q[name])
        return R, p, axes


def executed(document: dict[str, Any], tree: Tree) -> tuple[np.ndarray, np.ndarray]:
    """Return contact forces (T, n_l) and object displacement (T, 6) of the references, from the block alone."""
    block = document["execution"]
    q = dict(zip(block["joints"], block["q_0"], strict=True))
    centre = np.array(block["object"]["position_m"])
    G, J = list[np.ndarray](), list[np.ndarray]()
    for contact in block["contacts"]:
        point, frame = np.array(contact["point_m"]), np.array(contact["frame"])
        _, _, axes = tree.pose(contact["link"], q)
        jacobian = np.zeros((6, len(q)))
        for name, (axis, place) in axes.items():
            jacobian[:, block["joints"].index(name)] = [*np.cross(axis, point - place), *axis]
        rows = [np.concatenate([direction, np.cross(point - centre, direction)]) for direction in frame]
        moves = [np.concatenate([direction, np.zeros(3)]) @ jacobian for direction in frame]
        if contact["kind"] == "soft":
            rows.append(np.concatenate([np.zeros(3), frame[0]]))
            moves.append(np.concatenate([np.zeros(3), frame[0]]) @ jacobian)
        keep = 1 if contact["kind"] == "frictionless" else len(rows)
        G += rows[:keep]
        J += moves[:keep]
    Gt, Jc, S = np.array(G), np.array(J), np.array(block["S"])
    C = Jc @ np.array(block["C_q"]) @ Jc.T + Jc @ S @ np.array(block["C_z"]) @ S.T @ Jc.T
    start = 0
    for contact in block["contacts"]:
        compliance = np.array(contact["compliance"])
        rows = slice(start, start + len(compliance))
        C[rows, rows] += compliance
        start = rows.stop
    lambda_0 = np.array(block["lambda_0"])
    n = len(lambda_0)
    system = np.block([[C, Gt], [Gt.T, np.zeros((6, 6))]])  # C (lambda - lambda_0) = J S dz_r - G' u; G lambda + w = 0
    pushed = np.array(document["dz_r"]) @ (Jc @ S).T
    loaded = -(np.array(document["wrench"]) + Gt.T @ lambda_0)
    found = np.linalg.solve(system, np.hstack([pushed, loaded]).T).T
    return lambda_0 + found[:, :n], found[:, n:]
