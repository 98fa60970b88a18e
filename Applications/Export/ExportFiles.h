// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Files that show a shading model on a ball in other programs.
 */

#ifndef ExportFiles_h
#define ExportFiles_h

#include "ModelFit.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace tool
{
/// A kind of file that is exported to.
struct ExportTarget
{
  std::string Name;                    // of --to
  std::vector<std::string> Extensions; // that its files may end in
  std::vector<std::string> Models;     // that it holds, or may hold: one after the other in a file
  std::string Description;
  /// The bytes of a file of these fits, one for each model. binary: .glb, not .gltf.
  std::string (*Make)(const std::vector<ModelFit>& fits, const std::string& name, bool binary);
};

const std::vector<ExportTarget>& GetExportTargets();

///@{
/**
 * The bytes of a file. name: the material's; in files that restrict names, other characters become
 * '_'.
 *
 * MakeGltf: glTF 2.0 as JSON with its buffer inside, or as GLB. The mesh is a ball with normals and
 * tangents. MakeMaterialX: one material for each fit. MakeUsd: text. MakeVtkJson: what
 * vtkProperty's setters take. MakeParaViewScript: for pvpython and ParaView's Load State.
 */
std::string MakeGltf(const ModelFit& fit, const std::string& name, bool binary);
std::string MakeMaterialX(const std::vector<ModelFit>& fits, const std::string& name);
std::string MakeUsd(const ModelFit& fit, const std::string& name);
std::string MakeVtkJson(const ModelFit& fit, const std::string& name);
std::string MakeParaViewScript(const ModelFit& fit, const std::string& name);
///@}

/// A name of ASCII letters, digits and '_' that begins with a letter.
std::string MakeIdentifier(const std::string& name);

/// A number with at most 4 decimals, as the files have them.
std::string FormatValue(double value);

/// A parameter's number, or a list of three.
nlohmann::ordered_json GetJson(const ModelFit& fit, const ModelParameter& parameter);

/// The numbers as the files have them, within their ranges.
void RoundValues(SurfaceModel* model);
} // namespace tool

#endif
