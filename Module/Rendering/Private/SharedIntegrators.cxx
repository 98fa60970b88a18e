// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedIntegrators.h"

#include "SharedObjects.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSetRadianceIntegrator.h"

#include <exception>
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

vtkSmartPointer<vtkRadianceIntegrator> NewCopyFor(
  vtkRadianceIntegrator* wanted, vtkBRDF* brdf, vtkEnvironment* environment)
{
  auto copy = vtkSmartPointer<vtkRadianceIntegrator>::Take(wanted->NewCopy());
  copy->SetBRDF(brdf);
  copy->SetEnvironment(environment);
  return copy;
}

// Not one that cannot tell, for lack of memory say: asked once, not in each frame.
bool IsIsotropic(vtkBRDF* brdf)
{
  try
  {
    return brdf->IsIsotropic();
  }
  catch (const std::exception&)
  {
    return false;
  }
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
    [&]() { return NewCopyFor(wanted, brdf, environment); });
}

vtkSmartPointer<vtkRadianceIntegrator> FindStandIn(vtkBRDF* brdf, vtkEnvironment* environment)
{
  static vtkLightSetRadianceIntegrator& lights = *vtkLightSetRadianceIntegrator::New();
  static vtkHybridRadianceIntegrator& table = *NewSmallTable();
  return GetCopies().Find({ &table, brdf->GetMTime(), brdf, environment },
    [&]()
    {
      return NewCopyFor(IsIsotropic(brdf) ? static_cast<vtkRadianceIntegrator*>(&table) : &lights,
        brdf, environment);
    });
}

void SweepIntegrators() { GetCopies().Sweep(); }
} // namespace measuredbrdf
