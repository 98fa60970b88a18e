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
// m grows with the square of the point's number.
class Hemisphere
{
public:
  Hemisphere(const glm::dvec3& mirror, int radial, int circular)
    : Axes(FrameAbout(mirror))
    , Radial(radial)
    , Circular(circular)
  {
  }

  vtkIdType GetNumberOfPoints() const
  {
    return 1 + static_cast<vtkIdType>(this->Radial) * this->Circular;
  }

  // Point 0 is m, the others go circle by circle; then come as many, mirrored at the surface.
  glm::dvec3 GetDirection(vtkIdType point) const
  {
    if (point >= this->GetNumberOfPoints())
    {
      const glm::dvec3 above = this->GetDirection(point - this->GetNumberOfPoints());
      return { above.x, above.y, -above.z };
    }
    if (point == 0)
    {
      return this->Axes[2];
    }
    const vtkIdType circle = 1 + (point - 1) / this->Circular;
    const double step = static_cast<double>(circle) / this->Radial;
    const double azimuth =
      2.0 * Pi * static_cast<double>((point - 1) % this->Circular) / this->Circular;
    const glm::dvec3 side = std::cos(azimuth) * this->Axes[0] + std::sin(azimuth) * this->Axes[1];
    // cos(a) m.z + sin(a) side.z = 0 at the horizon.
    const double horizon = std::atan2(this->Axes[2].z, -side.z);
    const double angle = horizon * step * step;
    glm::dvec3 direction = std::cos(angle) * this->Axes[2] + std::sin(angle) * side;
    direction.z = step < 1.0 ? std::max(direction.z, 0.0) : 0.0; // no rounding on the rim
    return direction;
  }

  // Of points from the first one on. They face outwards of what lies above the surface, or, turned,
  // below it.
  void AddCells(vtkCellArray* cells, vtkIdType first, bool below) const
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
    for (vtkIdType k = 0; k < this->Circular; ++k)
    {
      const vtkIdType next = (k + 1) % this->Circular;
      add({ 0, 1 + k, 1 + next });
      for (vtkIdType ring = 0; ring + 1 < this->Radial; ++ring)
      {
        const vtkIdType inner = 1 + ring * this->Circular;
        const vtkIdType outer = inner + this->Circular;
        add({ inner + k, outer + k, outer + next, inner + next });
      }
    }
  }

private:
  Frame Axes; // the third is m
  int Radial;
  int Circular;
};

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
  const double theta = this->ThetaI * Degree;
  const double phi = this->PhiI * Degree;
  const glm::dvec3 i(
    std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  const Hemisphere hemisphere(
    { -i.x, -i.y, i.z }, this->RadialResolution, this->CircularResolution);
  const vtkIdType above = hemisphere.GetNumberOfPoints();
  const vtkIdType count = this->Transmission ? 2 * above : above;
  // Above the surface, then, where there is transmission, as many below.
  const auto values = NewArray<vtkFloatArray>("BRDF", 3, count);
  const auto radiances = NewArray<vtkFloatArray>("Radiance", 3, count);
  const auto luminances = NewArray<vtkFloatArray>("Luminance", 1, count);
  const auto directions = NewArray<vtkFloatArray>("Direction", 3, count);
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
      const glm::dvec3 o = hemisphere.GetDirection(k);
      glm::dvec3 f;
      k < above ? brdf->Evaluate(glm::value_ptr(i), glm::value_ptr(o), glm::value_ptr(f))
                : btdf->Evaluate(glm::value_ptr(i), glm::value_ptr(o), glm::value_ptr(f));
      const glm::dvec3 radiance = f * i.z;
      values->SetTypedTuple(k, glm::value_ptr(glm::vec3(f)));
      radiances->SetTypedTuple(k, glm::value_ptr(glm::vec3(radiance)));
      luminances->SetValue(k, static_cast<float>(GetLuminance(radiance)));
      directions->SetTypedTuple(k, glm::value_ptr(glm::vec3(o)));
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
    const double distance = factor * GetDistance(this->Scaling, luminances->GetValue(k));
    const glm::dvec3 place = distance * hemisphere.GetDirection(k);
    points->SetPoint(k, glm::value_ptr(place));
  }
  vtkNew<vtkCellArray> cells;
  hemisphere.AddCells(cells, 0, false);
  if (btdf)
  {
    hemisphere.AddCells(cells, above, true);
  }

  output->SetPoints(points);
  output->SetPolys(cells);
  output->GetPointData()->AddArray(values);
  output->GetPointData()->AddArray(radiances);
  output->GetPointData()->AddArray(directions);
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
