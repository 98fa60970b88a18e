// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Materials, their projections onto bases, and how far these are off.
 */

#ifndef TestProjections_h
#define TestProjections_h

#include "TestBasisHelpers.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkBasisProjector.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <functional>

namespace testbasis
{
inline vtkSmartPointer<vtkBlinnPhongBRDF> MakePhong(double exponent)
{
  auto phong = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
  phong->SetSpecular(0.5, 0.2, 0.1);
  phong->SetExponent(exponent);
  return phong;
}

inline vtkSmartPointer<vtkAshikhminShirleyBRDF> MakeBrushed(double u, double v)
{
  auto brushed = vtkSmartPointer<vtkAshikhminShirleyBRDF>::New();
  brushed->SetExponents(u, v);
  return brushed;
}

/// Over both zones; more: sets what else the projector needs.
inline vtkSmartPointer<vtkBasisBRDF> Project(
  vtkBRDF* input, int basis, int order, const double incident[2] = Zone,
  const double outgoing[2] = Zone,
  const std::function<void(vtkBasisProjector*)>& more = [](vtkBasisProjector*) {})
{
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(input);
  projector->SetBasis(basis);
  projector->SetOrder(order);
  projector->SetIncidentZone(incident);
  projector->SetOutgoingZone(outgoing);
  more(projector);
  EXPECT_TRUE(projector->Project());
  return projector->GetOutput();
}

inline double GetZoneError(vtkBRDF* truth, vtkBRDF* other, double begin, double end)
{
  const double zone[2] = { begin, end };
  return vtkBRDFResampler::GetZoneRelativeL2Error(truth, other, zone, zone, 1 << 15);
}
} // namespace testbasis

#endif
