// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material under an environment, and what a thousand pairs of a sphere seen from everywhere
 * reflect, for benchmarks that tell errors.
 */

#ifndef BenchmarkCase_h
#define BenchmarkCase_h

#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDFReader.h"
#include "vtkDoubleArray.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <string>

struct BenchmarkCase
{
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkDoubleArray> Normals, Views, Reference;

  // Files of the data folder, or embedded ones.
  BenchmarkCase(const std::string& material, const std::string& light)
    : BenchmarkCase(FindBRDF(material), light)
  {
  }

  BenchmarkCase(vtkBRDF* brdf, const std::string& light)
    : BRDF(brdf)
  {
    const std::string folder = MEASUREDBRDF_SHARED_DATA;
    vtkNew<vtkEnvironmentReader> map;
    map->SetFileName(folder + "/environments/" + light);
    map->GlobalWarningDisplayOff();
    if (light.find('.') == std::string::npos)
    {
      this->Environment =
        vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment(light));
    }
    else if (map->Read())
    {
      this->Environment = map->GetEnvironment();
    }
    if (this->BRDF && this->Environment)
    {
      this->SetPairs(1000);
      vtkNew<vtkAdaptiveRadianceIntegrator> reference;
      reference->SetBRDF(this->BRDF);
      reference->SetEnvironment(this->Environment);
      reference->Integrate(this->Normals, this->Views, this->Reference);
    }
  }

  static vtkSmartPointer<vtkBRDF> FindBRDF(const std::string& name)
  {
    if (name.find('.') == std::string::npos)
    {
      return vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    }
    const std::string folder = MEASUREDBRDF_SHARED_DATA;
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(folder + "/materials/" + name);
    reader->GlobalWarningDisplayOff();
    return reader->Read() ? reader->GetBRDF() : nullptr;
  }

  // Views over the sphere of directions, and for each a point of the disc that it shows:
  // sunflowers.
  void SetPairs(int pairs)
  {
    this->Normals->SetNumberOfComponents(3);
    this->Views->SetNumberOfComponents(3);
    for (int k = 0; k < pairs; ++k)
    {
      const double y = 1.0 - (2.0 * k + 1.0) / pairs;
      const double s = std::sqrt(1.0 - y * y);
      const double around = 2.399963229728653 * k;
      const double view[3] = { s * std::cos(around), y, s * std::sin(around) };
      double u[3], v[3];
      vtkMath::Perpendiculars(view, u, v, 0.0);
      const double r = std::sqrt(std::fmod((k + 0.5) * 0.6180339887498949, 1.0));
      const double phi = 2.0 * vtkMath::Pi() * std::fmod(k * 0.7548776662466927, 1.0);
      double normal[3];
      for (int c = 0; c < 3; ++c)
      {
        normal[c] =
          r * std::cos(phi) * u[c] + r * std::sin(phi) * v[c] + std::sqrt(1.0 - r * r) * view[c];
      }
      this->Normals->InsertNextTuple(normal);
      this->Views->InsertNextTuple(view);
    }
  }

  // Relative L1.
  double GetError(vtkDoubleArray* radiance) const
  {
    double difference = 0.0;
    double sum = 0.0;
    for (vtkIdType k = 0; k < radiance->GetNumberOfValues(); ++k)
    {
      difference += std::abs(radiance->GetValue(k) - this->Reference->GetValue(k));
      sum += this->Reference->GetValue(k);
    }
    return difference / sum;
  }
};

#endif
