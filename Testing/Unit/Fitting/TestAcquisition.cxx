// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The laboratory's simulated device against vtkBasisProjector's inner products; its noise and
// rounding. What extrapolates its result, against materials inside and outside a basis's span.
#include "Acquisition.h"
#include "BasisFunctions.h"
#include "TestProjections.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <stdexcept>

using namespace testbasis;
using laboratory::Acquire;
using laboratory::AcquisitionOptions;
using laboratory::Extrapolate;

namespace
{
AcquisitionOptions MakeDevice(int order, int nTheta = 8, int nPhi = 16)
{
  AcquisitionOptions device;
  device.Order = order;
  device.NumberOfTheta = nTheta;
  device.NumberOfPhi = nPhi;
  return device;
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
  const auto phong = MakePhong(20.0);
  const auto brushed = MakeBrushed(8.0, 40.0);
  for (vtkBRDF* material : { static_cast<vtkBRDF*>(phong), static_cast<vtkBRDF*>(brushed) })
  {
    for (const int basis : { 1, 2, 3 })
    {
      AcquisitionOptions device = MakeDevice(6);
      device.Basis = basis;
      const laboratory::Acquisition taken = Acquire(material, device);
      vtkBasisBRDF* stack = taken.Stack;
      const double end = basis == 1 ? 90.0 : 57.0;
      const auto expected = Project(material, basis, 6, Zone, Zone,
        [basis, end](vtkBasisProjector* projector)
        {
          projector->SetOutgoingZone(basis == 1 ? 0.0 : 9.0, end);
          projector->SetMethod(vtkBasisProjector::INNER_PRODUCT);
          projector->IncidentCosineOn();
          projector->OutgoingCosineOff();
          projector->SetNumberOfTheta(8);
          projector->SetNumberOfPhi(16);
        });
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
      // 48 x 96 directions of light against 96 x 256 nodes.
      EXPECT_LT(difference, (basis == 1 ? 2e-3 : 1e-4) * largest) << basis;
      EXPECT_TRUE(stack->GetIncidentCosine());
      EXPECT_FALSE(stack->GetOutgoingCosine());
      EXPECT_EQ(stack->GetNumberOfPhi(), material->IsIsotropic() ? 1 : 16);
      EXPECT_EQ(stack->GetOutgoingZone()[1], end);
      // B_0 is nowhere negative, all others somewhere.
      EXPECT_EQ(taken.NumberOfPhotographs, 97);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Acquisition, SameSeedSameBits)
{
  const auto phong = MakePhong(10.0);
  phong->SetName("name");
  phong->SetSource("somewhere");
  AcquisitionOptions device = MakeDevice(3);
  device.Noise = 0.01;
  device.Bits = 12;
  const auto first = Acquire(phong, device).Stack;
  EXPECT_EQ(first->GetName(), "name");
  EXPECT_EQ(first->GetSource(), "simulated acquisition of: somewhere");
  EXPECT_EQ(Acquire(phong, device).Stack->GetCoefficients(), first->GetCoefficients());
  device.Seed = 2;
  EXPECT_NE(Acquire(phong, device).Stack->GetCoefficients(), first->GetCoefficients());
}

//------------------------------------------------------------------------------
// Two photographs of deviation Noise x full, averaged over the camera's azimuths after turning
// them: a coefficient of function k > 0 is off by Noise full_k sqrt(2 / NumberOfPhi), RMS.
TEST(Acquisition, NoiseIsAveragedOverAzimuths)
{
  const auto phong = MakePhong(5.0);
  double before = 0.0;
  for (const int nPhi : { 1, 4, 16 })
  {
    AcquisitionOptions device = MakeDevice(4, 16, nPhi);
    const auto clean = Acquire(phong, device).Stack;
    device.Noise = 0.02;
    double sum = 0.0;
    constexpr int seeds = 6;
    for (device.Seed = 1; device.Seed <= seeds; ++device.Seed)
    {
      sum += std::pow(GetDistance(clean, Acquire(phong, device).Stack), 2.0) / seeds;
    }
    const double noise = std::sqrt(sum);
    if (before > 0.0)
    {
      EXPECT_NEAR(noise / before, 0.5, 0.06); // four times the azimuths
    }
    before = noise;
  }
  // Its size: a Lambert-like sample has the same exposure at all pixels of B_0, all channels.
  const auto flat = vtkSmartPointer<FunctionBRDF>::New();
  flat->Function = [](const glm::dvec3&, const glm::dvec3&) { return glm::dvec3(1.0); };
  AcquisitionOptions device = MakeDevice(1, 64, 16);
  const auto clean = Acquire(flat, device).Stack;
  device.Noise = 0.02;
  const auto noisy = Acquire(flat, device).Stack;
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
  const auto phong = MakePhong(5.0);
  AcquisitionOptions device = MakeDevice(4, 24, 4);
  const auto clean = Acquire(phong, device).Stack;
  double before = 0.0;
  for (const int bits : { 6, 8, 10, 12, 14 })
  {
    device.Bits = bits;
    const double error = GetDistance(clean, Acquire(phong, device).Stack);
    if (before > 0.0)
    {
      EXPECT_NEAR(error / before, 0.25, 0.07) << bits;
    }
    before = error;
  }
  // A black sample stays black.
  phong->SetSpecular(0.0, 0.0, 0.0);
  device.Noise = 0.1;
  const auto black = Acquire(phong, device).Stack;
  for (const float v : black->GetCoefficients())
  {
    ASSERT_EQ(v, 0.0f);
  }
}

//------------------------------------------------------------------------------
// Progress grows to 1, and what it throws ends the work.
TEST(Acquisition, ProgressAndAbort)
{
  const auto phong = MakePhong(5.0);
  const auto zonal = Project(phong, 3, 4);
  const std::function<void(const laboratory::Progress&)> works[] = {
    [&](const laboratory::Progress& show) { Acquire(phong, MakeDevice(2, 40), show); },
    [&](const laboratory::Progress& show) { Extrapolate(zonal, {}, show); }
  };
  for (const auto& work : works)
  {
    double last = 0.0;
    work(
      [&last](double share)
      {
        EXPECT_GE(share, last);
        last = share;
      });
    EXPECT_EQ(last, 1.0);
    const auto stop = [](double share)
    {
      if (share > 0.6)
      {
        throw std::runtime_error("stopped");
      }
    };
    EXPECT_THROW(work(stop), std::runtime_error);
  }
}

//------------------------------------------------------------------------------
// The condition of the harmonics' Gram matrix over 9 to 57 degrees, theory.md section 2.
TEST(Extrapolator, ProblemIsIllPosed)
{
  const double figures[] = { 3e4, 6e6, 1e9, 2e11 };
  for (int order = 2; order <= 5; ++order)
  {
    const int count = (order + 1) * (order + 1);
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(count, count);
    Eigen::VectorXd values(count);
    const measuredbrdf::BasisFunctions harmonics(false, order, 1.0, -1.0);
    ForZone(Zone, 40, 32,
      [&](const glm::dvec3& d, double weight)
      {
        harmonics.Evaluate(d.z, std::atan2(d.y, d.x), values.data());
        gram += weight * values * values.transpose();
      });
    const Eigen::VectorXd eigen =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_NEAR(std::log10(eigen(count - 1) / eigen(0)), std::log10(figures[order - 2]), 0.2);
  }
}

//------------------------------------------------------------------------------
// A wide lobe: far closer to the truth than holding the zone's edge.
TEST(Extrapolator, ExtendsSmoothMaterials)
{
  const auto phong = MakePhong(5.0);
  for (const int basis : { 2, 3 })
  {
    for (const bool cosines : { false, true })
    {
      const auto zonal = Project(phong, basis, 6, Zone, Zone,
        [cosines](vtkBasisProjector* projector)
        {
          projector->SetIncidentCosine(cosines);
          projector->SetOutgoingCosine(cosines);
          projector->SetNumberOfNodes(40);
        });
      zonal->SetName("name");
      const laboratory::Extrapolation whole = Extrapolate(zonal);
      EXPECT_TRUE(whole.IsAccepted);
      EXPECT_EQ(whole.ResidualLimit, basis == 2 ? 0.10 : 0.03);
      EXPECT_EQ(whole.Output->GetBasis(), vtkBasisBRDF::SPHERICAL_HARMONICS);
      EXPECT_EQ(whole.Output->GetOrder(), 6);
      EXPECT_EQ(whole.Output->GetOutgoingZone()[1], 90.0);
      EXPECT_EQ(whole.Output->GetName(), "name");
      const double error = GetZoneError(phong, whole.Output, 0.0, 75.0);
      EXPECT_LT(whole.InZoneResidual, basis == 2 ? 0.04 : 0.003);
      EXPECT_LT(error, basis == 2 ? 0.08 : 0.03);
      EXPECT_LT(error, 0.3 * GetZoneError(phong, zonal, 0.0, 75.0));
      // Both directions outside, where f is a tenth of what it is inside: the hardest part.
      EXPECT_LT(GetZoneError(phong, whole.Output, 57.0, 75.0), basis == 2 ? 0.3 : 0.15);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Extrapolator, RefusesWhatDoesNotFit)
{
  for (const int basis : { 2, 3 })
  {
    const auto zonal = Project(MakePhong(50.0), basis, 6);
    const laboratory::Extrapolation whole = Extrapolate(zonal);
    EXPECT_FALSE(whole.IsAccepted);
    EXPECT_GT(whole.InZoneResidual, whole.ResidualLimit);
    EXPECT_TRUE(whole.Output); // for whoever wants to look
    laboratory::ExtrapolationOptions lenient;
    lenient.MaximumResidual = 0.2;
    lenient.MaximumNegativeMass = 1.0;
    EXPECT_TRUE(Extrapolate(zonal, lenient).IsAccepted);
  }
  // Results that are negative somewhere.
  const auto zonal = Project(MakePhong(50.0), 2, 8);
  laboratory::Extrapolation whole = Extrapolate(zonal);
  EXPECT_FALSE(whole.IsAccepted);
  EXPECT_LT(whole.InZoneResidual, whole.ResidualLimit);
  EXPECT_GT(whole.NegativeMass, 0.05);
  laboratory::ExtrapolationOptions lenient;
  lenient.MaximumNegativeMass = 0.1;
  EXPECT_TRUE(Extrapolate(zonal, lenient).IsAccepted);
  // Zones of i and o that share nothing are looked at, too.
  const auto apart = Project(MakePhong(200.0), 2, 4, Zone, Zone,
    [](vtkBasisProjector* projector)
    {
      projector->SetIncidentZone(40.0, 70.0);
      projector->SetOutgoingZone(0.0, 30.0);
    });
  whole = Extrapolate(apart);
  EXPECT_FALSE(whole.IsAccepted);
  EXPECT_GT(whole.InZoneResidual, 0.1);
  EXPECT_THROW(Extrapolate(vtkNew<vtkBasisBRDF>()), std::runtime_error);
}

//------------------------------------------------------------------------------
// A brushed material keeps its direction.
TEST(Extrapolator, AnisotropicMaterials)
{
  const auto brushed = MakeBrushed(3.0, 12.0);
  const auto zonal = Project(brushed, 3, 6, Zone, Zone,
    [](vtkBasisProjector* projector)
    {
      projector->SetNumberOfTheta(24);
      projector->SetNumberOfPhi(24);
      projector->SetNumberOfNodes(16);
    });
  ASSERT_EQ(zonal->GetNumberOfPhi(), 24);
  const laboratory::Extrapolation whole = Extrapolate(zonal);
  EXPECT_TRUE(whole.IsAccepted);
  EXPECT_EQ(whole.Output->GetNumberOfPhi(), 24);
  EXPECT_LT(
    GetZoneError(brushed, whole.Output, 0.0, 75.0), 0.8 * GetZoneError(brushed, zonal, 0.0, 75.0));
}
