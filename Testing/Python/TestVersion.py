# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""With a VTK of another minor version the package is not loaded; the exception says which one it needs."""

from vtkmodules import vtkCommonCore

built_for, _, patch = vtkCommonCore.vtkVersion.GetVTKVersion().rpartition(".")


class Another:
    @staticmethod
    def GetVTKVersion():
        return f"{built_for}9.{patch}"


vtkCommonCore.vtkVersion = Another
try:
    import vtkmeasuredbrdf

    raise AssertionError(f"{vtkmeasuredbrdf} was imported")
except ImportError as error:
    assert f"pip install 'vtk=={built_for}.*'" in str(error), error
