// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The shading models of other programs as BRDFs, so that what they show can be summed and measured
 * like a measured material: glTF, standard_surface, OpenPBR, UsdPreviewSurface and VTK's PBR.
 */

#ifndef SurfaceModel_h
#define SurfaceModel_h

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace tool
{
/// Parts of a model that a file may leave out; Core is always there.
enum class Feature
{
  Core,
  Specular,
  Coat,
  Sheen,
  Anisotropy
};

/// "core", "specular", "coat", "sheen", "anisotropy".
const char* GetFeatureName(Feature feature);

/// A parameter: one number or a linear color.
struct ModelParameter
{
  std::string Name; // as the target's files write it
  std::size_t Size; // 1, or 3 for a color
  double Least;     // the range that is searched, within the target's valid range
  double Most;
  double Neutral; // what stands for it where its part is left out
  Feature Part;
  /// Where the search begins: the k-th start takes the k-th value of every parameter of the part,
  /// or its last one. None: the material's albedo.
  std::vector<double> Starts;
  double MostUsual = std::numeric_limits<double>::infinity(); // that people set by hand
};

/// Two directions and what the formulas take of them. All unit, in the local frame.
struct Directions
{
  Directions(const glm::dvec3& light, const glm::dvec3& view);

  glm::dvec3 Light, View, Half;
  double NdL, NdV, NdH, VdH;
};

/// The numbers of a model's parameters, one after the other, as a struct of doubles and colors in
/// that order.
template <typename Values>
Values ReadValues(const double* numbers)
{
  static_assert(std::is_trivially_copyable_v<Values> && sizeof(glm::dvec3) == 3 * sizeof(double));
  Values values;
  std::memcpy(&values, numbers, sizeof(Values));
  return values;
}

/// One number of a parameter.
struct ModelNumber
{
  const ModelParameter* Parameter;
  std::size_t Channel; // of a color, else 0
};

/// A shading model: its parameters, and f as a function of their numbers.
struct ShadingModel
{
  std::string Name;
  std::string Title; // what people call it
  /// Colors first take their red, then green and blue: the order of the numbers. All models begin
  /// with the core's color, metallic part and roughness.
  std::vector<ModelParameter> Parameters;
  glm::dvec3 (*Shade)(const double* numbers, const Directions& directions);
};

/**
 * A shading model with the values of its parameters. It has a C++ form only: no GLSL, and no bounds
 * of use to a planner.
 */
class SurfaceModel : public vtkBRDF
{
public:
  static SurfaceModel* New();
  vtkTypeMacro(SurfaceModel, vtkBRDF);

  /// "gltf", "standard_surface", "open_pbr", "preview_surface" or "vtk_pbr", with neutral values.
  static vtkSmartPointer<SurfaceModel> Make(const std::string& name);

  std::string GetTitle() const { return this->Model->Title; }
  const std::vector<ModelParameter>& GetParameters() const { return this->Model->Parameters; }

  ///@{
  /// All numbers of all parameters in that order, and their values; as many as there are.
  const std::vector<ModelNumber>& GetNumbers() const { return this->Numbers; }
  void SetValues(const std::vector<double>& values);
  const std::vector<double>& GetValues() const { return this->Values; }
  ///@}

  ///@{
  /// The values of a parameter by its name; it must be one of the model's.
  double GetNumber(const std::string& name) const { return this->Values[this->Find(name)]; }
  std::array<double, 3> GetColor(const std::string& name) const;
  ///@}

  /// Evaluate() for directions that are there already, unit and above the horizon.
  glm::dvec3 EvaluateDirections(const Directions& directions) const;

  /// Whether any number of the part is not neutral.
  bool HasFeature(Feature feature) const;

  void GetShaderInputs(vtkBRDFShaderInputs&) override {}
  bool IsIsotropic() override { return !this->HasFeature(Feature::Anisotropy); }
  bool IsReciprocal() override { return false; } // layers may depend on the view alone

protected:
  SurfaceModel();

  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;

private:
  void SetModel(const ShadingModel& model);
  std::size_t Find(const std::string& name) const;

  const ShadingModel* Model;
  std::vector<ModelNumber> Numbers;
  std::vector<double> Values;
};

///@{
/// The models themselves (VTK's, glTF's and USD's in PbrModels.cxx).
const std::vector<ShadingModel>& GetPbrModels();
const std::vector<ShadingModel>& GetMaterialXModels();
///@}
} // namespace tool

#endif
