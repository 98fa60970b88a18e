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
#include <cstdio>
#include <string>
#include <vector>

namespace
{
constexpr int Side = 80; // pixels

// Seen from afar along z.
tool::Surface MakeSphere()
{
  tool::Surface surface;
  for (int k = 0; k < Side * Side; ++k)
  {
    const double x = 2.0 * (k % Side + 0.5) / Side - 1.0;
    const double y = 2.0 * (k / Side + 0.5) / Side - 1.0;
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

double GetError(const double* rgb, const double* exact, double least)
{
  double difference = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    difference += std::abs(rgb[c] - exact[c]);
  }
  return difference / std::max(exact[0] + exact[1] + exact[2], least);
}
}

//------------------------------------------------------------------------------
TEST(ReferencePicture, IsWithinItsToleranceMatteAndGlossy)
{
  const tool::Interruptible interruptible;
  const tool::Surface surface = MakeSphere();
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkBlinnPhongBRDF> matte; // which evaluates one light at a time
  matte->SetExponent(1.0);
  vtkNew<vtkLambertBRDF> ground;
  ground->SetAlbedo(0.02, 0.01, 0.03);
  vtkNew<vtkBlinnPhongBRDF> coat;
  coat->SetExponent(3000.0);
  vtkNew<vtkSumBRDF> glossy;
  glossy->AddTerm(ground);
  glossy->AddTerm(coat);
  for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(matte), static_cast<vtkBRDF*>(glossy) })
  {
    std::size_t shown = 0;
    const tool::ReferencePicture picture =
      tool::DrawReference(brdf, environment, surface, { Side, Side },
        [&](const std::vector<double>& radiance) { shown += radiance.empty() ? 0 : 1; });
    std::printf("%s: %.1f %% integrated, %.4f within, worst %.3f %%\n", brdf->GetClassName(),
      100.0 * picture.Integrated, picture.Within, 100.0 * picture.Worst);
    EXPECT_GE(picture.Within, 0.99);
    EXPECT_GE(shown, 4u);
    if (brdf == matte)
    {
      EXPECT_LT(picture.Integrated, 0.9); // what is smooth is interpolated
    }

    // Some that are not those of its own sample.
    std::vector<double> normals, views, got;
    for (std::size_t k = 1; k < surface.Pixels.size(); k += 23)
    {
      normals.insert(normals.end(), &surface.Normals[3 * k], &surface.Normals[3 * k] + 3);
      views.insert(views.end(), &surface.Views[3 * k], &surface.Views[3 * k] + 3);
      got.insert(got.end(), &picture.Radiance[3 * k], &picture.Radiance[3 * k] + 3);
    }
    vtkNew<vtkAdaptiveRadianceIntegrator> strict;
    strict->SetBRDF(brdf);
    strict->SetEnvironment(environment);
    strict->SetTolerance(2e-4);
    const std::vector<double> exact = tool::IntegratePairs(strict, normals, views);
    double sum = 0.0;
    for (const double value : exact)
    {
      sum += value;
    }
    const std::size_t count = exact.size() / 3;
    std::size_t off = 0;
    for (std::size_t k = 0; k < count; ++k)
    {
      const double error =
        GetError(&got[3 * k], &exact[3 * k], 0.02 * sum / static_cast<double>(count));
      off += error > tool::ReferencePicture::Tolerance ? 1 : 0;
      EXPECT_LT(error, 0.02);
    }
    // One percent of one sample may be more of another.
    EXPECT_LE(off, count / 25) << "of " << count;
  }
}

//------------------------------------------------------------------------------
// Materials that evaluate many lights at once are cheap: no pixel is interpolated.
TEST(ReferencePicture, IntegratesEveryPixelWherePixelsAreCheap)
{
  const tool::Interruptible interruptible;
  const tool::Surface surface = MakeSphere();
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkAshikhminShirleyBRDF> gloss;
  gloss->SetDiffuse(0.2, 0.1, 0.3);
  gloss->SetExponents(50.0, 50.0);
  vtkNew<vtkAdaptiveWarpBRDF> measured;
  ASSERT_EQ(measured->SetTables(MakeAnisotropicTables(gloss, { 16, 1, 1, 65 })), "");
  std::size_t shown = 0;
  const tool::ReferencePicture picture = tool::DrawReference(measured, environment, surface,
    { Side, Side }, [&](const std::vector<double>& radiance) { shown += radiance.size(); });
  EXPECT_EQ(picture.Integrated, 1.0);
  EXPECT_EQ(picture.Within, 1.0);
  EXPECT_EQ(shown, 3 * surface.Normals.size()); // of blocks in grids of 8, 4 and 2 pixels
  vtkNew<vtkAdaptiveRadianceIntegrator> each;
  each->SetBRDF(measured);
  each->SetEnvironment(environment);
  each->SetTolerance(2e-4);
  const std::vector<double> exact = tool::IntegratePairs(each, surface.Normals, surface.Views);
  double worst = 0.0;
  for (std::size_t k = 0; k < exact.size(); k += 3)
  {
    worst = std::max(worst, GetError(&picture.Radiance[k], &exact[k], 0.0));
  }
  EXPECT_LT(worst, tool::ReferencePicture::Tolerance);
}

//------------------------------------------------------------------------------
// A pixel's radiance does not depend on which others are asked for; pictures of odd sides.
TEST(PixelBlocks, AreAlwaysTheSame)
{
  const tool::Interruptible interruptible;
  const tool::Surface surface = MakeSphere();
  constexpr int width = 77; // the last column is half a block
  tool::Surface odd;
  std::vector<int> places(static_cast<std::size_t>(width * Side), -1);
  for (std::size_t k = 0; k < surface.Pixels.size(); ++k)
  {
    const int x = surface.Pixels[k] % Side;
    if (x < width)
    {
      const int place = surface.Pixels[k] / Side * width + x;
      places[static_cast<std::size_t>(place)] = static_cast<int>(odd.Pixels.size());
      odd.Pixels.push_back(place);
      odd.Normals.insert(odd.Normals.end(), &surface.Normals[3 * k], &surface.Normals[3 * k] + 3);
      odd.Views.insert(odd.Views.end(), &surface.Views[3 * k], &surface.Views[3 * k] + 3);
    }
  }
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkAshikhminShirleyBRDF> gloss;
  gloss->SetExponents(200.0, 200.0);
  vtkNew<vtkAdaptiveRadianceIntegrator> integrator;
  integrator->SetBRDF(gloss);
  integrator->SetEnvironment(environment);
  integrator->SetTolerance(0.003);
  const auto integrate = [&](const std::vector<int>& pixels)
  { return tool::IntegrateInBlocks(integrator, odd, width, places, pixels, [](double) {}); };
  std::vector<int> all, some;
  for (int k = 0; k < static_cast<int>(odd.Pixels.size()); ++k)
  {
    all.push_back(k);
    if (k % 17 == 3)
    {
      some.insert(some.begin(), k); // in another order
    }
  }
  const std::vector<double> whole = integrate(all);
  const std::vector<double> part = integrate(some);
  ASSERT_EQ(part.size(), 3 * some.size());
  for (std::size_t k = 0; k < some.size(); ++k)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      EXPECT_EQ(part[3 * k + c], whole[3 * static_cast<std::size_t>(some[k]) + c]);
    }
  }
  // And each is its own radiance, not a neighbor's.
  const std::vector<double> each = tool::IntegratePixels(integrator, odd, some, [](double) {});
  for (std::size_t k = 0; k < each.size(); ++k)
  {
    EXPECT_NEAR(part[k], each[k], 0.01 * each[k]);
  }
  EXPECT_EQ(tool::CountInBlocks(odd, width, { 0 }), 4u);
  EXPECT_LT(tool::CountInBlocks(odd, width, all), odd.Pixels.size() * 11 / 10);
  EXPECT_TRUE(integrate({}).empty());
}

//------------------------------------------------------------------------------
TEST(BlockTolerance, IsTheFinestAffordable)
{
  using tool::BlockTolerance;
  EXPECT_EQ(BlockTolerance::Choose(1000.0, 1e4), 0.0014);
  EXPECT_EQ(BlockTolerance::Choose(10500.0, 1e4), BlockTolerance::Coarsest);
  EXPECT_EQ(BlockTolerance::Choose(7800.0, 1e4), 0.002);
  EXPECT_EQ(BlockTolerance::Choose(15000.0, 1e4), BlockTolerance::Coarsest);
  EXPECT_EQ(BlockTolerance::Choose(17000.0, 1e4), 0.0);
  // Of a picture of four times as many pixels as usual.
  EXPECT_EQ(BlockTolerance::Choose(1900.0, 4.0 * BlockTolerance::UsualPixels), 0.002);
  EXPECT_EQ(BlockTolerance::Choose(5000.0, 4.0 * BlockTolerance::UsualPixels), 0.0);
}

//------------------------------------------------------------------------------
TEST(ReferenceSample, TellsErrors)
{
  tool::ReferenceSample sample;
  sample.Scatter(4, 100);
  EXPECT_EQ(sample.GetPixels().size(), 4u);
  for (const int pixel : sample.GetPixels())
  {
    EXPECT_TRUE(pixel >= 0 && pixel < 100) << pixel;
  }
  sample.SetExact({ 1, 2, 3, 1, 1, 1, 0, 0, 0, 2, 2, 2 }, 0.02); // a mean of 3.75
  double worst = 0.0;
  // 0.06 of 6, 0.006 of 3, 0.003 where 0.075 is the least, and none.
  EXPECT_EQ(sample.GetWithin({ 1, 2.06, 3, 1, 1, 1.006, 0.003, 0, 0, 2, 2, 2 }, 0.005, worst), 0.5);
  EXPECT_NEAR(worst, 0.04, 1e-12);
}

//------------------------------------------------------------------------------
TEST(ReferencePicture, TellsHowFarItIsAndStops)
{
  const tool::Surface surface = MakeSphere();
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkLambertBRDF> matte;
  std::atomic<bool> stop(false);
  std::vector<double> shares;
  const auto show = [&](const std::string& label, double share)
  {
    EXPECT_EQ(label, "integrating");
    shares.push_back(share);
  };
  const tool::BackgroundWork work(stop, show);
  const tool::ReferencePicture whole =
    tool::DrawReference(matte, environment, surface, { Side, Side });
  // One bar for all of its parts.
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GE(shares.size(), 10u);
  EXPECT_GT(shares.back(), 0.5);
  EXPECT_LE(shares.back(), 1.0);

  const auto stopAtOnce = [&](const std::string&, double share) { stop = share > 0.2; };
  const tool::BackgroundWork inner(stop, stopAtOnce);
  EXPECT_THROW(tool::DrawReference(matte, environment, surface, { Side, Side }), tool::Error);
}

//------------------------------------------------------------------------------
TEST(ReferencePicture, TakesEachPixelOfAGrid)
{
  const tool::Interruptible interruptible;
  tool::Surface some = MakeSphere();
  some.Stride = 8;
  some.Pixels.resize(20);
  some.Normals.resize(60);
  some.Views.resize(60);
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkLambertBRDF> matte;
  const tool::ReferencePicture picture =
    tool::DrawReference(matte, environment, some, { Side, Side });
  vtkNew<vtkAdaptiveRadianceIntegrator> each;
  each->SetBRDF(matte);
  each->SetEnvironment(environment);
  EXPECT_EQ(picture.Radiance, tool::IntegratePairs(each, some.Normals, some.Views));
  EXPECT_EQ(picture.Integrated, 1.0);
}

//------------------------------------------------------------------------------
TEST(ReferenceLimit, IsProportionalToTime)
{
  const tool::Interruptible interruptible;
  const tool::Surface surface = MakeSphere();
  const auto count = static_cast<int>(surface.Pixels.size());
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkLambertBRDF> matte;
  const double seconds = tool::EstimateReferenceSeconds(matte, environment, surface);
  EXPECT_GT(seconds, 0.01); // 2 us to 10 ms a pixel
  EXPECT_LT(seconds, 50.0);
  EXPECT_EQ(tool::LimitReference(matte, environment, surface, 1e4, "limit"), count);
  const int few = tool::LimitReference(matte, environment, surface, 0.1 * seconds, "limit");
  EXPECT_GT(few, count / 100); // the machine may be ten times as fast or as slow meanwhile
  EXPECT_LE(few, count);
  EXPECT_EQ(tool::LimitReference(matte, environment, surface, 1e-9, "limit"), 1);
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
