// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * cases.json: shading models with given values, for tests and for programs that check the exports.
 */

#ifndef ExportCases_h
#define ExportCases_h

#include "ModelFit.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <vector>

struct ExportCase
{
  std::string Name;
  std::string Model;
  tool::ModelFit Fit;
};

inline nlohmann::json ReadJson(const std::string& path)
{
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

inline std::vector<ExportCase> ReadExportCases(const std::string& path)
{
  std::vector<ExportCase> cases;
  for (const nlohmann::json& entry : ReadJson(path))
  {
    ExportCase made{ entry.at("name"), entry.at("model"), {} };
    made.Fit.Model = tool::SurfaceModel::Make(made.Model);
    std::vector<double> values;
    for (const auto& [parameter, channel] : made.Fit.Model->GetNumbers())
    {
      const auto found = entry.at("values").find(parameter->Name);
      values.push_back(found == entry.at("values").end() ? parameter->Neutral
                       : parameter->Size == 1            ? found->get<double>()
                                                         : found->at(channel).get<double>());
    }
    made.Fit.Model->SetValues(values);
    for (const std::string part : entry.at("parts"))
    {
      for (const tool::Feature feature : { tool::Feature::Specular, tool::Feature::Coat,
             tool::Feature::Sheen, tool::Feature::Anisotropy })
      {
        if (part == tool::GetFeatureName(feature))
        {
          made.Fit.Features.push_back(feature);
        }
      }
    }
    cases.push_back(std::move(made));
  }
  return cases;
}

#endif
