// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material as it is shown: read or made of parameters, with the edits of its samples. Without Qt.
 */

#ifndef MadeMaterial_h
#define MadeMaterial_h

#include "Inputs.h"
#include "State.h"

#include <map>
#include <string>

namespace explorer
{
/// What a state says of all materials beside their files.
struct MaterialSettings
{
  ModelStates Models;
  std::map<std::string, SampleEdits> Edits;
};

struct MadeMaterial
{
  tool::Material Original; // without edits
  tool::Material Shown;    // prepared
  ModelValues Values;      // of a model; empty for others
  SampleEdits Edits;

  /// Whether it would be another one by these settings.
  bool IsAnother(const MaterialSettings& settings) const;
};

/// By its file or name. Takes long. Throws tool::Error.
MadeMaterial MakeMaterial(const std::string& file, const MaterialSettings& settings);

/// The same by other settings, without reading it again.
MadeMaterial RemakeMaterialOf(const tool::Material& original, const MaterialSettings& settings);
} // namespace explorer

#endif
