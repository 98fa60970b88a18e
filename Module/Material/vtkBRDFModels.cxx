// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFModels.h"

#include "ContentHash.h"
#include "Printable.h"
#include "Refusal.h"
#include "Registry.h"
#include "ScopedErrorCapture.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAngleBasisBRDF.h"
#include "vtkAngularTableBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFData.h"
#include "vtkBRDFExchange.h"
#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"
#include "vtkTensorTreeBRDF.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <typeinfo>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBRDFModels);

namespace
{
using Models = Registry<vtkBRDF>::Items;

constexpr int MaximumDepth = 16; // of terms in terms

Registry<vtkBRDF>& GetRegistry()
{
  static auto& registry = Registry<vtkBRDF>::MakeShared(
    []()
    {
      auto models =
        Registry<vtkBRDF>::Make<vtkLambertBRDF, vtkBlinnPhongBRDF, vtkAshikhminShirleyBRDF,
          vtkDistributionBRDF, vtkTabulatedBRDF, vtkTabulatedBRDF, vtkAngleBasisBRDF,
          vtkAngularTableBRDF, vtkTensorTreeBRDF, vtkBasisBRDF, vtkAdaptiveWarpBRDF, vtkSumBRDF>();
      const int one[4] = { 1, 1, 1, 1 }; // the second table is a model of another name
      vtkTabulatedBRDF::SafeDownCast(models[5])->SetVolume(0, one, { 0.0f, 0.0f, 0.0f });
      return models;
    }());
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
// Knows how deep in terms it is. What it does throws std::runtime_error.
class Exchange : public vtkBRDFExchange
{
public:
  static void Save(int depth, vtkBRDF* brdf, vtkBRDFData& data)
  {
    Require(depth <= MaximumDepth, "terms are nested too deeply");
    Require(brdf, "there is no material");
    // A subclass is another material, even if it has its superclass's parameters.
    const auto model = FindModel(
      [brdf](const auto& other)
      {
        const vtkBRDF& object = *other;
        return typeid(object) == typeid(*brdf);
      });
    Require(model, std::string(brdf->GetClassName()) +
                     " has no form in this format (vtkBRDFModels::Register gives it one)");
    data = {};
    data.Model = brdf->GetModelName();
    data.Name = brdf->GetName();
    data.Source = brdf->GetSource();
    Exchange(data, false, depth).ExchangeAll(brdf);
  }

  static vtkSmartPointer<vtkBRDF> Load(int depth, vtkBRDFData& data)
  {
    Require(depth <= MaximumDepth, "terms are nested too deeply");
    const auto model = FindModel(data.Model);
    Require(
      model, "unknown model " + Quote(data.Model) + ", expected " + vtkBRDFModels::GetNames());
    auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkBRDF::SafeDownCast(model->NewInstance()));
    const ScopedErrorCapture errors(brdf); // the exchange says what is wrong
    const ScopedErrorCapture warnings(brdf, vtkCommand::WarningEvent);
    Exchange(data, true, depth).ExchangeAll(brdf);
    brdf->SetName(data.Name);
    brdf->SetSource(data.Source);
    return brdf;
  }

protected:
  void SaveTerm(vtkBRDF* term, vtkBRDFData& data) override { Save(this->Depth + 1, term, data); }
  void LoadTerm(vtkBRDFData& data, const std::function<void(vtkBRDF*)>& add) override
  {
    add(Load(this->Depth + 1, data));
  }

private:
  Exchange(vtkBRDFData& data, bool loading, int depth)
    : vtkBRDFExchange(data, loading)
    , Depth(depth)
  {
  }

  void ExchangeAll(vtkBRDF* brdf)
  {
    brdf->ExchangeData(*this);
    this->Check(
      this->HasNamed() ? "" : "the model names no parameters (vtkBRDF::ExchangeData does)");
    double tolerance = brdf->GetResamplingTolerance();
    this->Number("resamplingTolerance", tolerance,
      [&](double value)
      {
        brdf->SetResamplingTolerance(value);
        tolerance = brdf->GetResamplingTolerance();
      });
  }

  const int Depth;
};

//------------------------------------------------------------------------------
void AddData(ContentHash& hash, const vtkBRDFData& data)
{
  hash.AddText(data.Model);
  for (const auto& [name, option] : data.Options)
  {
    hash.AddText(name);
    hash.AddText(option);
  }
  for (const auto& [name, numbers] : data.Numbers)
  {
    hash.AddText(name);
    hash.AddValues(numbers);
  }
  for (const auto& [name, array] : data.Arrays)
  {
    hash.AddText(name);
    hash.AddValues(array.Shape);
    hash.AddValues(array.Values);
  }
  hash.AddValue(data.Terms.size());
  for (const vtkBRDFData& term : data.Terms)
  {
    AddData(hash, term);
  }
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
  const std::string problem = FindProblemOf(
    [model]()
    {
      Require(model, "there is no model");
      const std::string name = model->GetModelName();
      Require(
        IsName(name), "found the name " + Quote(name) + ", expected letters, digits and hyphens");
      Require(GetRegistry().Add(model, [](vtkBRDF* other) { return other->GetModelName(); }),
        "a model is called '" + name + "' already; expected another name");
    });
  if (!problem.empty())
  {
    vtkGenericWarningMacro("vtkBRDFModels::Register: " << problem << ".");
  }
  return problem.empty();
}

//------------------------------------------------------------------------------
bool vtkBRDFModels::Unregister(vtkBRDF* model) { return GetRegistry().Remove(model); }

//------------------------------------------------------------------------------
std::vector<vtkSmartPointer<vtkBRDF>> vtkBRDFModels::GetModels() { return GetRegistry().GetAll(); }

//------------------------------------------------------------------------------
std::string vtkBRDFModels::GetNames()
{
  return JoinNames(GetModels(), [](const auto& model) { return model->GetModelName(); });
}

//------------------------------------------------------------------------------
std::string vtkBRDFModels::Save(vtkBRDF* brdf, vtkBRDFData& data)
{
  return FindProblemOf([&]() { Exchange::Save(0, brdf, data); });
}

//------------------------------------------------------------------------------
std::string vtkBRDFModels::Load(vtkBRDFData& data, vtkSmartPointer<vtkBRDF>& brdf)
{
  brdf = nullptr;
  return FindProblemOf([&]() { brdf = Exchange::Load(0, data); });
}

//------------------------------------------------------------------------------
std::string vtkBRDFModels::GetContentKey(vtkBRDF* brdf)
{
  vtkBRDFData data;
  if (!Save(brdf, data).empty())
  {
    return "";
  }
  ContentHash hash;
  AddData(hash, data);
  return hash.GetText();
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
