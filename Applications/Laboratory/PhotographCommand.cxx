// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "NumberText.h"
#include "Picture.h"
#include "SimulatedPhotographs.h"
#include "Tool.h"

#include "vtkNew.h"
#include "vtkPictureReader.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <memory>

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
};

//------------------------------------------------------------------------------
// Images of one size, whose channels are the weights of the materials in their order.
vtkSmartPointer<vtkMaterialMap> MakeMap(const PhotographOptions& options)
{
  auto map = vtkSmartPointer<vtkMaterialMap>::New();
  map->SetModeToTextures();
  for (const std::string& file : options.Files)
  {
    const tool::Material material = tool::LoadMaterial(file);
    map->AddMaterial(material.BRDF, material.Name);
  }
  int channels = 0;
  for (const std::string& file : options.Weights)
  {
    vtkNew<vtkPictureReader> reader;
    reader->SetFileName(file);
    if (!reader->Read())
    {
      tool::TakeErrorText();
      throw tool::Error(reader->GetErrorMessage());
    }
    vtkImageData* image = reader->GetPicture();
    map->AddWeightImage(image);
    const int* size = map->GetWeightImage(0)->GetDimensions();
    if (image->GetDimensions()[0] != size[0] || image->GetDimensions()[1] != size[1])
    {
      throw tool::Error(file + ": expected " + std::to_string(size[0]) + " x " +
                        std::to_string(size[1]) + " texels, as " + options.Weights[0] + " has");
    }
    channels += image->GetNumberOfScalarComponents();
  }
  if (channels < map->GetNumberOfMaterials())
  {
    throw tool::Error("--weights: " + std::to_string(options.Files.size()) + " materials with " +
                      std::to_string(channels) + " channels of weights");
  }
  return map;
}

//------------------------------------------------------------------------------
// As files of the Bonn database are called, whose directions are whole degrees:
// tl015_pl030_tv045_pv060.
std::string GetBonnName(const double light[3], const double view[3])
{
  std::string name;
  for (const double* d : { light, view })
  {
    const double sine = std::hypot(d[0], d[1]);
    const double degrees = 180.0 / measuredbrdf::Pi;
    const long theta = std::lround(std::atan2(sine, d[2]) * degrees);
    const long phi = sine > 1e-9 ? std::lround(std::atan2(d[1], d[0]) * degrees) + 360 : 0;
    char text[32];
    const char which = d == light ? 'l' : 'v';
    std::snprintf(text, sizeof(text), "t%c%03ld_p%c%03ld", which, theta, which, phi % 360);
    name += (name.empty() ? "" : "_") + std::string(text);
  }
  return name;
}

//------------------------------------------------------------------------------
void WritePhotograph(vtkImageData* image, const std::string& path, bool encode)
{
  vtkDataArray* values = image->GetPointData()->GetScalars();
  tool::Picture picture(image->GetDimensions()[0], image->GetDimensions()[1]);
  for (vtkIdType k = 0; k < values->GetNumberOfTuples(); ++k)
  {
    for (int c = 0; c < 4; ++c)
    {
      picture.Pixels[4 * static_cast<std::size_t>(k) + static_cast<std::size_t>(c)] =
        c < 3 ? static_cast<float>(values->GetComponent(k, c)) : 1.0f;
    }
  }
  const auto toByte = [](double linear) { return tool::EncodeSRGB(std::clamp(linear, 0.0, 1.0)); };
  encode ? tool::WritePNG(path, picture, toByte) : tool::WriteEXR(path, picture);
}

//------------------------------------------------------------------------------
void RunPhotograph(const PhotographOptions& options)
{
  double exposure = 0.0; // automatic
  if (options.Exposure != "auto" &&
      (!measuredbrdf::ParseNumber(options.Exposure, exposure) || !(exposure > 0.0)))
  {
    throw tool::UsageError(
      "--exposure: found '" + options.Exposure + "', expected auto or a number > 0");
  }
  tool::Interruptible interruptible;
  vtkNew<SimulatedPhotographs> set;
  set->Map = MakeMap(options);
  set->Noise = options.Noise;
  const bool isBonn = options.Directions == "bonn";
  isBonn ? set->AddBonnDirections(options.Count, exposure)
         : set->AddHalfVectorDirections(options.Count, exposure);
  tool::MakeFolder(options.Output);
  const bool encode = options.Format == "png";
  ordered_json list = {
    { "comment", "SIMULATED by measured-brdf-lab photograph: no photographs of anything real" },
    { "irradiance", set->GetIrradiance() }, { "transfer", encode ? "srgb" : "linear" },
    { "photographs", ordered_json::array() }
  };
  const auto show = laboratory::ShowProgress("photographing");
  for (int k = 0; k < set->GetNumberOfPhotographs(); ++k)
  {
    show(static_cast<double>(k) / set->GetNumberOfPhotographs());
    double light[3], view[3];
    set->GetLight(k, light);
    set->GetView(k, view);
    const std::string name =
      (isBonn ? GetBonnName(light, view) : "photograph-" + std::to_string(k)) + "." +
      options.Format;
    const auto image = vtkSmartPointer<vtkImageData>::Take(set->NewPicture(k));
    WritePhotograph(image, options.Output + "/" + name, encode);
    list["photographs"].push_back({ { "file", name }, { "light", light }, { "view", view },
      { "exposure", set->GetExposure(k) } });
  }
  const std::string path = options.Output + "/photographs.json";
  tool::WriteWhole(path, list.dump(1) + "\n");
  tool::PrintOut(
    "simulated " +
    tool::FormatCount(static_cast<std::size_t>(set->GetNumberOfPhotographs()), "photograph") +
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
  command->add_option("MATERIAL", options->Files, "The materials. " + GetMaterialHelp())
    ->required();
  command
    ->add_option("--weights", options->Weights,
      "Images of the materials' weights at each texel, linear: their channels belong to the "
      "materials in their order")
    ->delimiter(',')
    ->required();
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
  command
    ->add_option("--noise", options->Noise,
      "Standard deviation of the camera's noise; 1 is full scale (default 0)")
    ->check(CLI::Range(0.0, 1e6));
  command
    ->add_option("--format", options->Format,
      "exr (default): linear floats; png: 8 bits by sRGB's curve, as cameras' JPEG files have")
    ->check(CLI::IsMember({ "exr", "png" }));
  command->add_option("-o,--output", options->Output, "Folder for the images and photographs.json")
    ->required();
  command->footer("Nothing of it was photographed: photographs.json says so, too.\n\n"
                  "Example:\n  measured-brdf-lab photograph nickel red-fabric2 --weights rust.png "
                  "--noise 0.005 -o photos\n"
                  "  measured-brdf svbrdf photos/photographs.json -o found");
  command->callback([options]() { RunPhotograph(*options); });
}
} // namespace tool
