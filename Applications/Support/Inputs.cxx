// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Inputs.h"

#include "FetchCatalog.h"
#include "Files.h"
#include "NumberText.h"
#include "Tool.h"

#include "vtkBRDFFormats.h"
#include "vtkBRDFReader.h"
#include "vtkBasisBRDF.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironmentReader.h"
#include "vtkLightSetGenerator.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkNew.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

namespace tool
{
namespace
{
//------------------------------------------------------------------------------
// Finite numbers with separators between; none where there is anything else.
std::vector<double> ParseNumbers(const std::string& text, char separator)
{
  std::vector<double> numbers;
  std::istringstream stream(text + separator);
  for (std::string cell; std::getline(stream, cell, separator);)
  {
    double number = 0.0;
    if (!measuredbrdf::ParseNumber(cell, number))
    {
      return {};
    }
    numbers.push_back(number);
  }
  return numbers;
}
}

//------------------------------------------------------------------------------
Size ParseSize(const std::string& option, const std::string& text, int largest)
{
  const std::vector<double> sides = ParseNumbers(text, 'x');
  const bool valid =
    sides.size() == 2 && std::all_of(sides.begin(), sides.end(),
                           [largest](double side)
                           { return side >= 1.0 && side <= largest && side == std::floor(side); });
  if (!valid)
  {
    throw UsageError(option + ": '" + text + "' is not WIDTHxHEIGHT with both between 1 and " +
                     std::to_string(largest) + ", like 800x600");
  }
  return { static_cast<int>(sides[0]), static_cast<int>(sides[1]) };
}

//------------------------------------------------------------------------------
View ParseView(const std::string& text)
{
  std::vector<double> angles = ParseNumbers(text, ',');
  if (angles.size() == 2)
  {
    angles.push_back(View{}.Angle);
  }
  if (angles.size() != 3 || std::abs(angles[1]) > 90.0 || angles[2] < 1.0 || angles[2] > 120.0)
  {
    throw UsageError("--view: '" + text +
                     "' is not AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,ANGLE in degrees with the "
                     "elevation between -90 and 90 and the angle of view between 1 and 120, like "
                     "30,20");
  }
  return { angles[0], angles[1], angles[2] };
}

//------------------------------------------------------------------------------
Range ParseZone(const std::string& option, const std::string& text)
{
  const std::vector<double> zone = ParseNumbers(text, ',');
  if (zone.size() != 2 || zone[0] < 0.0 || zone[0] + vtkBasisBRDF::MinimumZoneWidth > zone[1] ||
      zone[1] > 90.0)
  {
    throw UsageError(option + ": '" + text +
                     "' is not BEGIN,END in degrees with 0 <= BEGIN < END <= 90 and at least " +
                     FormatNumber(vtkBasisBRDF::MinimumZoneWidth) + " between, like 9,57");
  }
  return { zone[0], zone[1] };
}

namespace
{
const std::map<std::string, int> Projections = { { "auto", vtkEnvironmentReader::AUTOMATIC },
  { "lat-long", vtkEnvironmentReader::LAT_LONG }, { "angular", vtkEnvironmentReader::ANGULAR_MAP },
  { "mirror-ball", vtkEnvironmentReader::MIRROR_BALL },
  { "horizontal-cross", vtkEnvironmentReader::CUBE_HORIZONTAL_CROSS },
  { "vertical-cross", vtkEnvironmentReader::CUBE_VERTICAL_CROSS },
  { "horizontal-strip", vtkEnvironmentReader::CUBE_HORIZONTAL_STRIP },
  { "vertical-strip", vtkEnvironmentReader::CUBE_VERTICAL_STRIP } };

std::string Projection = "auto"; // set by --projection
std::string Layer;               // set by --layer

//------------------------------------------------------------------------------
// What to add to a reader's complaint about a file whose ending is of no format that is read.
std::string GetFormatAdvice(const std::string& file)
{
  const std::string extension = tool::Extension(file.substr(0, file.find('#')));
  std::error_code ignored;
  for (const auto& format : vtkBRDFFormats::GetFormats())
  {
    const auto known = format->GetExtensions();
    if (std::find(known.begin(), known.end(), extension) != known.end())
    {
      return "";
    }
  }
  if (!std::filesystem::is_regular_file(file, ignored))
  {
    return "";
  }
  return ". '" + extension +
         "' is not one of the formats that are read: " + vtkBRDFFormats::GetDescriptions();
}

//------------------------------------------------------------------------------
// Why a reader could not read a file, and how to get one that is published under that name.
template <typename Reader>
std::string Explain(Reader* reader, const std::string& file, const std::string& kind)
{
  const std::string logged = TakeErrorText();
  const std::string said = reader->GetErrorMessage();
  const std::string advice = GetFetchAdvice(file, kind);
  return (!said.empty() ? said : file + ": " + logged) + (advice.empty() ? "" : "." + advice);
}
}

std::string GetMaterialHelp()
{
  return "A material: the name of an embedded one (see 'measured-brdf list'), or a file: " +
         vtkBRDFFormats::GetDescriptions() +
         ". A name with a '/', a '.' or a '#' is a file; of other names, embedded materials come "
         "first";
}

const char* const EnvironmentHelp =
  "Light from all around: "
  "a lat-long image, cube cross or other probe (--projection) in a file of OpenEXR, Radiance HDR, "
  "PNG, JPEG"
#if MEASUREDBRDF_WITH_OPENIMAGEIO
  ", TIFF, BMP, PNM or PFM; "
#else
  " or TIFF; "
#endif
  "six cube faces, named with %s for px, nx, py, ny, pz, nz; or "
  "'room' (photographed), 'sky' or 'hall' (computed), which are built in";

//------------------------------------------------------------------------------
Material LoadMaterial(const std::string& file)
{
  Material result;
  result.File = file;
  const bool isPath = file.find_first_of("/.#") != std::string::npos;
  if (!isPath)
  {
    for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
    {
      if (vtkEmbeddedMaterials::GetName(k) == file)
      {
        result.BRDF = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(file));
        result.Name = file;
        result.Source = result.BRDF->GetSource();
        result.Format = "embedded";
        result.Kind = vtkEmbeddedMaterials::GetKind(k);
        return result;
      }
    }
  }
  const std::string path = ResolveFetched(file, "material");
  std::error_code ignored;
  if (!isPath && !std::filesystem::exists(path, ignored))
  {
    const std::string advice = GetFetchAdvice(file, "material");
    if (!advice.empty())
    {
      throw Error("material '" + file + "': there is no such file yet." + advice);
    }
    vtkEmbeddedMaterials::NewBRDF(file); // says which names are near
    throw Error("unknown material '" + file + "': there is no such file, and " + TakeErrorText() +
                " 'measured-brdf list' names them all");
  }

  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(path);
  if (!reader->Read() || !reader->GetBRDF())
  {
    throw Error(Explain(reader.Get(), file, "material") + GetFormatAdvice(path));
  }
  result.BRDF = reader->GetBRDF();
  result.Transmission = reader->GetTransmission();
  result.Name = result.BRDF->GetName();
  if (result.Name.empty())
  {
    result.Name = std::filesystem::path(path).stem().string();
  }
  result.Source = result.BRDF->GetSource();
  result.Format = reader->GetFormatName();
  result.Notes = reader->GetNotes();
  result.NumberOfNegativeValues = reader->GetNumberOfNegativeValues();
  result.NumberOfInvalidValues = reader->GetNumberOfInvalidValues();
  return result;
}

//------------------------------------------------------------------------------
void AddProjectionOption(CLI::App* command)
{
  std::vector<std::string> names;
  for (const auto& projection : Projections)
  {
    names.push_back(projection.first);
  }
  command
    ->add_option("--projection", Projection,
      "Projection of environment files: auto (default: by the aspect ratio; needed for square "
      "ones), "
      "lat-long, angular (Debevec's angular map), mirror-ball, horizontal-cross, vertical-cross, "
      "horizontal-strip or vertical-strip of cube faces")
    ->check(CLI::IsMember(names));
  command->add_option("--layer", Layer,
    "Layer or part of an OpenEXR environment file (default: the one named Combined, else the "
    "channels R, G and B without a name, else the first)");
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> LoadEnvironment(const std::string& file)
{
  if (auto embedded =
        vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment(file)))
  {
    return embedded;
  }
  vtkNew<vtkEnvironmentReader> reader;
  const std::string path = ResolveFetched(file, "environment");
  reader->SetProjection(Projections.at(Projection));
  reader->SetLayer(Layer);
  reader->SetFileName(path);
  if (!reader->Read() || !reader->GetEnvironment())
  {
    throw Error(Explain(reader.Get(), file, "environment"));
  }
  PrintNote(reader->GetNotes());
  vtkSmartPointer<vtkEnvironment> environment = reader->GetEnvironment();
  environment->SetName(std::filesystem::path(path).stem().string());
  return environment;
}

//------------------------------------------------------------------------------
void LightSetOptions::AddTo(CLI::App* command, const std::string& countName)
{
  command
    ->add_option(countName, this->Count,
      "Number of lights that replace the environment (default " + std::to_string(this->Count) +
        "); with median cut a power of two")
    ->check(CLI::Range(1, vtkLightSetGenerator::MaximumNumberOfLights));
  command
    ->add_option("--light-set", this->Method,
      "How the lights are chosen: median-cut (regions of equal energy, one light each; default), "
      "variance (regions of small spread: the widest is always split next) or importance (drawn at "
      "random in proportion to the energy)")
    ->check(CLI::IsMember({ "median-cut", "variance", "importance" }));
  command->add_option("--seed", this->Seed,
    "Seed of --light-set importance (default 1); the same seed gives the same lights");
}

//------------------------------------------------------------------------------
void LightSetOptions::Check() const
{
  if (this->IsMedianCut() && (this->Count & (this->Count - 1)) != 0)
  {
    int below = 1;
    while (below * 2 < this->Count)
    {
      below *= 2;
    }
    throw UsageError(std::to_string(this->Count) +
                     " lights: median cut makes powers of two only; try " + std::to_string(below) +
                     " or " + std::to_string(2 * below) + ", or --light-set variance");
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkLightSet> MakeLightSet(
  vtkEnvironment* environment, const LightSetOptions& options)
{
  vtkNew<vtkLightSetGenerator> generator;
  generator->SetMethod(options.IsMedianCut()    ? vtkLightSetGenerator::MEDIAN_CUT
                       : options.IsImportance() ? vtkLightSetGenerator::IMPORTANCE
                                                : vtkLightSetGenerator::VARIANCE);
  generator->SetSeed(options.Seed);
  auto lights = vtkSmartPointer<vtkLightSet>::New();
  if (!generator->Generate(environment, options.Count, lights))
  {
    throw Error("light set: " + TakeErrorText());
  }
  return lights;
}
} // namespace tool
