"""The part of an MJCF file that says how it moves, as one text for MuJoCo, with the place of every line.

Everything else is left out before MuJoCo sees it, so that no missing mesh, texture or plugin can stop a hand from
loading. Included files are put in where they are named, and attached models are read like the file itself: MuJoCo gets
texts and opens no file.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from xml.sax.saxutils import quoteattr

from synergrip.documents.documents import LARGEST_NUMBER
from synergrip.hands.models.mjcf_files import Amount, ModelFiles, expanded, real
from synergrip.hands.models.xml_elements import LARGEST_MODEL, Element

LEFT_OUT = {
    "camera", "config", "contact", "custom", "deformable", "extension", "flex", "flexcomp", "flexstrain", "flexvert",
    "hfield", "inertial", "keyframe", "lengthrange", "light", "material", "mesh", "option", "pair", "plugin",
    "sensor", "size", "skin", "statistic", "texture", "visual",
}  # fmt: skip
"""Elements without influence on the kinematics."""
OF_A_GEOM = ("name", "class", "type", "size", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "fromto")
"""Attributes of a geom that a spatial tendon wraps around; the other geoms are left out."""
COMPILER = ("angle", "autolimits", "coordinate", "eulerseq")
"""Attributes of <compiler> with influence on the kinematics; "fusestatic", for one, would lose links."""
ATTRIBUTES_LEFT_OUT = ("align", "material")
DRIVEN = ("joint", "jointinparent", "tendon")
"""Attributes that say what an actuator drives; the other actuators are left out, and dampers, which hold nothing."""
AT_A_PLACE = ("site", "cranksite")
"""Attributes of an actuator that moves joints in another way, which is not read."""
OF_A_PLUGIN = ("name", "class", *DRIVEN, "gear", "forcelimited", "forcerange")
"""Attributes that an actuator plugin shares with <general>, which stands in for it."""
INERTIA = {"pos": "0 0 0", "mass": "1", "diaginertia": "1 1 1"}
ARMATURE = "1"
"""Kinematics needs no inertia, MuJoCo does: of each body, and about each joint."""
BOUNDED = ("coef", "gear", "polycoef", "pos", "ref")
LARGEST = 1e6
"""[m, rad or 1] Larger numbers are no place or ratio of a joint, and overflow in MuJoCo."""
MOST_ATTRIBUTES = 100
"""Of an element; MuJoCo knows some forty."""
MOST_MODELS = 50
"""To attach in one file; MuJoCo holds a copy of each."""
MOST_ATTACHED = 10
"""Models that attach models that attach models, and so on."""


@dataclass(frozen=True)
class Source:
    """A text for MuJoCo with one element in each line."""

    text: str
    lines: tuple[Element, ...]
    """The element of each line, as it stands in the user's file."""
    equalities: tuple[Element, ...]
    """In the order in which MuJoCo numbers them."""
    files: Mapping[str, bytes]
    """Texts of all attached models, by the names that stand in `text` and in each other."""
    attached: Mapping[str, Source]
    """Those that this text names itself."""
    actuators_left_out: tuple[str, ...]
    """Names of those that move joints in a way that is not read."""
    amount: Amount
    """What MuJoCo makes of it, once every replicate and attached model is put in."""

    def at(self, lines: Sequence[int]) -> Element:
        """Return the element at a line of the text, at a line of the model that is attached there, and so on."""
        first, rest = (lines[0], lines[1:]) if lines else (0, ())
        element = self.lines[first - 1] if 1 <= first <= len(self.lines) else self.lines[0]
        model = self.attached.get(element.attributes.get("file", "")) if element.tag == "model" else None
        return model.at(rest) if model and rest else element

    def place(self, tag: str, name: str) -> Element:
        """Return the element of that tag and name, or the outermost one."""
        found = (element for element in self.lines if element.tag == tag and element.attributes.get("name") == name)
        return next(found, self.lines[0])


def kinematic_source(root: Element) -> Source:
    """Return the text that MuJoCo is to compile.

    Args:
        root: the element <mujoco> of the file.

    Raises:
        InputError: an included or attached file that cannot be read, a model that attaches itself, too many elements, a
            number that is not finite; with file and line.
    """
    return _source(root, ModelFiles(max(LARGEST_MODEL - root.length, 0)), {}, ())


def _source(root: Element, files: ModelFiles, done: dict[Path, tuple[str, Source]], above: tuple[Path, ...]) -> Source:
    """Return the text for a file that the files `above` attach; `done` are all attached models, by their files."""
    path = real(root.path)
    whole = replace(root, children=list(files.with_includes(root, root.path.parent, [path])))
    attached: dict[str, Source] = {}
    named: dict[str, Amount] = {}
    models = [model for asset in whole.all("asset") for model in asset.all("model")]
    if len(models) > MOST_MODELS:
        raise root.refused(f"the file names {len(models)} models to attach; expected at most {MOST_MODELS}")
    for model in models:
        name, child = _attached(model, files, done, (*above, path))
        attached[name] = child
        named[model.attributes.get("name") or child.lines[0].attributes.get("model", "")] = child.amount
        model.attributes = {**model.attributes, "file": name}
    amount = expanded(whole, named, LEFT_OUT | {"geom"})
    spatial = [tendon for part in whole.all("tendon") for tendon in part.all("spatial")]
    wrapped = {geom.attributes.get("geom", "") for tendon in spatial for geom in tendon.all("geom")}
    parts = list(_written(whole, "", wrapped))
    kept = [element for _, _, element in parts if element is not None]
    equalities = [element for _, parent, element in parts if element is not None and parent == "equality"]
    actuators = [actuator for part in whole.all("actuator") for actuator in part.children]
    unread = [each.attributes.get("name", each.tag) for each in actuators if {*AT_A_PLACE} & {*each.attributes}]
    text = "".join(text for text, _, _ in parts)
    texts = {name: child.text.encode() for name, child in done.values()}
    return Source(text, tuple(kept), tuple(equalities), texts, attached, tuple(unread), amount)


def _attached(
    model: Element, files: ModelFiles, done: dict[Path, tuple[str, Source]], above: tuple[Path, ...]
) -> tuple[str, Source]:
    """Return the name that MuJoCo is to know the file of an element <model> by, and the text for it."""
    path = model.path.parent / model.required("file")
    if real(path) in above:
        raise model.refused(f"the file '{path}' attaches itself" + (" through others" if len(above) > 1 else ""))
    if len(above) > MOST_ATTACHED:
        raise model.refused(f"attached models attach others more than {MOST_ATTACHED} deep")
    if real(path) not in done:
        root = files.read(model, path, "attached model")
        if root.tag != "mujoco":
            raise root.refused(f"an attached model is a <mujoco> (MJCF), not a <{root.tag}>")
        source = _source(root, files, done, above)
        done[real(path)] = f"{len(done)}.xml", source
    return done[real(path)]


def _written(element: Element, parent: str, wrapped: set[str]) -> Iterator[tuple[str, str, Element | None]]:
    """Yield pieces of the text, with parent and element where a line begins."""
    tag, attributes = _kept(element, parent, wrapped)
    if not tag:
        return
    _check_numbers(element, attributes)
    yield ("\n" if parent else "") + f"<{tag}{_written_attributes(attributes)}>", parent, element
    if tag == "body":
        yield f"<inertial{_written_attributes(INERTIA)}/>", tag, None
    for child in element.children:
        yield from _written(child, tag, wrapped)
    if not parent:
        yield '<compiler><lengthrange mode="none"/></compiler>', tag, None
    yield f"</{tag}>", tag, None


def _written_attributes(attributes: dict[str, str]) -> str:
    return "".join(f" {name}={quoteattr(value)}" for name, value in attributes.items())


def _kept(element: Element, parent: str, wrapped: set[str]) -> tuple[str, dict[str, str]]:
    """Return the tag and attributes that MuJoCo is to see; an empty tag for nothing."""
    tag = element.tag
    attributes = {name: value for name, value in element.attributes.items() if name not in ATTRIBUTES_LEFT_OUT}
    if parent == "actuator":
        if tag == "damper" or not any(name in attributes for name in DRIVEN):
            return "", {}
        if tag == "plugin":
            return "general", {name: attributes[name] for name in OF_A_PLUGIN if name in attributes}
        return tag, attributes
    if tag in LEFT_OUT or (parent == "asset" and tag != "model"):
        return "", {}
    if tag == "geom" and parent != "spatial":
        return _wrapping(element, parent, wrapped)
    if tag == "compiler":
        return tag, {name: attributes[name] for name in COMPILER if name in attributes}
    if tag == "joint" and parent in ("body", "frame"):
        attributes["armature"] = ARMATURE
    return tag, attributes


def _wrapping(element: Element, parent: str, wrapped: set[str]) -> tuple[str, dict[str, str]]:
    """Return a geom that a tendon wraps around, or the defaults of such ones; what it looks like is left out."""
    named = element.attributes.get("name", "") in wrapped - {""}
    if not named and parent != "default":
        return "", {}
    if named and "mesh" in element.attributes:
        raise element.refused("a tendon wraps around this geom, which is fitted to a mesh; give it a type and a size")
    return "geom", {name: value for name, value in element.attributes.items() if name in OF_A_GEOM}


def _check_numbers(element: Element, attributes: dict[str, str]) -> None:
    """Refuse the numbers at which MuJoCo writes a log file beside its answer, and what has no end."""
    if len(attributes) > MOST_ATTRIBUTES:
        raise element.refused(f"<{element.tag}> has {len(attributes):,} attributes; expected at most {MOST_ATTRIBUTES}")
    for name, text in attributes.items():
        element.check_length(name)
        for part in text.split():
            try:
                value = float(part)
            except ValueError:
                break
            if math.isnan(value) or LARGEST_NUMBER < abs(value) < math.inf:
                raise element.refused(f"<{element.tag} {name}> is {text!r}; expected finite numbers")
            if name in BOUNDED and not abs(value) < LARGEST:
                raise element.refused(f"<{element.tag} {name}> is {text!r}; expected numbers below {LARGEST:g}")
