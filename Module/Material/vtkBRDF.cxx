// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDF.h"

#include "HalfVector.h"
#include "HalfVectorSampler.h"
#include "HemisphereIntegral.h"
#include "LocalFrame.h"
#include "ParallelFor.h"
#include "Printable.h"
#include "Refusal.h"
#include "Setters.h"
#include "vtkBRDFExchange.h"
#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
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

// How many tuples inputs have together, where one tuple serves for all. Throws what is wrong.
vtkIdType CountTuples(const std::vector<Tuples>& inputs)
{
  vtkIdType count = 1;
  std::string longest;
  for (const Tuples& input : inputs)
  {
    const std::string name = input.Name;
    const std::string expected =
      std::to_string(input.Components) + (input.Components == 1 ? " component" : " components");
    Require(input.Array, name + ": found no array, expected one of " + expected);
    Require(input.Array->GetNumberOfComponents() == input.Components,
      name + ": found tuples of " + std::to_string(input.Array->GetNumberOfComponents()) +
        ", expected " + expected);
    const vtkIdType tuples = input.Array->GetNumberOfTuples();
    const bool isOdd = tuples != 1 && count != 1 && tuples != count;
    Require(!isOdd, name + ": found " + std::to_string(tuples) + " tuples, expected " +
                      std::to_string(count) + ", as " + longest + " has, or 1");
    if (tuples != 1)
    {
      count = tuples;
      longest = name;
    }
  }
  return count;
}

// Prepares the material, resizes the result, of floats or doubles, and lets function(const double*
// const inputs[2], double* result) fill its tuples, on several threads, each of at least `grain` of
// them. The result may be one of the one or two inputs. Returns false with an error event where
// something is wrong with the arrays.
template <typename Function>
bool MapTuples(vtkBRDF* brdf, const char* caller, std::vector<Tuples> inputs, const Tuples& result,
  vtkIdType grain, const Function& function)
{
  const auto fill = [&]()
  {
    brdf->Prepare();
    const vtkIdType count = CountTuples(inputs);
    const std::string name = result.Name;
    vtkDataArray* const to = result.Array;
    Require(to, name + ": found no array, expected one to fill");
    const bool isReal = to->GetDataType() == VTK_FLOAT || to->GetDataType() == VTK_DOUBLE;
    Require(isReal, name + ": found an array of type " + to->GetDataTypeAsString() +
                      ", expected float or double");
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
    // Memory of another owner (vtkDataArray::SetVoidArray) stays in use where it has the right
    // size.
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
  };
  const std::string problem = FindProblemOf(fill);
  if (!problem.empty())
  {
    vtkErrorWithObjectMacro(brdf, << caller << ": " << problem << ".");
  }
  return problem.empty();
}

//------------------------------------------------------------------------------
// Reads a material's parameters for people: as far as it has some, with its terms.
class Reading : public vtkBRDFExchange
{
public:
  explicit Reading(vtkBRDFData& data)
    : vtkBRDFExchange(data, false)
  {
  }
  void Read(vtkBRDF* brdf)
  {
    FindProblemOf([&]() { brdf->ExchangeData(*this); }); // of an empty table, say
  }

protected:
  void SaveTerm(vtkBRDF* term, vtkBRDFData& data) override
  {
    data.Model = term->GetClassName();
    Reading(data).Read(term);
  }
  void LoadTerm(vtkBRDFData&, const std::function<void(vtkBRDF*)>&) override {}
};

// "Exponent: 50", the name in upper camel case.
std::ostream& PrintName(std::ostream& os, vtkIndent indent, std::string name)
{
  name[0] = static_cast<char>(std::toupper(name[0]));
  return os << indent << name << ": ";
}

void PrintData(const vtkBRDFData& data, std::ostream& os, vtkIndent indent)
{
  for (const auto& [name, option] : data.Options)
  {
    PrintName(os, indent, name) << option << "\n";
  }
  for (const auto& [name, numbers] : data.Numbers)
  {
    PrintName(os, indent, name);
    std::copy(numbers.begin(), numbers.end(), std::ostream_iterator<double>(os, " "));
    os << "\n";
  }
  for (const auto& [name, array] : data.Arrays)
  {
    PrintName(os, indent, name);
    std::copy(array.Shape.begin(), array.Shape.end(), std::ostream_iterator<int>(os, " x "));
    os << array.Channels << " values\n";
  }
  for (const vtkBRDFData& term : data.Terms)
  {
    os << indent << "Term: " << term.Model << "\n";
    PrintData(term, os, indent.GetNextIndent());
  }
}

// Sets rgb to an integral over the directions above the horizon, of a given one there; else to 0.
void Integrate(vtkBRDF* brdf, const double given[3], bool overView, double rgb[3])
{
  rgb[0] = rgb[1] = rgb[2] = 0.0;
  glm::dvec3 unit;
  if (ToUpperUnit(given, &unit.x))
  {
    brdf->Prepare();
    const glm::dvec3 sum = IntegrateBRDF(brdf, unit, overView);
    std::copy_n(&sum.x, 3, rgb);
  }
}
}

struct vtkBRDF::HalfVectors : public HalfVectorSampler
{
  using HalfVectorSampler::HalfVectorSampler;
};

//------------------------------------------------------------------------------
vtkBRDF::vtkBRDF() = default;

//------------------------------------------------------------------------------
vtkBRDF::~vtkBRDF() = default;

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBRDF, ResamplingTolerance, double, 1e-5, 0.5);

//------------------------------------------------------------------------------
void vtkBRDF::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Name: " << ToPrintable(this->Name) << "\n";
  os << indent << "Source: " << ToPrintable(this->Source) << "\n";
  os << indent << "ResamplingTolerance: " << this->ResamplingTolerance << "\n";
  vtkBRDFData data;
  Reading(data).Read(this);
  PrintData(data, os, indent);
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
void vtkBRDF::Evaluate(const double i[3], const double o[3], double f[3])
{
  this->EvaluateSoft(i, o, 0.0, f);
}

//------------------------------------------------------------------------------
void vtkBRDF::EvaluateSoft(const double i[3], const double o[3], double spread, double f[3])
{
  f[0] = f[1] = f[2] = 0.0;
  double iUnit[3], oUnit[3];
  if (!ToUpperUnit(i, iUnit) || !ToUpperUnit(o, oUnit))
  {
    return;
  }
  if (spread > 0.0)
  {
    this->EvaluateSoftAbove(iUnit, oUnit, std::min(spread, 1e6), f);
  }
  else
  {
    this->EvaluateAbove(iUnit, oUnit, f);
  }
  for (int c = 0; c < 3; ++c)
  {
    f[c] = std::isfinite(f[c]) ? std::max(f[c], 0.0) : 0.0;
  }
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
  return MapTuples(this, "EvaluateArray", { { "i", i, 3 }, { "o", o, 3 } }, { "f", f, 3 }, Grain,
    [this](const double* const inputs[2], double* result)
    { this->Evaluate(inputs[0], inputs[1], result); });
}

//------------------------------------------------------------------------------
bool vtkBRDF::SampleArray(vtkDataArray* o, vtkDataArray* u, vtkDataArray* i)
{
  return MapTuples(this, "SampleArray", { { "o", o, 3 }, { "u", u, 2 } }, { "i", i, 3 }, Grain,
    [this](const double* const inputs[2], double* result)
    { this->Sample(inputs[0], inputs[1][0], inputs[1][1], result); });
}

//------------------------------------------------------------------------------
bool vtkBRDF::PdfArray(vtkDataArray* i, vtkDataArray* o, vtkDataArray* pdf)
{
  return MapTuples(this, "PdfArray", { { "i", i, 3 }, { "o", o, 3 } }, { "pdf", pdf, 1 }, Grain,
    [this](const double* const inputs[2], double* result)
    { *result = this->Pdf(inputs[0], inputs[1]); });
}

//------------------------------------------------------------------------------
bool vtkBRDF::GetDirectionalAlbedoArray(vtkDataArray* o, vtkDataArray* albedo)
{
  return MapTuples(this, "GetDirectionalAlbedoArray", { { "o", o, 3 } }, { "albedo", albedo, 3 }, 1,
    [this](const double* const inputs[2], double* result)
    { this->GetDirectionalAlbedo(inputs[0], result); });
}

//------------------------------------------------------------------------------
void vtkBRDF::SetLobe(int nTheta, int nPhi, double share, const std::vector<double>& weights)
{
  this->Lobe = std::make_shared<HalfVectors>(
    weights.empty()
      ? MeanOverDifferenceAngles(nTheta, nPhi,
          [this](const double i[3], const double o[3], double f[3]) { this->Evaluate(i, o, f); })
      : weights,
    nTheta, nPhi, share);
}

//------------------------------------------------------------------------------
bool vtkBRDF::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  if (!this->Lobe)
  {
    this->Prepare();
  }
  if (!this->Lobe)
  {
    SampleCosine(u1, u2, i);
    return i[2] > 0.0;
  }
  glm::dvec3 direction;
  const bool above = this->Lobe->Sample(glm::make_vec3(o), u1, u2, direction);
  std::copy_n(&direction.x, 3, i);
  return above;
}

//------------------------------------------------------------------------------
double vtkBRDF::PdfAbove(const double i[3], const double o[3])
{
  if (!this->Lobe)
  {
    this->Prepare();
  }
  return this->Lobe ? this->Lobe->Pdf(glm::make_vec3(i), glm::make_vec3(o)) : i[2] / Pi;
}

//------------------------------------------------------------------------------
void vtkBRDF::GetDirectionalAlbedo(const double o[3], double albedo[3])
{
  Integrate(this, o, false, albedo);
}

//------------------------------------------------------------------------------
void vtkBRDF::GetDirectionalReflectance(const double i[3], double reflectance[3])
{
  Integrate(this, i, true, reflectance);
}
