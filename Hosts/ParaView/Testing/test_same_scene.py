# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of same_scene.py by pvbatch and by ParaView's window: `test_same_scene.py PREFIX`."""
import os
import sys

from common import OUTPUT, get_difference, read

pictures = {host: read(os.path.join(OUTPUT, f"{sys.argv[1]}-{host}.png")) for host in ("pvbatch", "window")}
for host, picture in pictures.items():
    changed = (picture != pictures["pvbatch"]).any(axis=2).sum()
    largest, mean = get_difference(picture, pictures["pvbatch"])
    print(f"{host}: largest difference from pvbatch {largest}, mean {mean:.5f}, {changed} pixels of {picture.shape[0] * picture.shape[1]}")
    assert largest <= 1, (host, largest)
print("passed")
