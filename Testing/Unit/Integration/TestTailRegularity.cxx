// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Which materials' lights may be shared by a window and a table.
#include "FilledTable.h"
#include "TailRegularity.h"
#include "vtkBRDFReader.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTabulatedBRDF.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>

using namespace measuredbrdf;

namespace
{
// A lobe of a cosine power of 20 over a diffuse base, cell by cell, then changed.
vtkSmartPointer<vtkTabulatedBRDF> NewTable(
  int range, const std::function<double(std::size_t, double)>& change)
{
  return tool::stability::FillTable({ 12, 24, 32 }, range,
    [&](std::size_t cell, const double* i, const double* o)
    {
      double value = 0.1;
      if (i)
      {
        const double h = std::hypot(i[0] + o[0], i[1] + o[1], i[2] + o[2]);
        value += std::pow((i[2] + o[2]) / h, 20.0);
      }
      value = change(cell, value);
      return std::array<double, 3>{ value, value, value };
    });
}
}

TEST(TailRegularity, OfMaterials)
{
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    const auto brdf = vtk::TakeSmartPointer(vtkEmbeddedMaterials::NewBRDF(name));
    const double irregularity = GetTailIrregularity(brdf);
    std::printf("%s: %.3f\n", name.c_str(), irregularity);
    if (brdf->IsIsotropic())
    {
      EXPECT_TRUE(vtkHybridRadianceIntegrator::AreWindowed(brdf, 8)) << name;
      EXPECT_FALSE(vtkHybridRadianceIntegrator::AreWindowed(brdf, 1)) << name;
    }
  }
  EXPECT_FALSE(vtkHybridRadianceIntegrator::AreWindowed(nullptr, 8));
}

TEST(TailRegularity, OfMeasuredMaterials)
{
  const std::string folder = std::string(MEASUREDBRDF_SHARED_DATA) + "/materials/";
  if (!std::ifstream(folder + "rgl/satin_purple_rgb.bsdf").good())
  {
    GTEST_SKIP() << "no measured data at " << folder;
  }
  for (const std::string name : { "rgl/acrylic_felt_white_rgb.bsdf", "rgl/satin_purple_rgb.bsdf",
         "rgl/vch_ultra_pink_rgb.bsdf", "rgl/irid_flake_paint2_rgb.bsdf",
         "rgl/chm_light_blue_rgb.bsdf", "rgl/cc_ibiza_sunset_rgb.bsdf" })
  {
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(folder + name);
    ASSERT_TRUE(reader->Read()) << name;
    const double irregularity = GetTailIrregularity(reader->GetBRDF());
    std::printf("%s: %.3f\n", name.c_str(), irregularity);
    EXPECT_LT(irregularity, 0.1) << name;
  }
}

TEST(TailRegularity, OfOddTables)
{
  const auto same = [](std::size_t, double value) { return value; };
  const auto oneSide = [](std::size_t cell, double value)
  { return value * (cell % 12 < 6 ? 1.6 : 0.4); };
  const auto noise = [](std::size_t cell, double value)
  { return value - (cell * 2654435761u % 1000 < 200 ? 0.3 : 0.0); };
  const double smooth = GetTailIrregularity(NewTable(vtkTabulatedBRDF::HALF_TURN, same));
  const double asymmetric = GetTailIrregularity(NewTable(vtkTabulatedBRDF::FULL_TURN, oneSide));
  const double noisy = GetTailIrregularity(NewTable(vtkTabulatedBRDF::HALF_TURN, noise));
  std::printf("smooth %.3f, asymmetric %.3f, noisy %.3f\n", smooth, asymmetric, noisy);
  EXPECT_LT(smooth, 0.05);
  EXPECT_GT(asymmetric, 0.12);
  EXPECT_GT(noisy, 0.12);
}
