// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceIntegrator.h"

#include "DirectionPairs.h"
#include "LocalFrame.h"
#include "ParallelFor.h"
#include "Printable.h"
#include "ScopedErrorCapture.h"
#include "vtkBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <vector>

namespace
{
using measuredbrdf::IsFiniteDirection;
using measuredbrdf::NormalizeAny;

// Appends pairs, whose tangents may be null, from arrays; what is wrong with these, or "".
std::string TakePairs(vtkDataArray* normals, vtkDataArray* views, vtkDataArray* tangents,
  vtkIdType size, std::vector<vtkDirectionPair>& pairs)
{
  const vtkIdType count = normals->GetNumberOfTuples();
  for (vtkDataArray* array : { normals, views, tangents })
  {
    if (array && (array->GetNumberOfComponents() != 3 || array->GetNumberOfTuples() != count))
    {
      return "normals, views and tangents must have 3 components and equally many tuples.";
    }
  }
  if (count % size != 0)
  {
    return "found " + std::to_string(count) + " pairs, expected a multiple of " +
           std::to_string(size) + ".";
  }
  for (vtkIdType k = 0; k < count; ++k)
  {
    const glm::dvec3 n = measuredbrdf::GetDirection(normals, k);
    const glm::dvec3 v = measuredbrdf::GetDirection(views, k);
    const glm::dvec3 t = measuredbrdf::GetDirection(tangents, k);
    if (!IsFiniteDirection(n) || !IsFiniteDirection(v) || !IsFiniteDirection(t) ||
        n == glm::dvec3(0.0) || v == glm::dvec3(0.0))
    {
      return "pair " + std::to_string(k) + " holds a direction that is zero or not finite.";
    }
    const glm::dvec3 normal = NormalizeAny(n);
    pairs.push_back({ normal, measuredbrdf::LiftView(NormalizeAny(v), normal), NormalizeAny(t) });
  }
  return "";
}
}

//------------------------------------------------------------------------------
vtkRadianceIntegrator::vtkRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkRadianceIntegrator::~vtkRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkCxxSetSmartPointerMacro(vtkRadianceIntegrator, BRDF, vtkBRDF);
vtkCxxSetSmartPointerMacro(vtkRadianceIntegrator, Environment, vtkEnvironment);

//------------------------------------------------------------------------------
vtkBRDF* vtkRadianceIntegrator::GetBRDF() { return this->BRDF; }

//------------------------------------------------------------------------------
vtkEnvironment* vtkRadianceIntegrator::GetEnvironment() { return this->Environment; }

//------------------------------------------------------------------------------
bool vtkRadianceIntegrator::Prepare()
{
  if (!this->BRDF)
  {
    vtkErrorMacro("Prepare: there is no BRDF.");
    return false;
  }
  if (this->PrepareTime > this->GetInputsMTime())
  {
    return true;
  }
  this->BRDF->Prepare();
  this->Abort = false; // one that an earlier run left
  if (!this->Begin())
  {
    return false;
  }
  this->PrepareTime.Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkRadianceIntegrator::HasLight()
{
  const bool isThere = this->Environment && !this->Environment->GetPixels().empty();
  if (!isThere)
  {
    vtkErrorMacro("Prepare: there is no environment, or it is empty.");
  }
  return isThere;
}

//------------------------------------------------------------------------------
bool vtkRadianceIntegrator::IsIsotropic(const char* what)
{
  if (!this->BRDF->IsIsotropic())
  {
    const std::string name = this->BRDF->GetName();
    vtkErrorMacro("Prepare: " << what << " are for isotropic materials; "
                              << (name.empty() ? "this one" : measuredbrdf::Quote(name)) << " ("
                              << this->BRDF->GetClassName() << ") is not.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkRadianceIntegrator::GetInputsMTime()
{
  return std::max({ this->GetMTime(), this->BRDF ? this->BRDF->GetMTime() : 0,
    this->Environment ? this->Environment->GetPixelsMTime() : 0 });
}

//------------------------------------------------------------------------------
bool vtkRadianceIntegrator::Report(double progress)
{
  this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
  return !this->Abort;
}

//------------------------------------------------------------------------------
vtkRadianceIntegrator* vtkRadianceIntegrator::NewCopy()
{
  vtkRadianceIntegrator* copy = this->NewInstance();
  copy->CopyProperties(this);
  return copy;
}

//------------------------------------------------------------------------------
void vtkRadianceIntegrator::CopyProperties(vtkRadianceIntegrator* source)
{
  std::vector<int> values;
  for (const Size& size : source->GetSizes())
  {
    values.push_back(size.Value);
  }
  this->SetSizes(values);
}

//------------------------------------------------------------------------------
std::string vtkRadianceIntegrator::GetMethodName() { return this->GetClassName(); }

//------------------------------------------------------------------------------
bool vtkRadianceIntegrator::SetSizes(const std::vector<int>& values)
{
  const std::vector<Size> sizes = this->GetSizes();
  if (values.size() > sizes.size())
  {
    vtkErrorMacro(
      "SetSizes: found " << values.size() << " sizes, expected at most " << sizes.size() << ".");
    return false;
  }
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    if (values[k] < sizes[k].Least || values[k] > sizes[k].Largest)
    {
      vtkErrorMacro("SetSizes: found " << values[k] << " " << sizes[k].Name << ", expected "
                                       << sizes[k].Least << " to " << sizes[k].Largest << ".");
      return false;
    }
  }
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    sizes[k].Set(values[k]);
  }
  return true;
}

//------------------------------------------------------------------------------
std::string vtkRadianceIntegrator::GetSizesText()
{
  std::string text;
  for (const Size& size : this->GetSizes())
  {
    text += (text.empty() ? "" : " x ") + std::to_string(size.Value) + " " + size.Name;
  }
  return text;
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> vtkRadianceIntegrator::GetCandidateSizes(bool) { return {}; }

//------------------------------------------------------------------------------
bool vtkRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs&) { return false; }

//------------------------------------------------------------------------------
bool vtkRadianceIntegrator::Integrate(
  vtkDataArray* normals, vtkDataArray* views, vtkDataArray* radiance, vtkDataArray* tangents)
{
  const auto sumPairs = [this](const vtkDirectionPair* pairs, vtkIdType count, double* sums)
  {
    measuredbrdf::ParallelForEach(
      count,
      [&](vtkIdType k)
      {
        const vtkDirectionPair& pair = pairs[k];
        if (glm::dot(pair.Normal, pair.View) > 0.0)
        {
          this->IntegratePair(&pair.Normal.x, &pair.View.x, &pair.Tangent.x, &sums[3 * k]);
        }
      },
      &this->Abort, 0);
  };
  return this->IntegrateGroups("Integrate", normals, views, radiance, tangents, 1, sumPairs);
}

//------------------------------------------------------------------------------
bool vtkRadianceIntegrator::IntegrateGroups(const char* method, vtkDataArray* normals,
  vtkDataArray* views, vtkDataArray* radiance, vtkDataArray* tangents, vtkIdType size,
  const SumGroups& sum)
{
  this->Abort = false;
  std::vector<vtkDirectionPair> pairs;
  const std::string problem = !normals || !views || !radiance
                                ? "normals, views and radiance are needed."
                                : TakePairs(normals, views, tangents, size, pairs);
  if (!problem.empty())
  {
    vtkErrorMacro(<< method << ": " << problem);
    return false;
  }
  if (!this->Prepare())
  {
    return false;
  }
  if (this->Environment)
  {
    double rows[9];
    this->Environment->GetWorldToEnvironment(rows);
    const glm::dmat3 turn = glm::transpose(glm::make_mat3(rows)); // glm takes columns
    for (vtkDirectionPair& pair : pairs)
    {
      pair = { turn * pair.Normal, turn * pair.View, turn * pair.Tangent };
    }
  }
  const vtkIdType count = pairs.size();
  std::vector<double> sums(3 * pairs.size(), 0.0);
  if (!measuredbrdf::WorkInBatches(
        count / size,
        [&](vtkIdType first, vtkIdType groups)
        { sum(&pairs[first * size], groups, &sums[3 * first * size]); },
        [this](double progress) { return this->Report(progress); }))
  {
    vtkErrorMacro(<< method << ": aborted.");
    return false;
  }
  radiance->SetNumberOfComponents(3);
  radiance->SetNumberOfTuples(count);
  for (vtkIdType k = 0; k < count; ++k)
  {
    radiance->SetTuple(k, &sums[3 * k]);
  }
  radiance->Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkRadianceIntegrator::PrepareLayer(vtkRadianceIntegrator* layer)
{
  vtkNew<vtkCallbackCommand> follow;
  follow->SetClientData(this);
  follow->SetCallback(
    [](vtkObject* caller, unsigned long, void* self, void* progress)
    {
      auto* whole = static_cast<vtkRadianceIntegrator*>(self);
      whole->InvokeEvent(vtkCommand::ProgressEvent, progress);
      static_cast<vtkRadianceIntegrator*>(caller)->SetAbort(whole->Abort);
    });
  const unsigned long tag = layer->AddObserver(vtkCommand::ProgressEvent, follow);
  const measuredbrdf::ScopedErrorCapture reason(layer); // an abort is the whole's to tell
  const bool prepared = layer->Prepare();
  layer->RemoveObserver(tag);
  if (!prepared && !this->Abort && !reason.GetText().empty())
  {
    vtkErrorMacro("Prepare: " << reason.GetText());
  }
  return prepared;
}

//------------------------------------------------------------------------------
void vtkRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
  for (const Size& size : this->GetSizes())
  {
    os << indent << size.Name << ": " << size.Value << "\n";
  }
}
