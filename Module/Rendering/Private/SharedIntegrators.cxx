// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedIntegrators.h"

#include "SharedObjects.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSetRadianceIntegrator.h"

#include <tuple>

namespace measuredbrdf
{
namespace
{
// The program's integrator as it was at that time: a changed one needs another copy.
using Key = std::tuple<vtkRadianceIntegrator*, vtkMTimeType, vtkBRDF*, vtkEnvironment*>;
using Copies = SharedObjects<Key, vtkRadianceIntegrator>;

Copies& GetCopies()
{
  static Copies& copies = *new Copies;
  return copies;
}

// Made in a tenth of a second.
vtkHybridRadianceIntegrator* NewSmallTable()
{
  vtkHybridRadianceIntegrator* table = vtkHybridRadianceIntegrator::New();
  table->SetNumberOfRows(33);
  table->SetNumberOfViewAngles(8);
  table->SetNumberOfAzimuths(8);
  return table;
}
}

vtkSmartPointer<vtkRadianceIntegrator> FindIntegrator(
  vtkRadianceIntegrator* wanted, vtkBRDF* brdf, vtkEnvironment* environment)
{
  if (wanted->GetBRDF() == brdf && wanted->GetEnvironment() == environment)
  {
    return wanted;
  }
  return GetCopies().Find({ wanted, wanted->GetMTime(), brdf, environment },
    [&]()
    {
      auto copy = vtkSmartPointer<vtkRadianceIntegrator>::Take(wanted->NewCopy());
      copy->SetBRDF(brdf);
      copy->SetEnvironment(environment);
      return copy;
    });
}

vtkSmartPointer<vtkRadianceIntegrator> FindStandIn(vtkBRDF* brdf, vtkEnvironment* environment)
{
  static vtkLightSetRadianceIntegrator& lights = *vtkLightSetRadianceIntegrator::New();
  static vtkHybridRadianceIntegrator& table = *NewSmallTable();
  return FindIntegrator(
    brdf->IsIsotropic() ? static_cast<vtkRadianceIntegrator*>(&table) : &lights, brdf, environment);
}

void SweepIntegrators() { GetCopies().Sweep(); }
} // namespace measuredbrdf
