// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkBRDFAcquisition against vtkBasisProjector's inner products; its noise, rounding, refusals.
#include "ErrorCatcher.h"
#include "ExpectStops.h"
#include "TestBasisHelpers.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFAcquisition.h"
#include "vtkBasisProjector.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <iostream>
#include <limits>
#include <sstream>

using namespace testbasis;

namespace
{

vtkSmartPointer<vtkBRDFAcquisition> MakeAcquisition(vtkBRDF* input, int order = 3)
{
  auto acquisition = vtkSmartPointer<vtkBRDFAcquisition>::New();
  acquisition->SetInput(input);
  acquisition->SetOrder(order);
  acquisition->SetNumberOfTheta(8);
  acquisition->SetNumberOfPhi(16);
  return acquisition;
}

vtkSmartPointer<vtkBlinnPhongBRDF> MakeColoredPhong(double exponent)
{
  auto phong = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
  phong->SetSpecular(0.5, 0.2, 0.1);
  phong->SetExponent(exponent);
  return phong;
}

vtkSmartPointer<vtkBasisBRDF> Acquire(vtkBRDFAcquisition* acquisition)
{
  EXPECT_TRUE(acquisition->Acquire());
  return acquisition->GetOutput();
}

/// Root mean square of the difference of two stacks of coefficients.
double GetDistance(vtkBasisBRDF* a, vtkBasisBRDF* b)
{
  EXPECT_EQ(a->GetCoefficients().size(), b->GetCoefficients().size());
  double sum = 0.0;
  for (std::size_t k = 0; k < a->GetCoefficients().size(); ++k)
  {
    const double d = a->GetCoefficients()[k] - b->GetCoefficients()[k];
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(a->GetCoefficients().size()));
}
}

//------------------------------------------------------------------------------
TEST(Acquisition, IsTheInnerProduct)
{
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(8.0, 40.0);
  const auto phong = MakeColoredPhong(20.0);
  for (vtkBRDF* material : { static_cast<vtkBRDF*>(phong), static_cast<vtkBRDF*>(brushed) })
  {
    for (const int basis : { 1, 2, 3 })
    {
      const auto acquisition = MakeAcquisition(material, 6);
      acquisition->SetBasis(basis);
      const auto stack = Acquire(acquisition);
      vtkNew<vtkBasisProjector> projector;
      projector->SetInput(material);
      projector->SetBasis(basis);
      projector->SetOrder(6);
      projector->SetIncidentZone(9.0, 57.0);
      const double end = basis == 1 ? 90.0 : 57.0;
      projector->SetOutgoingZone(basis == 1 ? 0.0 : 9.0, end);
      projector->SetMethod(vtkBasisProjector::INNER_PRODUCT);
      projector->IncidentCosineOn();
      projector->OutgoingCosineOff();
      projector->SetNumberOfTheta(8);
      projector->SetNumberOfPhi(16);
      ASSERT_TRUE(projector->Project());
      vtkBasisBRDF* expected = projector->GetOutput();
      double largest = 0.0, difference = 0.0;
      const int nPhi = expected->GetNumberOfPhi();
      for (std::size_t k = 0; k < expected->GetCoefficients().size(); ++k)
      {
        if (basis == 1 && k / 3 / static_cast<std::size_t>(nPhi) % 8 == 7)
        {
          continue; // at 90 degrees lobes are sharper than any of these rules resolves
        }
        const float wanted = expected->GetCoefficients()[k];
        largest = std::max(largest, static_cast<double>(std::abs(wanted)));
        difference =
          std::max(difference, static_cast<double>(std::abs(wanted - stack->GetCoefficients()[k])));
      }
      std::cout << vtkBasisBRDF::GetBasisName(basis) << ", "
                << (material->IsIsotropic() ? "isotropic" : "anisotropic")
                << ": largest difference " << difference / largest << " of the peak\n";
      // 48 x 96 directions of light against 96 x 256 nodes.
      EXPECT_LT(difference, (basis == 1 ? 2e-3 : 1e-4) * largest);
      EXPECT_TRUE(stack->GetIncidentCosine());
      EXPECT_FALSE(stack->GetOutgoingCosine());
      EXPECT_EQ(stack->GetNumberOfPhi(), material->IsIsotropic() ? 1 : 16);
      EXPECT_EQ(stack->GetOutgoingZone()[1], end);
      // B_0 is nowhere negative, all others somewhere.
      EXPECT_EQ(acquisition->GetNumberOfPhotographs(), 97);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Acquisition, SameSeedSameBits)
{
  const auto phong = MakeColoredPhong(10.0);
  phong->SetName("name");
  phong->SetSource("somewhere");
  const auto acquisition = MakeAcquisition(phong);
  acquisition->SetNoise(0.01);
  acquisition->SetBits(12);
  const auto first = Acquire(acquisition);
  EXPECT_EQ(first->GetName(), "name");
  EXPECT_EQ(first->GetSource(), "simulated acquisition of: somewhere");
  EXPECT_EQ(Acquire(acquisition)->GetCoefficients(), first->GetCoefficients());
  acquisition->SetSeed(2);
  const auto other = Acquire(acquisition);
  EXPECT_NE(other, first);
  EXPECT_NE(other->GetCoefficients(), first->GetCoefficients());
}

//------------------------------------------------------------------------------
// Two photographs of deviation Noise x full, averaged over the camera's azimuths after turning
// them: a coefficient of function k > 0 is off by Noise full_k sqrt(2 / NumberOfPhi), RMS.
TEST(Acquisition, NoiseIsAveragedOverAzimuths)
{
  const auto phong = MakeColoredPhong(5.0);
  double before = 0.0;
  for (const int nPhi : { 1, 4, 16, 64 })
  {
    const auto acquisition = MakeAcquisition(phong, 4);
    acquisition->SetNumberOfTheta(16);
    acquisition->SetNumberOfPhi(nPhi);
    const auto clean = Acquire(acquisition);
    acquisition->SetNoise(0.02);
    double sum = 0.0;
    constexpr int seeds = 6;
    for (unsigned int seed = 1; seed <= seeds; ++seed)
    {
      acquisition->SetSeed(seed);
      const double distance = GetDistance(clean, Acquire(acquisition));
      sum += distance * distance / seeds;
    }
    const double noise = std::sqrt(sum);
    std::cout << nPhi << " azimuths: RMS noise of a coefficient " << noise << "\n";
    if (before > 0.0)
    {
      EXPECT_NEAR(noise / before, 0.5, 0.06); // four times the azimuths
    }
    before = noise;
  }
  // Its size: a Lambert-like sample has the same exposure at all pixels of B_0, all channels.
  const auto flat = vtkSmartPointer<FunctionBRDF>::New();
  flat->Function = [](const glm::dvec3&, const glm::dvec3&) { return glm::dvec3(1.0); };
  const auto acquisition = MakeAcquisition(flat, 1);
  acquisition->SetNumberOfTheta(64);
  acquisition->SetNumberOfPhi(16);
  const auto clean = Acquire(acquisition);
  acquisition->SetNoise(0.02);
  const auto noisy = Acquire(acquisition);
  double square = 0.0;
  for (int v = 0; v < 3 * 64; ++v)
  {
    const double d = noisy->GetCoefficients()[v] / clean->GetCoefficients()[v] - 1.0;
    square += d * d / (3 * 64);
  }
  EXPECT_NEAR(std::sqrt(square), 0.02 / std::sqrt(16.0), 0.15 * 0.02 / std::sqrt(16.0));
}

//------------------------------------------------------------------------------
TEST(Acquisition, ABitHalvesTheError)
{
  const auto phong = MakeColoredPhong(5.0);
  const auto acquisition = MakeAcquisition(phong, 4);
  acquisition->SetNumberOfPhi(4);
  acquisition->SetNumberOfTheta(24);
  const auto clean = Acquire(acquisition);
  double before = 0.0;
  for (const int bits : { 6, 8, 10, 12, 14 })
  {
    acquisition->SetBits(bits);
    const double error = GetDistance(clean, Acquire(acquisition));
    std::cout << bits << " bits: RMS error of a coefficient " << error << "\n";
    if (before > 0.0)
    {
      EXPECT_NEAR(error / before, 0.25, 0.07);
    }
    before = error;
  }
  // A black sample stays black.
  phong->SetSpecular(0.0, 0.0, 0.0);
  acquisition->SetNoise(0.1);
  for (const float v : Acquire(acquisition)->GetCoefficients())
  {
    ASSERT_EQ(v, 0.0f);
  }
}

//------------------------------------------------------------------------------
TEST(Acquisition, RefusesAndKeeps)
{
  vtkNew<vtkBRDFAcquisition> acquisition;
  ErrorCatcher errors(acquisition);
  const auto refuse = [&](const std::string& expected)
  {
    const vtkSmartPointer<vtkBasisBRDF> before = acquisition->GetOutput();
    EXPECT_FALSE(acquisition->Acquire());
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_NE(errors.GetText().find("Acquire: " + expected), std::string::npos) << errors.GetText();
    EXPECT_EQ(acquisition->GetOutput(), before);
  };
  refuse("no input");
  const auto phong = MakeColoredPhong(5.0);
  acquisition->SetInput(phong);
  acquisition->SetNumberOfTheta(4);
  acquisition->SetNumberOfPhi(4);
  acquisition->SetOrder(1);
  ASSERT_TRUE(acquisition->Acquire());
  // Setters refuse what is out of range: one message each, and the value stays (TestSetters).
  const auto refuseValue = [&](const std::string& expected)
  {
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_NE(errors.GetText().find(expected), std::string::npos) << errors.GetText();
  };
  for (const int basis : { int(vtkBasisBRDF::SPHERICAL_HARMONICS), 7 })
  {
    acquisition->SetBasis(basis);
    refuseValue("found " + std::to_string(basis));
    EXPECT_EQ(acquisition->GetBasis(), vtkBasisBRDF::ZONAL);
  }
  for (const int order : { -3, 0, 21, 100 })
  {
    acquisition->SetOrder(order);
    refuseValue("found " + std::to_string(order) + ", expected a number from 1 to 20");
    EXPECT_EQ(acquisition->GetOrder(), 1);
  }
  acquisition->SetZone(57.0, 9.0);
  refuseValue("zone 57 to 9 degrees, expected");
  acquisition->SetZone(9.0, 9.2);
  refuseValue("zone 9 to 9.2 degrees, expected");
  EXPECT_EQ(acquisition->GetZone()[1], 57.0);
  for (const double noise : { -0.1, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    acquisition->SetNoise(noise);
    refuseValue("SetNoise");
    EXPECT_EQ(acquisition->GetNoise(), 0.0);
  }
  for (const int bits : { -1, 25, 30 })
  {
    acquisition->SetBits(bits);
    refuseValue("found " + std::to_string(bits) + ", expected a number from 0 to 24");
    EXPECT_EQ(acquisition->GetBits(), 0);
  }
  // More memory than a simulation should take: anisotropic samples only.
  acquisition->SetNumberOfTheta(1024);
  acquisition->SetNumberOfPhi(256);
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(8.0, 40.0);
  acquisition->SetInput(brushed);
  refuse("1024 x 256 pixels need ");
  std::ostringstream text;
  acquisition->Print(text);
  EXPECT_NE(text.str().find("NumberOfPhotographs: 7"), std::string::npos);
}

//------------------------------------------------------------------------------
TEST(Acquisition, ProgressAndAbort) // at once, and between photographs
{
  const auto acquisition = MakeAcquisition(MakeColoredPhong(5.0), 2);
  acquisition->SetNumberOfTheta(40);
  ExpectStops(
    acquisition.Get(), [&]() { return acquisition->Acquire(); },
    [&]() { return acquisition->GetOutput(); }, 0, { 0.0, 0.6 });
}
