// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshInspection.h"

#include "Inputs.h"
#include "Meshes.h"
#include "TracedSurface.h"

#include "vtkBlinnPhongBRDF.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <cstdio>

using nlohmann::ordered_json;

namespace
{
constexpr double GlossExponent = 50.0;

//------------------------------------------------------------------------------
std::string CountLine(const char* label, const ordered_json& count)
{
  char line[80];
  std::snprintf(line, sizeof(line), "%-26s%lld\n", label, count.get<long long>());
  return line;
}
}

namespace tool
{
//------------------------------------------------------------------------------
ordered_json InspectMesh(const std::string& file)
{
  const vtkSmartPointer<vtkPolyData> mesh = LoadMesh(file);
  const vtkSmartPointer<vtkTracedScene> traced = MakeTracedScene(mesh);
  double bounds[6];
  traced->GetBounds(bounds);
  ordered_json info = { { "name", file }, { "points", mesh->GetNumberOfPoints() },
    { "triangles", traced->GetNumberOfTriangles() },
    { "skipped_triangles", traced->GetNumberOfSkippedTriangles() }, { "bounds", bounds },
    { "unoccluded", ordered_json::array() } };
  vtkNew<vtkLambertBRDF> matte;
  vtkNew<vtkBlinnPhongBRDF> gloss;
  gloss->SetExponent(GlossExponent);
  for (int k = 0; k < vtkEmbeddedEnvironments::GetNumberOfEnvironments(); ++k)
  {
    const std::string name = vtkEmbeddedEnvironments::GetName(k);
    const vtkSmartPointer<vtkEnvironment> environment = LoadEnvironment(name);
    for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(matte), static_cast<vtkBRDF*>(gloss) })
    {
      const auto predictor = PredictOcclusion(traced, brdf, environment);
      info["unoccluded"].push_back(
        { { "environment", name }, { "material", brdf == matte.Get() ? "diffuse" : "gloss" },
          { "error", predictor->GetError() }, { "uncertainty", predictor->GetUncertainty() } });
    }
  }
  return info;
}

//------------------------------------------------------------------------------
std::string FormatMeshInspection(const ordered_json& info)
{
  char name[27];
  std::snprintf(name, sizeof(name), "%-26s", "mesh");
  std::string text = name + info["name"].get<std::string>() + "\n";
  text += CountLine("points", info["points"]) + CountLine("triangles", info["triangles"]) +
          CountLine("degenerate triangles", info["skipped_triangles"]);
  text += "\nunoccluded light: error of leaving out what this mesh hides of the environment\n"
          "  environment   material   relative L1\n";
  for (const ordered_json& row : info["unoccluded"])
  {
    char line[160];
    std::snprintf(line, sizeof(line), "  %-13s %-10s %5.1f %% +- %.1f %%\n",
      row["environment"].get<std::string>().c_str(), row["material"].get<std::string>().c_str(),
      100.0 * row["error"].get<double>(), 100.0 * row["uncertainty"].get<double>());
    text += line;
  }
  return text + "\nAs seen from everywhere; gloss: a Blinn-Phong lobe of exponent 50.\n";
}
} // namespace tool
