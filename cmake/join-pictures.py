#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Join PNG pictures of the same height, one beside the other.

    join-pictures.py OUTPUT.png PICTURE.png ...
"""

import sys

from vtkmodules.vtkFiltersCore import vtkImageAppend
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter


def main(output, pictures):
    append = vtkImageAppend()
    for picture in pictures:
        reader = vtkPNGReader()
        if not reader.CanReadFile(picture):
            sys.exit(f"{picture} is no PNG picture")
        reader.SetFileName(picture)
        append.AddInputConnection(reader.GetOutputPort())
    writer = vtkPNGWriter()
    writer.SetFileName(output)
    writer.SetInputConnection(append.GetOutputPort())
    writer.SetCompressionLevel(9)
    writer.Write()


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
