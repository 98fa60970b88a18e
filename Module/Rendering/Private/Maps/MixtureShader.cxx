// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MixtureShader.h"

#include "PartSurfaces.h"
#include "WeightImages.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
using partarrays::WeightsPerGroup;

// In the fragment shader. The superclass renames it where there is a geometry shader.
std::string VaryingOf(const std::string& attribute) { return attribute + "VCVSOutput"; }

std::string Weight(int slot) { return "brdfWeights[" + std::to_string(slot) + "]"; }

std::string Texel(std::size_t image) { return "brdfTexel" + std::to_string(image); }
}

MixtureShader::MixtureShader(const MaterialPart& part, const std::vector<int>& imageComponents)
  : Part(part)
  , ImageComponents(imageComponents)
{
  switch (part.Kind)
  {
    case MixtureKind::Weights:
    case MixtureKind::Nearest:
      for (int first = 0; first < part.NumberOfWeights; first += WeightsPerGroup)
      {
        this->Attributes.emplace_back(partarrays::GetWeights(first / WeightsPerGroup), "vec4");
      }
      break;
    case MixtureKind::Value:
      this->Attributes.emplace_back(partarrays::Value, "float");
      break;
    case MixtureKind::Images:
      this->Attributes.emplace_back(partarrays::Coordinates, "vec2");
      break;
    default:
      break;
  }
}

std::string MixtureShader::GetDeclarations() const
{
  std::string text;
  for (const auto& [name, type] : this->Attributes)
  {
    text += "in " + type + " " + VaryingOf(name) + ";\n";
  }
  for (std::size_t k = 0; k < this->Part.Knots.size(); ++k)
  {
    text += "uniform vec4 brdfHat" + std::to_string(k) + ";\n";
  }
  text += this->Part.IsBand ? "uniform vec2 brdfBand;\n" : "";
  for (std::size_t k = 0;
       this->Part.Kind == MixtureKind::Images && k < this->ImageComponents.size(); ++k)
  {
    text += "uniform sampler2D " + WeightTextures::GetSampler(k) + ";\n";
  }
  if (this->Part.Kind == MixtureKind::Nearest)
  {
    return text + "uniform int brdfSlot;\n";
  }
  return text + "float brdfWeights[" + std::to_string(this->Part.NumberOfWeights) + "];\n";
}

// Of a slot, before all are divided by their sum.
std::string MixtureShader::GetWeight(int slot) const
{
  const std::string number = std::to_string(slot);
  switch (this->Part.Kind)
  {
    case MixtureKind::Value:
      return "clamp(min(brdfHat" + number + ".x + brdfHat" + number + ".y * brdfAt, brdfHat" +
             number + ".z + brdfHat" + number + ".w * brdfAt), 0.0, 1.0)";
    case MixtureKind::Images:
    {
      const auto place = static_cast<std::size_t>(slot);
      int component = place < this->Part.Components.size() ? this->Part.Components[place] : -1;
      std::size_t image = 0;
      while (component >= 0 && component >= this->ImageComponents[image])
      {
        component -= this->ImageComponents[image++];
      }
      return component < 0 ? "0.0" : Texel(image) + "[" + std::to_string(component) + "]";
    }
    default:
      return VaryingOf(partarrays::GetWeights(slot / WeightsPerGroup)) + "[" +
             std::to_string(slot % WeightsPerGroup) + "]";
  }
}

std::string MixtureShader::GetImplementation(const std::vector<bool>& drawn) const
{
  if (this->Part.Kind == MixtureKind::Nearest)
  {
    // Of several weights that are the largest the first one counts, so that each pixel is of one
    // part.
    std::string nearest =
      "  int brdfNearest = 0;\n  float brdfMost = " + this->GetWeight(0) + ";\n";
    for (int slot = 1; slot < this->Part.NumberOfWeights; ++slot)
    {
      const std::string weight = this->GetWeight(slot);
      nearest += "  brdfNearest = " + weight + " > brdfMost ? " + std::to_string(slot) +
                 " : brdfNearest;\n  brdfMost = max(brdfMost, " + weight + ");\n";
    }
    return nearest + "  if (brdfNearest != brdfSlot)\n  {\n    discard;\n  }\n";
  }
  const int count = this->Part.NumberOfWeights;
  std::string text;
  if (this->Part.Kind == MixtureKind::Value)
  {
    text += "  float brdfAt = " + VaryingOf(partarrays::Value) + ";\n";
    text += this->Part.IsBand
              ? "  if (brdfAt < brdfBand.x || brdfAt >= brdfBand.y)\n  {\n    discard;\n  }\n"
              : "";
  }
  for (std::size_t k = 0;
       this->Part.Kind == MixtureKind::Images && k < this->ImageComponents.size(); ++k)
  {
    text += "  vec4 " + Texel(k) + " = texture(" + WeightTextures::GetSampler(k) + ", " +
            VaryingOf(partarrays::Coordinates) + ");\n";
  }
  std::string sum = "0.0";
  int others = -1; // the material where no other has a weight
  for (int slot = 0; slot < count; ++slot)
  {
    const auto place = static_cast<std::size_t>(slot);
    const bool given = place >= drawn.size() || drawn[place];
    const bool ofImages = this->Part.Kind == MixtureKind::Images;
    const bool isOthers =
      ofImages && (place >= this->Part.Components.size() || this->Part.Components[place] < 0);
    others = given && (isOthers || others < 0) ? slot : others;
    text += "  " + Weight(slot) + " = " + (given ? this->GetWeight(slot) : "0.0") + ";\n";
    sum += " + " + Weight(slot);
  }
  text += "  float brdfSum = " + sum + ";\n";
  for (int slot = 0; slot < count; ++slot)
  {
    text += "  " + Weight(slot) + " = brdfSum > 0.0 ? " + Weight(slot) +
            " / brdfSum : " + (slot == others ? "1.0" : "0.0") + ";\n";
  }
  if (this->Part.HasRest || this->Part.IsRest)
  {
    text += "  if (" + Weight(count - 1) + (this->Part.HasRest ? " > 0.0" : " <= 0.0") +
            ")\n  {\n    discard;\n  }\n";
  }
  return text;
}
} // namespace measuredbrdf
