// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedIntegrators.h"

#include "SharedObjects.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkObjectFactory.h"

#include <exception>
#include <tuple>

namespace measuredbrdf
{
namespace
{
// The material that stands in for one until there is a plan: of its values, but with a coarse table
// for shaders (vtkBRDF::NewQuickRenderable) where the material's own takes seconds. That is made
// when it is first asked for: only lights need it.
class StandInBRDF : public vtkBRDF
{
public:
  static StandInBRDF* New();
  vtkTypeMacro(StandInBRDF, vtkBRDF);

  // The material must not change while this lives.
  static vtkSmartPointer<vtkBRDF> Make(vtkBRDF* material)
  {
    auto made = vtkSmartPointer<StandInBRDF>::New();
    made->Material = material;
    made->Name = material->GetName();
    made->Source = material->GetSource();
    made->ResamplingTolerance = material->GetResamplingTolerance();
    return made;
  }

  void GetDirectionalAlbedo(const double o[3], double albedo[3]) override
  {
    this->Material->GetDirectionalAlbedo(o, albedo);
  }
  bool IsIsotropic() override { return this->Material->IsIsotropic(); }
  bool IsReciprocal() override { return this->Material->IsReciprocal(); }
  void Prepare() override { this->Material->Prepare(); }
  bool IsRenderable() override { return false; }
  vtkBRDF* GetRenderable() override
  {
    this->Quick = this->Quick
                    ? this->Quick
                    : vtkSmartPointer<vtkBRDF>::Take(this->Material->NewQuickRenderable());
    return this->Quick;
  }
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override
  {
    this->GetRenderable()->GetShaderInputs(inputs);
  }

protected:
  StandInBRDF() = default;
  ~StandInBRDF() override = default;

  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    this->Material->Evaluate(i, o, f);
  }
  void EvaluateSoftAbove(const double i[3], const double o[3], double spread, double f[3]) override
  {
    this->Material->EvaluateSoft(i, o, spread, f);
  }
  bool SampleAbove(const double o[3], double u1, double u2, double i[3]) override
  {
    return this->Material->Sample(o, u1, u2, i);
  }
  double PdfAbove(const double i[3], const double o[3]) override
  {
    return this->Material->Pdf(i, o);
  }

private:
  StandInBRDF(const StandInBRDF&) = delete;
  void operator=(const StandInBRDF&) = delete;

  vtkSmartPointer<vtkBRDF> Material;
  vtkSmartPointer<vtkBRDF> Quick;
};

vtkStandardNewMacro(StandInBRDF);

// The program's integrator as it was at that time: a changed one needs another copy. Of what stands
// in: none, the material's time, and whether it is quick.
using Key = std::tuple<vtkRadianceIntegrator*, vtkMTimeType, vtkBRDF*, vtkEnvironment*, bool>;
using Copies = SharedObjects<Key, vtkRadianceIntegrator>;

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

vtkSmartPointer<vtkRadianceIntegrator> NewStandIn(vtkBRDF* brdf, bool quick)
{
  if (!IsIsotropic(brdf))
  {
    return vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
  }
  auto table = vtkSmartPointer<vtkHybridRadianceIntegrator>::New();
  table->SetSizes({ 65, 8, 8 }); // 33 rows have 23 % error for mirror-like metals under panels
  table->SetQuick(quick);
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
  return Copies::Get().Find({ wanted, wanted->GetMTime(), brdf, environment, false },
    [&]()
    {
      auto copy = vtkSmartPointer<vtkRadianceIntegrator>::Take(wanted->NewCopy());
      copy->SetBRDF(brdf);
      copy->SetEnvironment(environment);
      return copy;
    });
}

vtkSmartPointer<vtkRadianceIntegrator> FindStandIn(
  vtkBRDF* brdf, vtkEnvironment* environment, bool quick)
{
  return Copies::Get().Find({ nullptr, brdf->GetMTime(), brdf, environment, quick },
    [&]()
    {
      vtkSmartPointer<vtkRadianceIntegrator> made = NewStandIn(brdf, quick);
      made->SetBRDF(quick ? StandInBRDF::Make(brdf) : vtkSmartPointer<vtkBRDF>(brdf));
      made->SetEnvironment(environment);
      return made;
    });
}

void SweepIntegrators() { Copies::Get().Sweep(); }
} // namespace measuredbrdf
