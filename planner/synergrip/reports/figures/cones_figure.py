"""The force of every contact inside its friction cone, seen along the normal."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from synergrip.grasps.contacts.contact import Contact
from synergrip.reports.figures.subject import Subject
from synergrip.reports.pictures.cone_sections import Cones, cones_height, draw_cones
from synergrip.reports.pictures.page import IN_PAPER, SPACE, Heading
from synergrip.reports.pictures.paper import Paper
from synergrip.reports.pictures.sheet import Sheet, write_picture
from synergrip.simulation.played_plan import pad_of
from synergrip.simulation.told_values import Told

WIDE_MM, BESIDE = 180.0, 0.1
"""Usual width [mm], and the room beside the cross-sections [inch]."""


def draw_cones_figure(subject: Subject, path: Path, paper: Paper) -> str:
    """Draw the cross-sections of the friction cones of a plan.

    Args:
        subject: with a plan.
        path: ends in .svg, .png or .pdf.
        paper: width, letters and title; the height follows.

    Returns:
        What is to be said below it in a paper.

    Raises:
        InputError: a height, a suffix that says no format, a font that is not installed; a saved plan of a grasp given
            as matrices whose problem cannot be read again.
        OSError: the file cannot be written.
    """
    paper.refuse_height("cones")
    document = subject.document or {}
    contacts, forces = _contacts(subject), np.array(document["lambda"])
    ends = np.cumsum([0, *(contact.n_rows for contact in contacts)])
    margins = np.array(document["margin"]["per_contact_N"])
    parts = [forces[:, first:last] for first, last in pairwise(ends)]
    cones = Cones(contacts, parts, margins, np.array(document["time_s"]))
    width = paper.wide(WIDE_MM)
    heading, wide = Heading.of(paper.title, "", width, IN_PAPER), width - 2 * BESIDE
    top = heading.height + SPACE / 2 if paper.title else BESIDE / 2

    def fill(sheet: Sheet) -> None:
        heading.write(sheet)
        draw_cones(sheet, cones, BESIDE, top, wide)

    write_picture(path, width, top + cones_height(cones, wide), fill, paper.letters)
    return (
        f"{document['title']}. Force of each contact over time inside its friction cone, along the tangents t and o "
        f"as a share of the friction that it has, spin included: on the circle it slips. {_times(cones)}"
    )


def _times(cones: Cones) -> str:
    """Return what the marks stand for."""
    if len(cones.times) == 1:
        return "Dots: the forces."
    begin, end = (f"t = {time:.3g} s" for time in cones.times[[0, -1]])
    return f"Rings: {begin}, squares: {end}, dots: where its slip margin is least."


def _contacts(subject: Subject) -> Sequence[Contact]:
    """Return the contacts of a plan: those of the grasp at hand, or of the file, which tells those on a hand."""
    document = subject.document or {}
    if subject.question is None and isinstance(document.get("execution"), dict):
        told = Told(document["execution"], "execution").several("contacts")
        return [pad_of(each, np.zeros(3)).contact for each in told]
    return subject.asked().grasp.contacts
