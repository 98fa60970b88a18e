// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceCore.h"

#include "FieldSynthesis.h"
#include "LobeHarmonics.h"
#include "LobePlacement.h"
#include "TableSynthesis.h" // for GetSmoothed
#include "vtkSMPTools.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr int LargestOrder = 8;          // lobes that are longer than wide; more tells nothing
constexpr float LargestValue = 32768.0f; // of a 16-bit texture, with room to spare
constexpr double LeastEnergy = 1e-12;    // of the mean radiance's: less is rounding
constexpr double LeastWeight = 1e-3;     // of views along the normal and the horizon

// A function about the axis, by degree, and its weights by view angle and channel.
struct Mode
{
  int Order;
  double Energy; // by field
  Eigen::VectorXd Function;
  Eigen::VectorXd Weights;
};

int CountFields(int order) { return order > 0 ? 2 : 1; }

// Mean square of the environment's harmonics of each degree, all channels.
std::vector<double> GetPower(const EnvironmentHarmonics& environment, int degree)
{
  std::vector<double> power;
  for (int l = 0; l <= degree; ++l)
  {
    double sum = 0.0;
    for (int channel = 0; channel < 3; ++channel)
    {
      for (int m = 0; m <= l; ++m)
      {
        sum += (m > 0 ? 2.0 : 1.0) * std::norm(environment.Get(channel, l, m));
      }
    }
    power.push_back(sum / (2.0 * l + 1.0));
  }
  return power;
}

double GetViewAngle(std::size_t knot, std::size_t count)
{
  return LobeViews::GetLastAngle() * static_cast<double>(knot) / (static_cast<double>(count) - 1.0);
}

// How much of a sphere's disc is seen at a view angle, for the singular values.
double GetViewWeight(double theta)
{
  return std::sqrt(std::cos(theta) * std::sin(theta) + LeastWeight);
}

// The modes of one order: eigenvectors of the Gram matrix are the right singular vectors.
void Decompose(int order, const Eigen::MatrixXd& kernels, const std::vector<double>& power,
  const Eigen::VectorXd& columnWeights, double least, std::vector<Mode>& modes)
{
  Eigen::MatrixXd weighted = kernels;
  for (Eigen::Index l = 0; l < weighted.rows(); ++l)
  {
    weighted.row(l) *= std::sqrt(power[static_cast<std::size_t>(l)]);
  }
  weighted = weighted * columnWeights.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(weighted.transpose() * weighted);
  for (Eigen::Index k = weighted.cols() - 1; k >= 0; --k) // eigenvalues ascend
  {
    const double energy = solver.eigenvalues()[k];
    if (!(energy > least))
    {
      break;
    }
    const Eigen::VectorXd right = solver.eigenvectors().col(k);
    Mode mode;
    mode.Order = order;
    mode.Energy = energy; // twice that of 2 Re(e^(-i m psi) G), which takes two fields
    mode.Function = kernels * (columnWeights.asDiagonal() * right);
    mode.Weights = right;
    for (Eigen::Index column = 0; column < right.size(); ++column)
    {
      mode.Weights[column] =
        columnWeights[column] > 0.0 ? right[column] / columnWeights[column] : 0.0;
    }
    modes.push_back(std::move(mode));
  }
}

// All orders' kernels above the blur, one column for each knot and channel, as shares of the lobe's
// amplitude.
std::vector<Eigen::MatrixXd> ExpandKernels(
  const MaterialPrecomputation::Kernels& knots, int degree, double smoothing)
{
  std::vector<Eigen::MatrixXd> kernels(LargestOrder + 1,
    Eigen::MatrixXd::Zero(degree + 1, 3 * static_cast<Eigen::Index>(knots.size())));
  vtkSMPTools::For(0, static_cast<vtkIdType>(knots.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType knot = begin; knot < end; ++knot)
      {
        const LobeHarmonics& lobe = *knots[static_cast<std::size_t>(knot)];
        const std::vector<float> b = lobe.Expand(lobe.GetMeans().Delta, degree, LargestOrder);
        for (int order = 0; order <= LargestOrder; ++order)
        {
          for (int channel = 0; channel < 3; ++channel)
          {
            for (int l = order; l <= degree; ++l)
            {
              const std::size_t at = static_cast<std::size_t>(3 * order + channel) *
                                       static_cast<std::size_t>(degree + 1) +
                                     static_cast<std::size_t>(l);
              kernels[static_cast<std::size_t>(order)](l, 3 * knot + channel) =
                b[at] * (1.0 - GetSmoothed(l, smoothing));
            }
          }
        }
      }
    });
  return kernels;
}

std::vector<Mode> ChooseModes(const EnvironmentHarmonics& environment,
  const MaterialPrecomputation::Kernels& knots, int degree, double smoothing, int fields)
{
  const std::vector<double> power = GetPower(environment, degree);
  Eigen::VectorXd weights(3 * static_cast<Eigen::Index>(knots.size()));
  for (std::size_t knot = 0; knot < knots.size(); ++knot)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      weights[3 * static_cast<Eigen::Index>(knot) + channel] =
        GetViewWeight(GetViewAngle(knot, knots.size())) *
        knots[knot]->GetMeans().Amplitude[channel];
    }
  }
  const std::vector<Eigen::MatrixXd> kernels = ExpandKernels(knots, degree, smoothing);
  std::vector<Mode> modes;
  const double least = LeastEnergy * power[0] * weights.squaredNorm();
  for (int order = 0; order <= LargestOrder; ++order)
  {
    Decompose(order, kernels[static_cast<std::size_t>(order)], power, weights, least, modes);
  }
  std::stable_sort(
    modes.begin(), modes.end(), [](const Mode& a, const Mode& b) { return a.Energy > b.Energy; });
  std::vector<Mode> chosen;
  for (Mode& mode : modes)
  {
    if (CountFields(mode.Order) <= fields)
    {
      fields -= CountFields(mode.Order);
      chosen.push_back(std::move(mode));
    }
  }
  std::stable_sort(
    chosen.begin(), chosen.end(), [](const Mode& a, const Mode& b) { return a.Order < b.Order; });
  return chosen;
}

// A mode's weight of a view, in shares of the lobe's amplitude.
glm::dvec3 GetWeight(const Mode& mode, double theta, std::size_t knots)
{
  const double last = static_cast<double>(knots) - 1.0;
  const double exact = std::clamp(last * theta / LobeViews::GetLastAngle(), 0.0, last);
  const std::size_t low = std::min(static_cast<std::size_t>(exact), knots - 2);
  glm::dvec3 weight;
  for (int c = 0; c < 3; ++c)
  {
    const Eigen::Index at = 3 * static_cast<Eigen::Index>(low) + c;
    weight[c] = glm::mix(mode.Weights[at], mode.Weights[at + 3], exact - static_cast<double>(low));
  }
  return weight;
}
}

int RadianceCore::GetNumberOfFields() const
{
  int fields = 0;
  for (const int order : this->Orders)
  {
    fields += CountFields(order);
  }
  return fields;
}

bool RadianceCore::Make(const EnvironmentHarmonics& environment, const LobeViews& views,
  const MaterialPrecomputation::Kernels& knots, int degree, double smoothing, int fields,
  const std::function<bool(double)>& goOn)
{
  const std::vector<Mode> modes = ChooseModes(environment, knots, degree, smoothing, fields);
  const std::size_t texels =
    static_cast<std::size_t>(this->Columns) * static_cast<std::size_t>(this->Rows);
  const FieldSynthesis synthesis(environment, this->Rows, this->Columns);
  std::vector<double> scales;
  for (const Mode& mode : modes)
  {
    const FieldSynthesis::Matrix kernel = mode.Function.cast<float>();
    std::array<FieldSynthesis::Field, 3> result;
    synthesis.Run(mode.Order, { kernel, kernel, kernel }, result);
    // 2 Re(e^(-i m psi) G) = 2 cos(m psi) Re G + 2 sin(m psi) Im G.
    const std::size_t first = this->Fields.size();
    this->Fields.resize(first + 3 * texels * static_cast<std::size_t>(CountFields(mode.Order)));
    float* real = &this->Fields[first];
    float peak = 0.0f;
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      for (std::size_t texel = 0; texel < texels; ++texel)
      {
        const std::complex<float> value = (mode.Order > 0 ? 2.0f : 1.0f) * result[channel][texel];
        real[3 * texel + channel] = value.real();
        peak = std::max(peak, std::abs(value));
        if (mode.Order > 0)
        {
          real[3 * (texels + texel) + channel] = value.imag();
        }
      }
    }
    const float scale = peak > 0.0f ? LargestValue / peak : 1.0f;
    for (std::size_t k = first; k < this->Fields.size(); ++k)
    {
      this->Fields[k] *= scale;
    }
    scales.push_back(1.0 / static_cast<double>(scale));
    this->Orders.push_back(mode.Order);
    if (!goOn(static_cast<double>(scales.size()) / static_cast<double>(modes.size())))
    {
      return false;
    }
  }

  constexpr int size = LobeViews::NumberOfViews;
  this->Profile.assign(3 * size * (1 + modes.size()), 0.0f);
  for (int view = 0; view < size; ++view)
  {
    const LobeMeans& lobe = views.GetViews()[static_cast<std::size_t>(view)].Means;
    const auto put = [&](std::size_t row, const glm::dvec3& value)
    {
      for (int c = 0; c < 3; ++c)
      {
        this->Profile[3 * (row * size + static_cast<std::size_t>(view)) +
                      static_cast<std::size_t>(c)] = static_cast<float>(value[c]);
      }
    };
    put(0, { 0.0, std::cos(lobe.Delta), std::sin(lobe.Delta) });
    for (std::size_t k = 0; k < modes.size(); ++k)
    {
      put(1 + k,
        lobe.Amplitude * scales[k] * GetWeight(modes[k], LobeViews::GetAngle(view), knots.size()));
    }
  }
  return true;
}

glm::dvec3 RadianceCore::Evaluate(
  const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t) const
{
  const LobePlacement place(n, o, t);
  const glm::dvec3 axis = GetProfileValue(this->Profile, 0, place.U);
  const MapPosition at(place.GetAxis(axis.y, axis.z));
  const glm::dvec2 once = place.GetTurn(axis.y, axis.z, at);
  const std::size_t texels =
    static_cast<std::size_t>(this->Columns) * static_cast<std::size_t>(this->Rows);
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
    glm::dvec3 field = GetMapValue(this->Fields, this->Rows, this->Columns, first, at);
    first += texels;
    if (order > 0)
    {
      field =
        turn.x * field + turn.y * GetMapValue(this->Fields, this->Rows, this->Columns, first, at);
      first += texels;
    }
    sum += field * GetProfileValue(this->Profile, static_cast<int>(1 + k), place.U);
  }
  return sum;
}
} // namespace measuredbrdf
