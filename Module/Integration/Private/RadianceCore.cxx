// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceCore.h"

#include "FieldSynthesis.h"
#include "LobePlacement.h"
#include "ParallelFor.h"

#include <glm/gtc/packing.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr float LargestValue = 32768.0f; // of a 16-bit texture, with room to spare
constexpr vtkIdType PackedTexels = 4096; // by a thread at a time
}

int RadianceCore::GetNumberOfFields() const
{
  int fields = 0;
  for (const int order : this->Orders)
  {
    fields += CoreMode::CountFields(order);
  }
  return fields;
}

// A mode's fields, as the synthesis has them, scaled to what a texture holds; returns what undoes
// that.
double RadianceCore::AddFields(
  int order, const std::array<FieldSynthesis::Field, 3>& fields, std::size_t mode)
{
  const std::size_t texels = this->GetNumberOfTexels();
  // 2 Re(e^(-i m psi) G) = 2 cos(m psi) Re G + 2 sin(m psi) Im G.
  const std::size_t first = this->Fields.size();
  this->Fields.resize(first + 3 * texels * static_cast<std::size_t>(CoreMode::CountFields(order)));
  double squared = 0.0; // in double precision: squares of floats can be too large for floats
  for (const FieldSynthesis::Field& field : fields)
  {
    for (std::size_t texel = 0; texel < texels; ++texel)
    {
      squared = std::max(squared, std::norm(std::complex<double>(field[mode * texels + texel])));
    }
  }
  const float share = order > 0 ? 2.0f : 1.0f;
  const float peak = share * static_cast<float>(std::sqrt(squared));
  const float scale = peak > 0.0f ? LargestValue / peak : 1.0f;
  float* const real = &this->Fields[first];
  const auto pack = [scale, share](float value)
  { return glm::unpackHalf1x16(glm::packHalf1x16(scale * (share * value))); };
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(texels), PackedTexels,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (std::size_t texel = static_cast<std::size_t>(begin);
           texel < static_cast<std::size_t>(end); ++texel)
      {
        for (std::size_t channel = 0; channel < 3; ++channel)
        {
          const std::complex<float> value = fields[channel][mode * texels + texel];
          real[3 * texel + channel] = pack(value.real());
          if (order > 0)
          {
            real[3 * (texels + texel) + channel] = pack(value.imag());
          }
        }
      }
    });
  this->Orders.push_back(order);
  return 1.0 / static_cast<double>(scale);
}

bool RadianceCore::Make(const EnvironmentHarmonics& environment, const LobeViews& views,
  const CoreKernels& kernels, int fields, const std::function<bool(double)>& goOn)
{
  const std::vector<CoreMode> modes = ChooseModes(environment, kernels, fields);
  FieldSynthesis synthesis(environment, this->Rows, this->Columns, MapNodes::Centers);
  constexpr int size = LobeViews::NumberOfViews;
  this->Profile.assign(3 * size * (1 + modes.size()), 0.0f);
  const auto put = [this](std::size_t row, int view, const glm::dvec3& value)
  {
    for (int c = 0; c < 3; ++c)
    {
      this
        ->Profile[3 * (row * size + static_cast<std::size_t>(view)) + static_cast<std::size_t>(c)] =
        static_cast<float>(value[c]);
    }
  };
  for (int view = 0; view < size; ++view)
  {
    const double delta = views.GetViews()[static_cast<std::size_t>(view)].Means.Delta;
    put(0, view, { 0.0, std::cos(delta), std::sin(delta) });
  }
  for (std::size_t k = 0, next = 0; k < modes.size(); k = next)
  {
    const int order = modes[k].Order;
    while (next < modes.size() && modes[next].Order == order)
    {
      ++next;
    }
    FieldSynthesis::Matrix functions(
      modes[k].Function.size(), static_cast<Eigen::Index>(next - k)); // turned alike
    for (std::size_t mode = k; mode < next; ++mode)
    {
      functions.col(static_cast<Eigen::Index>(mode - k)) = modes[mode].Function.cast<float>();
    }
    std::array<FieldSynthesis::Field, 3> fieldsOfModes;
    synthesis.Run(order, { functions, functions, functions }, fieldsOfModes);
    for (std::size_t mode = k; mode < next; ++mode)
    {
      const double scale = this->AddFields(order, fieldsOfModes, mode - k);
      for (int view = 0; view < size; ++view)
      {
        put(1 + mode, view, scale * modes[mode].GetWeight(kernels, LobeViews::GetAngle(view)));
      }
    }
    if (!goOn(static_cast<double>(next) / static_cast<double>(modes.size())))
    {
      return false;
    }
  }
  this->SetUnits();
  return true;
}

void RadianceCore::SetUnits()
{
  constexpr std::size_t size = 3 * static_cast<std::size_t>(LobeViews::NumberOfViews);
  constexpr auto most = static_cast<float>(MostSteps * MostSteps);
  this->Units.assign(3 * this->Orders.size(), 0.0f);
  for (std::size_t k = size; k < this->Profile.size(); ++k) // after the row of the axis
  {
    float& unit = this->Units[3 * (k / size - 1) + k % 3];
    unit = std::max(unit, std::abs(this->Profile[k]) / most);
  }
}

glm::dvec3 RadianceCore::GetSteps(std::size_t mode, double u) const
{
  const glm::dvec3 weights = GetProfileValue(this->Profile, static_cast<int>(1 + mode), u);
  glm::dvec3 steps(0.0);
  for (int c = 0; c < 3; ++c)
  {
    const double unit = static_cast<double>(this->Units[3 * mode + static_cast<std::size_t>(c)]);
    if (unit > 0.0)
    {
      const double root = std::round(std::sqrt(std::abs(weights[c]) / unit));
      steps[c] = std::copysign(std::min(root, MostSteps), weights[c]);
    }
  }
  return steps;
}

glm::dvec3 RadianceCore::Evaluate(
  const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t) const
{
  const LobePlacement place(n, o, t);
  const double u = GetNearestPosition(place.U);
  const glm::dvec2 delta = GetAxisTurn(this->Profile, place.Theta, u);
  const MapPosition at(place.GetAxis(delta.x, delta.y));
  const glm::dvec2 once = place.GetTurn(delta.x, delta.y, at);
  const std::size_t texels = this->GetNumberOfTexels();
  glm::dvec2 turn(1.0, 0.0); // cosine and sine of order times psi
  glm::dvec3 sum(0.0);
  int order = 0;
  std::size_t first = 0;
  for (std::size_t k = 0; k < this->Orders.size(); ++k)
  {
    for (; order < this->Orders[k]; ++order)
    {
      turn = glm::dvec2(turn.x * once.x - turn.y * once.y, turn.x * once.y + turn.y * once.x);
    }
    glm::dvec3 field = GetCenteredValue(this->Fields, this->Rows, this->Columns, first, at);
    first += texels;
    if (order > 0)
    {
      field = turn.x * field +
              turn.y * GetCenteredValue(this->Fields, this->Rows, this->Columns, first, at);
      first += texels;
    }
    const glm::dvec3 steps = this->GetSteps(k, u);
    sum += field * steps * glm::abs(steps) * glm::dvec3(glm::make_vec3(&this->Units[3 * k]));
  }
  return sum;
}
} // namespace measuredbrdf
