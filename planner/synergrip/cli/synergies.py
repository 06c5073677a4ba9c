"""``synergrip synergies``: S from recorded postures; sets listed, shown, compared; how many a task needs."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from synergrip.cli import ending
from synergrip.cli.loading import load_placed
from synergrip.cli.progress import counted
from synergrip.cli.running import (
    Format,
    FormatOption,
    ProblemArgument,
    SetOption,
    answering,
    draw_at,
    heard,
    picture_place,
    placed,
    possible,
    show,
    shown_anyway,
    writing,
)

synergies = typer.Typer(
    help="Synergy sets: fit to recorded postures, list, show, compare; how many of them a task needs.",
    no_args_is_help=True,
    add_completion=False,
)
HandArgument = Annotated[str, typer.Argument(metavar="HAND", help="A bundled hand, or a folder with hand.toml.")]
FirstOption = Annotated[int | None, typer.Option("--first", metavar="K", help="Only the first K synergies.")]
SET = "A set of the hand, or a synergy file."
PictureOption = Annotated[Path | None, typer.Option("--picture", metavar="FILE", help="Draw into .svg, .png or .pdf.")]


class By(StrEnum):
    """What makes some synergies better than others with which there is a plan, too."""

    PEAK_FORCE = "peak_force"
    EFFORT = "effort"
    MARGIN = "margin"


@synergies.command("fit")
def fit(
    postures: Annotated[Path, typer.Argument(metavar="POSTURES", help="CSV: names of joints, then postures.")],
    count: Annotated[int, typer.Option("-n", "--number", metavar="K", help="How many synergies.")],
    hand: Annotated[str | None, typer.Option("--hand", metavar="HAND", help="Whose joints they are.")] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", metavar="FILE.toml", help="Write them here.")] = None,
    name: Annotated[str, typer.Option("--name", help="Title of the set.")] = "",
    picture: PictureOption = None,
    degrees: Annotated[bool, typer.Option("--degrees", help="Angles are degrees, unless the header says.")] = False,
    form: FormatOption = Format.TEXT,
) -> None:
    """Find the synergies that explain most of recorded postures (principal component analysis)."""
    with answering(form):
        from synergrip.hands.folder import load_hand
        from synergrip.hands.synergies.fitting import fit as make
        from synergrip.hands.synergies.synergy_file import write_synergy_file
        from synergrip.reports.data.json_synergies import fit_document
        from synergrip.reports.text.text_fit import fit_text

        picture_place(picture)
        loaded = load_hand(hand, key="--hand") if hand is not None else None
        made = make(postures, count, loaded, title=name, degrees=degrees, key="-n")
        with shown_anyway(form, lambda: fit_text(made, None, None), lambda: fit_document(made, None, None)):
            if output is not None:
                write_synergy_file(output, made.file, "--output")
                ending.keep(output)
            if picture is not None:
                from synergrip.reports.pictures.variance import draw_variance

                shares = made.principal.shares[: made.principal.decision.rank]
                draw_at(picture, lambda path: draw_variance(shares, path, made.file.title))
        show(form, lambda: fit_text(made, output, picture), lambda: fit_document(made, output, picture))


@synergies.command("list")
def list_(
    which: Annotated[str | None, typer.Argument(metavar="[HAND|FILE.toml]", help="Default: all hands.")] = None,
    form: FormatOption = Format.TEXT,
) -> None:
    """List synergy sets with the number of synergies, the rank and the length of the columns."""
    with answering(form):
        from synergrip.hands.folder import bundled_hands, load_hand
        from synergrip.hands.hand_file import FILE
        from synergrip.hands.synergies.synergy_file import SUFFIX, read_synergies, read_synergy_file
        from synergrip.reports.data.json_synergies import list_document
        from synergrip.reports.text.text_synergies import list_text

        if which is not None and which.endswith(SUFFIX) and Path(which).name != FILE:
            joints = read_synergy_file(Path(which), "FILE.toml").joints
            sets = [("", read_synergies(Path(which), joints, {}))]
        else:
            hands = [load_hand(name, key="HAND") for name in (bundled_hands() if which is None else [which])]
            sets = [(hand.name, each) for hand in hands for each in hand.synergy_sets.values()]
        show(form, lambda: list_text(sets), lambda: list_document(sets))


@synergies.command("show")
def show_(
    hand: HandArgument,
    chosen: Annotated[str | None, typer.Option("--set", metavar="SET", help=SET)] = None,
    first: FirstOption = None,
    posture: Annotated[str | None, typer.Option("--posture", metavar="P", help="A posture of the hand.")] = None,
    picture: PictureOption = None,
    form: FormatOption = Format.TEXT,
) -> None:
    """Show S with a row for each joint, its rank, and what repeats; draw what each synergy does."""
    with answering(form):
        from synergrip.hands.folder import load_hand
        from synergrip.hands.synergies.matrix import posture as take
        from synergrip.hands.synergies.matrix import resting
        from synergrip.hands.synergies.select import first_of, select
        from synergrip.reports.data.json_synergies import show_document
        from synergrip.reports.text.text_synergies import show_text

        picture_place(picture)
        loaded = load_hand(hand, key="HAND")
        whole = select(loaded, chosen, "--set")
        shown = whole if first is None else first_of(whole, first, "--first")
        q = None if posture is None else take(loaded, shown, posture, "--posture")
        with shown_anyway(
            form, lambda: show_text(loaded, shown, q, None), lambda: show_document(loaded, shown, q, None)
        ):
            if picture is not None:
                from synergrip.reports.pictures.synergies import draw_synergies

                at = resting(loaded.joints, shown) if q is None else q
                draw_at(picture, lambda path: draw_synergies(loaded, shown, at, path))
        show(form, lambda: show_text(loaded, shown, q, picture), lambda: show_document(loaded, shown, q, picture))


@synergies.command("compare")
def compare(
    sets: Annotated[list[str], typer.Argument(metavar="[HAND] A B", help="Two sets of a hand, or two synergy files.")],
    first: FirstOption = None,
    form: FormatOption = Format.TEXT,
) -> None:
    """Compare the ranges of two sets: principal angles, and what each reproduces of the other."""
    with answering(form):
        from synergrip.hands.folder import load_hand
        from synergrip.hands.synergies.angles import compare as measure
        from synergrip.hands.synergies.pairing import pair_of_files, pair_of_hand
        from synergrip.reports.data.json_synergies import compare_document
        from synergrip.reports.text.text_synergies import compare_text

        *hand, a, b = sets if 2 <= len(sets) <= 3 else _usage(sets)
        keys = ("A", "B", "--first")
        if hand:
            pair = pair_of_hand(load_hand(hand[0], key="HAND"), a, b, first, keys)
        else:
            pair = pair_of_files(a, b, first, keys)
        found = measure(pair.first.S, pair.second.S)
        show(form, lambda: compare_text(pair, found), lambda: compare_document(pair, found))


@synergies.command("needed")
def needed(
    problem: ProblemArgument,
    by: Annotated[By, typer.Option("--by", help="What makes k synergies better than others.")] = By.PEAK_FORCE,
    most: Annotated[
        int, typer.Option("--most", min=1, max=1_000_000, help="Look at all subsets of k when there are no more.")
    ] = 500,
    up_to: Annotated[int | None, typer.Option("--up-to", metavar="K", help="Only up to K synergies.")] = None,
    along: Annotated[
        bool, typer.Option("--along", help="Verdicts and figures of the hand that moves, not of its start posture.")
    ] = False,
    csv: Annotated[Path | None, typer.Option("--csv", metavar="FILE", help="Write the table here.")] = None,
    picture: PictureOption = None,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
) -> None:
    """Find the fewest synergies for a task: margin, effort, peak force and tracking error over their number."""
    with answering(form):
        from synergrip.explain.synergies.synergies_needed import synergies_needed
        from synergrip.files import refuse_unwritable
        from synergrip.reports.data.needed_files import needed_document, write_needed
        from synergrip.reports.text.text_needed import needed_text

        picture_place(picture)
        if csv is not None:
            possible("--csv", csv, refuse_unwritable)
        loaded = load_placed(problem, overrides)

        def told(size: int, done: int, of: int) -> None:
            counted(done, of, f"subsets of {size}")

        with placed(loaded), heard():
            found = synergies_needed(loaded.grasp, loaded.timed, by=by, most=most, up_to=up_to, along=along, told=told)
        with shown_anyway(form, lambda: needed_text(loaded, found), lambda: needed_document(found)):
            if csv is not None:
                with writing("--csv", csv):
                    write_needed(found, csv)
                ending.keep(csv)
            if picture is not None:
                from synergrip.reports.pictures.needed_curve import draw_needed

                draw_at(picture, lambda path: draw_needed(found, path, loaded.title))
        written = "".join(f"\nwrote {path}" for path in (csv, picture) if path is not None)
        show(form, lambda: needed_text(loaded, found) + written, lambda: needed_document(found))
    raise typer.Exit(130 if found.interrupted else 0)


def _usage(sets: list[str]) -> NoReturn:
    from synergrip.errors import InputError

    raise InputError.at("A B", f"expected a hand and two of its sets, or two synergy files; got {len(sets)}")
