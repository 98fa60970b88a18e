// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What can be shown: what is built in, models with parameters, and files; and a material as it is
 * shown. Without Qt.
 */

#ifndef Materials_h
#define Materials_h

#include "Inputs.h"
#include "State.h"

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace explorer
{
enum class FileKind
{
  Material,
  Environment,
  MaterialOrEnvironment,
  Mesh,
  State
};

/// Names without '/', '.' and '#' are built in, materials where no environment is called so. An
/// ending that nobody knows is taken for a material's: its reader says what it reads.
FileKind FindFileKind(const std::string& file);

///@{
/// Endings with their dots.
std::vector<std::string> GetMaterialExtensions();
const std::vector<std::string>& GetEnvironmentExtensions();
///@}

/// A line of a list.
struct Item
{
  std::string File; // name or path, as State has it
  std::string Name;
  std::string Kind; // heading
  std::string Source;
};

///@{
/// Built-in ones under their headings, and the opened files under theirs.
std::vector<Item> ListMaterials(const std::vector<std::string>& opened);
std::vector<Item> ListEnvironments(const std::vector<std::string>& opened);
std::vector<Item> ListMeshes(const std::string& opened);
///@}

/// Whether it is a built-in name, or a model's, and no file.
bool IsBuiltIn(const std::string& name);

struct ModelParameter
{
  std::string Key;  // in state files
  std::string Name; // for people
  std::string Description;
  double Least;
  double Largest;
  std::vector<double> Default; // one number, or red, green and blue
  bool IsLogarithmic = false;  // the slider's scale
};

struct ParametricModel
{
  std::string Key; // as vtkBRDFModels calls it
  std::string Name;
  std::string Description;
  std::vector<ModelParameter> Parameters;
  vtkSmartPointer<vtkBRDF> (*Make)(const ModelValues& values); // values that are in range
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

/// A copy for another thread; the material itself where its class has none.
tool::Material MakeSnapshot(const tool::Material& material);

/// A material as it is shown and plotted.
struct ShownMaterial
{
  tool::Material Material;     // prepared
  ModelValues Values;          // of a model; empty for others
  nlohmann::ordered_json Info; // what tool::InspectMaterial finds; null before
};

/// By name or file as State has it, models among them; without Info. Takes long. Throws
/// tool::Error.
ShownMaterial ReadMaterial(const std::string& file, const ModelStates& models);
} // namespace explorer

#endif
