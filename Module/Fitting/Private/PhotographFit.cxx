// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PhotographFit.h"

#include "ParallelFor.h"
#include "SRGB.h"
#include "ScopedErrorCapture.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPhotographSet.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace measuredbrdf
{
namespace
{
// Beyond this a value is as good as infinite: its square must fit into a double, and it into a
// float after any curve.
constexpr double LargestValue = 1e12;

bool IsFloat(int type) { return type == VTK_FLOAT || type == VTK_DOUBLE; }

PixelState GetState(const double rgb[3], bool hasLevels, vtkPhotographSet* set)
{
  const double sum = std::abs(rgb[0]) + std::abs(rgb[1]) + std::abs(rgb[2]);
  if (!(sum <= LargestValue)) // NaN, too
  {
    return PixelState::Invalid;
  }
  const double most = std::max({ rgb[0], rgb[1], rgb[2] });
  return hasLevels && most >= set->GetSaturationLevel() ? PixelState::Saturated
         : hasLevels && most <= set->GetBlackLevel()    ? PixelState::Black
                                                        : PixelState::Valid;
}

// From a stored value (integers: a share of their largest) to a linear one.
float GetLinear(double stored, bool isFloat, vtkPhotographSet* set)
{
  const int transfer = set->GetTransfer();
  const bool isAutomatic = transfer == vtkPhotographSet::AUTOMATIC;
  if (transfer == vtkPhotographSet::LINEAR || (isAutomatic && isFloat))
  {
    return static_cast<float>(stored);
  }
  // Negative values, which noise makes, mirror the curve.
  const double magnitude = std::abs(stored);
  const double linear = transfer == vtkPhotographSet::SRGB || isAutomatic
                          ? DecodeSRGB(magnitude)
                          : std::pow(magnitude, set->GetGamma());
  return static_cast<float>(std::copysign(std::min(linear, LargestValue), stored));
}

std::string FormatSize(int width, int height)
{
  return std::to_string(width) + " x " + std::to_string(height);
}

// What keeps a picture from being a photograph; "" if nothing.
std::string FindPictureProblem(vtkImageData* picture)
{
  const int* size = picture->GetDimensions();
  vtkDataArray* values = picture->GetPointData()->GetScalars();
  if (!values || size[0] < 1 || size[1] < 1 || size[2] != 1)
  {
    return "size: found " + FormatSize(size[0], size[1]) + " x " + std::to_string(size[2]) +
           (values ? "" : " without values") + ", expected a picture of one slice";
  }
  const int components = values->GetNumberOfComponents();
  if (components != 1 && components != 3 && components != 4)
  {
    return "found " + std::to_string(components) + " components, expected 1, 3 or 4";
  }
  const int type = values->GetDataType();
  if (!IsFloat(type) && type != VTK_UNSIGNED_CHAR && type != VTK_UNSIGNED_SHORT &&
      type != VTK_UNSIGNED_INT)
  {
    return "found values of type " + std::string(values->GetDataTypeAsString()) +
           ", expected unsigned integers or floats";
  }
  return "";
}
}

PhotographPasses::PhotographPasses(vtkPhotographSet* set, std::function<bool(double)> report)
  : Set(set)
  , Report(std::move(report))
{
  const PhotographPixels first = this->Read(0);
  this->Width = first.Width;
  this->Height = first.Height;
}

PhotographPixels PhotographPasses::Read(int index) const
{
  const ScopedErrorCapture error(this->Set);
  const auto picture = vtkSmartPointer<vtkImageData>::Take(this->Set->NewPicture(index));
  std::string problem = picture                   ? FindPictureProblem(picture)
                        : error.GetText().empty() ? "there is no picture"
                                                  : error.GetText();
  PhotographPixels pixels;
  pixels.Width = picture ? picture->GetDimensions()[0] : 0;
  pixels.Height = picture ? picture->GetDimensions()[1] : 0;
  if (problem.empty() && this->Width > 0 &&
      (pixels.Width != this->Width || pixels.Height != this->Height))
  {
    problem = "size: found " + FormatSize(pixels.Width, pixels.Height) +
              ", expected the first photograph's " + FormatSize(this->Width, this->Height);
  }
  if (!problem.empty())
  {
    const std::string given = this->Set->GetName(index);
    const std::string name = given.empty() ? "photograph " + std::to_string(index) : given;
    const bool isNamed = problem.find(name) != std::string::npos;
    throw std::runtime_error(isNamed ? problem : name + ": " + problem);
  }
  vtkDataArray* values = picture->GetPointData()->GetScalars();
  const bool isFloat = IsFloat(values->GetDataType());
  const double divisor = isFloat ? 1.0 : values->GetDataTypeMax();
  const bool isGray = values->GetNumberOfComponents() == 1;
  const bool hasLevels = !isFloat || this->Set->GetLevelsForFloats();
  std::vector<float> table; // of each code, where there are few
  for (double code = 0.0; divisor <= 65535.0 && !isFloat && code <= divisor; ++code)
  {
    table.push_back(GetLinear(code / divisor, isFloat, this->Set));
  }
  for (vtkIdType k = 0; k < values->GetNumberOfTuples(); ++k)
  {
    double rgb[3];
    for (int c = 0; c < 3; ++c)
    {
      rgb[c] = values->GetComponent(k, isGray ? 0 : c) / divisor;
    }
    pixels.States.push_back(GetState(rgb, hasLevels, this->Set));
    for (const double value : rgb)
    {
      pixels.Values.push_back(pixels.States.back() != PixelState::Valid ? 0.0f
                              : table.empty()
                                ? GetLinear(value, isFloat, this->Set)
                                : table[static_cast<std::size_t>(std::lround(value * divisor))]);
    }
  }
  return pixels;
}

void PhotographPasses::Run(
  double from, double to, const std::function<void(int, const PhotographPixels&)>& use)
{
  this->PixelCounts.fill(0);
  const int count = this->Set->GetNumberOfPhotographs();
  for (int k = 0; k < count; ++k)
  {
    this->Proceed(from + (to - from) * k / count);
    const PhotographPixels pixels = this->Read(k);
    for (const PixelState state : pixels.States)
    {
      ++this->PixelCounts[static_cast<std::size_t>(state)];
    }
    use(k, pixels);
  }
}

void PhotographPasses::Proceed(double share) const
{
  if (!this->Report(share))
  {
    throw MapFitStopped();
  }
}

//------------------------------------------------------------------------------
TexelSums::TexelSums(const MaterialValues& materials, std::vector<std::size_t> texels)
  : Materials(materials)
  , Texels(std::move(texels))
  , Matrix(materials.Values.transpose() * materials.Values)
  , Right(Eigen::MatrixXd::Zero(
      materials.Values.cols(), static_cast<Eigen::Index>(this->Texels.size())))
  , Squares(this->Texels.size(), 0.0)
  , Masked(this->Texels.size())
{
}

void TexelSums::Add(int photograph, const PhotographPixels& pixels)
{
  const Eigen::MatrixXd rows = this->Materials.Values.middleRows<3>(3 * photograph).transpose();
  const double inverse = 1.0 / this->Materials.Scales[static_cast<std::size_t>(photograph)];
  ParallelForEach(
    this->Texels.size(),
    [&](std::size_t k)
    {
      const std::size_t texel = this->Texels[k];
      if (pixels.States[texel] != PixelState::Valid)
      {
        this->Masked[k].push_back(photograph);
        return;
      }
      const Eigen::Vector3d value =
        Eigen::Map<const Eigen::Vector3f>(&pixels.Values[3 * texel]).cast<double>() * inverse;
      this->Right.col(static_cast<Eigen::Index>(k)).noalias() += rows * value;
      this->Squares[k] += value.squaredNorm();
    },
    nullptr, 0);
}

SmallMatrix TexelSums::GetMatrix(std::size_t k, const std::vector<int>& columns) const
{
  SmallMatrix matrix = this->Matrix(columns, columns);
  for (const int p : this->Masked[k])
  {
    const Eigen::Matrix3Xd rows = this->Materials.Values(Eigen::seqN(3 * p, 3), columns);
    matrix -= rows.transpose() * rows;
  }
  return matrix;
}

MaterialValues EvaluateMaterials(vtkPhotographSet* set, const std::vector<NamedMaterial>& materials,
  const std::vector<double>& scales)
{
  const int photographs = set->GetNumberOfPhotographs();
  const auto count = static_cast<Eigen::Index>(materials.size());
  MaterialValues result;
  result.Values.resize(3 * photographs, count);
  result.Scales = scales;
  for (const NamedMaterial& material : materials)
  {
    material.first->Prepare();
  }
  for (int k = 0; k < photographs; ++k)
  {
    double light[3], view[3];
    set->GetLight(k, light);
    set->GetView(k, view);
    auto rows = result.Values.middleRows<3>(3 * k);
    for (Eigen::Index m = 0; m < count; ++m)
    {
      Eigen::Vector3d f;
      materials[static_cast<std::size_t>(m)].first->Evaluate(light, view, f.data());
      rows.col(m) = set->GetScale(k) * f;
    }
    if (scales.empty())
    {
      result.Scales.push_back(std::exp((rows.array() + NoiseFloor).log().mean()));
    }
    rows /= result.Scales[static_cast<std::size_t>(k)];
  }
  return result;
}

namespace
{
constexpr int MostRounds = 8;         // of exchanges
constexpr double LeastGain = 1e-3;    // an exchange must lower the sum by this share
constexpr double NothingLeft = 1e-14; // of the sum of squares: rounding

class Selection
{
public:
  Selection(
    const TexelSums& sums, int most, double tolerance, const std::function<void(double)>& proceed)
    : Sums(sums)
    , Most(std::min(most, sums.GetNumberOfMaterials()))
    , Tolerance(tolerance)
    , Proceed(proceed)
  {
    for (std::size_t k = 0; k < sums.GetNumberOfTexels(); ++k)
    {
      this->Least += NothingLeft * sums.GetSquares(k);
    }
  }

  std::vector<int> Run()
  {
    // It ends where nothing is left to describe, or the next material does not pay.
    while (static_cast<int>(this->Chosen.size()) < this->Most && this->Error > this->Least &&
           this->Exchange(this->Chosen.size(), this->Chosen.empty() ? 0.0 : this->Tolerance, 0.0))
    {
    }
    for (int round = 0; round < MostRounds; ++round)
    {
      std::size_t place = 0;
      while (place < this->Chosen.size() && !this->Exchange(place, LeastGain, this->Least))
      {
        ++place;
      }
      if (place == this->Chosen.size()) // no exchange helps
      {
        break;
      }
    }
    // What earlier choices no longer need goes.
    for (std::size_t place = 0; place < this->Chosen.size() && this->Chosen.size() > 1;)
    {
      std::vector<int> without = this->Chosen;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(place));
      const double error = this->GetError(without);
      if ((1.0 - this->Tolerance) * error > this->Error + this->Least)
      {
        ++place;
        continue;
      }
      this->Chosen = without;
      this->Error = error;
    }
    std::sort(this->Chosen.begin(), this->Chosen.end());
    return this->Chosen;
  }

private:
  // Texels in a fixed order, so that the sum does not depend on threads.
  double GetError(const std::vector<int>& columns) const
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < this->Sums.GetNumberOfTexels(); ++k)
    {
      sum += SolveTexel(this->Sums, k, columns).Residual;
    }
    return sum;
  }

  // Puts another material at a place, behind the last one to add it: the one that leaves least, if
  // that is less than the error by a share and a margin. Returns whether it is.
  bool Exchange(std::size_t place, double share, double margin)
  {
    std::vector<std::vector<int>> sets;
    for (int k = 0; k < this->Sums.GetNumberOfMaterials(); ++k)
    {
      if (std::find(this->Chosen.begin(), this->Chosen.end(), k) == this->Chosen.end())
      {
        sets.push_back(this->Chosen);
        sets.back().resize(std::max(this->Chosen.size(), place + 1));
        sets.back()[place] = k;
      }
    }
    std::vector<double> errors(sets.size());
    constexpr std::size_t batch = 32; // so that progress is told now and then
    for (std::size_t first = 0; first < sets.size(); first += batch)
    {
      ParallelForEach(std::min(batch, sets.size() - first),
        [&](std::size_t k) { errors[first + k] = this->GetError(sets[first + k]); });
      this->Proceed(static_cast<double>(this->Chosen.size()) / this->Most);
    }
    const auto best = std::min_element(errors.begin(), errors.end());
    if (best == errors.end() || !(*best < (1.0 - share) * this->Error - margin))
    {
      return false;
    }
    this->Error = *best;
    this->Chosen = sets[static_cast<std::size_t>(best - errors.begin())];
    return true;
  }

  const TexelSums& Sums;
  int Most;
  double Tolerance;
  const std::function<void(double)>& Proceed;
  std::vector<int> Chosen;
  double Least = 0.0; // sum of squares that is as good as nothing
  double Error = std::numeric_limits<double>::infinity();
};
}

WeightSolution SolveTexel(const TexelSums& sums, std::size_t k, const std::vector<int>& columns)
{
  WeightSolution solution;
  if (sums.GetNumberOfPhotographs(k) == 0)
  {
    solution.Weights = SmallVector::Zero(static_cast<Eigen::Index>(columns.size()));
    return solution;
  }
  const SmallMatrix matrix = sums.GetMatrix(k, columns);
  const SmallVector right = sums.GetRight(k, columns);
  solution.Weights = SolveConstrained(matrix, right, UnknownsAre::Shares);
  const double residual = sums.GetSquares(k) - 2.0 * right.dot(solution.Weights) +
                          solution.Weights.dot(matrix * solution.Weights);
  solution.Residual = std::max(residual, 0.0); // rounding
  return solution;
}

std::vector<int> SelectMaterials(
  const TexelSums& sums, int most, double tolerance, const std::function<void(double)>& proceed)
{
  for (std::size_t k = 0; k < sums.GetNumberOfTexels(); ++k)
  {
    if (sums.GetNumberOfPhotographs(k) > 0)
    {
      return Selection(sums, most, tolerance, proceed).Run();
    }
  }
  return {};
}
} // namespace measuredbrdf
