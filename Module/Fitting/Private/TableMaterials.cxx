// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TableMaterials.h"

#include "TableCompletion.h"
#include "vtkPhotographSet.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace measuredbrdf
{
TableMaterials::TableMaterials(
  vtkPhotographSet* set, const MapFitOptions& options, std::size_t sampleSize)
  : Set(set)
  , Options(options)
  , Data(3 * set->GetNumberOfPhotographs(), static_cast<Eigen::Index>(sampleSize))
  , Mask(sampleSize * static_cast<std::size_t>(set->GetNumberOfPhotographs()), 0)
  , Means(static_cast<std::size_t>(set->GetNumberOfPhotographs()), -1.0)
  , Scales(this->Means.size(), NoiseFloor)
{
}

void TableMaterials::Add(
  int photograph, const PhotographPixels& pixels, const std::vector<std::size_t>& sample)
{
  const auto number = static_cast<std::size_t>(photograph);
  double sum = 0.0;
  std::size_t valid = 0;
  for (std::size_t k = 0; k < sample.size(); ++k)
  {
    const float* value = &pixels.Values[3 * sample[k]];
    const bool isValid = pixels.States[sample[k]] == PixelState::Valid;
    this->Mask[k * this->Means.size() + number] = isValid ? 0 : 1;
    this->HasMasked = this->HasMasked || !isValid;
    valid += isValid ? 1 : 0;
    for (int c = 0; c < 3; ++c)
    {
      this->Data(3 * photograph + c, static_cast<Eigen::Index>(k)) = value[c];
      sum += value[c];
    }
  }
  if (valid > 0)
  {
    this->Means[number] = std::max(sum / (3.0 * static_cast<double>(valid)), 0.0);
    this->Scales[number] = this->Means[number] + NoiseFloor;
    // Where data say nothing, the photograph's mean is the first guess.
    for (std::size_t k = 0; k < sample.size() && this->HasMasked; ++k)
    {
      if (this->Mask[k * this->Means.size() + number] != 0)
      {
        this->Data.block<3, 1>(3 * photograph, static_cast<Eigen::Index>(k))
          .setConstant(static_cast<float>(this->Means[number]));
      }
    }
  }
}

std::string TableMaterials::Find(const std::function<bool(double)>& proceed)
{
  if (std::all_of(this->Means.begin(), this->Means.end(), [](double mean) { return mean < 0.0; }))
  {
    return "no pixel is valid: all are saturated, black or not finite";
  }
  for (std::size_t k = 0; k < this->Scales.size(); ++k)
  {
    this->Data.middleRows<3>(3 * static_cast<Eigen::Index>(k)) /=
      static_cast<float>(this->Scales[k]);
  }
  FactorizationOptions options;
  options.Materials = this->Options.Most;
  options.Seed = this->Options.Seed;
  options.Compactness = this->Options.Compactness;
  options.Proceed = proceed;
  this->Factors =
    Factorize(this->Data, this->HasMasked ? this->Mask : std::vector<unsigned char>(), options);
  this->Data.resize(0, 0);
  return this->Factors.Stopped ? std::string() : this->MakeTables();
}

std::string TableMaterials::MakeTables()
{
  std::vector<TablePoint> points;
  std::vector<int> seen; // the points' photographs
  for (std::size_t k = 0; k < this->Means.size(); ++k)
  {
    if (this->Means[k] >= 0.0)
    {
      TablePoint point;
      this->Set->GetLight(static_cast<int>(k), point.I);
      this->Set->GetView(static_cast<int>(k), point.O);
      // A logarithm's error is that of the value over the value.
      point.Weight = std::max(std::pow(this->Means[k] / this->Scales[k], 2), 1e-6);
      points.push_back(point);
      seen.push_back(static_cast<int>(k));
    }
  }
  const TableCompletion completion(points, this->Options.TableDimensions, this->Options.Smoothness);
  if (completion.HasFailed())
  {
    return "the tables' equations have no solution";
  }
  this->SeenShare = completion.GetSeenShare();
  for (Eigen::Index m = 0; m < this->Factors.Values.cols(); ++m)
  {
    std::vector<float> volume;
    for (int c = 0; c < 3; ++c)
    {
      std::vector<double> values;
      for (const int k : seen)
      {
        values.push_back(this->Factors.Values(3 * k + c, m) *
                         this->Scales[static_cast<std::size_t>(k)] / this->Set->GetScale(k));
      }
      const std::vector<double> cells = completion.Complete(values);
      volume.resize(3 * cells.size());
      for (std::size_t cell = 0; cell < cells.size(); ++cell)
      {
        volume[3 * cell + static_cast<std::size_t>(c)] = static_cast<float>(cells[cell]);
      }
    }
    const auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
    if (!table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN,
          this->Options.TableDimensions.data(), std::move(volume)))
    {
      return "a table was refused";
    }
    const std::string name = "material " + std::to_string(m + 1);
    table->SetName(name);
    table->SetSource("found in " + std::to_string(seen.size()) + " photographs");
    this->Materials.push_back({ table, name });
  }
  return std::string();
}
} // namespace measuredbrdf
