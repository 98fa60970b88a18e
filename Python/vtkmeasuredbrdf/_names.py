# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Whether a text means a file or the name of something embedded."""

from __future__ import annotations

import difflib
import os
from typing import NoReturn


def is_path(text: str) -> bool:
    """Whether the text can only mean a file: it has a folder or an extension."""
    return os.path.basename(text) != text or os.path.splitext(text)[1] != ""


def fail_to_find(text: str, names: list[str], kind: str) -> NoReturn:
    """The error that names the nearest names."""
    nearest = difflib.get_close_matches(text, names, 3, 0.5) or names[:3]
    raise ValueError(f"{text!r} is neither a file nor an {kind}; the nearest names are "
                     + ", ".join(map(repr, nearest)))
