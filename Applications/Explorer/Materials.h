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

#include <map>
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

/// Parameters of a model, by their keys: one number, or red, green and blue.
using ModelValues = std::map<std::string, std::vector<double>>;

struct ModelParameter
{
  std::string Key;  // in names of models
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

/**
 * A model is named in a material's place with those of its parameters that are not as usual:
 * "model:Lambert", "model:BlinnPhong exponent=300 specular=0.1,0.2,0.3".
 */
std::string NameModel(const ParametricModel& model, const ModelValues& values);

/// The model of that name, whatever follows it; null: it is none's.
const ParametricModel* FindModel(const std::string& name);

/// All parameters of a name that a model has. Throws tool::Error that says what was expected.
ModelValues GetValues(const std::string& name);

/// A copy for another thread; the material itself where its class has none.
tool::Material MakeSnapshot(const tool::Material& material);

/// A material as it is shown and plotted.
struct ShownMaterial
{
  tool::Material Material;     // prepared
  nlohmann::ordered_json Info; // what tool::InspectMaterial finds; null before
};

/// By name or file as State has it, models among them; without Info. Takes long. Throws
/// tool::Error.
ShownMaterial ReadMaterial(const std::string& file);
} // namespace explorer

#endif
