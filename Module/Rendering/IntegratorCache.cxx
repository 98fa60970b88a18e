// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "IntegratorCache.h"

#include "SharedObjects.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkTableRadianceIntegrator.h"

#include <tuple>

namespace measuredbrdf
{
vtkSmartPointer<vtkTableRadianceIntegrator> FindTable(
  vtkBRDF* brdf, vtkEnvironment* environment, int rows, int viewAngles, int azimuths)
{
  using Key = std::tuple<vtkBRDF*, vtkMTimeType, vtkEnvironment*, vtkMTimeType, int, int, int>;
  static SharedObjects<Key, vtkTableRadianceIntegrator> tables;
  return tables.Find({ brdf, brdf->GetMTime(), environment, environment->GetPixelsMTime(), rows,
                       viewAngles, azimuths },
    [&]() -> vtkSmartPointer<vtkTableRadianceIntegrator>
    {
      auto table = vtkSmartPointer<vtkTableRadianceIntegrator>::New();
      table->SetBRDF(brdf);
      table->SetEnvironment(environment);
      table->SetNumberOfRows(rows);
      table->SetNumberOfViewAngles(viewAngles);
      table->SetNumberOfAzimuths(azimuths);
      return table->Prepare() ? table : nullptr;
    });
}
} // namespace measuredbrdf
