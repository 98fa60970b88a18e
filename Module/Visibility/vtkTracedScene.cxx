// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTracedScene.h"

#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTracedSurfaces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace
{
using measuredbrdf::SurfacePoint;
using measuredbrdf::SurfaceTracer;

constexpr vtkIdType MostPoints = 10000000;
constexpr vtkIdType MostTries = 64; // rays a point that is wanted
constexpr vtkIdType FewestTries = 4096;

// Into a polydata as CastRays describes it.
void FillHits(const std::vector<SurfacePoint>& found, vtkPolyData* hits)
{
  const auto count = static_cast<vtkIdType>(found.size());
  hits->Initialize();
  const auto add = [&](vtkDataArray* array, const char* name, int components)
  {
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(count);
    hits->GetPointData()->AddArray(array);
  };
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  hits->SetPoints(points);
  vtkNew<vtkFloatArray> normals, facets;
  vtkNew<vtkIntArray> surfaces;
  vtkNew<vtkIdTypeArray> cells;
  add(normals, "Normals", 3);
  add(facets, "FacetNormals", 3);
  add(surfaces, "Surface", 1);
  add(cells, "Cell", 1);
  hits->GetPointData()->SetNormals(normals);
  for (vtkIdType k = 0; k < count; ++k)
  {
    const SurfacePoint& point = found[k];
    points->SetPoint(k, &point.Position.x);
    normals->SetTuple(k, &point.Normal.x);
    facets->SetTuple(k, &point.Facet.x);
    surfaces->SetValue(k, point.Surface);
    cells->SetValue(k, point.Cell);
  }
}

constexpr double Far = std::numeric_limits<double>::infinity();

glm::dvec3 Toward(const glm::dvec3& normal, const glm::dvec3& side)
{
  return glm::dot(normal, side) < 0.0 ? -normal : normal;
}
} // namespace

vtkStandardNewMacro(vtkTracedScene);

//------------------------------------------------------------------------------
vtkTracedScene::vtkTracedScene()
  : Data(std::make_unique<vtkTracedSurfaces>())
{
}

//------------------------------------------------------------------------------
vtkTracedScene::~vtkTracedScene() = default;

//------------------------------------------------------------------------------
int vtkTracedScene::AddSurface(vtkPolyData* surface, vtkMatrix4x4* matrix)
{
  if (!surface)
  {
    vtkErrorMacro("AddSurface: there is no surface.");
    return -1;
  }
  vtkTracedSurfaces::Surface added;
  vtkNew<vtkMatrix4x4> identity;
  vtkMatrix4x4* taken = matrix ? matrix : identity;
  for (int k = 0; k < 16; ++k)
  {
    added.Matrix[k] = taken->GetElement(k / 4, k % 4);
  }
  const std::array<double, 16>& m = added.Matrix;
  if (!std::all_of(m.begin(), m.end(), [](double value) { return std::isfinite(value); }) ||
      m[12] != 0.0 || m[13] != 0.0 || m[14] != 0.0 || m[15] != 1.0)
  {
    vtkErrorMacro(
      "AddSurface: found a matrix that is not finite, or whose last row is not 0, 0, 0, 1.");
    return -1;
  }
  const double points = this->Data->Points + static_cast<double>(surface->GetNumberOfPoints());
  const double cells = this->Data->Cells + static_cast<double>(surface->GetNumberOfCells());
  if (std::max(points, cells) > 4294967294.0)
  {
    vtkErrorMacro("AddSurface: found " << points << " points and " << cells
                                       << " cells in all, expected at most 2^32 - 2.");
    return -1;
  }
  added.Mesh = vtkSmartPointer<vtkPolyData>::New();
  added.Mesh->ShallowCopy(surface);
  this->Data->Surfaces.push_back(added);
  this->Data->Points = points;
  this->Data->Cells = cells;
  this->Data->Tracer.reset();
  this->Modified();
  return this->GetNumberOfSurfaces() - 1;
}

//------------------------------------------------------------------------------
void vtkTracedScene::RemoveAllSurfaces()
{
  this->Data->Surfaces.clear();
  this->Data->Points = this->Data->Cells = 0.0;
  this->Data->Tracer.reset();
  this->Modified();
}

//------------------------------------------------------------------------------
int vtkTracedScene::GetNumberOfSurfaces() { return static_cast<int>(this->Data->Surfaces.size()); }

//------------------------------------------------------------------------------
void vtkTracedScene::Build()
{
  if (this->Data->Tracer)
  {
    return;
  }
  auto tracer = std::make_unique<SurfaceTracer>();
  for (vtkTracedSurfaces::Surface& surface : this->Data->Surfaces)
  {
    tracer->AddSurface(surface.Mesh, surface.Matrix.data());
    this->Data->TakeNormals(surface);
  }
  tracer->Build();
  this->Data->Tracer = std::move(tracer);
}

//------------------------------------------------------------------------------
const vtkTracedSurfaces& vtkTracedScene::GetSurfaces()
{
  this->Build();
  return *this->Data;
}

//------------------------------------------------------------------------------
vtkIdType vtkTracedScene::GetNumberOfTriangles()
{
  this->Build();
  return this->Data->Tracer->GetNumberOfTriangles();
}

//------------------------------------------------------------------------------
vtkIdType vtkTracedScene::GetNumberOfSkippedTriangles()
{
  this->Build();
  return this->Data->Tracer->GetNumberOfSkippedTriangles();
}

//------------------------------------------------------------------------------
void vtkTracedScene::GetBounds(double bounds[6])
{
  this->Build();
  std::fill(bounds, bounds + 6, 0.0);
  this->Data->Tracer->GetBounds(bounds);
}

//------------------------------------------------------------------------------
bool vtkTracedScene::CastRays(vtkDataArray* origins, vtkDataArray* directions, vtkPolyData* hits)
{
  if (!origins || !directions || !hits || origins->GetNumberOfComponents() != 3 ||
      directions->GetNumberOfComponents() != 3 ||
      origins->GetNumberOfTuples() != directions->GetNumberOfTuples())
  {
    vtkErrorMacro(
      "CastRays: origins and directions must have 3 components and equally many tuples, "
      "and there must be hits to fill.");
    return false;
  }
  const vtkTracedSurfaces& scene = this->GetSurfaces();
  const vtkIdType count = origins->GetNumberOfTuples();
  std::vector<SurfacePoint> found(static_cast<std::size_t>(count));
  measuredbrdf::ParallelForEach(
    count,
    [&](vtkIdType k)
    {
      glm::dvec3 origin;
      glm::dvec3 direction;
      origins->GetTuple(k, &origin.x);
      directions->GetTuple(k, &direction.x);
      scene.Cast(origin, direction, found[k]);
    },
    nullptr, 0);
  FillHits(found, hits);
  return true;
}

//------------------------------------------------------------------------------
bool vtkTracedScene::DrawVisiblePoints(
  vtkIdType count, const double viewDirection[3], vtkPolyData* hits, vtkDataArray* views)
{
  const glm::dvec3 view(viewDirection[0], viewDirection[1], viewDirection[2]);
  if (!hits || !views || count < 1 || count > MostPoints || !std::isfinite(glm::length(view)))
  {
    vtkErrorMacro("DrawVisiblePoints: found " << count << " points, expected 1 to " << MostPoints
                                              << ", a finite view direction, hits and views.");
    return false;
  }
  const std::vector<SurfacePoint> found = this->GetSurfaces().DrawPoints(count, view);
  FillHits(found, hits);
  views->SetNumberOfComponents(3);
  views->SetNumberOfTuples(static_cast<vtkIdType>(found.size()));
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    views->SetTuple(static_cast<vtkIdType>(k), &found[k].View.x);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkTracedScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfSurfaces: " << this->GetNumberOfSurfaces() << "\n";
}

//------------------------------------------------------------------------------
// By the inverse transposed matrix, up to a factor: its cofactors.
void vtkTracedSurfaces::TakeNormals(Surface& surface) const
{
  vtkDataArray* normals = surface.Mesh->GetPointData()->GetNormals();
  surface.Normals.clear();
  if (!normals || normals->GetNumberOfComponents() != 3 ||
      normals->GetNumberOfTuples() != surface.Mesh->GetNumberOfPoints())
  {
    return;
  }
  const std::array<double, 16>& m = surface.Matrix;
  const glm::dvec3 x(m[0], m[4], m[8]);
  const glm::dvec3 y(m[1], m[5], m[9]);
  const glm::dvec3 z(m[2], m[6], m[10]);
  const glm::dmat3 turn(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  const vtkIdType count = normals->GetNumberOfTuples();
  for (vtkIdType k = 0; k < count; ++k)
  {
    glm::dvec3 n;
    normals->GetTuple(k, &n.x);
    n = turn * n;
    const double length = glm::length(n);
    surface.Normals.push_back(
      length > 0.0 && std::isfinite(length) ? glm::vec3(n / length) : glm::vec3(0.0f));
  }
}

//------------------------------------------------------------------------------
bool vtkTracedSurfaces::Cast(
  const glm::dvec3& origin, const glm::dvec3& direction, SurfacePoint& point) const
{
  const std::optional<SurfaceTracer::Hit> hit = this->Tracer->Intersect(origin, direction, Far);
  if (!hit)
  {
    return false;
  }
  glm::dvec3 n[3];
  point = SurfacePoint();
  point.Facet = Toward(hit->Normal, -direction);
  point.Surface = hit->Surface;
  point.Cell = hit->Cell;
  const std::vector<glm::vec3>& normals = this->Surfaces[hit->Surface].Normals;
  for (int k = 0; k < 3; ++k)
  {
    point.Position += hit->Barycentrics[k] * hit->Corners[k];
    if (!normals.empty())
    {
      n[k] = Toward(normals[hit->Points[k]], point.Facet);
      point.Normal += hit->Barycentrics[k] * n[k];
    }
  }
  const double length = glm::length(point.Normal);
  if (!(length > 1e-6))
  {
    point.Normal = point.Facet;
    return true;
  }
  point.Normal /= length;
  // Hanika 2021: onto the planes through the corners, where these lie above.
  glm::dvec3 lift(0.0);
  for (int k = 0; k < 3; ++k)
  {
    lift -=
      hit->Barycentrics[k] * std::min(glm::dot(point.Position - hit->Corners[k], n[k]), 0.0) * n[k];
  }
  point.Position += lift;
  return true;
}

//------------------------------------------------------------------------------
std::vector<SurfacePoint> vtkTracedSurfaces::DrawPoints(
  vtkIdType count, const glm::dvec3& viewDirection) const
{
  double bounds[6] = {};
  this->Tracer->GetBounds(bounds);
  const glm::dvec3 low(bounds[0], bounds[2], bounds[4]);
  const glm::dvec3 high(bounds[1], bounds[3], bounds[5]);
  const double radius = 0.5 * glm::length(high - low);
  const double length = glm::length(viewDirection);
  std::vector<SurfacePoint> found;
  const vtkIdType tries = radius > 0.0 ? std::max(MostTries * count, FewestTries) : 0;
  for (vtkIdType k = 0; k < tries && static_cast<vtkIdType>(found.size()) < count; ++k)
  {
    const auto index = static_cast<std::uint32_t>(k + 1);
    const double z = 1.0 - 2.0 * measuredbrdf::RadicalInverse(index, 2);
    const double azimuth = 2.0 * measuredbrdf::Pi * measuredbrdf::RadicalInverse(index, 3);
    const double sine = std::sqrt(std::max(1.0 - z * z, 0.0));
    const glm::dvec3 view = length > 0.0
                              ? viewDirection / length
                              : glm::dvec3(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
    const measuredbrdf::Frame frame = measuredbrdf::FrameAbout(view);
    const double r = radius * std::sqrt(measuredbrdf::RadicalInverse(index, 5));
    const double turn = 2.0 * measuredbrdf::Pi * measuredbrdf::RadicalInverse(index, 7);
    const glm::dvec3 origin = 0.5 * low + 0.5 * high + 2.0 * radius * view +
                              r * (std::cos(turn) * frame[0] + std::sin(turn) * frame[1]);
    SurfacePoint point;
    if (this->Cast(origin, -view, point))
    {
      point.View = view;
      found.push_back(point);
    }
  }
  return found;
}

//------------------------------------------------------------------------------
glm::dvec3 vtkTracedSurfaces::Leave(const SurfacePoint& from) const
{
  return from.Position + this->Tracer->GetOffset() * from.Facet;
}

//------------------------------------------------------------------------------
bool vtkTracedSurfaces::IsHidden(const SurfacePoint& from, const glm::dvec3& direction) const
{
  return this->Tracer->IsOccluded(this->Leave(from), direction, Far);
}
