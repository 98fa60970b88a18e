// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedIntegrators.h"

#include "BackgroundThreads.h"
#include "SharedObjects.h"
#include "StandInBRDF.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSetRadianceIntegrator.h"

#include <cmath>
#include <exception>
#include <memory>
#include <tuple>

namespace measuredbrdf
{
namespace
{
// The program's integrator as it was at that time: a changed one needs another copy.
using Key = std::tuple<vtkRadianceIntegrator*, vtkMTimeType, vtkBRDF*, vtkEnvironment*>;
using Copies = SharedObjects<Key, vtkRadianceIntegrator>;

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

// Whether f cos falls to less than 0.3 of its value within a row of the small table, off the mirror
// direction of a view 30 degrees off the normal: that table has 16 to 53 % error under panels then.
// Measured mirror-like paints and metals have at most 0.25, gloss that the table holds 0.5 or more.
bool IsMirrorLike(vtkBRDF* brdf)
{
  constexpr double degree = 0.017453292519943295;
  constexpr double view = 30.0 * degree;
  constexpr double row = 180.0 / 32.0 * degree;
  const auto reflect = [brdf](double theta)
  {
    const double o[3] = { std::sin(view), 0.0, std::cos(view) };
    const double i[3] = { -std::sin(theta), 0.0, std::cos(theta) };
    double f[3];
    brdf->Evaluate(i, o, f);
    return (f[0] + f[1] + f[2]) * i[2];
  };
  try
  {
    brdf->Prepare();
    return reflect(view - row) + reflect(view + row) < 0.3 * 2.0 * reflect(view);
  }
  catch (const std::exception&) // the table says why
  {
    return false;
  }
}

// Mirror-like materials need more rows.
vtkSmartPointer<vtkRadianceIntegrator> NewTable(int rows, bool quick)
{
  auto table = vtkSmartPointer<vtkHybridRadianceIntegrator>::New();
  table->SetNumberOfRows(rows);
  table->SetNumberOfViewAngles(8);
  table->SetNumberOfAzimuths(8);
  table->SetQuick(quick);
  return table;
}

// Of a material that is not isotropic, else by rows and whether it is quick.
struct Models
{
  vtkSmartPointer<vtkRadianceIntegrator> Lights =
    vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
  vtkSmartPointer<vtkRadianceIntegrator> Tables[2] = { NewTable(33, false), NewTable(33, true) };
  vtkSmartPointer<vtkRadianceIntegrator> Finer[2] = { NewTable(65, false), NewTable(65, true) };
};

// Others once the process ends.
std::shared_ptr<const Models> GetModels()
{
  static std::shared_ptr<const Models>& models = []() -> std::shared_ptr<const Models>&
  {
    auto* made = new std::shared_ptr<const Models>(std::make_shared<Models>());
    ReleaseAtExit([made]() { made->reset(); });
    return *made;
  }();
  return models ? models : std::make_shared<Models>();
}
}

vtkSmartPointer<vtkRadianceIntegrator> FindIntegrator(
  vtkRadianceIntegrator* wanted, vtkBRDF* brdf, vtkEnvironment* environment)
{
  if (wanted->GetBRDF() == brdf && wanted->GetEnvironment() == environment)
  {
    return wanted;
  }
  return Copies::Get().Find({ wanted, wanted->GetMTime(), brdf, environment },
    [&]() { return NewCopyFor(wanted, brdf, environment); });
}

vtkSmartPointer<vtkRadianceIntegrator> FindStandIn(
  vtkBRDF* brdf, vtkEnvironment* environment, bool quick)
{
  const std::shared_ptr<const Models> models = GetModels();
  vtkRadianceIntegrator* table = models->Tables[quick ? 1 : 0];
  return Copies::Get().Find({ table, brdf->GetMTime(), brdf, environment },
    [&]()
    {
      const bool isotropic = IsIsotropic(brdf);
      return NewCopyFor(!isotropic           ? models->Lights.Get()
                        : IsMirrorLike(brdf) ? models->Finer[quick ? 1 : 0].Get()
                                             : table,
        quick ? StandInBRDF::Make(brdf) : vtkSmartPointer<vtkBRDF>(brdf), environment);
    });
}

void SweepIntegrators() { Copies::Get().Sweep(); }
} // namespace measuredbrdf
