// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The exact picture of a sphere against one that is integrated to a tenth of its tolerance.

#include "AnisotropicWarp.h"
#include "Methods.h"
#include "Progress.h"
#include "ReferencePicture.h"
#include "Tool.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSumBRDF.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

namespace
{
constexpr int Width = 53; // the last column is half a block
constexpr int Height = 54;

// Of a sphere seen from afar along z: some pixels are missing on the right.
tool::Surface MakeSphere()
{
  tool::Surface surface;
  for (int k = 0; k < Width * Height; ++k)
  {
    const double x = 2.0 * (k % Width + 0.5) / Height - 1.0;
    const double y = 2.0 * (k / Width + 0.5) / Height - 1.0;
    const double z = std::sqrt(std::max(1.0 - x * x - y * y, 0.0));
    if (z > 0.05)
    {
      surface.Pixels.push_back(k);
      surface.Normals.insert(surface.Normals.end(), { x, y, z });
      surface.Views.insert(surface.Views.end(), { 0.0, 0.0, 1.0 });
    }
  }
  return surface;
}

struct ReferencePicture : testing::Test
{
  ReferencePicture()
    : Surface(MakeSphere())
  {
    this->Environment->SetToProceduralSky();
  }

  // Of every so many pixels, some of which are in no sample of the picture's own.
  void ExpectWithinTolerance(
    vtkBRDF* brdf, const std::vector<double>& radiance, std::size_t step, double largest)
  {
    std::vector<double> normals, views, got;
    const auto add = [](std::vector<double>& to, const std::vector<double>& from, std::size_t k)
    { to.insert(to.end(), &from[3 * k], &from[3 * k] + 3); };
    for (std::size_t k = 1; k < this->Surface.Pixels.size(); k += step)
    {
      add(normals, this->Surface.Normals, k);
      add(views, this->Surface.Views, k);
      add(got, radiance, k);
    }
    vtkNew<vtkAdaptiveRadianceIntegrator> strict;
    strict->SetBRDF(brdf);
    strict->SetEnvironment(this->Environment);
    strict->SetTolerance(2e-4);
    const std::vector<double> exact = tool::IntegratePairs(strict, normals, views);
    const std::size_t count = exact.size() / 3;
    const double least = 0.02 * std::accumulate(exact.begin(), exact.end(), 0.0) / count;
    std::size_t off = 0;
    for (std::size_t k = 0; k < exact.size(); k += 3)
    {
      double difference = 0.0;
      for (std::size_t c = k; c < k + 3; ++c)
      {
        difference += std::abs(got[c] - exact[c]);
      }
      const double error = difference / std::max(exact[k] + exact[k + 1] + exact[k + 2], least);
      off += error > tool::ReferencePicture::Tolerance ? 1 : 0;
      EXPECT_LT(error, largest);
    }
    // One percent of one sample may be more of another.
    EXPECT_LE(off, count / 25) << "of " << count;
  }

  tool::Surface Surface;
  vtkNew<vtkEnvironment> Environment;
};
}

//------------------------------------------------------------------------------
TEST_F(ReferencePicture, IsWithinItsTolerance)
{
  const tool::Interruptible interruptible;
  vtkNew<vtkBlinnPhongBRDF> matte; // which evaluates one light at a time
  matte->SetExponent(1.0);
  vtkNew<vtkLambertBRDF> ground;
  ground->SetAlbedo(0.02, 0.01, 0.03);
  vtkNew<vtkBlinnPhongBRDF> coat;
  coat->SetExponent(3000.0);
  vtkNew<vtkSumBRDF> glossy;
  glossy->AddTerm(ground);
  glossy->AddTerm(coat);
  vtkNew<vtkAshikhminShirleyBRDF> brushed; // whose pixels are turned, each by itself
  brushed->SetExponents(10.0, 40.0);
  for (vtkBRDF* brdf : std::initializer_list<vtkBRDF*>{ matte, glossy, brushed })
  {
    std::vector<std::vector<double>> shown;
    const tool::ReferencePicture picture =
      tool::DrawReference(brdf, this->Environment, this->Surface, { Width, Height },
        [&](const std::vector<double>& radiance) { shown.push_back(radiance); });
    EXPECT_GE(picture.Within, 0.99);
    ASSERT_EQ(shown.size(), 3u); // of blocks in grids of 8, 4 and 2 pixels
    EXPECT_EQ(shown[2], picture.Radiance);
    // No pixel is black where the mesh is, but at the rim of the coarse grid.
    EXPECT_LT(std::count(shown[0].begin(), shown[0].end(), 0.0), shown[0].size() / 10);
    this->ExpectWithinTolerance(brdf, picture.Radiance, 23, 0.02);
  }
}

//------------------------------------------------------------------------------
// Of a material that evaluates many lights at once, each pixel.
TEST_F(ReferencePicture, IsExactOfMeasuredMaterials)
{
  const tool::Interruptible interruptible;
  vtkNew<vtkAshikhminShirleyBRDF> gloss;
  gloss->SetDiffuse(0.2, 0.1, 0.3);
  gloss->SetExponents(50.0, 50.0);
  vtkNew<vtkAdaptiveWarpBRDF> measured;
  ASSERT_EQ(measured->SetTables(MakeAnisotropicTables(gloss, { 16, 1, 1, 65 })), "");
  const tool::ReferencePicture picture =
    tool::DrawReference(measured, this->Environment, this->Surface, { Width, Height });
  EXPECT_EQ(picture.Within, 1.0);
  this->ExpectWithinTolerance(measured, picture.Radiance, 1, tool::ReferencePicture::Tolerance);
}

//------------------------------------------------------------------------------
TEST_F(ReferencePicture, TellsHowFarItIsAndStops)
{
  vtkNew<vtkLambertBRDF> matte;
  std::atomic<bool> stop(false);
  std::vector<double> shares;
  const auto show = [&](const std::string& label, double share)
  {
    EXPECT_EQ(label, "integrating");
    shares.push_back(share);
  };
  const tool::BackgroundWork work(stop, show);
  tool::DrawReference(matte, this->Environment, this->Surface, { Width, Height });
  // One bar for all of its parts.
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GE(shares.size(), 10u);
  EXPECT_GT(shares.back(), 0.5);
  EXPECT_LE(shares.back(), 1.0);

  const auto stopAtOnce = [&](const std::string&, double share) { stop = share > 0.2; };
  const tool::BackgroundWork inner(stop, stopAtOnce);
  EXPECT_THROW(
    tool::DrawReference(matte, this->Environment, this->Surface, { Width, Height }), tool::Error);
}

//------------------------------------------------------------------------------
TEST_F(ReferencePicture, TakesEachPixelOfAGrid)
{
  const tool::Interruptible interruptible;
  tool::Surface some = this->Surface;
  some.Stride = 8;
  some.Pixels.resize(20);
  some.Normals.resize(60);
  some.Views.resize(60);
  vtkNew<vtkLambertBRDF> matte;
  vtkNew<vtkAdaptiveRadianceIntegrator> each;
  each->SetBRDF(matte);
  each->SetEnvironment(this->Environment);
  EXPECT_EQ(tool::DrawReference(matte, this->Environment, some, { Width, Height }).Radiance,
    tool::IntegratePairs(each, some.Normals, some.Views));
}

namespace
{
vtkSmartPointer<vtkSumBRDF> MakeGlossy(double exponent)
{
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(0.1, 0.1, 0.1);
  vtkNew<vtkBlinnPhongBRDF> phong;
  phong->SetExponent(exponent);
  auto sum = vtkSmartPointer<vtkSumBRDF>::New();
  sum->AddTerm(lambert);
  sum->AddTerm(phong);
  return sum;
}
}

//------------------------------------------------------------------------------
// Residuals of zonal order 6 on 9 to 57 degrees grow with the exponent; measured once: 0.021,
// 0.063, 0.19, 0.41 for n = 5, 20, 100, 300.
TEST(RepresentationAdvisor, BroadLobesGoIntoABasisAndSharpOnesDoNot)
{
  tool::Interruptible interruptible;
  double before = 0.0;
  for (const double exponent : { 5.0, 20.0, 100.0, 300.0 })
  {
    const tool::Advice advice = tool::Advise(MakeGlossy(exponent), 6);
    EXPECT_GT(advice.InZoneResidual, before) << exponent;
    before = advice.InZoneResidual;
    EXPECT_EQ(advice.IsBasis, exponent < 50.0) << advice.Reason;
    EXPECT_NE(advice.Reason.find("residual"), std::string::npos);
    EXPECT_GE(advice.NegativeMass, 0.0);
  }
  EXPECT_GT(before, 0.3);
  // Shares stay shares where probes miss the lobe altogether.
  vtkNew<vtkBlinnPhongBRDF> mirror;
  mirror->SetExponent(1e5);
  const tool::Advice sharpest = tool::Advise(mirror, 6);
  EXPECT_FALSE(sharpest.IsBasis);
  EXPECT_GT(sharpest.NegativeMass, 0.1);
  EXPECT_LE(sharpest.NegativeMass, 1.0);
  const tool::Advice exact = tool::Advise(vtkNew<vtkLambertBRDF>(), 2);
  EXPECT_TRUE(exact.IsBasis);
  EXPECT_LT(exact.InZoneResidual, 1e-3);
  EXPECT_EQ(exact.NegativeMass, 0.0);
}

//------------------------------------------------------------------------------
TEST(RepresentationAdvisor, RepresentsInABasisOrAsADBRDF)
{
  tool::Interruptible interruptible;
  tool::Material material;
  material.BRDF = MakeGlossy(10.0);
  const tool::Representation basis = tool::Represent(material, 6);
  EXPECT_EQ(basis.Kind, "basis");
  EXPECT_LT(vtkBRDFResampler::GetRelativeL2Error(material.BRDF, basis.BRDF, 1 << 14), 0.2);
  material.BRDF = MakeGlossy(300.0);
  const tool::Representation fit = tool::Represent(material, 6);
  EXPECT_EQ(fit.Kind, "fit");
  EXPECT_LT(vtkBRDFResampler::GetRelativeL2Error(material.BRDF, fit.BRDF, 1 << 14), 0.2);
  material.BRDF = basis.BRDF; // what is in a basis stays
  EXPECT_EQ(tool::Represent(material, 6).BRDF, basis.BRDF);
}
