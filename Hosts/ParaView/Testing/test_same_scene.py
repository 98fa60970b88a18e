# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of same_scene.py by pvbatch and by ParaView's window, and on one and on two ranks: `test_same_scene.py PREFIX`."""
import os
import sys

from common import OUTPUT, get_difference, read

for hosts in (("pvbatch", "window"), ("off-1", "off-2")):
    first, picture = (read(os.path.join(OUTPUT, f"{sys.argv[1]}-{host}.png")) for host in hosts)
    changed = (picture != first).any(axis=2).sum()
    largest, mean = get_difference(picture, first)
    print(f"{hosts[1]}: largest difference from {hosts[0]} {largest}, mean {mean:.5f}, {changed} pixels of {picture.shape[0] * picture.shape[1]}")
    assert largest <= 1, (hosts, largest)
print("passed")
