// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkBasisProjector, against materials inside and outside a basis's span.
#include "ErrorCatcher.h"
#include "ExpectStops.h"
#include "TestProjections.h"

#include <gtest/gtest.h>

using namespace testbasis;

namespace
{
/// The material whose sum over B_k is exact: f = sum / cosines, with this one's coefficients.
vtkSmartPointer<FunctionBRDF> MakeExact(
  vtkBasisBRDF* brdf, bool incidentCosine, bool outgoingCosine)
{
  auto exact = vtkSmartPointer<FunctionBRDF>::New();
  exact->Isotropic = brdf->IsIsotropic();
  exact->Function = [brdf, incidentCosine, outgoingCosine](const glm::dvec3& i, const glm::dvec3& o)
  {
    // Only evaluated at samples of o.
    const double* zone = brdf->GetOutgoingZone();
    const double theta = std::acos(o.z) * 180.0 / Pi;
    const int t = static_cast<int>(
      std::lround((theta - zone[0]) / (zone[1] - zone[0]) * (brdf->GetNumberOfTheta() - 1)));
    const double turn = std::atan2(o.y, o.x) / (2.0 * Pi);
    const int nPhi = brdf->GetNumberOfPhi();
    const int p = static_cast<int>(std::lround((turn - std::floor(turn)) * nPhi)) % nPhi;
    return SumExactly(brdf, i, t, p) /
           ((incidentCosine ? i.z : 1.0) * (outgoingCosine ? o.z : 1.0));
  };
  return exact;
}

double GetLargestDifference(vtkBasisBRDF* a, vtkBasisBRDF* b)
{
  EXPECT_EQ(a->GetCoefficients().size(), b->GetCoefficients().size());
  double largest = 0.0;
  for (std::size_t k = 0; k < a->GetCoefficients().size(); ++k)
  {
    largest = std::max(
      largest, static_cast<double>(std::abs(a->GetCoefficients()[k] - b->GetCoefficients()[k])));
  }
  return largest;
}

/// Relative L2 error over the zone of i, solid angle or projected solid angle as weight, of the
/// exact sum with the coefficients of one sample of o (azimuth 0).
double GetViewError(
  vtkBasisBRDF* brdf, vtkBRDF* truth, int t, const double zone[2], bool cosineWeighted)
{
  const double* views = brdf->GetOutgoingZone();
  const glm::dvec3 o = FromAngles(
    ToRadians(views[0] + (views[1] - views[0]) * t / (brdf->GetNumberOfTheta() - 1)), 0.0);
  double difference = 0.0, total = 0.0;
  ForZone(zone, 120, 128,
    [&](const glm::dvec3& i, double weight)
    {
      const double w = weight * (cosineWeighted ? i.z : 1.0);
      const double f = Evaluate(truth, i, o).x;
      const double g = SumExactly(brdf, i, t, 0).x;
      difference += w * (f - g) * (f - g);
      total += w * f * f;
    });
  return std::sqrt(difference / total);
}
}

//------------------------------------------------------------------------------
TEST(Projector, RecoversWhatLiesInTheBasis)
{
  for (int basis = 0; basis < 4; ++basis)
  {
    for (const int nPhi : { 1, 6 })
    {
      for (const int flags : { 1, 2 }) // where cosines are: of i, of o
      {
        const bool in = (flags & 1) != 0, out = (flags & 2) != 0;
        const double high[2] = { 0.0, 85.0 };
        const double* outgoing = nPhi == 1 ? high : Zone;
        const auto brdf =
          MakeBasis(basis, 4, Zone, outgoing, 3, nPhi, MakeCoefficients(4, 3, nPhi));
        ASSERT_TRUE(brdf);
        for (const int method : { 0, 1 })
        {
          if (method == vtkBasisProjector::INNER_PRODUCT && basis == 0)
          {
            continue; // not orthogonal on the hemisphere
          }
          const auto back = Project(MakeExact(brdf, in, out), basis, 4, Zone, outgoing,
            [&](vtkBasisProjector* projector)
            {
              projector->SetIncidentCosine(in);
              projector->SetOutgoingCosine(out);
              projector->SetNumberOfTheta(3);
              projector->SetNumberOfPhi(nPhi == 1 ? 4 : nPhi);
              projector->SetMethod(method);
              projector->SetRegularization(basis == 0 ? 0.0 : 1e-2); // of harmonics only
              projector->SetNumberOfNodes(32);
            });
          const double difference = GetLargestDifference(brdf, back);
          EXPECT_LT(difference, 1e-5) << basis << " " << nPhi << " " << flags << " " << method;
          EXPECT_EQ(back->GetIncidentCosine(), in);
          EXPECT_EQ(back->GetOutgoingCosine(), out);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(Projector, ErrorFallsWithTheOrder)
{
  const auto phong = MakePhong(20.0);
  for (int basis = 0; basis < 4; ++basis)
  {
    double before = 1.0;
    for (const int order : { 2, 4, 6, 8, 12 })
    {
      const auto brdf = Project(phong, basis, order, Zone, Zone,
        [](vtkBasisProjector* projector)
        {
          projector->SetNumberOfTheta(24);
          projector->SetNumberOfNodes(40);
        });
      const double error = GetZoneError(phong, brdf, 9.0, 57.0);
      EXPECT_LT(error, 0.9 * before + 3e-3) << basis << " " << order;
      before = error;
    }
    EXPECT_LT(before, basis == 2 ? 0.06 : 0.02);
  }
}

//------------------------------------------------------------------------------
// Each method is best at what it minimizes.
TEST(Projector, MethodsMinimizeTheirOwnNorm)
{
  const auto lobe = MakeLobe(50.0);
  const double views[2] = { 30.0, 50.0 };
  vtkSmartPointer<vtkBasisBRDF> brdf[2];
  for (const int method : { 0, 1 })
  {
    brdf[method] = Project(lobe, 2, 4, Zone, views,
      [method](vtkBasisProjector* projector)
      {
        projector->SetMethod(method);
        projector->OutgoingCosineOff();
        projector->SetNumberOfTheta(2);
      });
  }
  for (const int view : { 0, 1 })
  {
    EXPECT_LT(GetViewError(brdf[0], lobe, view, Zone, true),
      GetViewError(brdf[1], lobe, view, Zone, true) * 0.9999);
    EXPECT_LT(GetViewError(brdf[1], lobe, view, Zone, false),
      GetViewError(brdf[0], lobe, view, Zone, false) * 0.9999);
  }
}

//------------------------------------------------------------------------------
TEST(Projector, AnisotropicMaterials)
{
  const auto brushed = MakeBrushed(10.0, 100.0);
  const auto brdf = Project(brushed, 3, 8, Zone, Zone,
    [](vtkBasisProjector* projector)
    {
      projector->SetNumberOfTheta(16);
      projector->SetNumberOfPhi(32);
      projector->SetNumberOfNodes(24);
    });
  EXPECT_EQ(brdf->GetNumberOfPhi(), 32);
  EXPECT_LT(GetZoneError(brushed, brdf, 9.0, 57.0), 0.2);
}

//------------------------------------------------------------------------------
TEST(Projector, ProgressAndAbort)
{
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(MakePhong(5.0));
  projector->SetOrder(2);
  projector->SetNumberOfTheta(64);
  projector->SetNumberOfNodes(8);
  ExpectStops(
    projector.Get(), [&]() { return projector->Project(); },
    [&]() { return projector->GetOutput(); });
}

//------------------------------------------------------------------------------
TEST(Projector, RefusesAndKeeps)
{
  vtkNew<vtkBasisProjector> projector;
  ErrorCatcher errors(projector);
  const auto refuse = [&](const std::string& expected)
  {
    const vtkSmartPointer<vtkBasisBRDF> before = projector->GetOutput();
    EXPECT_FALSE(projector->Project());
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_NE(errors.GetText().find(expected), std::string::npos) << errors.GetText();
    EXPECT_EQ(projector->GetOutput(), before);
  };
  refuse("no input");
  const auto phong = MakePhong(5.0);
  projector->SetInput(phong);
  projector->SetNumberOfTheta(3);
  projector->SetNumberOfNodes(21);
  ASSERT_TRUE(projector->Project());
  projector->SetOrder(20);
  projector->SetNumberOfNodes(20);
  refuse("20 nodes, expected more than the order, 20");
  projector->SetOrder(3);
  // Values that a coefficient can't hold.
  const auto enormous = vtkSmartPointer<FunctionBRDF>::New();
  enormous->Function = [](const glm::dvec3&, const glm::dvec3&) { return glm::dvec3(1e200); };
  projector->SetInput(enormous);
  refuse("NaN or infinite");
  projector->SetInput(MakeBrushed(10.0, 100.0));
  projector->SetNumberOfTheta(1024);
  projector->SetNumberOfPhi(1024);
  projector->SetOrder(20);
  projector->SetNumberOfNodes(21);
  refuse("1387266048 coefficients, expected at most 67108864"); // before they are made
}
