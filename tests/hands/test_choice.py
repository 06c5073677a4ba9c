"""What a user may ask for as synergies: the first K of a set, of a hand or from a file."""

import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.files import bundled
from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.select import SetChoice, first_of, select

PCA = """schema = 1
joints = ["finger3_inner", "finger2_spread", "finger1_inner"]
synergies = ["one", "two", "three"]
S = [[0.6, 0, 0.8], [0, 1, 0], [0.8, 0, -0.6]]
offset = [0.3, 0.2, 0.1]
"""
SOURCE = bundled("models") / "hands" / "barrett"


@pytest.fixture(scope="module")
def barrett():
    return load_hand("barrett")


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "pca.toml").write_text(PCA, encoding="utf-8")
    return tmp_path


def test_a_file_is_found_beside_what_names_it(barrett, folder):
    found = select(barrett, "pca.toml", folder=folder)
    assert (found.name, found.synergies) == ("pca", ("one", "two", "three"))
    np.testing.assert_allclose(found.S[[0, 2, 6]], [[0.8, 0, -0.6], [0, 1, 0], [0.6, 0, 0.8]])
    np.testing.assert_array_equal(found.S[[3, 4, 5]], 0)
    absolute = select(barrett, str(folder / "pca.toml"))
    np.testing.assert_array_equal(absolute.S, found.S)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_the_first_of_a_file(barrett, folder, count):
    whole = select(barrett, "pca.toml", folder=folder)
    found = select(barrett, SetChoice("pca.toml", count), folder=folder)
    assert found.synergies == ("one", "two", "three")[:count]
    np.testing.assert_array_equal(found.S, whole.S[:, :count])
    np.testing.assert_array_equal(found.offset, whole.offset)
    assert found.effort_limits.shape == (count,)


def test_the_first_of_a_named_set(barrett):
    np.testing.assert_array_equal(
        select(barrett, SetChoice("close", 1)).S, barrett.synergy_sets["close"].S[:, :1]
    )  # fmt: skip
    np.testing.assert_array_equal(select(barrett, SetChoice("all", 5)).S, np.eye(8)[:, :5])
    assert select(barrett, SetChoice("close")) is barrett.synergy_sets["close"]


@pytest.mark.parametrize("count", [1, 2, 3])
def test_a_number_takes_the_first_of_a_default_set_from_a_file(folder, count):
    text = (SOURCE / "hand.toml").read_text(encoding="utf-8")
    table = '[synergies.pca]\nfile = "pca.toml"\n\n[synergies.motors]\n'
    (folder / "hand.toml").write_text(text.replace("[synergies.motors]\n", table), encoding="utf-8")
    postures = text[text.index("[postures.open]") :]
    (folder / "hand.toml").write_text(
        text.replace("[synergies.motors]\n", table).replace(postures, ""), encoding="utf-8"
    )
    (folder / "hand.urdf").write_bytes((SOURCE / "hand.urdf").read_bytes())
    hand = load_hand(folder)
    found = select(hand, count)
    assert (found.name, found.synergies) == ("pca", ("one", "two", "three")[:count])
    np.testing.assert_array_equal(found.S, hand.synergy_sets["pca"].S[:, :count])


@pytest.mark.parametrize(
    ("wish", "key", "fragment"),
    [
        (SetChoice("motrs", 2), "k.set", "did you mean 'motors'?"),
        (SetChoice("motors", 0), "k.first", "expected 1 to 4, the number of synergies of 'motors', got 0"),
        (SetChoice("pca.toml", 4), "k.first", "expected 1 to 3, the number of synergies of 'pca', got 4"),
        (SetChoice("none.toml", 1), "k.set", "synergy file"),
        ("none.toml", "k", "not found"),
    ],
)
def test_wishes_that_cannot_be(barrett, folder, wish, key, fragment):
    with pytest.raises(InputError) as caught:
        select(barrett, wish, "k", folder)
    (issue,) = caught.value.issues
    assert issue.key == key
    assert fragment in issue.message


def test_a_number_that_is_too_large_says_how_to_get_every_joint_and_a_table_does_not(barrett):
    with pytest.raises(InputError, match='got 5; write "all" for the 8 joints'):
        select(barrett, 5)
    with pytest.raises(InputError, match=r"got 5$"):
        first_of(barrett.synergy_sets["motors"], 5, "k")
