// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Geometry to show a material on.
 */

#ifndef Meshes_h
#define Meshes_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace tool
{
/// Read ply, stl, obj, vtp, vtk, gltf or glb by its ending, in a process of its own where the
/// tool's program lies beside this one (on Linux): a damaged file that crashes VTK's reader is an
/// error. A file without normals gets smooth ones. "ball-on-foot" gives MakeBallOnFoot(). Throws
/// Error.
vtkSmartPointer<vtkPolyData> LoadMesh(const std::string& path);

/// The tool's first argument in that process; the file's path and that of the answer follow.
constexpr const char* ReadMeshOption = "--read-mesh-for-parent";

/// What the tool does then: it writes the mesh, or what is wrong. Returns the exit status.
int AnswerLoadMesh(const std::string& path, const std::string& answer);

/// The endings of files that LoadMesh takes, with the dot.
const std::vector<std::string>& GetMeshExtensions();

/// Whether LoadMesh takes it, by its ending or name.
bool IsMeshFile(const std::string& path);

/// A unit sphere with exact normals.
vtkSmartPointer<vtkPolyData> MakeSphere();

/**
 * The gallery's piece: a ball on a fluted foot, as a surface of revolution of circular arcs with
 * folds. The ball shows the highlight's shape, neck and folds stretch it and turn it to grazing
 * angles.
 */
vtkSmartPointer<vtkPolyData> MakeBallOnFoot();
} // namespace tool

#endif
