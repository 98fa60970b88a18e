// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The weighted sum of materials as a material of its own: what a material map has to show.
 */

#ifndef MixtureBRDF_h
#define MixtureBRDF_h

#include "vtkBRDF.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"

#include <utility>
#include <vector>

class MixtureBRDF : public vtkBRDF
{
public:
  static MixtureBRDF* New();
  vtkTypeMacro(MixtureBRDF, vtkBRDF);

  void Add(vtkBRDF* brdf, double weight)
  {
    this->Terms.emplace_back(brdf, weight);
    this->Modified();
  }

  void GetBounds(double minimumCosine, double lower[3], double upper[3]) override
  {
    for (int c = 0; c < 3; ++c)
    {
      lower[c] = upper[c] = 0.0;
    }
    for (const auto& [brdf, weight] : this->Terms)
    {
      double low[3];
      double high[3];
      brdf->GetBounds(minimumCosine, low, high);
      for (int c = 0; c < 3; ++c)
      {
        lower[c] += weight * low[c];
        upper[c] += weight * high[c];
      }
    }
  }
  void Prepare() override
  {
    for (const auto& term : this->Terms)
    {
      term.first->Prepare();
    }
  }
  void GetShaderInputs(vtkBRDFShaderInputs&) override {} // never drawn

protected:
  MixtureBRDF() = default;
  ~MixtureBRDF() override = default;

  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    f[0] = f[1] = f[2] = 0.0;
    for (const auto& [brdf, weight] : this->Terms)
    {
      double value[3];
      brdf->Evaluate(i, o, value);
      for (int c = 0; c < 3; ++c)
      {
        f[c] += weight * value[c];
      }
    }
  }

private:
  MixtureBRDF(const MixtureBRDF&) = delete;
  void operator=(const MixtureBRDF&) = delete;

  std::vector<std::pair<vtkSmartPointer<vtkBRDF>, double>> Terms;
};

vtkStandardNewMacro(MixtureBRDF);

#endif
