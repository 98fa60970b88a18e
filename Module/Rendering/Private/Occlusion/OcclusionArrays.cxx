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
// Arrays of all points, with the bytes that get(point) returns, three in each float.
template <typename Get>
std::vector<vtkSmartPointer<vtkFloatArray>> Pack(
  vtkIdType points, int count, int components, const Get& get)
{
  std::vector<vtkSmartPointer<vtkFloatArray>> arrays;
  for (int first = 0; first < count; first += 3 * components)
  {
    arrays.push_back(vtkSmartPointer<vtkFloatArray>::New());
    arrays.back()->SetNumberOfComponents(components);
    arrays.back()->SetNumberOfTuples(points);
  }
  for (vtkIdType point = 0; point < points; ++point)
  {
    const auto bytes = get(point);
    for (int k = 0; 3 * k < count; ++k)
    {
      const int packed = bytes[3 * k] + 256 * bytes[3 * k + 1] + 65536 * bytes[3 * k + 2];
      arrays[k / components]->SetTypedComponent(point, k % components, static_cast<float>(packed));
    }
  }
  return arrays;
}

template <typename Get>
void PackCodes(OcclusionArrays::Side& side, vtkIdType points, const Get& get)
{
  static_assert(HorizonCode::Bytes == 3 * 4 * OcclusionArrays::Attributes, "three bytes a float");
  const auto arrays = Pack(points, HorizonCode::Bytes, 4, get);
  std::copy(arrays.begin(), arrays.end(), side.Codes.begin());
}

template <typename Get>
void PackBounce(OcclusionArrays::Side& side, vtkIdType points, const Get& get)
{
  side.Bounce = Pack(points, BounceCode::Bytes, BounceCode::Bytes / 3, get).front();
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

// These return false, with a reason, where there is none.
bool ReadBounce(vtkPolyData* surface, const std::string& suffix, OcclusionArrays::Side& side,
  std::string& problem)
{
  vtkUnsignedCharArray* bytes = FindArray(surface,
    vtkSurfaceVisibilityFilter::GetBouncedLightArrayName() + suffix, BounceCode::Bytes, problem);
  if (bytes)
  {
    PackBounce(side, surface->GetNumberOfPoints(),
      [bytes](vtkIdType k) { return bytes->GetPointer(k * BounceCode::Bytes); });
  }
  return bytes != nullptr;
}

bool ReadSide(vtkPolyData* surface, const std::string& suffix, OcclusionArrays::Side& side,
  std::string& problem)
{
  SideArrays arrays;
  arrays.Sky = FindArray(surface, vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName() + suffix,
    HorizonCode::SectorBytes, problem);
  arrays.Light =
    arrays.Sky ? FindArray(surface, vtkSurfaceVisibilityFilter::GetHiddenLightArrayName() + suffix,
                   HorizonCode::TransferBytes, problem)
               : nullptr;
  if (arrays.Light)
  {
    PackCodes(side, surface->GetNumberOfPoints(), [&arrays](vtkIdType k) { return arrays.Get(k); });
  }
  return arrays.Light != nullptr;
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
// has need no code. Of all polygons but a hundredth of the area.
double FindLeastCosine(vtkPolyData* surface)
{
  auto* sky = vtkUnsignedCharArray::SafeDownCast(
    surface->GetPointData()->GetAbstractArray(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()));
  std::vector<std::pair<double, double>> polygons; // least cosine to its points' normals, and area
  double left = 0.0;
  ForEachFace(surface, Faces::Polygons,
    [&](const vtkIdType* ids, vtkIdType count, vtkIdType)
    {
      const glm::dvec3 face = MakeFace(surface, ids, count).Area;
      const double area = glm::length(face);
      double least = area > 0.0 && std::isfinite(area) ? 1.0 : -1.0;
      for (vtkIdType k = 0; least >= 0.0 && k < count; ++k)
      {
        const glm::dvec3 normal =
          HorizonCode::UnpackNormal(sky->GetPointer(ids[k] * HorizonCode::SectorBytes));
        least = std::min(least, std::abs(glm::dot(face, normal)) / area);
      }
      if (least >= 0.0)
      {
        polygons.emplace_back(least, area);
        left += 0.01 * area;
      }
    });
  std::sort(polygons.begin(), polygons.end());
  const auto found = std::find_if(polygons.begin(), polygons.end(),
    [&left](const auto& polygon) { return (left -= polygon.second) < 0.0; });
  constexpr double margin = 0.05; // views differ within a triangle
  const double cosine = found == polygons.end() ? 1.0 : found->first;
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
  for (Side* side : { &whole.Front, both ? &whole.Back : &whole.Front })
  {
    if (!side->Codes[0])
    {
      PackCodes(*side, points, [](vtkIdType) { return HorizonCode::MakeOpen({ 0.0, 0.0, 1.0 }); });
    }
    if (bounced && !side->Bounce)
    {
      PackBounce(*side, points, [](vtkIdType) { return BounceCode::MakeDark(); });
    }
  }
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
  const bool both = surface->GetPointData()->HasArray(back.c_str()) != 0;
  if (both && !ReadSide(surface, "Back", arrays->Back, problem))
  {
    return nullptr;
  }
  arrays->LeastCosine = FindLeastCosine(surface);
  if (withBounce && (!ReadBounce(surface, "", arrays->Front, problem) ||
                      (both && !ReadBounce(surface, "Back", arrays->Back, problem))))
  {
    arrays->Front.Bounce = arrays->Back.Bounce = nullptr;
  }
  // A side that sees nothing of the sky costs nothing.
  const bool isBackClosed = both && IsClosed(surface, "Back");
  if (isBackClosed || (both && IsClosed(surface, "")))
  {
    arrays->Front = isBackClosed ? arrays->Front : arrays->Back;
    arrays->Back = Side();
    arrays->IsOtherClosed = true;
  }
  return arrays;
}
} // namespace measuredbrdf
