// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSumBRDF.h"

#include "HemisphereIntegral.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <functional>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkSumBRDF);

namespace
{
constexpr double WeightTolerance = 0.05; // any weights will do, good ones draw well

using TermList = std::vector<vtkSmartPointer<vtkBRDF>>;

bool Holds(vtkBRDF* haystack, vtkBRDF* needle)
{
  vtkSumBRDF* sum = vtkSumBRDF::SafeDownCast(haystack);
  bool holds = haystack == needle;
  for (int k = 0; sum && !holds && k < sum->GetNumberOfTerms(); ++k)
  {
    holds = Holds(sum->GetTerm(k), needle);
  }
  return holds;
}

// Adds what get(term, rgb) gives for each term.
template <typename Get>
void AddTerms(const TermList& terms, double sum[3], const Get& get)
{
  for (vtkBRDF* term : terms)
  {
    double part[3];
    get(term, part);
    std::transform(part, part + 3, sum, sum, std::plus<double>());
  }
}

// Whether is(term) of each term.
template <typename Is>
bool AllOf(const TermList& terms, const Is& is)
{
  return std::all_of(terms.begin(), terms.end(), is);
}
}

//------------------------------------------------------------------------------
void vtkSumBRDF::AddTerm(vtkBRDF* term)
{
  if (!term || Holds(term, this))
  {
    vtkErrorMacro("AddTerm: expected a BRDF that does not hold this sum.");
    return;
  }
  if (this->GetNumberOfTerms() == MaximumNumberOfTerms)
  {
    vtkErrorMacro("AddTerm: the sum has " << static_cast<int>(MaximumNumberOfTerms)
                                          << " terms already, the most it may.");
    return;
  }
  this->Terms.emplace_back(term);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkSumBRDF::RemoveAllTerms()
{
  this->Terms.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
int vtkSumBRDF::GetNumberOfTerms() { return static_cast<int>(this->Terms.size()); }

//------------------------------------------------------------------------------
vtkBRDF* vtkSumBRDF::GetTerm(int index)
{
  return index >= 0 && index < this->GetNumberOfTerms() ? this->Terms[index] : nullptr;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkSumBRDF::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkBRDF* term : this->Terms)
  {
    time = std::max(time, term->GetMTime());
  }
  return time;
}

//------------------------------------------------------------------------------
void vtkSumBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  AddTerms(this->Terms, f, [&](vtkBRDF* term, double part[3]) { term->Evaluate(i, o, part); });
}

//------------------------------------------------------------------------------
void vtkSumBRDF::EvaluateSoftAbove(const double i[3], const double o[3], double spread, double f[3])
{
  AddTerms(
    this->Terms, f, [&](vtkBRDF* term, double part[3]) { term->EvaluateSoft(i, o, spread, part); });
}

//------------------------------------------------------------------------------
void vtkSumBRDF::Prepare()
{
  if (this->PrepareTime > this->GetMTime() && this->Weights.size() == this->Terms.size())
  {
    return;
  }
  std::vector<double> weights;
  double total = 0.0;
  for (vtkBRDF* term : this->Terms)
  {
    term->Prepare();
    const glm::dvec3 albedo = IntegrateBRDF(term, { 0.0, 0.0, 1.0 }, false, WeightTolerance);
    weights.push_back(albedo[0] + albedo[1] + albedo[2]);
    total += weights.back();
  }
  // Lobes can grow towards grazing: no term gets less than a tenth of an even share.
  const double even = 1.0 / static_cast<double>(std::max<std::size_t>(weights.size(), 1));
  for (double& w : weights)
  {
    w = 0.1 * even + 0.9 * (total > 0.0 ? w / total : even);
  }
  this->Weights = weights;
  this->PrepareTime.Modified();
}

//------------------------------------------------------------------------------
bool vtkSumBRDF::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  this->Prepare();
  for (std::size_t k = 0; k < this->Terms.size(); ++k)
  {
    if (u1 < this->Weights[k] || k + 1 == this->Terms.size())
    {
      return this->Terms[k]->Sample(
        o, std::min(u1 / this->Weights[k], 0x1.fffffffffffffp-1), u2, i);
    }
    u1 -= this->Weights[k];
  }
  return this->Superclass::SampleAbove(o, u1, u2, i);
}

//------------------------------------------------------------------------------
double vtkSumBRDF::PdfAbove(const double i[3], const double o[3])
{
  this->Prepare();
  if (this->Terms.empty())
  {
    return this->Superclass::PdfAbove(i, o);
  }
  double pdf = 0.0;
  for (std::size_t k = 0; k < this->Terms.size(); ++k)
  {
    pdf += this->Weights[k] * this->Terms[k]->Pdf(i, o);
  }
  return pdf;
}

//------------------------------------------------------------------------------
void vtkSumBRDF::GetDirectionalAlbedo(const double o[3], double albedo[3])
{
  std::fill_n(albedo, 3, 0.0);
  AddTerms(this->Terms, albedo,
    [&](vtkBRDF* term, double part[3]) { term->GetDirectionalAlbedo(o, part); });
}

//------------------------------------------------------------------------------
bool vtkSumBRDF::IsIsotropic()
{
  return AllOf(this->Terms, [](vtkBRDF* term) { return term->IsIsotropic(); });
}

//------------------------------------------------------------------------------
bool vtkSumBRDF::IsReciprocal()
{
  return AllOf(this->Terms, [](vtkBRDF* term) { return term->IsReciprocal(); });
}

//------------------------------------------------------------------------------
bool vtkSumBRDF::IsRenderable()
{
  return AllOf(this->Terms, [](vtkBRDF* term) { return term->IsRenderable(); });
}

//------------------------------------------------------------------------------
vtkBRDF* vtkSumBRDF::GetRenderable()
{
  if (this->IsRenderable())
  {
    return this;
  }
  if (!this->Renderable || this->RenderableTime < this->GetMTime())
  {
    this->Renderable = vtkSmartPointer<vtkSumBRDF>::New();
    for (vtkBRDF* term : this->Terms)
    {
      this->Renderable->AddTerm(term->GetRenderable());
    }
    this->RenderableTime.Modified();
  }
  return this->Renderable;
}

//------------------------------------------------------------------------------
vtkBRDF* vtkSumBRDF::NewQuickRenderable()
{
  vtkSumBRDF* quick = vtkSumBRDF::New();
  bool direct = true;
  for (vtkBRDF* term : this->Terms)
  {
    const auto renderable = vtkSmartPointer<vtkBRDF>::Take(term->NewQuickRenderable());
    direct = direct && renderable == term;
    quick->AddTerm(renderable);
  }
  if (direct)
  {
    quick->Delete();
    this->Register(nullptr);
    return this;
  }
  return quick;
}

//------------------------------------------------------------------------------
void vtkSumBRDF::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  std::string description;
  for (vtkBRDF* term : this->Terms)
  {
    term->GetShaderInputs(inputs);
    description += (description.empty() ? "" : " + ") + inputs.Description;
  }
  inputs.Description = description.empty() ? "nothing (black)" : description;
}

//------------------------------------------------------------------------------
void vtkSumBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  exchange.Terms({ this->Terms.begin(), this->Terms.end() }, MaximumNumberOfTerms,
    [this](vtkBRDF* term) { this->AddTerm(term); });
}

//------------------------------------------------------------------------------
vtkBRDF* vtkSumBRDF::NewCopy()
{
  vtkSumBRDF* copy = vtkSumBRDF::New();
  for (vtkBRDF* term : this->Terms)
  {
    auto part = vtkSmartPointer<vtkBRDF>::Take(term->NewSnapshot());
    if (!part)
    {
      copy->Delete();
      return nullptr;
    }
    copy->Terms.push_back(part);
  }
  return copy;
}
