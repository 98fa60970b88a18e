// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Photographs of a flat sample whose materials and weights are known: exact evaluation of the
 * map's materials, no relief, and noise. The map has weights for all of them.
 */

#ifndef SimulatedPhotographs_h
#define SimulatedPhotographs_h

#include "HalfVector.h"
#include "LowDiscrepancy.h"
#include "vtkBRDF.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkObjectFactory.h"
#include "vtkPhotographSet.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

class SimulatedPhotographs : public vtkPhotographSet
{
public:
  static SimulatedPhotographs* New() { VTK_STANDARD_NEW_BODY(SimulatedPhotographs); }
  vtkTypeMacro(SimulatedPhotographs, vtkPhotographSet);

  vtkSmartPointer<vtkMaterialMap> Map;
  double Noise = 0.0; // standard deviation, linear
  int Bits = 0;       // of a pixel, linear and clipped; 0: floats

  /// exposure 0: that with which the brightest material, where it is alone, has the value 0.9.
  void Add(const double light[3], const double view[3], double exposure = 1.0)
  {
    Photograph photograph;
    std::copy_n(light, 3, photograph.Light);
    std::copy_n(view, 3, photograph.View);
    double brightest = 0.0;
    for (int k = 0; k < this->Map->GetNumberOfMaterials(); ++k)
    {
      double f[3];
      this->Map->GetBRDF(k)->Evaluate(light, view, f);
      brightest = std::max({ brightest, f[0], f[1], f[2] });
    }
    photograph.Exposure =
      exposure > 0.0 ? exposure : 0.9 / (this->Irradiance * brightest * light[2]);
    this->Insert(std::move(photograph));
  }

  /// Pairs of the Bonn database's 81 directions (Sattler, Sarlette, Klein 2003): rings of 15
  /// degrees. A fixed stride spreads them over all 6561.
  void AddBonnDirections(int count, double exposure)
  {
    const std::pair<int, int> rings[] = { { 0, 1 }, { 15, 6 }, { 30, 12 }, { 45, 18 }, { 60, 20 },
      { 75, 24 } };
    std::vector<glm::dvec3> directions;
    for (const auto& [theta, azimuths] : rings)
    {
      for (int k = 0; k < azimuths; ++k)
      {
        directions.emplace_back();
        GetDirection(theta, 360.0 * k / azimuths, &directions.back().x);
      }
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
    {
      const std::size_t pair = k * 4057 % 6561;
      this->Add(&directions[pair / 81].x, &directions[pair % 81].x, exposure);
    }
  }

  /// Pairs spread over half and difference angles, dense about the mirror direction, none of them
  /// beyond 80 degrees.
  void AddHalfVectorDirections(int count, double exposure)
  {
    using namespace measuredbrdf;
    for (unsigned int k = 1; this->GetNumberOfPhotographs() < count; ++k)
    {
      glm::dvec3 light, view;
      FromHalfDifference({ 0.5 * Pi * std::pow(RadicalInverse(k, 2), 2),
                           0.5 * Pi * RadicalInverse(k, 3), 2.0 * Pi * RadicalInverse(k, 5) },
        light, view);
      if (std::min(light.z, view.z) >= 0.1736)
      {
        const double turn = 2.0 * Pi * RadicalInverse(k, 7); // lights come from all sides
        const glm::dmat3 rotation(
          std::cos(turn), std::sin(turn), 0.0, -std::sin(turn), std::cos(turn), 0.0, 0.0, 0.0, 1.0);
        light = rotation * light;
        view = rotation * view;
        this->Add(&light.x, &view.x, exposure);
      }
    }
  }

  VTK_NEWINSTANCE vtkImageData* NewPicture(int index) override
  {
    const Photograph& photograph = this->Get(index);
    std::vector<glm::dvec3> values; // of a texel that is all of one material
    for (int k = 0; k < this->Map->GetNumberOfMaterials(); ++k)
    {
      values.emplace_back();
      this->Map->GetBRDF(k)->Evaluate(photograph.Light, photograph.View, &values.back().x);
    }
    this->SetTransfer(this->Bits > 0 ? LINEAR : AUTOMATIC);
    vtkImageData* picture = vtkImageData::New();
    picture->SetDimensions(this->Map->GetWeightImage(0)->GetDimensions());
    picture->AllocateScalars(this->Bits > 0 ? VTK_UNSIGNED_SHORT : VTK_FLOAT, 3);
    vtkDataArray* pixels = picture->GetPointData()->GetScalars();
    std::seed_seq sequence{ 1, index };
    std::mt19937 random(sequence);
    const auto number = [&random]() { return (random() + 0.5) * 0x1p-32; };
    const double levels = std::exp2(this->Bits) - 1.0;
    std::vector<std::pair<vtkDataArray*, int>> weights; // channels of the images, one after another
    for (int k = 0; k < this->Map->GetNumberOfWeightImages(); ++k)
    {
      vtkDataArray* array = this->Map->GetWeightImage(k)->GetPointData()->GetScalars();
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        weights.emplace_back(array, c);
      }
    }
    for (vtkIdType texel = 0; texel < picture->GetNumberOfPoints(); ++texel)
    {
      glm::dvec3 sum(0.0);
      double whole = 0.0; // of the weights, which a map divides by their sum
      for (std::size_t k = 0; k < values.size(); ++k)
      {
        const double weight = weights[k].first->GetComponent(texel, weights[k].second);
        sum += weight * values[k];
        whole += weight;
      }
      for (int c = 0; c < 3; ++c)
      {
        double value = whole > 0.0 ? this->GetScale(index) * sum[c] / whole : 0.0;
        if (this->Noise > 0.0) // Box and Muller 1958: the same numbers with every library
        {
          const double radius = std::sqrt(-2.0 * std::log(number()));
          value += this->Noise * radius * std::cos(2.0 * measuredbrdf::Pi * number());
        }
        pixels->SetComponent(texel, c,
          this->Bits > 0
            ? std::round(std::round(std::clamp(value, 0.0, 1.0) * levels) / levels * 65535.0)
            : value);
      }
    }
    return picture;
  }
};

#endif
