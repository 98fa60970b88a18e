// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A small material of each model.
 */

#ifndef EveryModel_h
#define EveryModel_h

#include "SmallFiles.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAngleBasisBRDF.h"
#include "vtkAngularTableBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"
#include "vtkTensorTreeBRDF.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace testio
{
/// makeValues(n): n values for a material's table, all >= 0.
inline std::vector<vtkSmartPointer<vtkBRDF>> MakeEveryModel(
  const std::function<std::vector<float>(std::size_t)>& makeValues)
{
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(0.1, 1.0 / 3.0, 1.25);
  vtkNew<vtkBlinnPhongBRDF> phong;
  phong->SetSpecular(0.1, 0.2, 1.0 / 7.0);
  phong->SetExponent(1234.5678901234567);
  vtkNew<vtkAshikhminShirleyBRDF> shirley;
  shirley->SetSpecularScale(0.9, 0.8, 0.7);
  shirley->SetReflectance(0.1, 0.2, 0.3);
  shirley->SetDiffuse(0.3, 0.2, 0.1);
  shirley->SetExponents(10.1, 1000.3);
  shirley->SetFresnelModelToDielectric();
  shirley->SetIndexOfRefraction(1.77);
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  sum->AddTerm(phong);
  vtkNew<vtkDistributionBRDF> distribution;
  std::vector<float> positive = makeValues(12);
  positive[1] = 0.5f;
  bool good = distribution->SetDistribution(4, 1, positive);
  good = good && distribution->SetFresnel(2, std::vector<float>(6, 0.7f));
  vtkNew<vtkTabulatedBRDF> table;
  const int dimensions[3] = { 3, 2, 2 };
  good = good && table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN,
                   dimensions, makeValues(36));
  vtkNew<vtkBasisBRDF> basis;
  const double zone[2] = { 0.0, 90.0 };
  good = good && basis->SetCoefficients(
                   vtkBasisBRDF::HEMISPHERICAL, 1, zone, zone, 3, 1, makeValues(36)) == "";
  vtkNew<vtkAdaptiveWarpBRDF> warp;
  good = good && warp->SetTables(MakeTables()) == "";
  vtkNew<vtkTabulatedBRDF> turned;
  const int size[4] = { 2, 1, 2, 2 };
  good = good && turned->SetVolume(vtkTabulatedBRDF::FULL_TURN, size, makeValues(24));
  vtkNew<vtkTensorTreeBRDF> tree;
  good = good && tree->SetTree({ 3, { { 1, 0 }, { 2, 1 }, { 0, 0 } }, { 0, 1, 0, 1, 0, 1, 0, 1 },
                   makeValues(9) }) == "";
  vtkNew<vtkAngleBasisBRDF> patches;
  good = good && patches->SetMatrix(
                   { { 90.0f }, { 2 } }, { { 45.0f, 90.0f }, { 1, 2 } }, makeValues(18)) == "";
  vtkNew<vtkAngularTableBRDF> nodes;
  good = good && nodes->SetValues({ { 0.0f }, { 0.0f, 180.0f } }, { { 0.0f, 45.0f }, { 0.0f } },
                   makeValues(12)) == "";
  if (!good)
  {
    return {};
  }
  return { lambert.Get(), phong.Get(), shirley.Get(), sum.Get(), distribution.Get(), table.Get(),
    basis.Get(), warp.Get(), turned.Get(), patches.Get(), tree.Get(), nodes.Get() };
}
} // namespace testio

#endif
