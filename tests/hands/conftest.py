"""Recordings in a file of their own, read or refused."""

import pytest

from synergrip.errors import InputError
from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.recorded import read_postures


@pytest.fixture(scope="module")
def barrett():
    return load_hand("barrett")


@pytest.fixture
def read(tmp_path):
    def read(text, hand=None, **options):
        path = tmp_path / "log.csv"
        path.write_bytes(text.encode("utf-8") if isinstance(text, str) else text)
        return read_postures(path, hand, **options)

    return read


@pytest.fixture
def refused(read):
    def refused(text, hand=None, **options):
        with pytest.raises(InputError) as caught:
            read(text, hand, **options)
        return caught.value.issues

    return refused
