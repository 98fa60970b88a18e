// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The arguments that several subcommands take: materials, environments, light sets, sizes, views.
 */

#ifndef Inputs_h
#define Inputs_h

#include "vtkBRDF.h"
#include "vtkBTDF.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkSmartPointer.h"

#include <string>

namespace CLI
{
class App;
}

namespace tool
{
struct Size
{
  int Width;
  int Height;
};

struct View
{
  double Azimuth;      // degrees
  double Elevation;    // degrees, in [-90, 90]
  double Angle = 30.0; // vertical angle of view in degrees, in [1, 120]
};

struct Range
{
  double Begin; // degrees
  double End;
};

/// "800x600" -> size, each side in [1, largest]. Throws UsageError that names the option.
Size ParseSize(const std::string& option, const std::string& text, int largest);

/// "30,-20" or, with the angle of view, "30,-20,50" -> view. Throws UsageError.
View ParseView(const std::string& text);

/// "9,57" -> polar angles, 0 <= begin < end <= 90, at least vtkBasisBRDF::MinimumZoneWidth apart.
/// Throws UsageError.
Range ParseZone(const std::string& option, const std::string& text);

/// Help texts for FILE and ENV.
std::string GetMaterialHelp();
extern const char* const EnvironmentHelp;

/// A material and what its reader said about it.
struct Material
{
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkBTDF> Transmission; // null: the file has none, or it is not read
  std::string File;                      // the argument
  std::string Name;                      // embedded name, the material's own, or the file's
  std::string Source;                    // for people; may be empty
  std::string Kind;                      // of embedded materials, else empty
  std::string Format;                    // "embedded" or the reader's name of the format
  std::string Notes;
  vtkIdType NumberOfNegativeValues = 0;
  vtkIdType NumberOfInvalidValues = 0;
};

/**
 * FILE -> material. An argument with a '/', '.' or '#' is a path; any other is an embedded name
 * if there is one, else a path. Throws Error.
 */
Material LoadMaterial(const std::string& file);

/// Add --projection and --layer, which hold for every environment file that the program loads.
void AddProjectionOption(CLI::App* command);

/// ENV -> environment: a built-in name ("room", "sky", "hall") or a path. Throws Error; prints the
/// reader's notes.
vtkSmartPointer<vtkEnvironment> LoadEnvironment(const std::string& file);

/// How to turn an environment into lights.
struct LightSetOptions
{
  int Count = 64;
  std::string Method = "median-cut";
  unsigned int Seed = 1;
  bool Soft = false; // where the subcommand evaluates a material

  /// Add the options to a subcommand; the count is called by the given name.
  void AddTo(CLI::App* command, const std::string& countName);

  bool IsMedianCut() const { return this->Method == "median-cut"; }
  bool IsImportance() const { return this->Method == "importance"; }

  /// Throws UsageError where the generator can't make that many.
  void Check() const;
};

/// Generate the lights. Throws Error.
vtkSmartPointer<vtkLightSet> MakeLightSet(
  vtkEnvironment* environment, const LightSetOptions& options);
} // namespace tool

#endif
