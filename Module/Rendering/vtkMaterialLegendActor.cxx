// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaterialLegendActor.h"

#include "MaterialPicture.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkCellArray.h"
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
#include "vtkProperty2D.h"
#include "vtkSmartPointer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkTexturedActor2D.h"
#include "vtkViewport.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace
{
constexpr double Tolerance = 0.05;   // of the pictures
constexpr double Gap = 0.06;         // between entries, as a share of their size
constexpr double NameShare = 0.25;   // of an entry's height, for a name below its sphere
constexpr double LargestText = 0.33; // of a sphere's diameter, for a name beside it
constexpr double TitleShare = 0.1;   // of the legend's height, at most
constexpr double TitleTimes = 1.2;   // as large as the names, at most

// A square with a texture.
struct Sphere
{
  Sphere()
  {
    const float corners[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
    this->Coordinates->SetNumberOfComponents(2);
    for (const float* corner : corners)
    {
      this->Points->InsertNextPoint(0.0, 0.0, 0.0);
      this->Coordinates->InsertNextTuple(corner);
    }
    const vtkIdType ids[4] = { 0, 1, 2, 3 };
    vtkNew<vtkCellArray> polygons;
    polygons->InsertNextCell(4, ids);
    vtkNew<vtkPolyData> square;
    square->SetPoints(this->Points);
    square->SetPolys(polygons);
    square->GetPointData()->SetTCoords(this->Coordinates);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(square);
    this->Texture->InterpolateOn();
    this->Texture->SetColorModeToDirectScalars();
    this->Actor->SetMapper(mapper);
    this->Actor->SetTexture(this->Texture);
  }

  void Place(double x, double y, double size)
  {
    const double corners[4][2] = { { x, y }, { x + size, y }, { x + size, y + size },
      { x, y + size } };
    for (vtkIdType k = 0; k < 4; ++k)
    {
      this->Points->SetPoint(k, corners[k][0], corners[k][1], 0.0);
    }
    this->Points->Modified();
    this->Points->GetData()->Modified();
  }

  vtkNew<vtkPoints> Points;
  vtkNew<vtkFloatArray> Coordinates;
  vtkNew<vtkTexture> Texture;
  vtkNew<vtkTexturedActor2D> Actor;
};

struct Entry
{
  vtkSmartPointer<vtkBRDF> BRDF;
  std::string Label;
  vtkSmartPointer<vtkImageData> Picture; // null: it could not be made
  vtkMTimeType Time = 0;                 // of what it was made of
  int Resolution = 0;
  std::shared_ptr<Sphere> Square;
  vtkSmartPointer<vtkTextActor> Text;
};

std::string ToText(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}
}

struct vtkMaterialLegendActor::Internals
{
  vtkSmartPointer<vtkMaterialMap> Map;
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkSmartPointer<vtkEnvironment> Sky; // where there is none
  std::string Title;
  vtkNew<vtkTextProperty> TextProperty;
  vtkSmartPointer<vtkTextActor> TitleActor; // made when it is drawn: it needs VTK's fonts
  std::vector<Entry> Entries;

  template <typename Visit>
  void ForEachActor(const Visit& visit)
  {
    for (Entry& entry : this->Entries)
    {
      if (entry.Picture)
      {
        visit(entry.Square->Actor);
      }
      visit(entry.Text);
    }
    if (!this->Title.empty() && !this->Entries.empty() && this->TitleActor)
    {
      visit(this->TitleActor);
    }
  }
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
  if (this->Impl->Map != map)
  {
    this->Impl->Map = map;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMaterialMap* vtkMaterialLegendActor::GetMaterialMap() { return this->Impl->Map; }

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::SetEnvironment(vtkEnvironment* environment)
{
  if (this->Impl->Environment != environment)
  {
    this->Impl->Environment = environment;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkEnvironment* vtkMaterialLegendActor::GetEnvironment() { return this->Impl->Environment; }

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::SetTitle(const std::string& title)
{
  if (this->Impl->Title != title)
  {
    this->Impl->Title = title;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
std::string vtkMaterialLegendActor::GetTitle() { return this->Impl->Title; }

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkMaterialLegendActor, SphereResolution, int, 8, 512);

//------------------------------------------------------------------------------
vtkTextProperty* vtkMaterialLegendActor::GetTextProperty() { return this->Impl->TextProperty; }

//------------------------------------------------------------------------------
vtkMTimeType vtkMaterialLegendActor::GetMTime()
{
  vtkMTimeType time = std::max(this->Superclass::GetMTime(), this->Impl->TextProperty->GetMTime());
  time = std::max(time, this->Impl->Map ? this->Impl->Map->GetMTime() : 0);
  return std::max(time, this->Impl->Environment ? this->Impl->Environment->GetMTime() : 0);
}

//------------------------------------------------------------------------------
// A picture is made anew only where its own material, the light or the resolution changed.
void vtkMaterialLegendActor::UpdateEntries()
{
  vtkEnvironment* light = this->Impl->Environment;
  if (!light)
  {
    if (!this->Impl->Sky)
    {
      this->Impl->Sky = vtkSmartPointer<vtkEnvironment>::New();
      this->Impl->Sky->SetToProceduralSky();
    }
    light = this->Impl->Sky;
  }
  std::vector<Entry> entries;
  vtkMaterialMap* map = this->Impl->Map;
  for (int k = 0; map && k < map->GetNumberOfMaterials(); ++k)
  {
    vtkBRDF* brdf = map->GetBRDF(k);
    if (!brdf)
    {
      continue;
    }
    Entry entry;
    const auto known = std::find_if(this->Impl->Entries.begin(), this->Impl->Entries.end(),
      [brdf](const Entry& other) { return other.BRDF == brdf; });
    if (known != this->Impl->Entries.end())
    {
      entry = *known;
      this->Impl->Entries.erase(known);
    }
    if (!entry.Square)
    {
      entry.Square = std::make_shared<Sphere>();
      entry.Text = vtkSmartPointer<vtkTextActor>::New();
    }
    const vtkMTimeType time = std::max(brdf->GetMTime(), light->GetMTime());
    if (entry.BRDF != brdf || entry.Time != time || entry.Resolution != this->SphereResolution)
    {
      entry.BRDF = brdf;
      entry.Time = time;
      entry.Resolution = this->SphereResolution;
      entry.Picture =
        measuredbrdf::MakeMaterialPicture(brdf, light, this->SphereResolution, Tolerance);
      if (!entry.Picture)
      {
        vtkErrorMacro("There is no picture of material " << k << ".");
      }
      entry.Square->Texture->SetInputDataObject(entry.Picture);
    }
    entry.Label = map->GetName(k).empty() ? ToText(map->GetValue(k)) : map->GetName(k);
    entries.push_back(entry);
  }
  this->Impl->Entries = std::move(entries);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::UpdateLayout(vtkViewport* viewport)
{
  this->UpdateEntries();
  std::vector<Entry>& entries = this->Impl->Entries;
  if (entries.empty())
  {
    return;
  }
  const int* low = this->PositionCoordinate->GetComputedViewportValue(viewport);
  const double left = low[0];
  const double bottom = low[1];
  const int* high = this->Position2Coordinate->GetComputedViewportValue(viewport);
  const double width = std::max(high[0] - left, 8.0);
  double height = std::max(high[1] - bottom, 8.0);
  const double count = static_cast<double>(entries.size());
  std::vector<vtkTextActor*> texts;
  for (Entry& entry : entries)
  {
    entry.Text->SetInput(entry.Label.c_str());
    entry.Text->GetTextProperty()->ShallowCopy(this->Impl->TextProperty);
    texts.push_back(entry.Text);
  }
  int size[2];
  if (!this->Impl->Title.empty())
  {
    const double share = TitleShare * height;
    if (!this->Impl->TitleActor)
    {
      this->Impl->TitleActor = vtkSmartPointer<vtkTextActor>::New();
    }
    vtkTextActor* title = this->Impl->TitleActor;
    title->SetInput(this->Impl->Title.c_str());
    title->GetTextProperty()->ShallowCopy(this->Impl->TextProperty);
    title->SetConstrainedFontSize(viewport, static_cast<int>(width), static_cast<int>(share));
    title->GetTextProperty()->SetVerticalJustificationToTop();
    title->SetPosition(left, bottom + height);
    height -= 1.2 * share;
  }
  const double cell = this->Horizontal ? width / count : height / count;
  const double sphere = (1.0 - Gap) * (this->Horizontal ? std::min(cell, (1.0 - NameShare) * height)
                                                        : std::min(cell, 0.5 * width));
  const double room = this->Horizontal ? (1.0 - Gap) * cell : width - (1.0 + Gap) * sphere;
  const double lines = this->Horizontal ? NameShare * height : LargestText * sphere;
  vtkTextActor::SetMultipleConstrainedFontSize(viewport, static_cast<int>(std::max(room, 1.0)),
    static_cast<int>(std::max(lines, 1.0)), texts.data(), static_cast<int>(texts.size()), size);
  if (!this->Impl->Title.empty())
  {
    vtkTextProperty* title = this->Impl->TitleActor->GetTextProperty();
    title->SetFontSize(std::min(title->GetFontSize(),
      static_cast<int>(TitleTimes * texts.front()->GetTextProperty()->GetFontSize())));
  }
  for (std::size_t k = 0; k < entries.size(); ++k)
  {
    const double at = static_cast<double>(k);
    vtkTextProperty* text = entries[k].Text->GetTextProperty();
    if (this->Horizontal)
    {
      const double middle = left + (at + 0.5) * cell;
      entries[k].Square->Place(middle - 0.5 * sphere, bottom + height - sphere, sphere);
      text->SetJustificationToCentered();
      text->SetVerticalJustificationToTop();
      entries[k].Text->SetPosition(middle, bottom + height - (1.0 + Gap) * sphere);
    }
    else
    {
      const double middle = bottom + height - (at + 0.5) * cell; // the first one on top
      entries[k].Square->Place(left, middle - 0.5 * sphere, sphere);
      text->SetJustificationToLeft();
      text->SetVerticalJustificationToCentered();
      entries[k].Text->SetPosition(left + (1.0 + Gap) * sphere, middle);
    }
  }
}

//------------------------------------------------------------------------------
int vtkMaterialLegendActor::GetNumberOfEntries()
{
  this->UpdateEntries();
  return static_cast<int>(this->Impl->Entries.size());
}

//------------------------------------------------------------------------------
std::string vtkMaterialLegendActor::GetLabel(int entry)
{
  const bool known = entry >= 0 && entry < this->GetNumberOfEntries();
  return known ? this->Impl->Entries[static_cast<std::size_t>(entry)].Label : "";
}

//------------------------------------------------------------------------------
vtkImageData* vtkMaterialLegendActor::GetSphere(int entry)
{
  const bool known = entry >= 0 && entry < this->GetNumberOfEntries();
  return known ? this->Impl->Entries[static_cast<std::size_t>(entry)].Picture.Get() : nullptr;
}

//------------------------------------------------------------------------------
int vtkMaterialLegendActor::RenderOverlay(vtkViewport* viewport)
{
  int drawn = 0;
  this->Impl->ForEachActor(
    [&drawn, viewport](vtkActor2D* actor) { drawn += actor->RenderOverlay(viewport); });
  return drawn;
}

//------------------------------------------------------------------------------
int vtkMaterialLegendActor::RenderOpaqueGeometry(vtkViewport* viewport)
{
  this->UpdateLayout(viewport);
  int drawn = 0;
  this->Impl->ForEachActor(
    [&drawn, viewport](vtkActor2D* actor) { drawn += actor->RenderOpaqueGeometry(viewport); });
  return drawn;
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Impl->ForEachActor(
    [window](vtkActor2D* actor) { actor->ReleaseGraphicsResources(window); });
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaterialMap: " << this->Impl->Map.Get() << "\n";
  os << indent << "Environment: " << this->Impl->Environment.Get() << "\n";
  os << indent << "Title: " << this->Impl->Title << "\n";
  os << indent << "Horizontal: " << (this->Horizontal ? "On" : "Off") << "\n";
  os << indent << "SphereResolution: " << this->SphereResolution << "\n";
}
