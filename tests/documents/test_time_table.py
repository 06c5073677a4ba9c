import numpy as np
import pytest

from synergrip.documents.time_table import MODES, MOTION, REFERENCES, WRENCH, read_table
from synergrip.errors import InputError

HEADER = "t_s," + ",".join(WRENCH) + "\n"


@pytest.fixture
def write(tmp_path):
    def written(text):
        path = tmp_path / "table.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return written


def issues(path, columns, key="task.wrench"):
    with pytest.raises(InputError) as caught:
        read_table(path, columns, key)
    return caught.value.issues


def test_values_and_times(write):
    table = read_table(write(HEADER + "0,1,2,3,4,5,6\n0.5,-1,2e-3,.5,+4,5.,6\n"), WRENCH)
    assert np.array_equal(table.times, [0.0, 0.5])
    assert np.array_equal(table.values, [[1, 2, 3, 4, 5, 6], [-1, 0.002, 0.5, 4, 5, 6]])
    assert not table.values.flags.writeable
    assert not table.times.flags.writeable


def test_columns_may_stand_in_any_order(write):
    table = read_table(write("rz_rad,x_m,y_m,t_s,z_m,rx_rad,ry_rad\n6,1,2,0,3,4,5\n"), MOTION)
    assert np.array_equal(table.values, [[1, 2, 3, 4, 5, 6]])


@pytest.mark.parametrize(("prefix", "name"), [(MODES, "beta"), (REFERENCES, "zr")])
def test_any_number_of_columns(write, prefix, name):
    table = read_table(write(f"t_s,{name}_2,{name}_1,{name}_3\n0,2,1,3\n"), prefix)
    assert np.array_equal(table.values, [[1, 2, 3]])


def test_comments_blank_lines_quotes_spaces_and_windows_are_tolerated(write):
    plain = read_table(write("t_s,zr_1\n0,1\n1,2\n"), REFERENCES)
    text = '\ufeff# recorded\r\n\r\n"t_s", zr_1\r\n  # more\r\n0 , 1\r\n\r\n"1","2"\r\n'
    other = read_table(write(text), REFERENCES)
    assert np.array_equal(plain.times, other.times)
    assert np.array_equal(plain.values, other.values)


def test_every_wrong_cell_has_its_place(write):
    found = issues(write("t_s,zr_1,zr_2\n0, nan,x\n1,2,1_0\n"), REFERENCES, "plan")
    assert [(issue.line, issue.column, issue.length) for issue in found] == [(2, 4, 3), (2, 8, 1), (3, 5, 3)]
    assert all(issue.key == "plan" for issue in found)
    assert found[0].source == "0, nan,x"


@pytest.mark.parametrize(
    ("cell", "shown"),
    [
        ("\u0661\u0662", "\u0661\u0662"), ("\uff11", "\uff11"), ('"1', '"1'), ('1"', '1"'), ('""1""', '"1"'),
        ('"', '"'), ('1"2', '1"2'),
    ],
)  # fmt: skip
def test_other_digits_and_half_quotes_are_no_numbers(write, cell, shown):
    (issue,) = issues(write(f"t_s,zr_1\n0,{cell}\n"), REFERENCES)
    assert issue.message == f"expected a number, got '{shown}'"
    assert (issue.line, issue.column) == (2, 3 + cell.find(shown))


def test_a_half_quoted_header_is_refused(write):
    assert "unknown column '\"zr_1'" in issues(write('t_s,"zr_1\n0,1\n'), REFERENCES)[0].message


def test_times_are_judged_although_other_lines_are_wrong(write):
    found = issues(write("zr_1,t_s\n0,1\nx,2\n0,0.5\n"), REFERENCES)
    assert [(issue.line, issue.column) for issue in found] == [(3, 1), (4, 3)]
    assert found[1].message == "times must increase: 0.5 s comes after 1 s"


def test_a_gap_in_the_numbering_is_refused(write):
    found = issues(write("t_s,beta_1,beta_3\n0,1,2\n"), MODES)
    assert "unknown column 'beta_3'; did you mean 'beta_2'?" in found[0].message


def test_a_flood_of_issues_is_cut(write):
    found = issues(write("t_s,zr_1\n" + "".join(f"{i},x\n" for i in range(100))), REFERENCES)
    assert len(found) == 20
    assert found[-1].message.endswith("(and 80 more in this file)")


def test_a_missing_file_is_an_issue_of_the_key_that_names_it(write):
    (issue,) = issues(write("").with_name("tabel.csv"), WRENCH)
    assert (issue.key, issue.file) == ("task.wrench", "")
    assert issue.message.endswith("did you mean 'table.csv'?")
