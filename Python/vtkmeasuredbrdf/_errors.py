# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Error events of C++ objects as texts for Python's exceptions, their notes as its warnings, and names that are none."""

from __future__ import annotations

import os
import re
import warnings
from typing import Any, NoReturn

# "ERROR: In FILE, line N\nCLASS (ADDRESS): TEXT"
_PREFIX = re.compile(r"\A\s*(ERROR: In .*?, line \d+\n)?(\w+ \((0x)?[0-9a-fA-F]+\): )?", re.DOTALL)


class TakenErrors:
    """Takes the error events of a VTK object inside of a with statement: VTK does not print them then.

    `text` is the last one, without the place in the source; "" if there was none.
    """

    def __init__(self, source: Any) -> None:
        self.text = ""
        self._source = source
        self._tag = 0

    def __enter__(self) -> TakenErrors:
        self._tag = self._source.AddObserver("ErrorEvent", self._take)
        return self

    def __exit__(self, *_: object) -> None:
        self._source.RemoveObserver(self._tag)

    def _take(self, _source: Any, _event: str, text: str) -> None:
        self.text = _PREFIX.sub("", text or "", count=1).strip()

    _take.CallDataType = "string0"  # type: ignore[attr-defined]


def warn_of_notes(path: str, reader: Any, stacklevel: int = 4) -> None:
    """One warning with what a reader of files has to say of the last one, if anything."""
    notes = reader.GetNotes()
    if notes:
        warnings.warn(f"{path}: " + " ".join(notes.splitlines()), stacklevel=stacklevel)


def is_path(text: str) -> bool:
    """Whether the text can only mean a file: it has a folder or an extension."""
    return os.path.basename(text) != text or os.path.splitext(text)[1] != ""


def fail_to_find(text: str, names: list[str], fault: str) -> NoReturn:
    """The error that names the nearest names."""
    import difflib

    nearest = difflib.get_close_matches(text, names, 3, 0.5) or names[:3]
    raise ValueError(f"{text!r} is {fault}; the nearest names are " + ", ".join(map(repr, nearest)))
