// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TableLamps.h"

#include "LampBRDF.h"
#include "LightTexture.h"
#include "vtkBRDF.h"
#include "vtkBRDFEnvironmentLamps.h"
#include "vtkLightSet.h"

#include <iterator>
#include <string>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr int MaximumUnrolled = 32;
}

TableLamps::TableLamps(vtkLightSet* lights, vtkBRDF* shaded)
  : Lights(lights)
  , Shaded(shaded)
{
}

TableLamps::~TableLamps() = default;

glm::dvec3 TableLamps::Sum(const Frame& frame, const glm::dvec3& view, const glm::dvec3& axis,
  const glm::dvec3& lambert) const
{
  glm::dvec3 sum(0.0);
  for (int k = 0; k < this->Lights->GetNumberOfLights(); ++k)
  {
    glm::dvec3 direction;
    this->Lights->GetDirection(k, &direction.x);
    const double weight = this->Window.GetWeight(direction, axis);
    const glm::dvec3 light = ToLocal(frame, direction);
    if (weight > 0.0 && light.z > 0.0)
    {
      glm::dvec3 irradiance;
      glm::dvec3 f;
      this->Lights->GetIrradiance(k, &irradiance.x);
      this->Shaded->Evaluate(&light.x, &view.x, &f.x);
      sum += weight * light.z * (f - lambert) * irradiance;
    }
  }
  return sum;
}

void TableLamps::AddTo(vtkBRDFShaderInputs::Term& table) const
{
  const int count = this->Lights->GetNumberOfLights();
  table.Source = std::string(vtkBRDFEnvironmentLamps) + table.Source;
  auto* areas = LampBRDF::SafeDownCast(this->Shaded);
  if (areas)
  {
    areas->AddTo(table);
  }
  table.Constants.push_back(
    { "EVALUATE_LAMP", areas ? LampBRDF::GetFunction() : std::string("brdfEvaluate") });
  for (vtkBRDFShaderInputs::Constant& constant : table.Constants)
  {
    if (constant.Name == "LAMPS_PART")
    {
      constant.Value = "brdfAddLampsINSTANCE(frame, o, d, lambert)";
    }
  }
  table.Evaluations += areas ? 0 : 1;
  table.Fetches +=
    (areas ? 3 : 2) + (count > MaximumUnrolled ? count : 0); // to look at it, and to find it
  std::string uniforms;
  std::string find = "for (int k = 0; k < " + std::to_string(count) +
                     "; ++k)\n    {\n      brdfFindLampINSTANCE(float(k), "
                     "brdfLampTexelINSTANCE(float(k), 0.0), d, lamps);\n    }";
  if (count <= MaximumUnrolled) // software renderers fetch slowly, and loop slowly
  {
    find.clear();
    for (int k = 0; k < count; ++k)
    {
      const std::string name = "brdfDirection" + std::to_string(k);
      double direction[3];
      this->Lights->GetDirection(k, direction);
      table.Uniforms.push_back(
        { name, std::vector<float>(std::begin(direction), std::end(direction)) });
      uniforms += "uniform vec3 " + name + "INSTANCE;\n";
      find +=
        "brdfFindLampINSTANCE(" + std::to_string(k) + ".0, " + name + "INSTANCE, d, lamps);\n    ";
    }
  }
  table.Constants.push_back({ "LAMP_UNIFORMS", uniforms });
  table.Constants.push_back({ "FIND_LAMPS", find });
  table.Constants.push_back({ "LIGHTS_PER_ROW", std::to_string(LightsPerRow) + ".0" });
  table.Uniforms.push_back({ "brdfLampReach", { static_cast<float>(2.0 * this->Window.Reach) } });
  table.Textures.push_back(MakeLightTexture(this->Lights));
}
} // namespace measuredbrdf
