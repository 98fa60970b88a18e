// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TableLamps.h"

#include "EnvironmentPrecomputation.h"
#include "LampBRDF.h"
#include "LightTexture.h"
#include "vtkBRDF.h"
#include "vtkBRDFEnvironmentLamps.h"
#include "vtkLightSet.h"
#include "vtkNew.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr int AtOnce = 31; // lamps that a pixel finds together, as bits of a number

// A lamp's first part and how many it has are one number to this base.
constexpr std::size_t CountBase = 16;
static_assert(ExtractedEmitters::MostParts < CountBase, "the count must be less than the base");
}

TableLamps::TableLamps(vtkLightSet* lights, vtkBRDF* shaded)
  : Lights(lights)
  , Shaded(shaded)
{
  auto* areas = LampBRDF::SafeDownCast(shaded);
  auto* lamps = areas && areas->GetSeesParts() ? LampSet::SafeDownCast(lights) : nullptr;
  for (int k = 0; lamps && k < lights->GetNumberOfLights(); ++k)
  {
    this->Parts.emplace_back();
    for (const ExtractedEmitters::Part& part : lamps->Parts[static_cast<std::size_t>(k)])
    {
      this->Parts.back().push_back({ part.Direction, part.Irradiance });
    }
  }
}

TableLamps::~TableLamps() = default;

glm::dvec3 TableLamps::Sum(const Frame& frame, const glm::dvec3& view, const glm::dvec3& axis,
  const glm::dvec3& lambert) const
{
  glm::dvec3 sum(0.0);
  for (int k = 0; k < this->Lights->GetNumberOfLights(); ++k)
  {
    Part whole;
    this->Lights->GetDirection(k, &whole.Direction.x);
    this->Lights->GetIrradiance(k, &whole.Irradiance.x);
    const double weight = this->Window.GetWeight(whole.Direction, axis);
    const auto add = [&](const Part& part)
    {
      const glm::dvec3 light = ToLocal(frame, part.Direction);
      if (light.z > 0.0)
      {
        glm::dvec3 f;
        this->Shaded->Evaluate(&light.x, &view.x, &f.x);
        sum += weight * light.z * (f - lambert) * part.Irradiance;
      }
    };
    const bool isWhole =
      this->Parts.empty() || this->Parts[static_cast<std::size_t>(k)].empty() ||
      this->Window.GetNearness(whole.Direction, axis) < LampWindow::PartsNearness;
    if (weight > 0.0 && isWhole)
    {
      add(whole);
    }
    else if (weight > 0.0)
    {
      const std::vector<Part>& parts = this->Parts[static_cast<std::size_t>(k)];
      std::for_each(parts.begin(), parts.end(), add);
    }
  }
  return sum;
}

// The lamps and, where they have some, their parts. The fourth component of a lamp: its first part
// and how many it has, in one number.
vtkBRDFShaderInputs::Texture TableLamps::MakeTexture() const
{
  vtkNew<vtkLightSet> all;
  const auto add = [&all](const Part& part)
  { all->AddLight(&part.Direction.x, &part.Irradiance.x); };
  const auto lamps = static_cast<std::size_t>(this->Lights->GetNumberOfLights());
  for (std::size_t k = 0; k < lamps; ++k)
  {
    Part whole;
    this->Lights->GetDirection(static_cast<int>(k), &whole.Direction.x);
    this->Lights->GetIrradiance(static_cast<int>(k), &whole.Irradiance.x);
    add(whole);
  }
  for (const std::vector<Part>& parts : this->Parts)
  {
    std::for_each(parts.begin(), parts.end(), add);
  }
  vtkBRDFShaderInputs::Texture texture = MakeLightTexture(all);
  std::size_t first = lamps;
  for (std::size_t k = 0; k < lamps; ++k)
  {
    const std::size_t count = this->Parts.empty() ? 0 : this->Parts[k].size();
    const std::size_t start = count > 0 ? first : k; // or itself
    texture.Data[8 * k + 3] =
      static_cast<float>(CountBase * start + std::max<std::size_t>(count, 1));
    first += count;
  }
  return texture;
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
  const bool haveParts = !this->Parts.empty();
  const int turns = (count + AtOnce - 1) / AtOnce; // at least
  table.Evaluations += areas ? 0 : turns;
  // The lamp and its light; a part's place. And many lamps are looked for.
  table.Fetches += turns * ((haveParts ? 3 : 2) + (areas ? 1 : 0)) + (turns > 1 ? count : 0);
  std::string uniforms;
  std::string find;
  if (count > AtOnce)
  {
    find = "for (int k = first; k < min(first + LAMPS_AT_ONCE, LAMP_COUNT); ++k)\n    {\n      "
           "found |= brdfLampNearnessINSTANCE(brdfLampTexelINSTANCE(float(k), 0.0).rgb, d) > 0.0 ? "
           "1 << (k - first) : 0;\n    }";
  }
  for (int k = 0; k < count && count <= AtOnce; ++k) // software renderers fetch and loop slowly
  {
    const std::string name = "brdfDirection" + std::to_string(k);
    double direction[3];
    this->Lights->GetDirection(k, direction);
    table.Uniforms.push_back(
      { name, std::vector<float>(std::begin(direction), std::end(direction)) });
    uniforms += "uniform vec3 " + name + "INSTANCE;\n";
    find += "found |= brdfLampNearnessINSTANCE(" + name + "INSTANCE, d) > 0.0 ? " +
            std::to_string(1 << k) + " : 0;\n    ";
  }
  table.Constants.push_back({ "LAMP_UNIFORMS", uniforms });
  table.Constants.push_back({ "FIND_LAMPS", find });
  table.Constants.push_back({ "LAMP_COUNT", std::to_string(count) });
  table.Constants.push_back({ "LAMPS_AT_ONCE", std::to_string(AtOnce) });
  table.Constants.push_back({ "COUNT_BASE", std::to_string(CountBase) + ".0" });
  table.Constants.push_back({ "HAVE_PARTS", haveParts ? "1" : "0" });
  table.Uniforms.push_back(
    { "brdfPartsNearness", { static_cast<float>(LampWindow::PartsNearness) } });
  table.Constants.push_back({ "LIGHTS_PER_ROW", std::to_string(LightsPerRow) + ".0" });
  table.Uniforms.push_back({ "brdfLampReach", { static_cast<float>(2.0 * this->Window.Reach) } });
  table.Textures.push_back(this->MakeTexture());
}
} // namespace measuredbrdf
