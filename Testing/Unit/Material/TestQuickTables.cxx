// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Half/difference tables cell by cell, and coarse ones that stand in for them.

#include "AnisotropicWarp.h"
#include "HalfVector.h"
#include "TestBasisHelpers.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using measuredbrdf::Pi;

namespace
{
vtkSmartPointer<vtkAdaptiveWarpBRDF> MakeIsotropicWarp()
{
  vtkNew<vtkAshikhminShirleyBRDF> gloss;
  gloss->SetReflectance(0.3, 0.2, 0.1);
  gloss->SetDiffuse(0.1, 0.2, 0.3);
  gloss->SetExponents(80.0, 80.0);
  auto warp = vtkSmartPointer<vtkAdaptiveWarpBRDF>::New();
  EXPECT_EQ(warp->SetTables(MakeAnisotropicTables(gloss, { 16, 1, 1, 65 })), "");
  EXPECT_TRUE(warp->IsIsotropic());
  return warp;
}
}

// Whether or not half of them could be left out: f cos(theta_o) at each cell's center, or, beyond
// the horizon, at the last theta_d before it.
TEST(HalfDifferenceFill, EachCellHoldsItsOwnValue)
{
  for (const double side : { 0.0, 0.5 }) // 0.5: more towards one side of the plane of incidence
  {
    vtkNew<testbasis::FunctionBRDF> brdf;
    brdf->Function = [side](const glm::dvec3& i, const glm::dvec3& o)
    { return glm::dvec3(1.0 + side * (i.x * o.y - i.y * o.x), 0.5 + 0.3 * i.z, o.z); };
    vtkNew<vtkBRDFResampler> resampler;
    resampler->SetInput(brdf);
    const int size[3] = { 7, 9, 12 }; // odd ones, too
    ASSERT_TRUE(resampler->ResampleTo(size[0], size[1], size[2]));
    const std::vector<float>& values = resampler->GetOutput()->GetVolume();
    int below = 0;
    for (std::size_t k = 0; k < values.size() / 3; ++k)
    {
      const int x = static_cast<int>(k) % size[0];
      const int y = static_cast<int>(k) / size[0] % size[1];
      const int z = static_cast<int>(k) / (size[0] * size[1]);
      measuredbrdf::HalfDifference angles{ measuredbrdf::UnitToThetaH((z + 0.5) / size[2]),
        0.5 * Pi * (y + 0.5) / size[1], 2.0 * Pi * (x + 0.5) / size[0] };
      const double horizon = measuredbrdf::FindHorizon(angles);
      below += angles.ThetaD > horizon ? 1 : 0;
      angles.ThetaD = std::min(angles.ThetaD, horizon * (1.0 - 1e-4));
      glm::dvec3 i, o, f;
      measuredbrdf::FromHalfDifference(angles, i, o);
      brdf->Evaluate(&i.x, &o.x, &f.x);
      for (std::size_t c = 0; c < 3; ++c)
      {
        ASSERT_NEAR(values[3 * k + c], f[static_cast<int>(c)] * o.z, 1e-6)
          << side << ": " << x << " " << y << " " << z;
      }
    }
    EXPECT_GT(below, 100);
  }
}

TEST(QuickTables, StandInUntilTheRealOneIsMade)
{
  const auto warp = MakeIsotropicWarp();
  const auto quick = vtkSmartPointer<vtkBRDF>::Take(warp->NewQuickRenderable());
  auto* table = vtkTabulatedBRDF::SafeDownCast(quick);
  ASSERT_TRUE(table);
  EXPECT_LT(table->GetVolume().size(), 3u * 40000u);
  const double error = vtkBRDFResampler::GetLogCosineDistance(warp, table, 1 << 14);
  EXPECT_LT(error, 0.03);
  vtkBRDF* real = warp->GetRenderable();
  EXPECT_NE(real, quick);
  EXPECT_LT(vtkBRDFResampler::GetLogCosineDistance(warp, real, 1 << 14), 0.7 * error);
  EXPECT_EQ(vtkSmartPointer<vtkBRDF>::Take(warp->NewQuickRenderable()), real);
  warp->SetResamplingTolerance(0.1); // another one is wanted now
  EXPECT_NE(vtkSmartPointer<vtkBRDF>::Take(warp->NewQuickRenderable()), real);
}

TEST(QuickTables, OfAnisotropicMaterialsAndSums)
{
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(5.0, 20.0);
  EXPECT_EQ(vtkSmartPointer<vtkBRDF>::Take(brushed->NewQuickRenderable()), brushed.Get());
  vtkNew<vtkAdaptiveWarpBRDF> warp;
  ASSERT_EQ(warp->SetTables(MakeAnisotropicTables(brushed, AnisotropicWarpSizes())), "");
  const auto quick = vtkSmartPointer<vtkBRDF>::Take(warp->NewQuickRenderable());
  EXPECT_TRUE(vtkTabulatedBRDF::SafeDownCast(quick));
  const double error = vtkBRDFResampler::GetLogCosineDistance(warp, quick, 1 << 12);
  EXPECT_LT(error, 0.05);

  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(brushed);
  EXPECT_EQ(vtkSmartPointer<vtkBRDF>::Take(sum->NewQuickRenderable()), sum.Get());
  sum->AddTerm(warp);
  const auto parts = vtkSmartPointer<vtkBRDF>::Take(sum->NewQuickRenderable());
  auto* made = vtkSumBRDF::SafeDownCast(parts);
  ASSERT_TRUE(made);
  ASSERT_EQ(made->GetNumberOfTerms(), 2);
  EXPECT_EQ(made->GetTerm(0), brushed.Get());
  EXPECT_TRUE(vtkTabulatedBRDF::SafeDownCast(made->GetTerm(1)));
}
