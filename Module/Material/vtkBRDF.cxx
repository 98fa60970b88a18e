// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDF.h"

#include "ContentHash.h"
#include "HalfVector.h"
#include "HemisphereIntegral.h"
#include "LocalFrame.h"
#include "Printable.h"
#include "Setters.h"
#include "TupleMap.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace measuredbrdf;

namespace
{
// Fewer directions are not worth a thread; an albedo alone is.
constexpr vtkIdType Grain = 512;

void Clean(double f[3])
{
  for (int c = 0; c < 3; ++c)
  {
    f[c] = std::isfinite(f[c]) ? std::max(f[c], 0.0) : 0.0;
  }
}
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBRDF, ResamplingTolerance, double, 1e-5, 0.5);

//------------------------------------------------------------------------------
void vtkBRDF::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Name: " << ToPrintable(this->Name) << "\n";
  os << indent << "Source: " << ToPrintable(this->Source) << "\n";
  os << indent << "ResamplingTolerance: " << this->ResamplingTolerance << "\n";
}

//------------------------------------------------------------------------------
vtkBRDF* vtkBRDF::NewSnapshot()
{
  vtkBRDF* copy = this->NewCopy();
  if (copy && std::strcmp(copy->GetClassName(), this->GetClassName()) != 0)
  {
    copy->Delete();
    return nullptr;
  }
  if (copy)
  {
    copy->Name = this->Name;
    copy->Source = this->Source;
    copy->ResamplingTolerance = this->ResamplingTolerance;
  }
  return copy;
}

//------------------------------------------------------------------------------
vtkBRDF* vtkBRDF::NewQuickRenderable()
{
  vtkBRDF* renderable = this->GetRenderable();
  renderable->Register(nullptr);
  return renderable;
}

//------------------------------------------------------------------------------
std::string vtkBRDF::GetContentKey()
{
  const std::pair<std::type_index, std::string> content = this->GetContent();
  if (content.first != typeid(*this))
  {
    return "";
  }
  ContentHash hash;
  hash.AddText(content.first.name());
  hash.AddText(content.second);
  hash.AddValue(this->ResamplingTolerance);
  return hash.GetText();
}

//------------------------------------------------------------------------------
std::pair<std::type_index, std::string> vtkBRDF::GetContent() { return { typeid(vtkBRDF), "" }; }

//------------------------------------------------------------------------------
void vtkBRDF::Evaluate(const double i[3], const double o[3], double f[3])
{
  f[0] = f[1] = f[2] = 0.0;
  double iUnit[3], oUnit[3];
  if (!ToUpperUnit(i, iUnit) || !ToUpperUnit(o, oUnit))
  {
    return;
  }
  EvaluateTerm(this, iUnit, oUnit, f);
}

//------------------------------------------------------------------------------
void vtkBRDF::EvaluateTerm(vtkBRDF* term, const double i[3], const double o[3], double f[3])
{
  f[0] = f[1] = f[2] = 0.0;
  term->EvaluateAbove(i, o, f);
  Clean(f);
}

//------------------------------------------------------------------------------
void vtkBRDF::EvaluateSoftTerm(
  vtkBRDF* term, const double i[3], const double o[3], double spread, double f[3])
{
  f[0] = f[1] = f[2] = 0.0;
  term->EvaluateSoftAbove(i, o, spread, f);
  Clean(f);
}

//------------------------------------------------------------------------------
void vtkBRDF::EvaluateSoft(const double i[3], const double o[3], double spread, double f[3])
{
  if (!(spread > 0.0))
  {
    this->Evaluate(i, o, f);
    return;
  }
  f[0] = f[1] = f[2] = 0.0;
  double iUnit[3], oUnit[3];
  if (!ToUpperUnit(i, iUnit) || !ToUpperUnit(o, oUnit))
  {
    return;
  }
  EvaluateSoftTerm(this, iUnit, oUnit, std::min(spread, 1e6), f);
}

//------------------------------------------------------------------------------
void vtkBRDF::EvaluateSoftAbove(
  const double i[3], const double o[3], double vtkNotUsed(spread), double f[3])
{
  this->EvaluateAbove(i, o, f);
}

//------------------------------------------------------------------------------
bool vtkBRDF::Sample(const double o[3], double u1, double u2, double i[3])
{
  double oUnit[3];
  if (!ToUpperUnit(o, oUnit) || !this->SampleAbove(oUnit, u1, u2, i))
  {
    i[0] = i[1] = i[2] = 0.0;
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
double vtkBRDF::Pdf(const double i[3], const double o[3])
{
  double iUnit[3], oUnit[3];
  if (!ToUpperUnit(i, iUnit) || !ToUpperUnit(o, oUnit))
  {
    return 0.0;
  }
  const double pdf = this->PdfAbove(iUnit, oUnit);
  return std::isfinite(pdf) ? std::max(pdf, 0.0) : 0.0;
}

//------------------------------------------------------------------------------
bool vtkBRDF::EvaluateArray(vtkDataArray* i, vtkDataArray* o, vtkDataArray* f)
{
  TupleMap map({ { "i", i, 3 }, { "o", o, 3 } }, { "f", f, 3 });
  if (!map.GetProblem().empty())
  {
    vtkErrorMacro("EvaluateArray: " << map.GetProblem());
    return false;
  }
  this->Prepare();
  map.Run(Grain, [this](const double* const inputs[2], double* result)
    { this->Evaluate(inputs[0], inputs[1], result); });
  return true;
}

//------------------------------------------------------------------------------
bool vtkBRDF::SampleArray(vtkDataArray* o, vtkDataArray* u, vtkDataArray* i)
{
  TupleMap map({ { "o", o, 3 }, { "u", u, 2 } }, { "i", i, 3 });
  if (!map.GetProblem().empty())
  {
    vtkErrorMacro("SampleArray: " << map.GetProblem());
    return false;
  }
  this->Prepare();
  map.Run(Grain, [this](const double* const inputs[2], double* result)
    { this->Sample(inputs[0], inputs[1][0], inputs[1][1], result); });
  return true;
}

//------------------------------------------------------------------------------
bool vtkBRDF::PdfArray(vtkDataArray* i, vtkDataArray* o, vtkDataArray* pdf)
{
  TupleMap map({ { "i", i, 3 }, { "o", o, 3 } }, { "pdf", pdf, 1 });
  if (!map.GetProblem().empty())
  {
    vtkErrorMacro("PdfArray: " << map.GetProblem());
    return false;
  }
  this->Prepare();
  map.Run(Grain, [this](const double* const inputs[2], double* result)
    { *result = this->Pdf(inputs[0], inputs[1]); });
  return true;
}

//------------------------------------------------------------------------------
bool vtkBRDF::GetDirectionalAlbedoArray(vtkDataArray* o, vtkDataArray* albedo)
{
  TupleMap map({ { "o", o, 3 } }, { "albedo", albedo, 3 });
  if (!map.GetProblem().empty())
  {
    vtkErrorMacro("GetDirectionalAlbedoArray: " << map.GetProblem());
    return false;
  }
  this->Prepare();
  map.Run(1, [this](const double* const inputs[2], double* result)
    { this->GetDirectionalAlbedo(inputs[0], result); });
  return true;
}

//------------------------------------------------------------------------------
bool vtkBRDF::SampleAbove(const double vtkNotUsed(o)[3], double u1, double u2, double i[3])
{
  SampleCosine(u1, u2, i);
  return i[2] > 0.0;
}

//------------------------------------------------------------------------------
double vtkBRDF::PdfAbove(const double i[3], const double vtkNotUsed(o)[3]) { return i[2] / Pi; }

//------------------------------------------------------------------------------
void vtkBRDF::GetDirectionalAlbedo(const double o[3], double albedo[3])
{
  albedo[0] = albedo[1] = albedo[2] = 0.0;
  double oUnit[3];
  if (!ToUpperUnit(o, oUnit))
  {
    return;
  }
  this->Prepare();
  const glm::dvec3 sum = IntegrateBRDF(this, glm::make_vec3(oUnit), false);
  std::copy_n(&sum.x, 3, albedo);
}
