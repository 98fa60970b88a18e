// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material under an environment, and what a thousand pairs of a sphere seen from everywhere
 * reflect, for benchmarks that tell errors.
 */

#ifndef BenchmarkCase_h
#define BenchmarkCase_h

#include "EverywherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDFReader.h"
#include "vtkDoubleArray.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <filesystem>
#include <string>

struct BenchmarkCase
{
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkDoubleArray> Normals, Views, Reference;

  BenchmarkCase(const std::string& material, const std::string& light)
    : BenchmarkCase(FindBRDF(material), light)
  {
  }

  BenchmarkCase(vtkBRDF* brdf, const std::string& light)
    : BRDF(brdf)
  {
    this->Environment = FindEnvironment(light);
    if (this->BRDF && this->Environment)
    {
      AddEverywherePairs(1000, this->Normals, this->Views);
      vtkNew<vtkAdaptiveRadianceIntegrator> reference;
      reference->SetBRDF(this->BRDF);
      reference->SetEnvironment(this->Environment);
      reference->Integrate(this->Normals, this->Views, this->Reference);
    }
  }

  // The name of an embedded one, or a file: its path, or its name in the data folder.
  static vtkSmartPointer<vtkEnvironment> FindEnvironment(const std::string& light)
  {
    if (light.find('.') == std::string::npos)
    {
      return vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment(light));
    }
    vtkNew<vtkEnvironmentReader> map;
    map->SetFileName(FindFile("environments", light));
    map->GlobalWarningDisplayOff();
    return map->Read() ? map->GetEnvironment() : nullptr;
  }

  static vtkSmartPointer<vtkBRDF> FindBRDF(const std::string& name)
  {
    if (name.find('.') == std::string::npos)
    {
      return vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    }
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(FindFile("materials", name));
    reader->GlobalWarningDisplayOff();
    return reader->Read() ? reader->GetBRDF() : nullptr;
  }

  static std::string FindFile(const std::string& kind, const std::string& name)
  {
    const std::string inData = std::string(MEASUREDBRDF_SHARED_DATA "/") + kind + "/" + name;
    return std::filesystem::exists(inData) ? inData : name;
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
