// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"

#include "Inputs.h"
#include "Laboratory.h"
#include "MaterialMapFiles.h"
#include "NumberText.h"
#include "Picture.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSimulatedPhotographSet.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace
{
struct PhotographOptions
{
  std::vector<std::string> Files;
  std::vector<std::string> Weights;
  std::string Output;
  std::string Directions = "bonn";
  std::string Exposure = "auto";
  std::string Format = "exr";
  int Count = 200;
  double Noise = 0.0;
  unsigned int Seed = 1;
};

//------------------------------------------------------------------------------
// The exposure; 0: automatic.
double Check(const PhotographOptions& options)
{
  if (!(options.Noise >= 0.0) || !std::isfinite(options.Noise))
  {
    throw tool::UsageError("--noise: " + tool::FormatNumber(options.Noise) +
                           " is not a standard deviation; expected 0 or more, like 0.01");
  }
  const bool isMap = options.Files.size() == 1 && tool::Extension(options.Files[0]) == ".json";
  if (isMap != options.Weights.empty())
  {
    throw tool::UsageError(isMap ? "--weights: the map has weights already"
                                 : "--weights is required, or a map.json in place of materials");
  }
  if (!MEASUREDBRDF_WITH_OPENEXR && options.Format == "exr")
  {
    throw tool::UsageError("--format: this build writes no OpenEXR; choose --format png");
  }
  if (options.Exposure == "auto")
  {
    return 0.0;
  }
  double exposure = 0.0;
  if (!measuredbrdf::ParseNumber(options.Exposure, exposure) || !(exposure > 0.0))
  {
    throw tool::UsageError(
      "--exposure: found '" + options.Exposure + "', expected auto or a number > 0");
  }
  return exposure;
}

//------------------------------------------------------------------------------
// By the Bonn database's convention, whose directions are whole degrees: tl015_pl030_tv045_pv060.
std::string GetBonnName(vtkSimulatedPhotographSet* set, int index)
{
  double directions[2][3];
  set->GetLight(index, directions[0]);
  set->GetView(index, directions[1]);
  std::string name;
  for (int k = 0; k < 2; ++k)
  {
    const double* d = directions[k];
    const double degrees = 180.0 / 3.14159265358979323846;
    const double sine = std::hypot(d[0], d[1]);
    const double phi = sine > 1e-9 ? std::atan2(d[1], d[0]) * degrees : 0.0;
    char text[32];
    std::snprintf(text, sizeof(text), "%st%c%03ld_p%c%03ld", k == 0 ? "" : "_", "lv"[k],
      std::lround(std::atan2(sine, d[2]) * degrees), "lv"[k], (std::lround(phi) + 360) % 360);
    name += text;
  }
  return name;
}

//------------------------------------------------------------------------------
double Clip(double value) { return value <= 0.0 ? 0.0 : value >= 1.0 ? 1.0 : value; }

double EncodeByte(double linear) { return tool::EncodeSRGB(Clip(linear)); }

void WritePhotograph(vtkImageData* image, const std::string& path, bool encode)
{
  vtkDataArray* values = image->GetPointData()->GetScalars();
  tool::Picture picture(image->GetDimensions()[0], image->GetDimensions()[1]);
  for (vtkIdType k = 0; k < values->GetNumberOfTuples(); ++k)
  {
    float* pixel = &picture.Pixels[4 * static_cast<std::size_t>(k)];
    for (int c = 0; c < 3; ++c)
    {
      pixel[c] = static_cast<float>(values->GetComponent(k, c));
    }
    pixel[3] = 1.0f;
  }
  encode ? tool::WritePNG(path, picture, EncodeByte) : tool::WriteEXR(path, picture);
}

//------------------------------------------------------------------------------
void RunPhotograph(const PhotographOptions& options)
{
  const double exposure = Check(options);
  tool::Interruptible interruptible;
  const auto map = options.Weights.empty() ? tool::ReadMaterialMap(options.Files[0])
                                           : tool::MakeMaterialMap(options.Files, options.Weights);
  vtkNew<vtkSimulatedPhotographSet> set;
  set->SetMaterialMap(map);
  set->SetNoise(options.Noise);
  set->SetSeed(options.Seed);
  const bool isBonn = options.Directions == "bonn";
  isBonn ? set->AddBonnDirections(options.Count, exposure)
         : set->AddHalfVectorDirections(options.Count, exposure);
  tool::MakeFolder(options.Output);
  const bool encode = options.Format == "png";
  const std::string ending = encode ? ".png" : ".exr";
  ordered_json list = {
    { "comment", "SIMULATED by measured-brdf-lab photograph: no photographs of anything real" },
    { "irradiance", set->GetIrradiance() }, { "transfer", encode ? "srgb" : "linear" },
    { "photographs", ordered_json::array() }
  };
  tool::ProgressBar bar("photographing");
  const int count = set->GetNumberOfPhotographs();
  for (int k = 0; k < count; ++k)
  {
    tool::Interruptible::Check();
    bar.Update(static_cast<double>(k) / count);
    const auto image = vtkSmartPointer<vtkImageData>::Take(set->NewPicture(k));
    if (!image)
    {
      throw tool::Error(tool::TakeErrorText());
    }
    const std::string name =
      (isBonn ? GetBonnName(set, k) : "photograph-" + std::to_string(k)) + ending;
    WritePhotograph(image, (fs::path(options.Output) / name).string(), encode);
    double light[3], view[3];
    set->GetLight(k, light);
    set->GetView(k, view);
    list["photographs"].push_back({ { "file", name }, { "light", light }, { "view", view },
      { "exposure", set->GetExposure(k) } });
  }
  const std::string path = (fs::path(options.Output) / "photographs.json").string();
  tool::WriteWhole(path, list.dump(1) + "\n");
  tool::PrintOut("simulated " + tool::FormatCount(static_cast<std::size_t>(count), "photograph") +
                 " -> " + path + "\n");
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddPhotographCommand(CLI::App& app)
{
  auto options = std::make_shared<PhotographOptions>();
  CLI::App* command = app.add_subcommand("photograph",
    "Simulate photographs of a flat sample of several materials, under known lights and views");
  command
    ->add_option("FILE", options->Files,
      "The materials, or a map.json that 'svbrdf' wrote. " + GetMaterialHelp())
    ->required();
  command
    ->add_option("--weights", options->Weights,
      "Images of the materials' weights at each texel, linear: the channels of the images, three "
      "or four each, belong to the materials in their order")
    ->delimiter(',');
  command
    ->add_option(
      "--count", options->Count, "Number of photographs (default 200); 6561 are all of bonn's")
    ->check(CLI::Range(1, 6561));
  command
    ->add_option("--directions", options->Directions,
      "bonn (default): pairs of the 81 directions of the Bonn database, 15 degrees apart, which "
      "miss sharp highlights; half-vector: spread over half and difference angles, dense about "
      "the mirror direction")
    ->check(CLI::IsMember({ "bonn", "half-vector" }));
  command->add_option("--exposure", options->Exposure,
    "auto (default): of each photograph so that the brightest material has the value 0.9; or a "
    "number for all: the value of a white diffuse surface below the light");
  command->add_option("--noise", options->Noise,
    "Standard deviation of the camera's noise; 1 is full scale (default 0)");
  command->add_option("--seed", options->Seed, "Seed of the noise (default 1)");
  command
    ->add_option("--format", options->Format,
      "exr: linear floats (default); png: 8 bits by sRGB's curve, as cameras' JPEG files have")
    ->check(CLI::IsMember({ "exr", "png" }));
  command->add_option("-o,--output", options->Output, "Folder for the images and photographs.json")
    ->required();
  command->footer("Nothing of it was photographed: photographs.json says so, too.\n\n"
                  "Example:\n  measured-brdf-lab photograph nickel red-fabric2 --weights rust.png "
                  "--noise 0.005 -o photos\n"
                  "  measured-brdf svbrdf photos/photographs.json -o found");
  command->callback([options, command]() { RunPhotograph(*options); });
}
} // namespace tool
