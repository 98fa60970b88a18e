// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFModels.h"

#include "Printable.h"
#include "Registry.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAngleBasisBRDF.h"
#include "vtkAngularTableBRDF.h"
#include "vtkAnisotropicTabulatedBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFData.h"
#include "vtkBRDFExchange.h"
#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkDistributionBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"
#include "vtkTensorTreeBRDF.h"

#include <algorithm>
#include <limits>
#include <typeinfo>

vtkStandardNewMacro(vtkBRDFModels);

namespace
{
using measuredbrdf::Quote;
using measuredbrdf::Registry;
using Models = Registry<vtkBRDF>::Items;

constexpr int MaximumDepth = 16; // of terms in terms

Registry<vtkBRDF>& GetRegistry()
{
  static auto& registry = Registry<vtkBRDF>::MakeShared(
    Registry<vtkBRDF>::Make<vtkLambertBRDF, vtkBlinnPhongBRDF, vtkAshikhminShirleyBRDF,
      vtkDistributionBRDF, vtkTabulatedBRDF, vtkAnisotropicTabulatedBRDF, vtkAngleBasisBRDF,
      vtkAngularTableBRDF, vtkTensorTreeBRDF, vtkBasisBRDF, vtkAdaptiveWarpBRDF, vtkSumBRDF>());
  return registry;
}

//------------------------------------------------------------------------------
template <class Predicate>
vtkSmartPointer<vtkBRDF> FindModel(const Predicate& predicate)
{
  const Models models = vtkBRDFModels::GetModels();
  const auto found = std::find_if(models.begin(), models.end(), predicate);
  return found == models.end() ? nullptr : *found;
}

vtkSmartPointer<vtkBRDF> FindModel(const std::string& name)
{
  return FindModel([&name](const auto& model) { return model->GetModelName() == name; });
}

//------------------------------------------------------------------------------
// Keeps a material from complaining on its own: the exchange says what is wrong.
class Silence
{
public:
  explicit Silence(vtkObject* object)
    : Object(object)
  {
    this->Tags[0] = object->AddObserver(vtkCommand::ErrorEvent, this->Command);
    this->Tags[1] = object->AddObserver(vtkCommand::WarningEvent, this->Command);
  }
  ~Silence()
  {
    this->Object->RemoveObserver(this->Tags[0]);
    this->Object->RemoveObserver(this->Tags[1]);
  }
  Silence(const Silence&) = delete;
  void operator=(const Silence&) = delete;

private:
  vtkNew<vtkCallbackCommand> Command; // does nothing
  vtkObject* Object;
  unsigned long Tags[2];
};

//------------------------------------------------------------------------------
std::string SaveAt(int depth, vtkBRDF* brdf, vtkBRDFData& data);
std::string LoadAt(int depth, vtkBRDFData& data, vtkSmartPointer<vtkBRDF>& brdf);

// Knows how deep in terms it is.
class Exchange : public vtkBRDFExchange
{
public:
  Exchange(vtkBRDFData& data, bool loading, int depth)
    : vtkBRDFExchange(data, loading)
    , Depth(depth)
  {
  }

protected:
  std::string SaveTerm(vtkBRDF* term, vtkBRDFData& data) override
  {
    return SaveAt(this->Depth + 1, term, data);
  }
  std::string LoadTerm(vtkBRDFData& data, vtkSmartPointer<vtkBRDF>& term) override
  {
    return LoadAt(this->Depth + 1, data, term);
  }

private:
  const int Depth;
};

//------------------------------------------------------------------------------
void ExchangeAll(vtkBRDFExchange& x, vtkBRDF* brdf, double tolerance)
{
  brdf->ExchangeData(x);
  if (!x.HasNamed())
  {
    x.Fail("the model names no parameters (vtkBRDF::ExchangeData does)");
  }
  x.Number("resamplingTolerance", tolerance,
    [&](double value)
    {
      brdf->SetResamplingTolerance(value);
      tolerance = brdf->GetResamplingTolerance();
    });
}

//------------------------------------------------------------------------------
std::string SaveAt(int depth, vtkBRDF* brdf, vtkBRDFData& data)
{
  if (!brdf)
  {
    return "there is no material";
  }
  if (depth > MaximumDepth)
  {
    return "terms are nested too deeply";
  }
  // A subclass is another material, even if it has its superclass's parameters.
  const auto model = FindModel(
    [brdf](const auto& other)
    {
      const vtkBRDF& object = *other;
      return typeid(object) == typeid(*brdf);
    });
  if (!model)
  {
    return std::string(brdf->GetClassName()) +
           " has no form in this format (vtkBRDFModels::Register gives it one)";
  }
  data = {};
  data.Model = model->GetModelName();
  data.Name = brdf->GetName();
  data.Source = brdf->GetSource();
  Exchange x(data, false, depth);
  ExchangeAll(x, brdf, brdf->GetResamplingTolerance());
  return x.GetProblem();
}

//------------------------------------------------------------------------------
std::string LoadAt(int depth, vtkBRDFData& data, vtkSmartPointer<vtkBRDF>& brdf)
{
  brdf = nullptr;
  if (depth > MaximumDepth)
  {
    return "terms are nested too deeply";
  }
  const auto model = FindModel(data.Model);
  if (!model)
  {
    return "unknown model " + Quote(data.Model) + ", expected " + vtkBRDFModels::GetNames();
  }
  auto made = vtkSmartPointer<vtkBRDF>::Take(vtkBRDF::SafeDownCast(model->NewInstance()));
  const Silence silence(made);
  Exchange x(data, true, depth);
  ExchangeAll(x, made, made->GetResamplingTolerance());
  if (x.HasFailed())
  {
    return x.GetProblem();
  }
  made->SetName(data.Name);
  made->SetSource(data.Source);
  brdf = made;
  return "";
}

//------------------------------------------------------------------------------
bool IsName(const std::string& name)
{
  return !name.empty() &&
         name.find_first_not_of(
           "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
}
}

//------------------------------------------------------------------------------
bool vtkBRDFModels::Register(vtkBRDF* model)
{
  if (!model)
  {
    vtkGenericWarningMacro("vtkBRDFModels::Register: there is no model.");
    return false;
  }
  const std::string name = model->GetModelName();
  if (!IsName(name))
  {
    vtkGenericWarningMacro("vtkBRDFModels::Register: found the name "
                           << Quote(name) << ", expected letters, digits and hyphens.");
    return false;
  }
  if (!GetRegistry().Add(model, [](vtkBRDF* other) { return other->GetModelName(); }))
  {
    vtkGenericWarningMacro("vtkBRDFModels::Register: a model is called '"
                           << name << "' already; expected another name.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkBRDFModels::Unregister(vtkBRDF* model) { return GetRegistry().Remove(model); }

//------------------------------------------------------------------------------
std::vector<vtkSmartPointer<vtkBRDF>> vtkBRDFModels::GetModels() { return GetRegistry().GetAll(); }

//------------------------------------------------------------------------------
std::string vtkBRDFModels::GetNames()
{
  return measuredbrdf::JoinNames(
    GetModels(), [](const auto& model) { return model->GetModelName(); });
}

//------------------------------------------------------------------------------
std::string vtkBRDFModels::Save(vtkBRDF* brdf, vtkBRDFData& data) { return SaveAt(0, brdf, data); }

//------------------------------------------------------------------------------
std::string vtkBRDFModels::Load(vtkBRDFData& data, vtkSmartPointer<vtkBRDF>& brdf)
{
  return LoadAt(0, data, brdf);
}

//------------------------------------------------------------------------------
double vtkBRDFModels::GetMaximumArraySize(const std::string& name)
{
  const auto model = FindModel(name);
  return model ? model->GetMaximumArraySize() : std::numeric_limits<double>::infinity();
}

//------------------------------------------------------------------------------
void vtkBRDFModels::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Models: " << GetNames() << "\n";
}
