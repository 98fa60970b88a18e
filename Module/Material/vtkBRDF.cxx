// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDF.h"

#include "ContentHash.h"
#include "HalfVector.h"
#include "HemisphereIntegral.h"
#include "LocalFrame.h"
#include "ParallelFor.h"
#include "Printable.h"
#include "Setters.h"
#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

using namespace measuredbrdf;

namespace
{
// Fewer directions are not worth a thread; an albedo alone is.
constexpr vtkIdType Grain = 512;

// An array of tuples, at most three numbers each.
struct Tuples
{
  const char* Name; // for messages
  vtkDataArray* Array;
  int Components;
};

// How many tuples inputs have together, where one tuple serves for all; what is wrong, or "".
std::string CountTuples(const std::vector<Tuples>& inputs, vtkIdType& count)
{
  count = 1;
  const char* longest = "";
  for (const Tuples& input : inputs)
  {
    const std::string name = input.Name;
    const std::string expected =
      std::to_string(input.Components) + (input.Components == 1 ? " component" : " components");
    if (!input.Array)
    {
      return name + ": found no array, expected one of " + expected + ".";
    }
    const int components = input.Array->GetNumberOfComponents();
    if (components != input.Components)
    {
      return name + ": found tuples of " + std::to_string(components) + ", expected " + expected +
             ".";
    }
    const vtkIdType tuples = input.Array->GetNumberOfTuples();
    if (tuples != 1 && count != 1 && tuples != count)
    {
      return name + ": found " + std::to_string(tuples) + " tuples, expected " +
             std::to_string(count) + ", as " + longest + " has, or 1.";
    }
    if (tuples != 1)
    {
      count = tuples;
      longest = input.Name;
    }
  }
  return "";
}

/**
 * Resizes the result, of floats or doubles, and lets function(const double* const inputs[2],
 * double* result) fill its tuples, on several threads, each of at least `grain` of them. The result
 * may be one of the one or two inputs. Returns what is wrong with the arrays, or "".
 */
template <typename Function>
std::string MapTuples(
  std::vector<Tuples> inputs, const Tuples& result, vtkIdType grain, const Function& function)
{
  vtkIdType count = 0;
  const std::string problem = CountTuples(inputs, count);
  if (!problem.empty())
  {
    return problem;
  }
  vtkDataArray* const to = result.Array;
  if (!to)
  {
    return std::string(result.Name) + ": found no array, expected one to fill.";
  }
  if (to->GetDataType() != VTK_FLOAT && to->GetDataType() != VTK_DOUBLE)
  {
    return std::string(result.Name) + ": found an array of type " + to->GetDataTypeAsString() +
           ", expected float or double.";
  }
  std::vector<vtkSmartPointer<vtkDataArray>> copies; // of an input that is the result, too
  for (Tuples& input : inputs)
  {
    if (input.Array == to)
    {
      copies.push_back(vtkSmartPointer<vtkDataArray>::Take(to->NewInstance()));
      copies.back()->DeepCopy(to);
      input.Array = copies.back();
    }
  }
  // Memory of another owner (vtkDataArray::SetVoidArray) stays in use where it has the right size.
  if (to->GetNumberOfComponents() != result.Components)
  {
    to->Initialize(); // or vtkSOADataArrayTemplate does not allocate the new components
    to->SetNumberOfComponents(result.Components);
  }
  if (to->GetNumberOfTuples() != count)
  {
    to->SetNumberOfTuples(count);
  }
  measuredbrdf::ParallelFor(0, count, grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      double from[2][3];
      double value[3];
      const double* const pointers[2] = { from[0], from[1] };
      for (vtkIdType k = begin; k < end; ++k)
      {
        for (std::size_t a = 0; a < inputs.size(); ++a)
        {
          inputs[a].Array->GetTuple(inputs[a].Array->GetNumberOfTuples() == 1 ? 0 : k, from[a]);
        }
        function(pointers, value);
        to->SetTuple(k, value);
      }
    });
  to->Modified();
  return "";
}

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
  this->Prepare();
  const std::string problem = MapTuples({ { "i", i, 3 }, { "o", o, 3 } }, { "f", f, 3 }, Grain,
    [this](const double* const inputs[2], double* result)
    { this->Evaluate(inputs[0], inputs[1], result); });
  if (!problem.empty())
  {
    vtkErrorMacro("EvaluateArray: " << problem);
  }
  return problem.empty();
}

//------------------------------------------------------------------------------
bool vtkBRDF::SampleArray(vtkDataArray* o, vtkDataArray* u, vtkDataArray* i)
{
  this->Prepare();
  const std::string problem = MapTuples({ { "o", o, 3 }, { "u", u, 2 } }, { "i", i, 3 }, Grain,
    [this](const double* const inputs[2], double* result)
    { this->Sample(inputs[0], inputs[1][0], inputs[1][1], result); });
  if (!problem.empty())
  {
    vtkErrorMacro("SampleArray: " << problem);
  }
  return problem.empty();
}

//------------------------------------------------------------------------------
bool vtkBRDF::PdfArray(vtkDataArray* i, vtkDataArray* o, vtkDataArray* pdf)
{
  this->Prepare();
  const std::string problem = MapTuples({ { "i", i, 3 }, { "o", o, 3 } }, { "pdf", pdf, 1 }, Grain,
    [this](const double* const inputs[2], double* result)
    { *result = this->Pdf(inputs[0], inputs[1]); });
  if (!problem.empty())
  {
    vtkErrorMacro("PdfArray: " << problem);
  }
  return problem.empty();
}

//------------------------------------------------------------------------------
bool vtkBRDF::GetDirectionalAlbedoArray(vtkDataArray* o, vtkDataArray* albedo)
{
  this->Prepare();
  const std::string problem = MapTuples({ { "o", o, 3 } }, { "albedo", albedo, 3 }, 1,
    [this](const double* const inputs[2], double* result)
    { this->GetDirectionalAlbedo(inputs[0], result); });
  if (!problem.empty())
  {
    vtkErrorMacro("GetDirectionalAlbedoArray: " << problem);
  }
  return problem.empty();
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
