// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleSet.h"

#include "PolygonTriangles.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
constexpr std::uint64_t MostElements = std::numeric_limits<std::uint32_t>::max() - 1u;

// SurfaceTracer::OffsetOrigin states the rule.
constexpr double OffsetOfExtent = 0x1p-20;
constexpr double OffsetOfPosition = 0x1p-48;

bool IsFinitePoint(const double* p)
{
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

glm::dvec3 GetPosition(vtkPolyData* surface, vtkIdType point)
{
  glm::dvec3 p;
  surface->GetPoint(point, &p.x);
  return p;
}
} // namespace

namespace measuredbrdf
{
//------------------------------------------------------------------------------
int TriangleSet::Add(vtkPolyData* surface, const double* matrix16)
{
  const std::uint64_t points = this->Positions.size() / 3;
  if (!surface ||
      points + static_cast<std::uint64_t>(surface->GetNumberOfPoints()) > MostElements ||
      this->Cells + static_cast<std::uint64_t>(surface->GetNumberOfCells()) > MostElements)
  {
    return -1;
  }
  const Start start{ static_cast<std::uint32_t>(points), static_cast<std::uint32_t>(this->Cells) };
  this->Starts.push_back(start);
  this->AddPoints(surface, matrix16);
  this->AddCells(surface, start);
  this->Cells += static_cast<std::uint64_t>(surface->GetNumberOfCells());
  return static_cast<int>(this->Starts.size()) - 1;
}

//------------------------------------------------------------------------------
void TriangleSet::AddPoints(vtkPolyData* surface, const double* m)
{
  const vtkIdType count = surface->GetNumberOfPoints();
  std::size_t next = this->Positions.size();
  this->Positions.resize(next + 3 * static_cast<std::size_t>(count));
  for (vtkIdType k = 0; k < count; ++k, next += 3)
  {
    const glm::dvec3 p = GetPosition(surface, k);
    for (int c = 0; c < 3; ++c)
    {
      this->Positions[next + static_cast<std::size_t>(c)] =
        m ? m[4 * c] * p.x + m[4 * c + 1] * p.y + m[4 * c + 2] * p.z + m[4 * c + 3] : p[c];
    }
  }
}

//------------------------------------------------------------------------------
void TriangleSet::AddTriangle(const Start& start, const vtkIdType corners[3], vtkIdType cell)
{
  Triangle triangle;
  for (int c = 0; c < 3; ++c)
  {
    triangle.Corners[c] = start.Point + static_cast<std::uint32_t>(corners[c]);
    if (!IsFinitePoint(&this->Positions[3 * static_cast<std::size_t>(triangle.Corners[c])]))
    {
      ++this->Skipped;
      return;
    }
  }
  triangle.Cell = start.Cell + static_cast<std::uint32_t>(cell);
  this->Triangles.push_back(triangle);
}

//------------------------------------------------------------------------------
void TriangleSet::AddCells(vtkPolyData* surface, const Start& start)
{
  const vtkIdType points = surface->GetNumberOfPoints();
  vtkIdType cell = surface->GetNumberOfVerts() + surface->GetNumberOfLines();
  std::vector<vtkIdType> corners;
  for (const bool strips : { false, true })
  {
    vtkCellArray* cells = strips ? surface->GetStrips() : surface->GetPolys();
    const auto next = vtk::TakeSmartPointer(cells->NewIterator());
    for (next->GoToFirstCell(); !next->IsDoneWithTraversal(); next->GoToNextCell(), ++cell)
    {
      vtkIdType count = 0;
      const vtkIdType* ids = nullptr;
      next->GetCurrentCell(count, ids);
      if (count < 3 ||
          std::any_of(ids, ids + count, [points](vtkIdType id) { return id < 0 || id >= points; }))
      {
        ++this->Skipped;
        continue;
      }
      corners.clear();
      if (!strips)
      {
        TriangulatePolygon(surface, count, ids, corners);
      }
      for (vtkIdType k = 2; strips && k < count; ++k)
      {
        corners.insert(corners.end(), { ids[k - 2], ids[k - 1 + k % 2], ids[k - k % 2] });
      }
      for (std::size_t k = 0; k + 2 < corners.size(); k += 3)
      {
        this->AddTriangle(start, &corners[k], cell);
      }
    }
  }
}

//------------------------------------------------------------------------------
void TriangleSet::Finish()
{
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(-low);
  for (const Triangle& triangle : this->Triangles)
  {
    for (const std::uint32_t corner : triangle.Corners)
    {
      const double* p = &this->Positions[3 * static_cast<std::size_t>(corner)];
      low = glm::min(low, glm::dvec3(p[0], p[1], p[2]));
      high = glm::max(high, glm::dvec3(p[0], p[1], p[2]));
    }
  }
  if (this->Triangles.empty())
  {
    low = high = glm::dvec3(0.0);
  }
  this->Middle = 0.5 * low + 0.5 * high;
  const glm::dvec3 half = high - this->Middle;
  const double longest = std::max({ half.x, half.y, half.z });
  int exponent = 0;
  std::frexp(longest, &exponent);
  this->Scale = longest > 0.0 ? std::ldexp(1.0, -exponent) : 1.0;
  this->Points.resize(this->Positions.size() + 1); // Embree reads 4 numbers of the last point
  for (std::size_t k = 0; k < this->Positions.size(); ++k)
  {
    const double value = (this->Positions[k] - this->Middle[static_cast<int>(k % 3)]) * this->Scale;
    // Points that no triangle uses may be anywhere.
    this->Points[k] = std::abs(value) <= 1.0 ? static_cast<float>(value) : 0.0f;
  }
  std::vector<double>().swap(this->Positions);

  const auto hasNoArea = [this](const Triangle& triangle)
  {
    const glm::dvec3 a = this->GetPoint(triangle.Corners[0]);
    const glm::dvec3 normal =
      glm::cross(this->GetPoint(triangle.Corners[1]) - a, this->GetPoint(triangle.Corners[2]) - a);
    const double area = glm::length(normal);
    return !(area > 0.0) || !std::isfinite(area);
  };
  const auto last = std::remove_if(this->Triangles.begin(), this->Triangles.end(), hasNoArea);
  this->Skipped += static_cast<vtkIdType>(this->Triangles.end() - last);
  this->Triangles.erase(last, this->Triangles.end());
  this->Triangles.shrink_to_fit();

  this->Low = (low - this->Middle) * this->Scale;
  this->High = half * this->Scale;
  const glm::dvec3 farthest = glm::abs(this->Middle) + half;
  this->Offset =
    OffsetOfExtent * longest + OffsetOfPosition * std::max({ farthest.x, farthest.y, farthest.z });
}

//------------------------------------------------------------------------------
int TriangleSet::FindSurface(std::uint32_t corner) const
{
  const auto after = std::upper_bound(this->Starts.begin(), this->Starts.end(), corner,
    [](std::uint32_t value, const Start& start) { return value < start.Point; });
  return static_cast<int>(after - this->Starts.begin()) - 1;
}

//------------------------------------------------------------------------------
std::size_t TriangleSet::GetBytes() const
{
  return this->Points.capacity() * sizeof(float) + this->Triangles.capacity() * sizeof(Triangle) +
         this->Starts.capacity() * sizeof(Start);
}
} // namespace measuredbrdf
