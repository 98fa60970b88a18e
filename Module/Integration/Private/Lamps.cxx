// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lamps.h"

#include "EnvironmentPrecomputation.h"
#include "Floats.h"
#include "HalfDifferenceFill.h"
#include "HalfVector.h"
#include "LightLanes.h"
#include "LobeViews.h"
#include "VolumeInterpolation.h"
#include "vtkBRDF.h"
#include "vtkBRDFEnvironmentLampLobe.h"
#include "vtkBRDFEnvironmentLamps.h"
#include "vtkLightSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTabulatedBRDF.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
// phi_d over half a turn, theta_d, theta_h. Blurred lobes need fewer samples than sharp ones.
constexpr int LobeSize[3] = { 16, 48, 256 };

constexpr double WidthsSeen = 12.0; // of a lamp, to the edge of lobes that see it as an area
constexpr double LeastSharpShare = 0.05;
constexpr double FarthestView = Pi / 3.0;

// PointsAlong of a lamp along each axis, within so many standard deviations; f is smooth over a
// lamp that is farther from the mirror direction than so many.
constexpr int PointsAlong = 5;
constexpr int MostLampPoints = 12;
constexpr double LampReach = 2.8;
constexpr double NearLamp = 8.0;
constexpr double FarLamp = 20.0;

// So many points at equal distances, and their weights, which have a normal distribution's
// variance, 1.
std::vector<glm::dvec2> MakeLampPoints(int count)
{
  std::vector<glm::dvec2> points;
  double sum = 0.0;
  double squares = 0.0;
  for (int k = 0; k < count; ++k)
  {
    const double x = LampReach * ((2.0 * k + 1.0) / count - 1.0);
    const double weight = count > 2 ? std::exp(-0.5 * x * x) : 1.0;
    points.emplace_back(x, weight);
    sum += weight;
    squares += weight * x * x;
  }
  for (glm::dvec2& point : points)
  {
    point *= glm::dvec2(squares > 0.0 ? std::sqrt(sum / squares) : 0.0, 1.0 / sum);
  }
  return points;
}
}

// f over lamps by quadrature: what the table samples.
struct LampBRDF::Mean
{
  vtkBRDF* Material;
  LightLanes Lights; // of it
  double Deviation;
  std::vector<std::vector<glm::dvec2>> Rules; // by their numbers of points

  glm::dvec3 Evaluate(const glm::dvec3& light, const glm::dvec3& view) const
  {
    glm::dvec3 f;
    const double away =
      glm::distance(light, glm::dvec3(-view.x, -view.y, view.z)) / this->Deviation;
    if (away > FarLamp)
    {
      this->Material->Evaluate(&light.x, &view.x, &f.x);
      return f;
    }
    // Across the plane of i and o the lobe of a half vector is narrower, by its cosine with o.
    const double cosine = std::max(glm::dot(HalfVector(light, view), view), 1e-3);
    const int along = away > NearLamp ? 2 : PointsAlong;
    const int across =
      away > NearLamp ? 2
                      : std::min(static_cast<int>(std::ceil(PointsAlong / cosine)), MostLampPoints);
    glm::dvec3 tangent = view - glm::dot(view, light) * light;
    const double length = glm::length(tangent);
    tangent = length > 1e-6 ? tangent / length : glm::dvec3(light.z, 0.0, -light.x);
    tangent = glm::normalize(tangent);
    const glm::dvec3 side = glm::cross(light, tangent);
    std::array<glm::dvec3, PointsAlong * MostLampPoints> lights{}, values{};
    std::array<double, PointsAlong * MostLampPoints> shares;
    std::size_t count = 0;
    for (const glm::dvec2& row : this->Rules[along])
    {
      for (const glm::dvec2& column : this->Rules[across])
      {
        const glm::dvec3 at =
          glm::normalize(light + this->Deviation * (row.x * tangent + column.x * side));
        if (at.z > 0.0) // the rest of the lamp has set
        {
          lights[count] = at;
          shares[count++] = row.y * column.y;
        }
      }
    }
    this->Lights.Evaluate(count, lights.data(), view, values.data());
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (std::size_t k = 0; k < count; ++k)
    {
      sum += shares[k] * values[k];
      weights += shares[k];
    }
    return sum / std::max(weights, 1e-12);
  }
};

vtkStandardNewMacro(LampBRDF);

LampBRDF::LampBRDF() = default;
LampBRDF::~LampBRDF() = default;

vtkSmartPointer<LampBRDF> LampBRDF::Make(vtkBRDF* material, double spread)
{
  auto made = vtkSmartPointer<LampBRDF>::New();
  made->Sampled.reset(new Mean{ material, LightLanes(material), std::sqrt(spread), {} });
  for (int count = 0; count <= MostLampPoints; ++count)
  {
    made->Sampled->Rules.push_back(MakeLampPoints(count));
  }
  const int whole[3] = { 2 * LobeSize[0], LobeSize[1], LobeSize[2] };
  vtkNew<vtkTabulatedBRDF> table;
  FillHalfDifference(made, false, whole, table);
  made->Sampled.reset();
  const std::vector<float>& volume = table->GetVolume();
  const float largest = std::max(*std::max_element(volume.begin(), volume.end()), 1e-20f);
  made->Scale = static_cast<double>(largest / LargestSharedExponent);
  made->Texels.reserve(volume.size() / 6);
  for (std::size_t row = 0; row < volume.size(); row += 3u * 2u * LobeSize[0])
  {
    for (std::size_t k = 0; k < static_cast<std::size_t>(LobeSize[0]); ++k)
    {
      const std::size_t other = 2 * static_cast<std::size_t>(LobeSize[0]) - 1 - k;
      made->Texels.push_back(PackSharedExponent(
        (glm::make_vec3(&volume[row + 3 * k]) + glm::make_vec3(&volume[row + 3 * other])) *
        static_cast<float>(0.5 / made->Scale)));
    }
  }
  return made;
}

bool LampBRDF::IsWidthSeen(const LobeViews& views, double spread)
{
  return spread > 0.0 &&
         views.GetSharpShare(Pi * WidthsSeen * WidthsSeen * spread, FarthestView) > LeastSharpShare;
}

vtkIdType LampBRDF::GetTextureBytes()
{
  return static_cast<vtkIdType>(sizeof(std::uint32_t)) * LobeSize[0] * LobeSize[1] * LobeSize[2];
}

void LampBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  glm::dvec3 sum(0.0);
  if (this->Sampled)
  {
    sum = this->Sampled->Evaluate(glm::make_vec3(i), glm::make_vec3(o));
    std::copy_n(&sum.x, 3, f);
    return;
  }
  const glm::dvec3 u = ToHalfDifferenceUnit(glm::make_vec3(i), glm::make_vec3(o), false);
  const VolumeCorners<3> corners = { ClampedNeighbors(2.0 * std::abs(u.x), LobeSize[0]),
    ClampedNeighbors(u.y, LobeSize[1]), ClampedNeighbors(u.z, LobeSize[2]) };
  ForCorners<3>(LobeSize, corners,
    [&](std::size_t cell, double weight)
    { sum += weight * glm::dvec3(UnpackSharedExponent(this->Texels[cell])); });
  sum *= this->Scale / o[2];
  std::copy_n(&sum.x, 3, f);
}

void LampBRDF::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  vtkBRDFShaderInputs::Term term;
  term.Source = vtkBRDFEnvironmentLampLobe;
  term.Uniforms.push_back({ "brdfLampLobeScale", { static_cast<float>(this->Scale) } });
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = "brdfLampLobe";
  texture.ThreeD = true;
  texture.Dimensions = { LobeSize[0], LobeSize[1], LobeSize[2] };
  texture.SharedExponents = this->Texels;
  term.Textures.push_back(std::move(texture));
  inputs = vtkBRDFShaderInputs();
  inputs.QuantizationError = std::ldexp(1.0, -9);
  inputs.Terms.push_back(std::move(term));
}

void LampBRDF::AddTo(vtkBRDFShaderInputs::Term& term)
{
  vtkBRDFShaderInputs inputs;
  this->GetShaderInputs(inputs);
  vtkBRDFShaderInputs::Term& own = inputs.Terms.front();
  term.Source = own.Source + term.Source;
  std::move(own.Uniforms.begin(), own.Uniforms.end(), std::back_inserter(term.Uniforms));
  std::move(own.Textures.begin(), own.Textures.end(), std::back_inserter(term.Textures));
}

double GetSpread(vtkLightSet* lights, int index)
{
  const double concentration = lights->GetConcentration(index);
  return concentration > 0.0 ? 1.0 / concentration : 0.0;
}

vtkBRDFShaderInputs::Texture MakeLightTexture(vtkLightSet* lights)
{
  const int count = lights->GetNumberOfLights();
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = "brdfLights";
  texture.Components = 4;
  texture.Dimensions = { 2 * std::clamp(count, 1, LightsPerRow),
    std::max((count + LightsPerRow - 1) / LightsPerRow, 1), 1 };
  texture.Data.resize(4 * static_cast<std::size_t>(texture.Dimensions[0]) *
                      static_cast<std::size_t>(texture.Dimensions[1]));
  for (int k = 0; k < count; ++k)
  {
    double direction[3], irradiance[3];
    lights->GetDirection(k, direction);
    lights->GetIrradiance(k, irradiance);
    float* texel = &texture.Data[8 * k];
    for (int c = 0; c < 3; ++c)
    {
      texel[c] = static_cast<float>(direction[c]);
      texel[4 + c] = static_cast<float>(irradiance[c]);
    }
    texel[3] = static_cast<float>(GetSpread(lights, k));
  }
  return texture;
}

namespace
{
constexpr int AtOnce = 31; // lamps that a pixel finds together, as bits of a number

// A lamp's first part and how many it has are one number to this base.
constexpr std::size_t CountBase = 16;
static_assert(ExtractedEmitters::MostParts < CountBase, "the count must be less than the base");
}

TableLamps::TableLamps(vtkLightSet* lights, vtkBRDF* shaded)
  : Shaded(shaded)
{
  auto* areas = LampBRDF::SafeDownCast(shaded);
  auto* lamps = areas && areas->GetSeesParts() ? LampSet::SafeDownCast(lights) : nullptr;
  this->HaveParts = lamps != nullptr;
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    Lamp lamp{ std::vector<Part>(1), {} };
    lights->GetDirection(k, &lamp.Whole[0].Direction.x);
    lights->GetIrradiance(k, &lamp.Whole[0].Irradiance.x);
    for (std::size_t part = 0; lamps && part < lamps->Parts[k].size(); ++part)
    {
      lamp.Parts.push_back({ lamps->Parts[k][part].Direction, lamps->Parts[k][part].Irradiance });
    }
    this->Lamps.push_back(std::move(lamp));
  }
}

TableLamps::~TableLamps() = default;

glm::dvec3 TableLamps::Sum(const Frame& frame, const glm::dvec3& view, const glm::dvec3& axis,
  const glm::dvec3& lambert) const
{
  glm::dvec3 sum(0.0);
  for (const Lamp& lamp : this->Lamps)
  {
    const glm::dvec3& middle = lamp.Whole[0].Direction;
    const double weight = LampWindow::GetWeight(middle, axis);
    const bool isWhole =
      lamp.Parts.empty() || LampWindow::GetNearness(middle, axis) < LampWindow::PartsNearness;
    for (const Part& part : isWhole ? lamp.Whole : lamp.Parts)
    {
      const glm::dvec3 light = ToLocal(frame, part.Direction);
      if (weight > 0.0 && light.z > 0.0)
      {
        glm::dvec3 f;
        this->Shaded->Evaluate(&light.x, &view.x, &f.x);
        sum += weight * light.z * (f - lambert) * part.Irradiance;
      }
    }
  }
  return sum;
}

// The lamps and, where they have some, their parts. The fourth component of a lamp: its first part
// and how many it has, in one number.
vtkBRDFShaderInputs::Texture TableLamps::MakeTexture() const
{
  vtkNew<vtkLightSet> all;
  for (const auto of : { &Lamp::Whole, &Lamp::Parts })
  {
    for (const Lamp& lamp : this->Lamps)
    {
      for (const Part& part : lamp.*of)
      {
        all->AddLight(&part.Direction.x, &part.Irradiance.x);
      }
    }
  }
  vtkBRDFShaderInputs::Texture texture = MakeLightTexture(all);
  std::size_t first = this->Lamps.size();
  for (std::size_t k = 0; k < this->Lamps.size(); ++k)
  {
    const std::size_t count = this->Lamps[k].Parts.size();
    const std::size_t start = count > 0 ? first : k; // or itself
    texture.Data[8 * k + 3] =
      static_cast<float>(CountBase * start + std::max<std::size_t>(count, 1));
    first += count;
  }
  return texture;
}

void TableLamps::AddTo(vtkBRDFShaderInputs::Term& table) const
{
  const int count = static_cast<int>(this->Lamps.size());
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
  const int turns = (count + AtOnce - 1) / AtOnce; // at least
  table.Evaluations += areas ? 0 : turns;
  // The lamp and its light; a part's place. And many lamps are looked for.
  table.Fetches += turns * ((this->HaveParts ? 3 : 2) + (areas ? 1 : 0)) + (turns > 1 ? count : 0);
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
    const glm::vec3 direction(this->Lamps[k].Whole[0].Direction);
    table.Uniforms.push_back({ name, { direction.x, direction.y, direction.z } });
    uniforms += "uniform vec3 " + name + "INSTANCE;\n";
    find += "found |= brdfLampNearnessINSTANCE(" + name + "INSTANCE, d) > 0.0 ? " +
            std::to_string(1 << k) + " : 0;\n    ";
  }
  table.Constants.push_back({ "LAMP_UNIFORMS", uniforms });
  table.Constants.push_back({ "FIND_LAMPS", find });
  table.Constants.push_back({ "LAMP_COUNT", std::to_string(count) });
  table.Constants.push_back({ "LAMPS_AT_ONCE", std::to_string(AtOnce) });
  table.Constants.push_back({ "COUNT_BASE", std::to_string(CountBase) + ".0" });
  table.Constants.push_back({ "HAVE_PARTS", this->HaveParts ? "1" : "0" });
  table.Uniforms.push_back(
    { "brdfPartsNearness", { static_cast<float>(LampWindow::PartsNearness) } });
  table.Constants.push_back({ "LIGHTS_PER_ROW", std::to_string(LightsPerRow) + ".0" });
  table.Uniforms.push_back(
    { "brdfLampReach", { static_cast<float>(2.0 * LampWindow::GetReach()) } });
  table.Textures.push_back(this->MakeTexture());
}
} // namespace measuredbrdf
