// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionArrays.h"

#include "SurfacePoints.h"
#include "VisibilityTask.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
vtkSmartPointer<vtkFloatArray> MakeFloats(vtkIdType points, int components)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(points);
  return array;
}

OcclusionArrays::Side MakeSide(vtkIdType points)
{
  static_assert(HorizonCode::Bytes == 3 * 4 * OcclusionArrays::Attributes, "three bytes a float");
  OcclusionArrays::Side side;
  for (vtkSmartPointer<vtkFloatArray>& array : side)
  {
    array = MakeFloats(points, 4);
  }
  return side;
}

// A point's bytes, three in each float of its tuples in the arrays.
void Pack(const unsigned char* bytes, int count, vtkIdType point,
  const vtkSmartPointer<vtkFloatArray>* arrays)
{
  const int components = arrays[0]->GetNumberOfComponents();
  for (int k = 0; 3 * k < count; ++k)
  {
    const int packed = bytes[3 * k] + 256 * bytes[3 * k + 1] + 65536 * bytes[3 * k + 2];
    arrays[k / components]->SetTypedComponent(point, k % components, static_cast<float>(packed));
  }
}

std::string Describe(const std::string& name, const std::string& problem)
{
  return "the point array \"" + name + "\" " + problem;
}

// Null, with a reason, where the array is not what the filter writes.
vtkUnsignedCharArray* FindArray(
  vtkPolyData* surface, const std::string& name, int components, std::string& problem)
{
  vtkAbstractArray* any = surface->GetPointData()->GetAbstractArray(name.c_str());
  auto* array = vtkUnsignedCharArray::SafeDownCast(any);
  if (any && !array)
  {
    problem = Describe(
      name, std::string("is of type ") + any->GetDataTypeAsString() + ", expected unsigned char");
  }
  else if (!array)
  {
    problem = Describe(name, "is missing");
  }
  else if (array->GetNumberOfComponents() != components ||
           array->GetNumberOfTuples() != surface->GetNumberOfPoints())
  {
    problem = Describe(name, "has " + std::to_string(array->GetNumberOfTuples()) + " tuples of " +
                               std::to_string(array->GetNumberOfComponents()) + ", expected " +
                               std::to_string(surface->GetNumberOfPoints()) + " of " +
                               std::to_string(components));
  }
  return problem.empty() ? array : nullptr;
}

// Null, with a reason, where there is none.
vtkSmartPointer<vtkFloatArray> ReadBounceSide(
  vtkPolyData* surface, const std::string& suffix, std::string& problem)
{
  vtkUnsignedCharArray* bytes = FindArray(surface,
    vtkSurfaceVisibilityFilter::GetBouncedLightArrayName() + suffix, BounceCode::Bytes, problem);
  if (!bytes)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkFloatArray> array =
    MakeFloats(surface->GetNumberOfPoints(), BounceCode::Bytes / 3);
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
  {
    Pack(bytes->GetPointer(k * BounceCode::Bytes), BounceCode::Bytes, k, &array);
  }
  return array;
}

bool ReadSide(vtkPolyData* surface, const std::string& suffix, OcclusionArrays::Side& side,
  std::string& problem)
{
  vtkUnsignedCharArray* sky =
    FindArray(surface, vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName() + suffix,
      HorizonCode::SectorBytes, problem);
  vtkUnsignedCharArray* light =
    sky ? FindArray(surface, vtkSurfaceVisibilityFilter::GetHiddenLightArrayName() + suffix,
            HorizonCode::TransferBytes, problem)
        : nullptr;
  if (!light)
  {
    return false;
  }
  const vtkIdType points = surface->GetNumberOfPoints();
  side = MakeSide(points);
  const SideArrays arrays = { sky, light, nullptr, {} };
  for (vtkIdType k = 0; k < points; ++k)
  {
    const HorizonCode::Code code = arrays.Get(k);
    Pack(code.data(), HorizonCode::Bytes, k, side.data());
  }
  return true;
}

// Whether nothing of the sky is seen from any point of a polygon, as from inside of a closed
// surface.
bool IsClosed(vtkPolyData* surface, const std::string& suffix)
{
  auto* sky = vtkUnsignedCharArray::SafeDownCast(surface->GetPointData()->GetAbstractArray(
    (vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName() + suffix).c_str()));
  const auto isClosed = [sky](vtkIdType point)
  {
    const unsigned char* bytes = sky->GetPointer(point * HorizonCode::SectorBytes);
    for (int s = 0; s < HorizonCode::Sectors; ++s)
    {
      if (bytes[3 + 2 * s] != 0 || bytes[4 + 2 * s] != 255)
      {
        return false;
      }
    }
    return true;
  };
  bool all = true;
  ForEachFace(surface, Faces::Polygons,
    [&](const vtkIdType* ids, vtkIdType count, vtkIdType)
    { all = all && std::all_of(ids, ids + count, isClosed); });
  return all;
}

// Triangles turned away from the viewer are not seen: of their points, those that no other triangle
// has need no code.
double FindLeastCosine(vtkPolyData* surface)
{
  auto* sky = vtkUnsignedCharArray::SafeDownCast(
    surface->GetPointData()->GetAbstractArray(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()));
  std::vector<glm::dvec3> normals;
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
  {
    normals.push_back(HorizonCode::UnpackNormal(sky->GetPointer(k * HorizonCode::SectorBytes)));
  }
  constexpr double margin = 0.05; // views differ within a triangle
  const double cosine = GetLeastCosine(surface, normals);
  return -std::sqrt(1.0 - cosine * cosine) - margin;
}

std::string CheckKey(vtkPolyData* surface)
{
  auto* keys = vtkStringArray::SafeDownCast(
    surface->GetFieldData()->GetAbstractArray(vtkSurfaceVisibilityFilter::GetKeyArrayName()));
  const std::string key =
    keys && keys->GetNumberOfValues() > 0 ? std::string(keys->GetValue(0)) : "";
  const std::string version = SurfaceKeyVersion;
  if (key.compare(0, version.size(), version) != 0)
  {
    return "its field data have no \"" +
           std::string(vtkSurfaceVisibilityFilter::GetKeyArrayName()) +
           "\" of this version, which says of what surface its visibility is";
  }
  return key == version + GetSurfaceKey(surface)
           ? ""
           : "its points, normals or cells have changed since its visibility was computed";
}
}

OcclusionArrays OcclusionArrays::Complete(
  const OcclusionArrays* given, vtkIdType points, bool both, bool bounced)
{
  OcclusionArrays whole = given ? *given : OcclusionArrays();
  if (given && whole.HasBack == both && whole.HasBounce == bounced)
  {
    return whole;
  }
  const Side open = MakeSide(points);
  const auto dark = MakeFloats(points, BounceCode::Bytes / 3);
  const HorizonCode::Code openCode = HorizonCode::MakeOpen({ 0.0, 0.0, 1.0 });
  const BounceCode::Code darkCode = BounceCode::MakeDark();
  for (vtkIdType k = 0; k < points; ++k)
  {
    Pack(openCode.data(), HorizonCode::Bytes, k, open.data());
    Pack(darkCode.data(), BounceCode::Bytes, k, &dark);
  }
  whole.Front = given ? whole.Front : open;
  whole.Back = both && !whole.HasBack ? open : whole.Back;
  whole.BounceFront = whole.HasBounce ? whole.BounceFront : dark;
  whole.BounceBack = whole.HasBounce && whole.HasBack ? whole.BounceBack : dark;
  whole.BounceBack = both ? whole.BounceBack : nullptr;
  whole.HasBack = both;
  whole.HasBounce = bounced;
  return whole;
}

bool OcclusionArrays::HasAny(vtkPolyData* surface)
{
  vtkPointData* data = surface->GetPointData();
  return data->HasArray(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()) ||
         data->HasArray(vtkSurfaceVisibilityFilter::GetHiddenLightArrayName());
}

std::shared_ptr<OcclusionArrays> OcclusionArrays::Read(
  vtkPolyData* surface, bool isPart, bool withBounce, std::string& problem)
{
  if (surface->GetNumberOfPoints() == 0 || !HasAny(surface))
  {
    return nullptr;
  }
  problem = isPart ? "" : CheckKey(surface);
  auto arrays = std::make_shared<OcclusionArrays>();
  if (!problem.empty() || !ReadSide(surface, "", arrays->Front, problem))
  {
    return nullptr;
  }
  const std::string back =
    std::string(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()) + "Back";
  arrays->HasBack = surface->GetPointData()->HasArray(back.c_str()) &&
                    ReadSide(surface, "Back", arrays->Back, problem);
  if (!problem.empty())
  {
    return nullptr;
  }
  arrays->LeastCosine = FindLeastCosine(surface);
  if (withBounce)
  {
    arrays->ReadBounce(surface, problem);
  }
  if (arrays->HasBack)
  {
    arrays->LeaveOutClosedSide(surface);
  }
  return arrays;
}

void OcclusionArrays::ReadBounce(vtkPolyData* surface, std::string& problem)
{
  this->BounceFront = ReadBounceSide(surface, "", problem);
  this->BounceBack =
    this->BounceFront && this->HasBack ? ReadBounceSide(surface, "Back", problem) : nullptr;
  this->HasBounce = problem.empty();
}

void OcclusionArrays::LeaveOutClosedSide(vtkPolyData* surface)
{
  if (IsClosed(surface, "Back"))
  {
    this->IsOtherClosed = true;
  }
  else if (IsClosed(surface, ""))
  {
    this->Front = this->Back;
    this->BounceFront = this->BounceBack;
    this->IsOtherClosed = true;
  }
  if (this->IsOtherClosed)
  {
    this->Back = Side();
    this->BounceBack = nullptr;
    this->HasBack = false;
  }
}
} // namespace measuredbrdf
