"""``synergrip analyse``: its picture and its table of dimensions."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path

import command_line
import pytest

from synergrip.problems.problem import load_problem
from synergrip.statics.dimensions import dimension_table

run, document = partial(command_line.run, "analyse"), partial(command_line.document, "analyse")


def test_a_picture_adds_one_line_and_one_key() -> None:
    name = "figure.svg"
    plain, drawn = run("table2-hard-motors"), run("table2-hard-motors", "--picture", name)
    assert drawn.exit_code == 0
    assert drawn.stdout == f"{plain.stdout}\nwrote {name}\n"
    assert Path(name).stat().st_size > 1000
    found = document("table2-hard-motors", "--picture", name)
    assert found.pop("picture") == name
    assert found == document("table2-hard-motors")


def test_a_folder_that_is_not_there_is_made() -> None:
    assert run("tripod", "--picture", "a/b/figure.svg").exit_code == 0
    assert Path("a/b/figure.svg").is_file()


def test_a_picture_that_cannot_be_written_or_has_no_format_is_bad_input() -> None:
    Path("file").touch()
    for picture, words in (("figure.jpg", "'.svg', '.png' or '.pdf'"), ("file/figure.svg", "cannot write")):
        result = run("tripod", "--picture", picture)
        assert (result.exit_code, result.stdout) == (2, "")
        assert words in result.stderr
        error = document("tripod", "--picture", picture, code=2)["error"]
        assert (error["type"], error["key"]) == ("InputError", "--picture")
        assert words in error["message"]
    assert run("pinch-hard", "--picture", "figure.jpg").exit_code == 2
    assert {path.name for path in Path().iterdir()} == {"file"}


def test_matrices_without_places_cannot_be_drawn() -> None:
    from synergrip.files import bundled

    grasp = json.loads((bundled("problems") / "tripod.json").read_text(encoding="utf-8"))
    for contact in grasp["contacts"]:
        del contact["point_m"], contact["normal"]
    grasp["G"] = [[10 * x if i > 2 else x for x in row] for i, row in enumerate(grasp["G"])]
    grasp["G"][3][0] += 1.0
    Path("grasp.json").write_text(json.dumps(grasp), encoding="utf-8")
    error = document("grasp.json", "--picture", "figure.svg", code=2)["error"]
    assert error["key"] == "--picture"
    assert "point_m" in error["message"]
    assert not Path("figure.svg").exists()


def test_an_object_that_is_not_restrained_is_not_drawn() -> None:
    result = run("pinch-hard", "--picture", "figure.svg")
    assert result.exit_code == 1
    assert "'figure.svg' was not drawn" in result.stderr
    assert result.stdout == run("pinch-hard").stdout
    assert document("pinch-hard", "--picture", "figure.svg", code=1)["picture"] is None
    assert not Path("figure.svg").exists()


def test_a_table_says_what_each_number_of_synergies_controls(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    plain, found = run("table2-hard-motors").stdout, run("table2-hard-motors", "--table").stdout
    assert found.splitlines()[:2] == plain.splitlines()[:2]  # what was read, and the task
    lines = [line.split() for line in found.splitlines()[2:]]
    assert lines[3:7] == [
        ["1", "spread", "0", "0", "1", "1", "0", "0"],
        ["2", "finger1", "1", "0", "1", "2", "0", "0"],
        ["3", "finger2", "2", "0", "1", "3", "0", "0"],
        ["4", "finger3", "3", "0", "1", "4", "0", "0"],
    ]
    assert "?" not in found


@pytest.mark.parametrize("name", ["table2-soft-joints", "tripod", "pinch-soft"])
def test_the_document_holds_the_same_table(name: str) -> None:
    found = document(name, "--table")
    table = found.pop("table")
    assert found == document(name)
    columns = dimension_table(load_problem(name).grasp)
    assert [row["n_z"] for row in table] == list(range(1, found["structure"]["n_z"] + 1))
    for column in columns:
        for k, row in enumerate(table):
            entry = row[column.kind]
            if column.rows:
                assert (entry["dim_E_s"], entry["dim_Gamma_ucs"]) == (column.rows[k].E_s, column.rows[k].Gamma_ucs)
                assert entry["dim_E_s"] + entry["dim_Gamma_ucs"] + entry["dim_Gamma_zr"] == row["n_z"]
                assert entry["ambiguous"] is False
            else:
                assert entry is None


def test_a_table_says_why_it_has_no_numbers() -> None:
    words = " ".join(run("pinch-hard", "--table").stdout.split())
    assert "hard the object may turn about the line through left and right; the dimensions are those of" in words
    assert "soft the matrices do not say how the contacts transmit moments about the normals" in words
    hard = {"dim_E_s": 1, "dim_Gamma_ucs": 0, "dim_Gamma_zr": 0, "ambiguous": False}
    assert document("pinch-hard", "--table", code=1)["table"] == [{"n_z": 1, "hard": hard, "soft": None}]


def test_ambiguous_rows_are_marked() -> None:
    """A spread that turns about an axis a hundredth of a nanometre beside the contact."""
    shifted = run("table2-hard-motors", "--table", "--set", POSTURE).stdout
    assert "1?" in shifted or "0?" in shifted
    assert "? ambiguous" in shifted


POSTURE = 'hand.posture={ spread = "30 deg", finger1 = "0 deg", finger2 = "90.00001 deg", finger3 = "90.00001 deg" }'


def test_what_can_hardly_be_meant_is_told_here_too() -> None:
    doubtful = ("tripod", "--set", "grasp.friction_factor=5")
    for options in ((), ("--table",), ("--quality",)):
        words = " ".join(run(*doubtful, *options).stdout.split())
        assert words.count("a coefficient of friction of 4 (contacts 'C1', 'C2', 'C3')") == 1
    (note,) = document(*doubtful)["notes"]
    assert "grasp.friction_factor: a coefficient of friction of 4" in note


def test_quality_is_shown_instead_and_is_a_part_of_the_document() -> None:
    plain, shown = run("tripod").stdout, run("tripod", "--quality").stdout
    assert shown.splitlines()[:2] == plain.splitlines()[:2]
    assert "is graspable, defective and hyperstatic" in shown
    found = document("tripod", "--quality")
    properties = found.pop("properties")
    assert found == document("tripod")
    assert {name: each["dimension"] for name, each in properties["references"].items()} == {
        "pure squeeze": 1, "spurious squeeze": 1, "motion without force": 2, "redundant motion": 0,
    }  # fmt: skip
    for group in (*properties["classes"].values(), properties["references"], properties["ellipsoids"],
                  properties["singularity"]):  # fmt: skip
        for each in group.values():
            assert each["formula"]
            assert each["unit"]
            assert each["source"]


def test_quality_tells_of_an_object_that_is_not_held_and_of_many_squeezes() -> None:
    shown = run("pinch-hard", "--quality")
    assert shown.exit_code == 1
    assert "softest  rotation about the line through left and right: not resisted at all" in shown.stdout
    properties = document("pinch-hard", "--quality", code=1)["properties"]
    assert properties["classes"]["joints"]["indeterminate"]["holds"] is True
    assert properties["compliance"] is None
    assert properties["ellipsoids"]["compliance"]["values"][0] is None
    assert "and 5 more, in the JSON document" in run("human-ball", "--quality").stdout
