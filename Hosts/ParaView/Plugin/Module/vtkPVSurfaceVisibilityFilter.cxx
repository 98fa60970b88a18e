// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVSurfaceVisibilityFilter.h"

#include "MaterialFiles.h"
#include "vtkAppendPolyData.h"
#include "vtkCommand.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMissingNormalsFilter.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSurfaceVisibilityFilter.h"

#include <cstddef>
#include <string>
#include <vector>

using namespace measuredmaterials;

namespace
{
vtkSmartPointer<vtkDataObject> AddNormals(vtkDataObject* data, double featureAngle)
{
  auto result = vtkSmartPointer<vtkDataObject>::Take(data->NewInstance());
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (auto* blocks = vtkCompositeDataSet::SafeDownCast(result))
  {
    blocks->CopyStructure(composite);
    blocks->GetFieldData()->ShallowCopy(composite->GetFieldData());
    auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      blocks->SetDataSet(it, AddNormals(it->GetCurrentDataObject(), featureAngle));
    }
    return result;
  }
  result->ShallowCopy(data);
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    vtkNew<vtkMissingNormalsFilter> normals;
    normals->SetInputData(surface);
    normals->SetFeatureAngle(featureAngle);
    normals->Update();
    result->ShallowCopy(normals->GetOutput());
  }
  return result;
}

//------------------------------------------------------------------------------
struct GatheredSurfaces
{
  std::vector<vtkSmartPointer<vtkPolyData>> Others;
  std::string Error; // the same on all processes; "": none
};

// The polygons of all other processes' surfaces, without data; none, and an error, where all
// processes together have more than that. Collective.
GatheredSurfaces GatherOthers(const std::vector<vtkPolyData*>& own, vtkIdType mostMebibytes,
  vtkMultiProcessController* controller)
{
  vtkNew<vtkAppendPolyData> append;
  for (vtkPolyData* surface : own)
  {
    vtkNew<vtkPolyData> polygons;
    polygons->SetPoints(surface->GetPoints());
    polygons->SetPolys(surface->GetPolys());
    polygons->SetStrips(surface->GetStrips());
    append->AddInputData(polygons);
  }
  vtkNew<vtkPolyData> sent;
  if (!own.empty())
  {
    append->Update();
    sent->ShallowCopy(append->GetOutput());
  }
  const vtkIdType kibibytes = static_cast<vtkIdType>(sent->GetActualMemorySize());
  vtkIdType all = 0;
  controller->AllReduce(&kibibytes, &all, 1, vtkCommunicator::SUM_OP);
  if (all > 1024 * mostMebibytes)
  {
    return { {}, "the parts of the surface take " + std::to_string(all / 1024 + 1) +
                   " MiB on all processes together, expected at most " +
                   std::to_string(mostMebibytes) + " MiB (Gather Limit)" };
  }
  std::vector<vtkSmartPointer<vtkDataObject>> received;
  controller->AllGather(sent, received);
  GatheredSurfaces gathered;
  for (std::size_t rank = 0; rank < received.size(); ++rank)
  {
    auto* surface = vtkPolyData::SafeDownCast(received[rank]);
    const bool isOwn = static_cast<int>(rank) == controller->GetLocalProcessId();
    if (surface && !isOwn && surface->GetNumberOfCells() > 0)
    {
      gathered.Others.emplace_back(surface);
    }
  }
  return gathered;
}
}

vtkStandardNewMacro(vtkPVSurfaceVisibilityFilter);

//------------------------------------------------------------------------------
vtkPVSurfaceVisibilityFilter::vtkPVSurfaceVisibilityFilter()
{
  this->Tracer->AddObserver(
    vtkCommand::ProgressEvent, this, &vtkPVSurfaceVisibilityFilter::FollowTracer);
}

//------------------------------------------------------------------------------
vtkPVSurfaceVisibilityFilter::~vtkPVSurfaceVisibilityFilter() = default;

//------------------------------------------------------------------------------
void vtkPVSurfaceVisibilityFilter::FollowTracer()
{
  this->UpdateProgress(this->Tracer->GetProgress());
}

//------------------------------------------------------------------------------
int vtkPVSurfaceVisibilityFilter::FillInputPortInformation(
  int vtkNotUsed(port), vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkPVSurfaceVisibilityFilter::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkSmartPointer<vtkDataObject> data = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  if (this->GenerateMissingNormals)
  {
    data = AddNormals(data, this->MissingNormalsFeatureAngle);
  }
  this->Tracer->SetNumberOfRays(this->NumberOfRays);
  this->Tracer->SetMaximumDistance(this->MaximumDistance);
  this->Tracer->SetBothSides(this->BothSides);
  this->Tracer->SetBounce(this->Bounce);
  if (vtkMultiProcessController* controller = GetController())
  {
    const GatheredSurfaces gathered = GatherOthers(
      vtkCompositeDataSet::GetDataSets<vtkPolyData>(data), this->GatherLimit, controller);
    if (!gathered.Error.empty())
    {
      if (controller->GetLocalProcessId() == 0)
      {
        vtkErrorMacro("Surface Visibility: " << gathered.Error
                                             << "; the surface is passed on without arrays, as if "
                                                "it hid nothing from itself.");
      }
      output->ShallowCopy(vtkDataObject::GetData(inputVector[0]));
      return 1;
    }
    for (vtkPolyData* other : gathered.Others)
    {
      this->Tracer->AddOccluder(other);
    }
  }
  this->Tracer->SetInputDataObject(data);
  this->Tracer->Update();
  output->ShallowCopy(this->Tracer->GetOutputDataObject(0));
  // What was traced is enough to keep.
  this->Tracer->RemoveAllOccluders();
  this->Tracer->SetInputDataObject(nullptr);
  this->Tracer->GetOutputDataObject(0)->Initialize();
  return 1;
}

//------------------------------------------------------------------------------
void vtkPVSurfaceVisibilityFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRays: " << this->NumberOfRays << "\n";
  os << indent << "MaximumDistance: " << this->MaximumDistance << "\n";
  os << indent << "BothSides: " << this->BothSides << "\n";
  os << indent << "Bounce: " << this->Bounce << "\n";
  os << indent << "GatherLimit: " << this->GatherLimit << "\n";
  os << indent << "GenerateMissingNormals: " << this->GenerateMissingNormals << "\n";
  os << indent << "MissingNormalsFeatureAngle: " << this->MissingNormalsFeatureAngle << "\n";
}
