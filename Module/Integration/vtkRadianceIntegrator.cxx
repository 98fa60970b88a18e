// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceIntegrator.h"

#include "DirectionPairs.h"
#include "ParallelFor.h"
#include "ScopedErrorCapture.h"
#include "vtkBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <vector>

// Unit vectors; the tangent may be zero.
struct vtkRadianceIntegrator::Pair
{
  glm::dvec3 Normal;
  glm::dvec3 View;
  glm::dvec3 Tangent;
};

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
  if (!this->Begin())
  {
    return false;
  }
  this->PrepareTime.Modified();
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
    this->SetSize(static_cast<int>(k), values[k]);
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
  this->Abort = false;
  if (!normals || !views || !radiance)
  {
    vtkErrorMacro("Integrate: normals, views and radiance are needed.");
    return false;
  }
  std::vector<Pair> pairs;
  const std::string problem = measuredbrdf::TakePairs(normals, views, tangents, pairs);
  if (!problem.empty())
  {
    vtkErrorMacro("Integrate: " << problem);
    return false;
  }
  if (!this->Prepare())
  {
    return false;
  }
  if (this->Environment)
  {
    measuredbrdf::TurnPairs(this->Environment, pairs);
  }
  std::vector<double> result(3 * pairs.size(), 0.0);
  if (!this->SumPairs(pairs, result))
  {
    vtkErrorMacro("Integrate: aborted.");
    return false;
  }
  const vtkIdType count = static_cast<vtkIdType>(pairs.size());
  radiance->SetNumberOfComponents(3);
  radiance->SetNumberOfTuples(count);
  for (vtkIdType k = 0; k < count; ++k)
  {
    radiance->SetTuple(k, &result[3 * static_cast<std::size_t>(k)]);
  }
  radiance->Modified();
  return true;
}

//------------------------------------------------------------------------------
// Batches of pairs, each pair in parts.
bool vtkRadianceIntegrator::SumPairs(const std::vector<Pair>& pairs, std::vector<double>& result)
{
  const vtkIdType parts = std::max(this->GetNumberOfParts(), 1);
  std::vector<double> sums;
  const auto sumBatch = [&](vtkIdType first, vtkIdType size)
  {
    sums.assign(3 * static_cast<std::size_t>(size * parts), 0.0);
    measuredbrdf::ParallelFor(0, size * parts,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType item = begin; item < end && !this->Abort; ++item)
        {
          const Pair& pair = pairs[static_cast<std::size_t>(first + item / parts)];
          if (glm::dot(pair.Normal, pair.View) > 0.0)
          {
            this->IntegratePart(static_cast<int>(item % parts), &pair.Normal.x, &pair.View.x,
              &pair.Tangent.x, &sums[3 * static_cast<std::size_t>(item)]);
          }
        }
      });
    for (std::size_t item = 0; item < sums.size() / 3; ++item)
    {
      const std::size_t pair =
        static_cast<std::size_t>(first) + item / static_cast<std::size_t>(parts);
      for (std::size_t c = 0; c < 3; ++c)
      {
        result[3 * pair + c] += sums[3 * item + c];
      }
    }
  };
  return measuredbrdf::WorkInBatches(static_cast<vtkIdType>(pairs.size()), sumBatch,
    [this](double progress) { return this->Report(progress); });
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
}
