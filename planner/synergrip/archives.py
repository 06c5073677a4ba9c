"""Arrays of an .npz archive, of which nothing is believed: sizes are compared with the bytes that are there."""

from __future__ import annotations

import io
import math
import struct
import tokenize
import zipfile
import zlib
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.errors import InputError
from synergrip.plain_file import read_bytes

LARGEST_ARRAYS = 128_000_000
"""Bytes of all arrays that are read, unpacked: what a small archive unpacks to has no bound of its own."""
MOST_MEMBERS = 1000
PACKED = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
"""How numpy packs; other ways may ask for gigabytes to unpack."""

_MEMBER = b"PK\x01\x02"  # begins the entry of each member in the list at the end of an archive
_BROKEN = (
    OSError, EOFError, LookupError, ValueError, TypeError, SyntaxError, RuntimeError, MemoryError, OverflowError,
    struct.error, tokenize.TokenError, zipfile.BadZipFile, zlib.error,
)  # fmt: skip


class NoArchiveError(Exception):
    """The file is no archive of plain arrays; says why."""


def read_arrays(path: Path, names: Collection[str] | None, kind: str, key: str = "") -> Mapping[str, NDArray[Any]]:
    """Return the arrays of an .npz archive by name.

    Args:
        path: the file.
        names: those wanted; what else is there is not unpacked. None for all of them.
        kind: what the file is to the user, for messages.
        key: the key that names the file, for messages.

    Raises:
        InputError: a file that `read_bytes` refuses.
        NoArchiveError: no archive, or in it something else than plain arrays of reasonable size.
    """
    raw = read_bytes(path, kind, key)
    try:
        return _arrays(raw, names)
    except (InputError, NoArchiveError):
        raise
    except _BROKEN as error:
        raise NoArchiveError(str(error)[:200] or type(error).__name__) from None


def _arrays(raw: bytes, names: Collection[str] | None) -> dict[str, NDArray[Any]]:
    if raw.count(_MEMBER) > MOST_MEMBERS:
        raise NoArchiveError(f"it has more than {MOST_MEMBERS} members")
    found: dict[str, NDArray[Any]] = {}
    left = LARGEST_ARRAYS
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        for info in archive.infolist():
            name = info.filename.removesuffix(".npy")
            if names is not None and name not in names:
                continue
            if info.compress_type not in PACKED:
                raise NoArchiveError(f"'{name}' is packed in another way than numpy packs")
            left -= info.file_size
            if left < 0:
                raise NoArchiveError(f"its arrays are larger than {LARGEST_ARRAYS // 1_000_000} MB together")
            found[name] = _array(name, archive.read(info))
    return found


def _array(name: str, raw: bytes) -> NDArray[Any]:
    """Return an array whose header states as many bytes as there are."""
    stream = io.BytesIO(raw)
    version = np.lib.format.read_magic(stream)
    read_header = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
    shape, _, dtype = read_header(stream)
    if dtype.hasobject or dtype.fields is not None:
        raise NoArchiveError(f"'{name}' is no plain array")
    there, stated = len(raw) - stream.tell(), math.prod(shape) * dtype.itemsize
    if stated != there:
        raise NoArchiveError(f"'{name}' states {shape} values of {dtype}, {stated:,} bytes, and has {there:,}")
    stream.seek(0)
    return np.asarray(np.lib.format.read_array(stream, allow_pickle=False))
