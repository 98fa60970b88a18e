// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaterialLegendActor.h"

#include "NumberText.h"
#include "ParallelFor.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkTexturedActor2D.h"
#include "vtkViewport.h"
#include "vtkWindow.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

using namespace measuredbrdf;

namespace
{
constexpr int SpherePixels = 96;     // across a picture
constexpr double Tolerance = 0.05;   // of the pictures
constexpr double LargestText = 0.33; // of a sphere's diameter, for its name
constexpr double TitleShare = 0.1;   // of the legend's height, at most
constexpr double LegendGap = 0.06;   // between entries, as a share of their size

// A picture of a sphere of a material, RGBA in floats, radiance^(1/2.2), transparent around the
// sphere. Seen along -z from a great distance. Null where there is nothing to integrate with.
vtkSmartPointer<vtkImageData> MakeMaterialPicture(vtkBRDF* brdf, vtkEnvironment* environment)
{
  vtkNew<vtkRadiancePlanner> planner;
  planner->SetBRDF(brdf);
  planner->SetEnvironment(environment);
  planner->SetErrorTolerance(Tolerance);
  if (!planner->Update())
  {
    return nullptr;
  }
  const auto integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
  vtkNew<vtkDoubleArray> normals, views, radiance;
  normals->SetNumberOfComponents(3);
  views->SetNumberOfComponents(3);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(SpherePixels, SpherePixels, 1);
  image->AllocateScalars(VTK_FLOAT, 4);
  vtkDataArray* rgba = image->GetPointData()->GetScalars();
  const double radius = 0.5 * SpherePixels - 1.0; // room for a soft edge
  for (vtkIdType k = 0; k < image->GetNumberOfPoints(); ++k)
  {
    glm::dvec2 place(k % SpherePixels + 0.5, k / SpherePixels + 0.5);
    place = (place - 0.5 * SpherePixels) / radius;
    const double r = glm::length(place);
    rgba->SetComponent(k, 3, std::clamp((1.0 - r) * radius + 0.5, 0.0, 1.0));
    place *= std::min(1.0, 0.999 / r);
    normals->InsertNextTuple3(place.x, place.y, std::sqrt(1.0 - glm::dot(place, place)));
    views->InsertNextTuple3(0.0, 0.0, 1.0);
  }
  if (!integrator || !integrator->Integrate(normals, views, radiance))
  {
    return nullptr;
  }
  for (vtkIdType k = 0; k < 3 * image->GetNumberOfPoints(); ++k)
  {
    const double value = std::max(radiance->GetValue(k), 0.0);
    rgba->SetComponent(k / 3, static_cast<int>(k % 3), std::pow(value, 1.0 / 2.2));
  }
  return image;
}

// A square with a picture, in pixels of the viewport.
vtkSmartPointer<vtkActor2D> MakeSquare(
  vtkImageData* picture, double left, double bottom, double size)
{
  vtkNew<vtkPoints> corners;
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  for (const glm::dvec2 corner :
    { glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1) })
  {
    corners->InsertNextPoint(left + size * corner.x, bottom + size * corner.y, 0.0);
    coordinates->InsertNextTuple2(corner.x, corner.y);
  }
  vtkNew<vtkPolyData> square;
  square->SetPoints(corners);
  square->GetPointData()->SetTCoords(coordinates);
  square->AllocateExact(1, 4);
  const vtkIdType ids[4] = { 0, 1, 2, 3 };
  square->InsertNextCell(VTK_QUAD, 4, ids);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(square);
  vtkNew<vtkTexture> texture;
  texture->InterpolateOn();
  texture->SetColorModeToDirectScalars();
  texture->SetInputData(picture);
  auto actor = vtkSmartPointer<vtkTexturedActor2D>::New();
  actor->SetMapper(mapper);
  actor->SetTexture(texture);
  return actor;
}

vtkSmartPointer<vtkTextActor> MakeText(
  const std::string& words, vtkTextProperty* property, double left, double y)
{
  auto text = vtkSmartPointer<vtkTextActor>::New();
  text->SetInput(words.c_str());
  text->GetTextProperty()->ShallowCopy(property);
  text->GetTextProperty()->SetJustificationToLeft();
  text->GetTextProperty()->SetVerticalJustificationToCentered();
  text->SetPosition(left, y);
  return text;
}
}

struct vtkMaterialLegendActor::Internals
{
  // A material and the light, as they were when its picture was made; times are never used twice.
  using Pictures = std::map<std::pair<vtkBRDF*, vtkMTimeType>, vtkSmartPointer<vtkImageData>>;

  vtkSmartPointer<vtkEnvironment> Sky; // where there is no environment
  vtkNew<vtkTextProperty> TextProperty;
  Pictures Known;
  std::vector<vtkSmartPointer<vtkActor2D>> Actors; // all that is drawn
  std::vector<double> LayoutOf;                    // what the last layout depended on
  vtkMTimeType LayoutTime = 0;
};

vtkStandardNewMacro(vtkMaterialLegendActor);

//------------------------------------------------------------------------------
vtkMaterialLegendActor::vtkMaterialLegendActor()
  : Impl(new Internals)
{
  this->PositionCoordinate->SetCoordinateSystemToNormalizedViewport();
  this->PositionCoordinate->SetValue(0.8, 0.1);
  this->Position2Coordinate->SetValue(0.18, 0.8);
}

//------------------------------------------------------------------------------
vtkMaterialLegendActor::~vtkMaterialLegendActor() = default;

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::SetMaterialMap(vtkMaterialMap* map)
{
  measuredbrdfAssignMacro(MaterialMap, map);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::SetEnvironment(vtkEnvironment* environment)
{
  measuredbrdfAssignMacro(Environment, environment);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::SetTitle(const std::string& title)
{
  measuredbrdfAssignMacro(Title, title);
}

//------------------------------------------------------------------------------
vtkMaterialMap* vtkMaterialLegendActor::GetMaterialMap() { return this->MaterialMap; }
vtkEnvironment* vtkMaterialLegendActor::GetEnvironment() { return this->Environment; }

//------------------------------------------------------------------------------
vtkTextProperty* vtkMaterialLegendActor::GetTextProperty() { return this->Impl->TextProperty; }

//------------------------------------------------------------------------------
vtkMTimeType vtkMaterialLegendActor::GetMTime()
{
  vtkMTimeType time = std::max(this->Superclass::GetMTime(), this->Impl->TextProperty->GetMTime());
  time = std::max(time, this->MaterialMap ? this->MaterialMap->GetMTime() : 0);
  return std::max(time, this->Environment ? this->Environment->GetMTime() : 0);
}

//------------------------------------------------------------------------------
// Entries stand in equal cells, each a sphere with its name to the right, and go down the columns.
void vtkMaterialLegendActor::UpdateLayout(vtkViewport* viewport)
{
  Internals& impl = *this->Impl;
  const int* low = this->PositionCoordinate->GetComputedViewportValue(viewport);
  const double left = low[0];
  const double bottom = low[1];
  const int* high = this->Position2Coordinate->GetComputedViewportValue(viewport);
  const double width = std::max(high[0] - left, 8.0);
  double height = std::max(high[1] - bottom, 8.0);
  vtkWindow* window = viewport->GetVTKWindow();
  const std::vector<double> from = { left, bottom, width, height,
    static_cast<double>(window ? window->GetDPI() : 0) };
  const vtkMTimeType time = this->GetMTime();
  if (from == impl.LayoutOf && time == impl.LayoutTime)
  {
    return; // fonts take time
  }
  impl.LayoutOf = from;
  impl.LayoutTime = time;
  this->ReleaseGraphicsResources(window);
  impl.Actors.clear();
  if (!this->Environment && !impl.Sky)
  {
    impl.Sky = vtkSmartPointer<vtkEnvironment>::New();
    impl.Sky->SetToProceduralSky();
  }
  vtkEnvironment* light = this->Environment ? this->Environment : impl.Sky;

  std::vector<int> shown;
  for (int k = 0; this->MaterialMap && k < this->MaterialMap->GetNumberOfMaterials(); ++k)
  {
    if (this->MaterialMap->GetBRDF(k))
    {
      shown.push_back(k);
    }
  }
  const int count = static_cast<int>(shown.size());
  if (count > 0 && !this->Title.empty())
  {
    const auto title = MakeText(this->Title, impl.TextProperty, left, bottom + height);
    title->GetTextProperty()->SetVerticalJustificationToTop();
    title->SetConstrainedFontSize(
      viewport, static_cast<int>(width), static_cast<int>(TitleShare * height));
    impl.Actors.push_back(title);
    height -= 1.2 * TitleShare * height;
  }
  // The columns with the largest spheres that leave most of the width to the names.
  const auto getRows = [count](int columns) { return (count + columns - 1) / columns; };
  const auto getSphere = [&](int columns)
  {
    const double share = columns > 1 ? 0.25 : 0.5;
    return (1.0 - LegendGap) * std::min(share * width / columns, height / getRows(columns));
  };
  int columns = 1;
  for (int more = 2; more <= count; ++more)
  {
    columns = getSphere(more) > getSphere(columns) ? more : columns;
  }
  const double sphere = count > 0 ? getSphere(columns) : 0.0;
  Internals::Pictures pictures;
  std::vector<vtkTextActor*> names;
  for (int place = 0; place < count; ++place)
  {
    const int rows = getRows(columns);
    const double x = left + place / rows * width / columns;
    const double y = bottom + height - (place % rows + 0.5) * height / rows;
    const int k = shown[place];
    vtkBRDF* brdf = this->MaterialMap->GetBRDF(k);
    const std::pair<vtkBRDF*, vtkMTimeType> key(
      brdf, std::max(brdf->GetMTime(), light->GetMTime()));
    const auto known = impl.Known.find(key);
    const auto [picture, isNew] = pictures.try_emplace(key);
    if (isNew)
    {
      picture->second =
        known != impl.Known.end() ? known->second : MakeMaterialPicture(brdf, light);
    }
    if (picture->second)
    {
      impl.Actors.push_back(MakeSquare(picture->second, x, y - 0.5 * sphere, sphere));
    }
    else if (isNew && known == impl.Known.end())
    {
      vtkErrorMacro("There is no picture of material " << k << ".");
    }
    const std::string name = this->MaterialMap->GetName(k);
    const auto text = MakeText(name.empty() ? NumberText(this->MaterialMap->GetValue(k)) : name,
      impl.TextProperty, x + (1.0 + LegendGap) * sphere, y);
    names.push_back(text);
    impl.Actors.push_back(text);
  }
  impl.Known = std::move(pictures);
  if (count > 0) // all names have one size: the largest with which they fit
  {
    const double room = width / columns - (1.0 + 2.0 * LegendGap) * sphere;
    int size[2];
    vtkTextActor::SetMultipleConstrainedFontSize(viewport, static_cast<int>(std::max(room, 1.0)),
      static_cast<int>(std::max(LargestText * sphere, 1.0)), names.data(), count, size);
  }
}

//------------------------------------------------------------------------------
int vtkMaterialLegendActor::RenderOverlay(vtkViewport* viewport)
{
  int drawn = 0;
  for (vtkActor2D* actor : this->Impl->Actors)
  {
    drawn += viewport ? actor->RenderOverlay(viewport) : 0;
  }
  return drawn;
}

//------------------------------------------------------------------------------
int vtkMaterialLegendActor::RenderOpaqueGeometry(vtkViewport* viewport)
{
  int drawn = 0;
  if (viewport && RunGuarded(this, "RenderOpaqueGeometry", [&]() { this->UpdateLayout(viewport); }))
  {
    for (vtkActor2D* actor : this->Impl->Actors)
    {
      drawn += actor->RenderOpaqueGeometry(viewport);
    }
  }
  return drawn;
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::ReleaseGraphicsResources(vtkWindow* window)
{
  for (vtkActor2D* actor : this->Impl->Actors)
  {
    actor->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaterialMap: " << this->MaterialMap.Get() << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
  os << indent << "Title: " << this->Title << "\n";
}
