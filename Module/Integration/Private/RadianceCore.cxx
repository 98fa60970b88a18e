// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceCore.h"

#include "FieldSynthesis.h"
#include "LobeHarmonics.h"
#include "LobePlacement.h"
#include "ModuleShader.h"
#include "ParallelFor.h"
#include "RadianceTable.h"
#include "WignerD.h"
#include "vtkBRDFEnvironmentCore.h"

#include <Eigen/Eigenvalues>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr int LargestOrder = RadianceCore::LargestOrder;
constexpr double LeastEnergy = 1e-12; // of the mean radiance's: less is rounding
constexpr double LeastWeight = 1e-3;  // of views along the normal and the horizon

// Exponent of the environment's power by degree. 1 makes the squared error least; more serves its
// absolute value better (docs/methods/factored.md).
constexpr double PowerExponent = 1.5;

// A function about the axis, cos or sin of order times psi, and its weight of each view.
struct CoreMode
{
  int Order = 0;
  double Energy = 0.0;      // of what it explains, by field
  Eigen::VectorXd Function; // harmonics of that order, by degree
  Eigen::VectorXd Weights;  // by knot and channel

  // Interpolated between the knots.
  glm::dvec3 GetWeight(double theta) const
  {
    const int knots = static_cast<int>(this->Weights.size()) / 3;
    const double exact = LobeViews::GetKnotPosition(theta, knots);
    const int low = std::min(static_cast<int>(exact), knots - 2);
    glm::dvec3 weight;
    for (int c = 0; c < 3; ++c)
    {
      const Eigen::Index at = 3 * static_cast<Eigen::Index>(low) + c;
      weight[c] = glm::mix(this->Weights[at], this->Weights[at + 3], exact - low);
    }
    return weight;
  }
};

// A mode of an order above 0 takes two fields, of the cosine and of the sine.
int CountFields(int order) { return order > 0 ? 2 : 1; }

// Mean square of the environment's harmonics of each degree, all channels.
std::vector<double> GetPower(const EnvironmentHarmonics& environment, int degree)
{
  std::vector<double> power;
  for (int l = 0; l <= degree; ++l)
  {
    power.push_back(
      (GetEnergy(environment, 0, l) + GetEnergy(environment, 1, l) + GetEnergy(environment, 2, l)) /
      (2.0 * l + 1.0));
  }
  return power;
}

// How much of a sphere's disc is seen at a view angle, for the singular values.
double GetViewWeight(double theta)
{
  return std::sqrt(std::cos(theta) * std::sin(theta) + LeastWeight);
}

std::size_t GetIndex(int order, int channel, int degree, int l)
{
  return static_cast<std::size_t>(3 * order + channel) * static_cast<std::size_t>(degree + 1) +
         static_cast<std::size_t>(l);
}

// The clamped cosine's harmonics about an axis delta from the normal, as GetIndex(order, 0, ...).
std::vector<double> TurnCosine(double delta, int degree)
{
  std::vector<double> turned(GetIndex(LargestOrder + 1, 0, degree, 0), 0.0);
  std::vector<double> d(static_cast<std::size_t>(degree) + 1);
  for (int order = 0; order <= LargestOrder; ++order)
  {
    const WignerD functions(order, 0, degree);
    functions.Evaluate(std::abs(delta), d.data());
    const double sign = delta < 0.0 && order % 2 != 0 ? -1.0 : 1.0;
    for (int l = functions.GetFirst(); l <= degree; ++l)
    {
      turned[GetIndex(order, 0, degree, l)] =
        sign * d[l - functions.GetFirst()] * GetClampedCosine(l);
    }
  }
  return turned;
}

using Matrices = std::vector<Eigen::MatrixXd>; // by order: degrees x (knots x channels)

// What the table, as it is interpolated, lacks of a knot's kernel about the axis that pixels look
// at: of the lobe, and of the Lambert part.
void ExpandKnot(const CoreKernels& kernels, const std::vector<std::vector<float>>& table,
  std::size_t knot, const std::vector<float>& whole, Matrices& result)
{
  const int degree = kernels.Degree;
  const double u = GetProfilePosition(kernels.GetViewAngle(knot));
  const glm::dvec3 share = GetProfileValue(kernels.Table.Profile, 1, u);
  const glm::dvec3 floor = GetProfileValue(kernels.Table.Profile, 2, u);
  const double place = LobeViews::GetKnotPosition(kernels.GetViewAngle(knot), kernels.Table.Angles);
  const std::size_t low = std::min(static_cast<std::size_t>(place), table.size() - 2);
  const double between = place - static_cast<double>(low);
  const LobeMeans& lobe = kernels.Knots.At[knot].Means;
  const std::vector<double> cosine = TurnCosine(lobe.Delta, degree);
  for (int order = 0; order <= LargestOrder; ++order)
  {
    // As many orders as the table's azimuths can tell apart.
    const double inTable = order <= kernels.Table.Azimuths / 2 ? 1.0 : 0.0;
    for (int channel = 0; channel < 3; ++channel)
    {
      const double amplitude = lobe.Amplitude[channel];
      const double lambert = lobe.Floor[channel] - floor[channel];
      const Eigen::Index column = 3 * static_cast<Eigen::Index>(knot) + channel;
      for (int l = order; l <= degree; ++l)
      {
        const std::size_t k = GetIndex(order, channel, degree, l);
        const double taken =
          glm::mix(table[low][k], table[low + 1][k], static_cast<float>(between));
        result[order](l, column) =
          GetTaper(l, degree, kernels.Rows) *
          (whole[k] * amplitude + lambert * cosine[GetIndex(order, 0, degree, l)] -
            inTable * share[channel] * taken);
      }
    }
  }
}

Matrices ExpandKernels(const CoreKernels& kernels)
{
  // The table is smoothed, so that its harmonics end by themselves: none of those within the
  // degree is to fade.
  const std::vector<std::vector<float>> table = ExpandTableKernels(
    kernels.TableKnots, kernels.Degree, LargestOrder, kernels.Smoothing, kernels.Degree);
  const std::vector<std::vector<float>> whole = kernels.Knots.Expand(kernels.Degree, LargestOrder);
  Matrices result(LargestOrder + 1, Eigen::MatrixXd::Zero(kernels.Degree + 1,
                                      3 * static_cast<Eigen::Index>(kernels.Knots.At.size())));
  measuredbrdf::ParallelForEach(kernels.Knots.At.size(),
    [&](std::size_t knot) { ExpandKnot(kernels, table, knot, whole[knot], result); });
  return result;
}

// The modes of one order: eigenvectors of the Gram matrix are the right singular vectors.
void Decompose(int order, const Eigen::MatrixXd& kernels, const std::vector<double>& power,
  const Eigen::VectorXd& weights, double least, std::vector<CoreMode>& modes)
{
  Eigen::MatrixXd weighted = kernels;
  for (Eigen::Index l = 0; l < weighted.rows(); ++l)
  {
    weighted.row(l) *= std::pow(power[l], 0.5 * PowerExponent);
  }
  weighted = weighted * weights.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(weighted.transpose() * weighted);
  for (Eigen::Index k = weighted.cols() - 1; k >= 0; --k) // eigenvalues ascend
  {
    const double energy = eigen.eigenvalues()[k];
    if (!(energy > least))
    {
      break;
    }
    const Eigen::VectorXd right = eigen.eigenvectors().col(k);
    CoreMode mode;
    mode.Order = order;
    mode.Energy = energy; // twice that of 2 Re(e^(-i m psi) G), which takes two fields
    mode.Function = kernels * weights.asDiagonal() * right;
    mode.Weights = right.cwiseQuotient(weights);
    modes.push_back(std::move(mode));
  }
}

// The modes that explain most under an environment, in so many fields at most; orders ascend.
std::vector<CoreMode> ChooseModes(
  const EnvironmentHarmonics& environment, const CoreKernels& kernels, int fields)
{
  const std::vector<double> power = GetPower(environment, kernels.Degree);
  Eigen::VectorXd weights(3 * static_cast<Eigen::Index>(kernels.Knots.At.size()));
  double total = 0.0;
  for (std::size_t knot = 0; knot < kernels.Knots.At.size(); ++knot)
  {
    const double weight = GetViewWeight(kernels.GetViewAngle(knot));
    weights.segment<3>(3 * static_cast<Eigen::Index>(knot)).setConstant(weight);
    const glm::dvec3 seen = weight * kernels.Knots.At[knot].Means.Amplitude;
    total += glm::dot(seen, seen);
  }
  const Matrices expanded = ExpandKernels(kernels);
  const double least = LeastEnergy * std::pow(power[0], PowerExponent) * total;
  std::array<std::vector<CoreMode>, LargestOrder + 1> byOrder;
  measuredbrdf::ParallelForEach(LargestOrder + 1,
    [&](int order)
    {
      const std::size_t at = order;
      Decompose(order, expanded[at], power, weights, least, byOrder[at]);
    });
  std::vector<CoreMode> modes;
  for (std::vector<CoreMode>& of : byOrder)
  {
    std::move(of.begin(), of.end(), std::back_inserter(modes));
  }
  std::stable_sort(modes.begin(), modes.end(),
    [](const CoreMode& a, const CoreMode& b) { return a.Energy > b.Energy; });
  std::vector<CoreMode> chosen;
  for (CoreMode& mode : modes)
  {
    if (CountFields(mode.Order) <= fields)
    {
      fields -= CountFields(mode.Order);
      chosen.push_back(std::move(mode));
    }
  }
  std::stable_sort(chosen.begin(), chosen.end(),
    [](const CoreMode& a, const CoreMode& b) { return a.Order < b.Order; });
  return chosen;
}

constexpr float LargestValue = 32768.0f; // of a 16-bit texture, with room to spare
constexpr vtkIdType PackedTexels = 4096; // by a thread at a time
}

double CoreKernels::GetViewAngle(std::size_t knot) const
{
  return LobeViews::GetKnotAngle(static_cast<int>(knot), static_cast<int>(this->Knots.At.size()));
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

// A mode's fields, as the synthesis has them, scaled to what a texture holds; returns what undoes
// that.
double RadianceCore::AddFields(int order, const FieldSynthesis::Fields& fields, std::size_t mode)
{
  const std::size_t texels = this->GetNumberOfTexels();
  // 2 Re(e^(-i m psi) G) = 2 cos(m psi) Re G + 2 sin(m psi) Im G.
  const std::size_t first = this->Fields.size();
  this->Fields.resize(first + 3 * texels * static_cast<std::size_t>(CountFields(order)));
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
  measuredbrdf::ParallelForEach(
    texels,
    [&](std::size_t texel)
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
    },
    nullptr, PackedTexels);
  this->Orders.push_back(order);
  return 1.0 / static_cast<double>(scale);
}

bool RadianceCore::Make(const EnvironmentHarmonics& environment, const LobeViews& views,
  const CoreKernels& kernels, int fields, const std::function<bool(double)>& goOn)
{
  const std::vector<CoreMode> modes = ChooseModes(environment, kernels, fields);
  FieldSynthesis synthesis(MapPart(this->Rows, this->Columns), MapNodes::Centers);
  constexpr int size = LobeViews::NumberOfViews;
  this->Profile.assign(3 * size * (1 + modes.size()), 0.0f);
  const auto put = [this](std::size_t row, int view, const glm::dvec3& value)
  {
    const glm::vec3 rounded(value);
    std::copy_n(&rounded.x, 3, &this->Profile[3 * (row * size + view)]);
  };
  for (int view = 0; view < size; ++view)
  {
    const double delta = views.GetViews()[view].Means.Delta;
    put(0, view, { 0.0, std::cos(delta), std::sin(delta) });
  }
  for (std::size_t k = 0, next = 0; k < modes.size(); k = next)
  {
    const int order = modes[k].Order;
    while (next < modes.size() && modes[next].Order == order)
    {
      ++next;
    }
    const Eigen::Index count = next - k; // turned alike
    FieldSynthesis::Kernels functions(3 * count, modes[k].Function.size());
    for (Eigen::Index row = 0; row < 3 * count; ++row)
    {
      functions.row(row) =
        modes[k + static_cast<std::size_t>(row % count)].Function.cast<float>().transpose();
    }
    FieldSynthesis::Fields fieldsOfModes;
    synthesis.Run(order, { { environment, functions } }, fieldsOfModes);
    for (std::size_t mode = k; mode < next; ++mode)
    {
      const double scale = this->AddFields(order, fieldsOfModes, mode - k);
      for (int view = 0; view < size; ++view)
      {
        put(1 + mode, view, scale * modes[mode].GetWeight(LobeViews::GetAngle(view)));
      }
    }
    if (!goOn(static_cast<double>(next) / static_cast<double>(modes.size())))
    {
      return false;
    }
  }
  return true;
}

std::vector<float> RadianceCore::GetShaderWeights() const
{
  const int modes = this->Orders.size();
  std::vector<float> texels(4 * ProfileTexels * CountWeightRows(modes), 0.0f);
  for (int mode = 0; mode < modes; ++mode)
  {
    for (int k = 0; k < ProfileTexels; ++k)
    {
      const glm::dvec3 weights =
        GetProfileValue(this->Profile, 1 + mode, k / (ProfileTexels - 1.0));
      for (int c = 0; c < 3; ++c)
      {
        const int number = 3 * mode + c;
        texels[4 * (number / 4 * ProfileTexels + k) + number % 4] = static_cast<float>(weights[c]);
      }
    }
  }
  return texels;
}

void RadianceCore::AddTo(vtkBRDFShaderInputs& inputs) const
{
  if (this->Orders.empty()) // constant light, or nothing sharp
  {
    return;
  }
  // Both parts look at the same place of their maps: one text, the maps' before the table's.
  vtkBRDFShaderInputs::Term& term = inputs.Terms.at(0);
  term.Source = std::string(vtkBRDFEnvironmentCore) + term.Source;
  term.Shader = "vtkBRDFEnvironmentCore";
  const int modes = this->Orders.size();
  const int rows = RadianceCore::CountWeightRows(modes);
  std::string steps;
  for (int row = 0; row < rows; ++row)
  {
    const std::string number = std::to_string(row);
    steps += "vec4 weights" + number + " = texelFetch(brdfCoreProfileINSTANCE, ivec2(view, " +
             number + "), 0); ";
  }
  const auto getWeight = [](int number)
  { return "weights" + std::to_string(number / 4) + "." + "xyzw"[number % 4]; };
  int order = 0;
  for (int mode = 0; mode < modes; ++mode)
  {
    const int next = this->Orders[mode];
    for (; order < next; ++order)
    {
      steps += "brdfCoreTurnINSTANCE(at); ";
    }
    steps += std::string("sum += ") +
             (next > 0 ? "brdfCoreTurnedINSTANCE" : "brdfCoreFieldINSTANCE") + "(at) * vec3(" +
             getWeight(3 * mode) + ", " + getWeight(3 * mode + 1) + ", " + getWeight(3 * mode + 2) +
             "); ";
  }
  const int fields = this->GetNumberOfFields();
  term.Fetches += rows + fields;
  for (vtkBRDFShaderInputs::Constant& constant : term.Constants)
  {
    if (constant.Name == "SHARP_PART")
    {
      constant.Value = "brdfCoreINSTANCE(view, position, turn)";
    }
  }
  term.Constants.push_back({ "CORE_STEPS", steps });
  term.Constants.push_back({ "CORE_FIELDS", std::to_string(fields) });
  vtkBRDFShaderInputs::Texture& profile = AddTexture(term, "brdfCoreProfile", ProfileTexels, rows);
  profile.Components = 4;
  profile.Data = this->GetShaderWeights();
  vtkBRDFShaderInputs::Texture& maps =
    AddTexture(term, "brdfCoreFields", this->Columns, this->Rows * fields);
  maps.HalfFloat = true;
  maps.Repeat[0] = true; // they are round
  maps.Data = this->Fields;
  inputs.Description += "; " + std::to_string(fields) + " maps of " +
                        std::to_string(this->Columns) + " x " + std::to_string(this->Rows) +
                        " of its sharp part";
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
    sum += field * GetProfileValue(this->Profile, static_cast<int>(1 + k), u);
  }
  return sum;
}
} // namespace measuredbrdf
