// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFLobeSource.h"

#include "HalfVector.h"
#include "LocalFrame.h"
#include "MaterialSource.h"
#include "ParallelFor.h"
#include "Setters.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBRDFLobeSource);

namespace
{
//------------------------------------------------------------------------------
// Directions on half circles from the mirror direction m to the horizon. Along each, the angle from
// m grows with the square of the point's number. The first is m, the others go circle by circle.
std::vector<glm::dvec3> MakeDirections(const glm::dvec3& mirror, int radial, int circular)
{
  const Frame axes = FrameAbout(mirror); // the third is m
  std::vector<glm::dvec3> directions = { mirror };
  for (int k = 0; k < radial * circular; ++k)
  {
    const double step = (k / circular + 1.0) / radial;
    const double azimuth = 2.0 * Pi * (k % circular) / circular;
    const glm::dvec3 side = std::cos(azimuth) * axes[0] + std::sin(azimuth) * axes[1];
    // cos(a) m.z + sin(a) side.z = 0 at the horizon.
    const double angle = std::atan2(mirror.z, -side.z) * step * step;
    glm::dvec3 direction = std::cos(angle) * mirror + std::sin(angle) * side;
    direction.z = step < 1.0 ? std::max(direction.z, 0.0) : 0.0; // no rounding on the rim
    directions.push_back(direction);
  }
  return directions;
}

//------------------------------------------------------------------------------
// Of points from the first one on. They face outwards of what lies above the surface, or, turned,
// below it.
void AddCells(int radial, int circular, vtkIdType first, bool below, vtkCellArray* cells)
{
  const auto add = [&](std::vector<vtkIdType> polygon)
  {
    for (vtkIdType& point : polygon)
    {
      point += first;
    }
    if (below)
    {
      std::reverse(polygon.begin(), polygon.end());
    }
    cells->InsertNextCell(static_cast<vtkIdType>(polygon.size()), polygon.data());
  };
  for (vtkIdType k = 0; k < circular; ++k)
  {
    const vtkIdType next = (k + 1) % circular;
    add({ 0, 1 + k, 1 + next });
    for (vtkIdType inner = 1; inner < (radial - 1) * circular; inner += circular)
    {
      const vtkIdType outer = inner + circular;
      add({ inner + k, outer + k, outer + next, inner + next });
    }
  }
}

//------------------------------------------------------------------------------
double GetDistance(int scaling, double luminance)
{
  return scaling == vtkBRDFLobeSource::LOGARITHMIC ? std::log1p(100.0 * luminance) : luminance;
}
}

//------------------------------------------------------------------------------
vtkBRDFLobeSource::vtkBRDFLobeSource() { this->SetNumberOfInputPorts(0); }

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBRDFLobeSource, ThetaI, double, 0.0, 89.9);
measuredbrdfSetClampedMacro(vtkBRDFLobeSource, PhiI, double, -360.0, 360.0);
measuredbrdfSetClampedMacro(vtkBRDFLobeSource, RadialResolution, int, 2, 2048);
measuredbrdfSetClampedMacro(vtkBRDFLobeSource, CircularResolution, int, 3, 2048);
measuredbrdfSetInRangeMacro(vtkBRDFLobeSource, Scaling, int, LINEAR, LOGARITHMIC);
measuredbrdfSetClampedMacro(vtkBRDFLobeSource, ScaleFactor, double, 1e-6, 1e6);

//------------------------------------------------------------------------------
void vtkBRDFLobeSource::SetBRDF(vtkBRDF* brdf) { measuredbrdfAssignMacro(BRDF, brdf); }

//------------------------------------------------------------------------------
void vtkBRDFLobeSource::SetTransmission(vtkBTDF* transmission)
{
  measuredbrdfAssignMacro(Transmission, transmission);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkBRDFLobeSource::GetMTime()
{
  const vtkMTimeType time = GetLatestTime(this->Superclass::GetMTime(), this->BRDF);
  return this->Transmission ? std::max(time, this->Transmission->GetMTime()) : time;
}

//------------------------------------------------------------------------------
int vtkBRDFLobeSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  return RunGuarded(this, "RequestData", [&]() { this->Fill(vtkPolyData::GetData(outputVector)); });
}

//------------------------------------------------------------------------------
void vtkBRDFLobeSource::Fill(vtkPolyData* output)
{
  if (!this->BRDF)
  {
    throw std::runtime_error("There is no BRDF; call SetBRDF first");
  }
  const glm::dvec3 i = ToDirection(std::cos(ToRadians(this->ThetaI)), ToRadians(this->PhiI));
  std::vector<glm::dvec3> directions =
    MakeDirections({ -i.x, -i.y, i.z }, this->RadialResolution, this->CircularResolution);
  const auto above = static_cast<vtkIdType>(directions.size());
  for (vtkIdType k = 0; this->Transmission && k < above; ++k) // as many below the surface
  {
    const glm::dvec3 up = directions[k];
    directions.emplace_back(up.x, up.y, -up.z);
  }
  const auto count = static_cast<vtkIdType>(directions.size());
  const auto values = NewArray<vtkFloatArray>("BRDF", 3, count);
  const auto radiances = NewArray<vtkFloatArray>("Radiance", 3, count);
  const auto luminances = NewArray<vtkFloatArray>("Luminance", 1, count);
  const auto named = NewArray<vtkFloatArray>("Direction", 3, count);
  const auto transmitted = NewArray<vtkFloatArray>("Transmitted", 1, count);
  this->BRDF->Prepare();
  if (this->Transmission)
  {
    this->Transmission->Prepare();
  }
  vtkBRDF* brdf = this->BRDF;
  vtkBTDF* btdf = this->Transmission;
  measuredbrdf::ParallelForEach(
    count,
    [&](vtkIdType k)
    {
      const glm::dvec3& o = directions[k];
      glm::dvec3 f;
      k < above ? brdf->Evaluate(glm::value_ptr(i), glm::value_ptr(o), glm::value_ptr(f))
                : btdf->Evaluate(glm::value_ptr(i), glm::value_ptr(o), glm::value_ptr(f));
      const glm::dvec3 radiance = f * i.z;
      values->SetTypedTuple(k, glm::value_ptr(glm::vec3(f)));
      radiances->SetTypedTuple(k, glm::value_ptr(glm::vec3(radiance)));
      luminances->SetValue(k, static_cast<float>(GetLuminance(radiance)));
      named->SetTypedTuple(k, glm::value_ptr(glm::vec3(o)));
      transmitted->SetValue(k, k < above ? 0.0f : 1.0f);
    },
    nullptr, 0);

  double factor = this->ScaleFactor;
  if (this->Normalize)
  {
    const double farthest = GetDistance(this->Scaling, luminances->GetRange(0)[1]);
    factor = farthest > 0.0 ? factor / farthest : 0.0;
  }
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(count);
  for (vtkIdType k = 0; k < count; ++k)
  {
    const glm::dvec3 place =
      factor * GetDistance(this->Scaling, luminances->GetValue(k)) * directions[k];
    points->SetPoint(k, glm::value_ptr(place));
  }
  vtkNew<vtkCellArray> cells;
  for (vtkIdType first = 0; first < count; first += above)
  {
    AddCells(this->RadialResolution, this->CircularResolution, first, first > 0, cells);
  }
  output->SetPoints(points);
  output->SetPolys(cells);
  output->GetPointData()->AddArray(values);
  output->GetPointData()->AddArray(radiances);
  output->GetPointData()->AddArray(named);
  output->GetPointData()->SetScalars(luminances);
  if (btdf)
  {
    output->GetPointData()->AddArray(transmitted);
  }
}

//------------------------------------------------------------------------------
void vtkBRDFLobeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "Transmission: " << this->Transmission.Get() << "\n";
  os << indent << "ThetaI: " << this->ThetaI << "\n";
  os << indent << "PhiI: " << this->PhiI << "\n";
  os << indent << "RadialResolution: " << this->RadialResolution << "\n";
  os << indent << "CircularResolution: " << this->CircularResolution << "\n";
  os << indent << "Scaling: " << this->Scaling << "\n";
  os << indent << "ScaleFactor: " << this->ScaleFactor << "\n";
  os << indent << "Normalize: " << this->Normalize << "\n";
}
