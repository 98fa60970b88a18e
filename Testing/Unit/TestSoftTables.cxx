// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Soft light on tables: levels of a half/difference volume against the closed forms they were
// tabulated from.

#include "HalfVector.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFGPUForm.h"
#include "vtkBRDFResampler.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTabulatedBRDF.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <vector>

using measuredbrdf::Pi;

namespace
{
vtkSmartPointer<vtkTabulatedBRDF> Tabulate(
  vtkBRDF* brdf, bool reciprocal, int nPhiD, int nThetaD, int nThetaH)
{
  vtkNew<vtkBRDFResampler> resampler;
  resampler->SetInput(brdf);
  resampler->SetReciprocal(reciprocal);
  EXPECT_TRUE(resampler->ResampleTo(nPhiD, nThetaD, nThetaH));
  return resampler->GetOutput();
}

// Calls visit(i, weight) for directions i above the horizon, dense about the mirror direction of o;
// weights: cos(theta_i) times i's solid angle.
template <typename Visitor>
void VisitLights(const double o[3], Visitor visit)
{
  const glm::dvec3 view = glm::make_vec3(o);
  constexpr int nTheta = 120;
  constexpr int nPhi = 32;
  for (int k = 0; k < nTheta; ++k)
  {
    const double u = (k + 0.5) / nTheta;
    const double theta = measuredbrdf::UnitToThetaH(u);
    for (int m = 0; m < nPhi; ++m)
    {
      const double phi = 2.0 * Pi * (m + 0.5) / nPhi;
      const glm::dvec3 h(
        std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      const double c = glm::dot(h, view);
      const glm::dvec3 i = measuredbrdf::ReflectAbout(view, h);
      if (c > 0.0 && i.z > 0.0)
      {
        const double ring = std::sin(theta) * Pi * u / nTheta * 2.0 * Pi / nPhi;
        visit(glm::value_ptr(i), i.z * 4.0 * c * ring);
      }
    }
  }
}

std::vector<double> GetView(double degrees)
{
  const double theta = degrees * Pi / 180.0;
  return { std::sin(theta), 0.0, std::cos(theta) };
}

// Relative L2 distance of soft f over lights and views.
double GetDistance(vtkBRDF* a, vtkBRDF* b, double spread, double viewDegrees)
{
  double differences = 0.0;
  double squares = 0.0;
  const std::vector<double> o = GetView(viewDegrees);
  VisitLights(o.data(),
    [&](const double i[3], double weight)
    {
      double f[3], g[3];
      a->EvaluateSoft(i, o.data(), spread, f);
      b->EvaluateSoft(i, o.data(), spread, g);
      differences += weight * (f[1] - g[1]) * (f[1] - g[1]);
      squares += weight * f[1] * f[1];
    });
  return std::sqrt(differences / squares);
}

double GetAlbedo(vtkBRDF* brdf, double spread, double viewDegrees)
{
  double albedo = 0.0;
  const std::vector<double> o = GetView(viewDegrees);
  VisitLights(o.data(),
    [&](const double i[3], double weight)
    {
      double f[3];
      brdf->EvaluateSoft(i, o.data(), spread, f);
      albedo += weight * f[1];
    });
  return albedo;
}
}

TEST(SoftTables, Explore)
{
  std::vector<vtkSmartPointer<vtkBRDF>> lobes;
  for (double n : { 20.0, 200.0, 2000.0 })
  {
    auto phong = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
    phong->SetExponent(n);
    lobes.push_back(phong);
    auto shirley = vtkSmartPointer<vtkAshikhminShirleyBRDF>::New();
    shirley->SetExponents(n, n);
    shirley->SetReflectance(0.5, 0.5, 0.5);
    shirley->SetDiffuse(0.2, 0.2, 0.2);
    lobes.push_back(shirley);
  }
  for (vtkBRDF* lobe : lobes)
  {
    for (bool reciprocal : { true, false })
    {
      auto table = Tabulate(lobe, reciprocal, 60, 90, 90);
      const auto start = std::chrono::steady_clock::now();
      vtkBRDFGPUForm form;
      form.SoftLights = true;
      table->GetGPUForm(form);
      std::cout << lobe->GetClassName() << " reciprocal " << reciprocal << ": " << form.Description
                << " "
                << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()
                << " s\n";
      for (double view : { 10.0, 50.0, 75.0 })
      {
        std::cout << "  view " << view << ":";
        for (double kappa : { 0.0, 1e5, 3e3, 1e3, 300.0, 100.0, 30.0, 10.0, 3.0 })
        {
          const double spread = kappa > 0.0 ? 1.0 / kappa : 0.0;
          std::cout << "  " << kappa << ": " << 100 * GetDistance(lobe, table, spread, view) << " %, "
                    << 100 * (GetAlbedo(lobe, spread, view) / GetAlbedo(lobe, 0.0, view) - 1.0)
                    << " "
                    << 100 * (GetAlbedo(table, spread, view) / GetAlbedo(table, 0.0, view) - 1.0)
                    << ";";
        }
        std::cout << "\n";
      }
    }
  }
}
