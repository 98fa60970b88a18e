// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Models with parameters as materials: what can be set of each, and the material of it. Without Qt.
 */

#ifndef ModelMaterials_h
#define ModelMaterials_h

#include "Inputs.h"
#include "Lists.h"
#include "State.h"

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace explorer
{
struct ModelParameter
{
  std::string Key;  // in state files
  std::string Name; // for people
  std::string Description;
  double Least;
  double Largest;
  std::vector<double> Default;      // one number, or red, green and blue
  bool IsLogarithmic = false;       // the slider's scale
  std::vector<std::string> Choices; // where it is one of a few: their names, from 0
};

struct ParametricModel
{
  std::string Key; // as vtkBRDFModels calls it
  std::string Name;
  std::string Description;
  std::vector<ModelParameter> Parameters;
};

/// Lambert, Blinn-Phong, Ashikhmin-Shirley, D-BRDF.
const std::vector<ParametricModel>& GetModels();

///@{
/// A model as State names it in a material's place, "model:Lambert"; null: it is none.
std::string GetModelFile(const ParametricModel& model);
const ParametricModel* FindModel(const std::string& file);
///@}

/// All parameters of a model: those that a state has set, and the others' defaults.
ModelValues GetValues(const ParametricModel& model, const ModelStates& states);

/// The same of a material by its name or file; nothing where that is no model.
ModelValues FindValues(const std::string& file, const ModelStates& states);

/// Of values that are in range.
vtkSmartPointer<vtkBRDF> MakeModel(const ParametricModel& model, const ModelValues& values);

/// The models as lines of a list.
std::vector<Item> ListModels();

/// A material by name or file as State has it, models among them. Throws tool::Error.
tool::Material LoadMaterial(const std::string& file, const ModelStates& states);
} // namespace explorer

#endif
