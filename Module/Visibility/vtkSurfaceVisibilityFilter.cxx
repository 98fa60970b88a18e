// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceVisibilityFilter.h"

#include "ContentHash.h"
#include "HiddenSky.h"
#include "LocalFrame.h"
#include "Setters.h"
#include "SurfacePoints.h"
#include "SurfaceTracer.h"
#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace measuredbrdf;

namespace
{
constexpr int Chunk = 4096; // points between two reports of progress
constexpr const char* Version = "2:";

// The point arrays of one side of a surface.
struct SideArrays
{
  vtkSmartPointer<vtkUnsignedCharArray> Sky;
  vtkSmartPointer<vtkUnsignedCharArray> Light;

  SideArrays() = default;
  SideArrays(vtkIdType points, const std::string& suffix)
    : Sky(Make(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName() + suffix, points,
        HiddenSky::SectorBytes))
    , Light(Make(vtkSurfaceVisibilityFilter::GetHiddenLightArrayName() + suffix, points,
        HiddenSky::TransferBytes))
  {
  }

  void Set(vtkIdType point, const HiddenSky::Code& code) const
  {
    std::copy_n(
      code.begin(), HiddenSky::SectorBytes, this->Sky->GetPointer(point * HiddenSky::SectorBytes));
    std::copy_n(code.begin() + HiddenSky::SectorBytes, HiddenSky::TransferBytes,
      this->Light->GetPointer(point * HiddenSky::TransferBytes));
  }

  HiddenSky::Code Get(vtkIdType point) const
  {
    HiddenSky::Code code;
    std::copy_n(
      this->Sky->GetPointer(point * HiddenSky::SectorBytes), HiddenSky::SectorBytes, code.begin());
    std::copy_n(this->Light->GetPointer(point * HiddenSky::TransferBytes), HiddenSky::TransferBytes,
      code.begin() + HiddenSky::SectorBytes);
    return code;
  }

private:
  static vtkSmartPointer<vtkUnsignedCharArray> Make(
    const std::string& name, vtkIdType points, int components)
  {
    auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(points);
    return array;
  }
};

struct SurfaceArrays
{
  std::vector<SideArrays> Sides;
  std::string Key; // of the points, normals and cells
};

// Two passes over the same points write the same bytes: threads share nothing but the tracer.
struct PointTask
{
  const SurfaceTracer& Tracer;
  const HiddenSky::Rays& Rays;
  double Farthest;

  HiddenSky::Code Trace(const SurfaceVertex& point, double side, std::vector<char>& hidden) const
  {
    const glm::dvec3 normal = side * point.Normal;
    if (glm::dot(normal, normal) == 0.0)
    {
      return HiddenSky::MakeOpen({ 0.0, 0.0, 1.0 });
    }
    std::uint8_t packed[3];
    HiddenSky::PackNormal(normal, packed);
    const glm::dmat3 frame = FrameAbout(HiddenSky::UnpackNormal(packed));
    const glm::dvec3 face = side * point.FaceNormal;
    glm::dvec3 origin;
    this->Tracer.OffsetOrigin(&point.Origin.x, &face.x, &face.x, &origin.x);
    const auto test = [&](const glm::dvec3& direction)
    {
      const glm::dvec3 d = frame * direction;
      return this->Tracer.IsOccluded(&origin.x, &d.x, 0.0, this->Farthest);
    };
    hidden.clear();
    for (const glm::dvec3& direction : this->Rays.GetDirections())
    {
      hidden.push_back(test(direction) ? 1 : 0);
    }
    return HiddenSky::Encode(normal, this->Rays, hidden, test);
  }
};

std::vector<vtkPolyData*> GetSurfaces(vtkDataObject* data)
{
  std::vector<vtkPolyData*> surfaces;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      if (auto* block = vtkPolyData::SafeDownCast(it->GetCurrentDataObject()))
      {
        surfaces.push_back(block);
      }
    }
  }
  else if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    surfaces.push_back(surface);
  }
  return surfaces;
}

// Points inside another body see nothing. Where a polygon of theirs sticks out, what is seen of it
// would darken towards them: they take what its most open point has.
void OpenBuriedPoints(vtkPolyData* surface, const SideArrays& side)
{
  constexpr double buried = 0.99; // of the irradiance is hidden
  std::vector<double> hidden;
  std::vector<vtkIdType> sources;
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
  {
    hidden.push_back(HiddenSky(side.Get(k)).GetHiddenCosine());
    sources.push_back(k);
  }
  const auto isMoreOpen = [&hidden](vtkIdType a, vtkIdType b)
  { return hidden[static_cast<std::size_t>(a)] < hidden[static_cast<std::size_t>(b)]; };
  vtkNew<vtkIdList> corners;
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(cell, corners);
      if (corners->GetNumberOfIds() == 0 ||
          std::any_of(corners->begin(), corners->end(),
            [&hidden](vtkIdType k) { return k < 0 || k >= static_cast<vtkIdType>(hidden.size()); }))
      {
        continue; // no polygon of this surface
      }
      const vtkIdType open = *std::min_element(corners->begin(), corners->end(), isMoreOpen);
      for (const vtkIdType corner : *corners)
      {
        vtkIdType& source = sources[static_cast<std::size_t>(corner)];
        if (hidden[static_cast<std::size_t>(corner)] > buried && isMoreOpen(open, source))
        {
          source = open;
        }
      }
    }
  }
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
  {
    if (sources[static_cast<std::size_t>(k)] != k)
    {
      side.Set(k, side.Get(sources[static_cast<std::size_t>(k)]));
    }
  }
}

void AddArrays(vtkPolyData* surface, const SurfaceArrays& arrays)
{
  for (const SideArrays& side : arrays.Sides)
  {
    surface->GetPointData()->AddArray(side.Sky);
    surface->GetPointData()->AddArray(side.Light);
  }
  vtkNew<vtkStringArray> key;
  key->SetName(vtkSurfaceVisibilityFilter::GetKeyArrayName());
  key->InsertNextValue(Version + arrays.Key);
  vtkNew<vtkFieldData> fields; // the input's own is shared
  fields->ShallowCopy(surface->GetFieldData());
  fields->AddArray(key);
  surface->SetFieldData(fields);
}
}

struct vtkSurfaceVisibilityFilter::Internals
{
  struct Occluder
  {
    vtkSmartPointer<vtkPolyData> Surface;
    vtkSmartPointer<vtkMatrix4x4> Matrix; // null: none
  };
  std::vector<Occluder> Occluders;

  // What was traced last.
  std::string Key;
  std::vector<SurfaceArrays> Arrays;

  std::string MakeKey(
    vtkSurfaceVisibilityFilter* self, const std::vector<vtkPolyData*>& surfaces) const
  {
    ContentHash hash;
    hash.AddValue(self->NumberOfRays);
    hash.AddValue(self->MaximumDistance);
    hash.AddValue(self->BothSides);
    hash.AddValue(self->SelfOcclusion);
    for (vtkPolyData* surface : surfaces)
    {
      hash.AddText(GetSurfaceKey(surface));
    }
    for (const Occluder& occluder : this->Occluders)
    {
      hash.AddText(GetSurfaceKey(occluder.Surface));
      if (occluder.Matrix)
      {
        hash.Add(occluder.Matrix->GetData(), 16 * sizeof(double));
      }
    }
    return hash.GetText();
  }

  // Returns whether it was not aborted.
  bool Trace(vtkSurfaceVisibilityFilter* self, const std::vector<vtkPolyData*>& surfaces)
  {
    SurfaceTracer tracer;
    for (vtkPolyData* surface : surfaces)
    {
      if (self->SelfOcclusion)
      {
        tracer.AddSurface(surface);
      }
    }
    for (const Occluder& occluder : this->Occluders)
    {
      tracer.AddSurface(occluder.Surface, occluder.Matrix ? occluder.Matrix->GetData() : nullptr);
    }
    tracer.Build();
    const HiddenSky::Rays rays(self->NumberOfRays / HiddenSky::Sectors);
    const PointTask task = { tracer, rays,
      self->MaximumDistance > 0.0 ? self->MaximumDistance
                                  : std::numeric_limits<double>::infinity() };
    vtkIdType all = 1;
    for (vtkPolyData* surface : surfaces)
    {
      all += surface->GetNumberOfPoints();
    }
    vtkIdType done = 0;
    std::vector<SurfaceArrays> traced;
    for (vtkPolyData* surface : surfaces)
    {
      SurfaceArrays arrays;
      arrays.Key = GetSurfaceKey(surface);
      const vtkIdType count = surface->GetNumberOfPoints();
      const std::vector<SurfaceVertex> points = FindSurfacePoints(surface);
      for (int side = 0; side < (self->BothSides ? 2 : 1); ++side)
      {
        arrays.Sides.emplace_back(count, side == 0 ? "" : "Back");
      }
      for (vtkIdType first = 0; first < count; first += Chunk)
      {
        vtkSMPTools::For(first, std::min(first + Chunk, count), 64,
          [&](vtkIdType begin, vtkIdType end)
          {
            std::vector<char> hidden;
            for (vtkIdType k = begin; k < end; ++k)
            {
              for (std::size_t side = 0; side < arrays.Sides.size(); ++side)
              {
                arrays.Sides[side].Set(k,
                  task.Trace(points[static_cast<std::size_t>(k)], side == 0 ? 1.0 : -1.0, hidden));
              }
            }
          });
        done += std::min<vtkIdType>(Chunk, count - first);
        self->UpdateProgress(static_cast<double>(done) / static_cast<double>(all));
        if (self->GetAbortExecute())
        {
          return false;
        }
      }
      for (const SideArrays& side : arrays.Sides)
      {
        OpenBuriedPoints(surface, side);
      }
      traced.push_back(std::move(arrays));
    }
    this->Arrays = std::move(traced);
    return true;
  }
};

vtkStandardNewMacro(vtkSurfaceVisibilityFilter);

//------------------------------------------------------------------------------
vtkSurfaceVisibilityFilter::vtkSurfaceVisibilityFilter()
  : Impl(new Internals)
{
}

//------------------------------------------------------------------------------
vtkSurfaceVisibilityFilter::~vtkSurfaceVisibilityFilter() = default;

//------------------------------------------------------------------------------
void vtkSurfaceVisibilityFilter::SetNumberOfRays(int numberOfRays)
{
  const int clamped = std::clamp(numberOfRays, 64, 4096);
  if (clamped != numberOfRays)
  {
    vtkWarningMacro("SetNumberOfRays: " << numberOfRays << " is not from 64 to 4096; " << clamped
                                        << " is taken.");
  }
  const int rounded = clamped / HiddenSky::Sectors * HiddenSky::Sectors;
  measuredbrdfAssignMacro(NumberOfRays, rounded);
}

measuredbrdfSetClampedMacro(
  vtkSurfaceVisibilityFilter, MaximumDistance, double, 0.0, VTK_DOUBLE_MAX);

//------------------------------------------------------------------------------
void vtkSurfaceVisibilityFilter::AddOccluder(vtkPolyData* surface, vtkMatrix4x4* matrix)
{
  if (!surface)
  {
    vtkErrorMacro("AddOccluder: there is no surface.");
    return;
  }
  Internals::Occluder occluder;
  occluder.Surface = surface;
  occluder.Matrix = matrix;
  this->Impl->Occluders.push_back(occluder);
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkSurfaceVisibilityFilter::AddOccluder(vtkActor* actor, vtkActor* self)
{
  vtkMapper* mapper = actor ? actor->GetMapper() : nullptr;
  if (mapper && mapper->GetNumberOfInputConnections(0) > 0)
  {
    mapper->Update();
  }
  const std::vector<vtkPolyData*> surfaces =
    GetSurfaces(mapper ? mapper->GetInputDataObject(0, 0) : nullptr);
  vtkNew<vtkMatrix4x4> matrix;
  if (self)
  {
    vtkMatrix4x4::Invert(self->GetMatrix(), matrix);
  }
  if (surfaces.empty() || (self && self->GetMatrix()->Determinant() == 0.0))
  {
    vtkErrorMacro("AddOccluder: " << (surfaces.empty() ? "the actor shows no polydata."
                                                       : "the matrix of self has no inverse."));
    return false;
  }
  vtkMatrix4x4::Multiply4x4(matrix, actor->GetMatrix(), matrix);
  for (vtkPolyData* surface : surfaces)
  {
    this->AddOccluder(surface, matrix);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkSurfaceVisibilityFilter::RemoveAllOccluders()
{
  if (!this->Impl->Occluders.empty())
  {
    this->Impl->Occluders.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkSurfaceVisibilityFilter::GetNumberOfOccluders()
{
  return static_cast<int>(this->Impl->Occluders.size());
}

//------------------------------------------------------------------------------
vtkMTimeType vtkSurfaceVisibilityFilter::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (const Internals::Occluder& occluder : this->Impl->Occluders)
  {
    time = std::max(time, occluder.Surface->GetMTime());
    time = std::max(time, occluder.Matrix ? occluder.Matrix->GetMTime() : 0);
  }
  return time;
}

//------------------------------------------------------------------------------
int vtkSurfaceVisibilityFilter::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkSurfaceVisibilityFilter::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  if (!input || !output)
  {
    return 0;
  }
  const std::vector<vtkPolyData*> surfaces = GetSurfaces(input);
  const std::string key = this->Impl->MakeKey(this, surfaces);
  bool whole = key == this->Impl->Key;
  if (!whole)
  {
    whole = this->Impl->Trace(this, surfaces);
    this->Impl->Key = whole ? key : "";
    this->NumberOfTraces += whole ? 1 : 0;
  }
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    output->ShallowCopy(input);
    if (whole && !surfaces.empty())
    {
      AddArrays(vtkPolyData::SafeDownCast(output), this->Impl->Arrays[0]);
    }
    return 1;
  }
  auto* blocks = vtkCompositeDataSet::SafeDownCast(output);
  blocks->CopyStructure(composite);
  blocks->GetFieldData()->ShallowCopy(composite->GetFieldData());
  auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  std::size_t number = 0;
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    vtkDataObject* block = it->GetCurrentDataObject();
    auto copy = vtkSmartPointer<vtkDataObject>::Take(block->NewInstance());
    copy->ShallowCopy(block);
    auto* surface = vtkPolyData::SafeDownCast(copy);
    if (surface && whole)
    {
      AddArrays(surface, this->Impl->Arrays[number++]);
    }
    blocks->SetDataSet(it, copy);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkSurfaceVisibilityFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRays: " << this->NumberOfRays << "\n";
  os << indent << "MaximumDistance: " << this->MaximumDistance << "\n";
  os << indent << "BothSides: " << (this->BothSides ? "On" : "Off") << "\n";
  os << indent << "SelfOcclusion: " << (this->SelfOcclusion ? "On" : "Off") << "\n";
  os << indent << "NumberOfOccluders: " << this->GetNumberOfOccluders() << "\n";
  os << indent << "NumberOfTraces: " << this->NumberOfTraces << "\n";
}
