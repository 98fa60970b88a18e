// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLightSet.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkLightSet);

//------------------------------------------------------------------------------
void vtkLightSet::RemoveAllLights()
{
  this->Lights.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkLightSet::AddLight(
  const double direction[3], const double irradiance[3], double solidAngle, double concentration)
{
  Light light = {};
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    vtkErrorMacro("AddLight: the direction (" << direction[0] << ", " << direction[1] << ", "
                                              << direction[2] << ") has no length.");
    return false;
  }
  for (int c = 0; c < 3; ++c)
  {
    if (!std::isfinite(irradiance[c]) || irradiance[c] < 0.0)
    {
      vtkErrorMacro("AddLight: the irradiance (" << irradiance[0] << ", " << irradiance[1] << ", "
                                                 << irradiance[2]
                                                 << ") is negative or not finite.");
      return false;
    }
    light.Direction[c] = direction[c] / length;
    light.Irradiance[c] = irradiance[c];
  }
  if (!(concentration >= 0.0))
  {
    vtkErrorMacro("AddLight: the concentration " << concentration << " is negative or NaN.");
    return false;
  }
  light.SolidAngle = solidAngle;
  light.Concentration = std::isfinite(concentration) ? concentration : 0.0;
  this->Lights.push_back(light);
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
const vtkLightSet::Light& vtkLightSet::GetLight(int index) const
{
  static const Light none = {};
  return index >= 0 && static_cast<std::size_t>(index) < this->Lights.size()
           ? this->Lights[static_cast<std::size_t>(index)]
           : none;
}

//------------------------------------------------------------------------------
int vtkLightSet::GetNumberOfLights() { return static_cast<int>(this->Lights.size()); }

//------------------------------------------------------------------------------
void vtkLightSet::GetDirection(int index, double direction[3])
{
  std::copy_n(this->GetLight(index).Direction, 3, direction);
}

//------------------------------------------------------------------------------
void vtkLightSet::GetIrradiance(int index, double irradiance[3])
{
  std::copy_n(this->GetLight(index).Irradiance, 3, irradiance);
}

//------------------------------------------------------------------------------
double vtkLightSet::GetSolidAngle(int index) { return this->GetLight(index).SolidAngle; }

//------------------------------------------------------------------------------
double vtkLightSet::GetConcentration(int index) { return this->GetLight(index).Concentration; }

//------------------------------------------------------------------------------
double vtkLightSet::GetConcentrationOfVariance(double v)
{
  if (!(v > 0.0))
  {
    return 0.0;
  }
  const double r = std::max(std::sqrt(std::max(1.0 - v, 0.0)), 1e-3);
  return r * (3.0 - r * r) / std::min(v, 1.0);
}

//------------------------------------------------------------------------------
void vtkLightSet::GetTotal(double rgb[3])
{
  std::fill_n(rgb, 3, 0.0);
  for (const Light& light : this->Lights)
  {
    for (int c = 0; c < 3; ++c)
    {
      rgb[c] += light.Irradiance[c];
    }
  }
}

//------------------------------------------------------------------------------
void vtkLightSet::SetLastRegion(int x0, int y0, int x1, int y1)
{
  if (this->Lights.empty() || x0 >= x1 || y0 >= y1)
  {
    vtkErrorMacro("SetLastRegion: no light, or an empty region.");
    return;
  }
  int* region = this->Lights.back().Region;
  region[0] = x0;
  region[1] = y0;
  region[2] = x1;
  region[3] = y1;
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkLightSet::GetRegion(int index, int region[4])
{
  std::copy_n(this->GetLight(index).Region, 4, region);
  return region[0] < region[2];
}

//------------------------------------------------------------------------------
vtkPolyData* vtkLightSet::NewPolyData()
{
  const vtkIdType count = this->GetNumberOfLights();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkPolyData* lights = vtkPolyData::New();
  const auto addArray = [lights, count](const char* name, int components)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(count);
    lights->GetPointData()->AddArray(array);
    return array.Get();
  };
  vtkDoubleArray* irradiance = addArray("Irradiance", 3);
  vtkDoubleArray* solidAngle = addArray("SolidAngle", 1);
  vtkDoubleArray* concentration = addArray("Concentration", 1);
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType k = 0; k < count; ++k)
  {
    const Light& light = this->Lights[static_cast<std::size_t>(k)];
    points->SetPoint(k, light.Direction);
    irradiance->SetTuple(k, light.Irradiance);
    solidAngle->SetValue(k, light.SolidAngle);
    concentration->SetValue(k, light.Concentration);
    vertices->InsertNextCell(1, &k);
  }
  lights->SetPoints(points);
  lights->SetVerts(vertices);
  return lights;
}

//------------------------------------------------------------------------------
bool vtkLightSet::SetPolyData(vtkPolyData* lights)
{
  vtkDataArray* irradiance = lights ? lights->GetPointData()->GetArray("Irradiance") : nullptr;
  if (!lights || !lights->GetPoints() || !irradiance || irradiance->GetNumberOfComponents() != 3 ||
      irradiance->GetNumberOfTuples() != lights->GetNumberOfPoints())
  {
    vtkErrorMacro("SetPolyData: points with a 3-component point array \"Irradiance\" are needed.");
    return false;
  }
  vtkDataArray* solidAngle = lights->GetPointData()->GetArray("SolidAngle");
  vtkDataArray* concentration = lights->GetPointData()->GetArray("Concentration");
  std::vector<Light> old;
  old.swap(this->Lights);
  for (vtkIdType k = 0; k < lights->GetNumberOfPoints(); ++k)
  {
    double direction[3];
    double rgb[3];
    lights->GetPoint(k, direction);
    irradiance->GetTuple(k, rgb);
    if (!this->AddLight(direction, rgb, solidAngle ? solidAngle->GetComponent(k, 0) : 0.0,
          concentration ? concentration->GetComponent(k, 0) : 0.0))
    {
      this->Lights.swap(old);
      return false;
    }
  }
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
void vtkLightSet::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLights: " << this->GetNumberOfLights() << "\n";
  double total[3];
  this->GetTotal(total);
  os << indent << "Total: " << total[0] << " " << total[1] << " " << total[2] << "\n";
}
