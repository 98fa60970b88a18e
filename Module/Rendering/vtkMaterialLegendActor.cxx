// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaterialLegendActor.h"

#include "NumberText.h"
#include "ParallelFor.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkCellArray.h"
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
#include "vtkProperty2D.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkTexturedActor2D.h"
#include "vtkViewport.h"
#include "vtkWindow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

using namespace measuredbrdf;

namespace
{
constexpr double Tolerance = 0.05;       // of the pictures
constexpr double LargestText = 0.33;     // of a sphere's diameter, for a name beside it
constexpr double TitleShare = 0.1;       // of the legend's height, at most
constexpr int SmallestText = 9;          // pixels
constexpr double TitleTimes = 1.2;       // as large as the names, at most
constexpr double LegendGap = 0.06;       // between entries, as a share of their size
constexpr double LegendNameShare = 0.25; // of an entry's height, for a name below its sphere
constexpr double SphereShare = 0.5;      // of an entry's width, at most
constexpr double NarrowShare = 0.25;     // the same in several columns

// How entries are laid out: in equal cells, in pixels.
struct LegendGrid
{
  int Columns = 1;
  int Rows = 1;
  double Width = 0.0; // of a cell
  double Height = 0.0;
  double Sphere = 0.0; // diameter

  // The one with the largest spheres.
  static LegendGrid Find(int count, double width, double height, bool horizontal)
  {
    LegendGrid best;
    for (int lines = 1; lines <= count; ++lines) // columns, or rows where they stand side by side
    {
      const int others = (count + lines - 1) / lines;
      LegendGrid grid;
      grid.Columns = horizontal ? others : lines;
      grid.Rows = horizontal ? lines : others;
      grid.Width = width / grid.Columns;
      grid.Height = height / grid.Rows;
      grid.Sphere =
        (1.0 - LegendGap) *
        (horizontal ? std::min(grid.Width, (1.0 - LegendNameShare) * grid.Height)
                    : std::min((lines > 1 ? NarrowShare : SphereShare) * grid.Width, grid.Height));
      best = grid.Sphere > best.Sphere ? grid : best;
    }
    return best;
  }
};

}

namespace measuredbrdf
{
// A rectangle in pixels: its edges, or filled, with or without a texture.
struct LegendRectangle
{
  explicit LegendRectangle(bool filled)
  {
    const float corners[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(2);
    for (const float* corner : corners)
    {
      coordinates->InsertNextTuple(corner);
    }
    this->Points->SetNumberOfPoints(4);
    const vtkIdType ids[5] = { 0, 1, 2, 3, 0 };
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell(filled ? 4 : 5, ids);
    vtkNew<vtkPolyData> shape;
    shape->SetPoints(this->Points);
    shape->GetPointData()->SetTCoords(coordinates);
    filled ? shape->SetPolys(cells) : shape->SetLines(cells);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(shape);
    this->Actor->SetMapper(mapper);
  }

  void Place(double left, double bottom, double width, double height)
  {
    this->Points->SetPoint(0, left, bottom, 0.0);
    this->Points->SetPoint(1, left + width, bottom, 0.0);
    this->Points->SetPoint(2, left + width, bottom + height, 0.0);
    this->Points->SetPoint(3, left, bottom + height, 0.0);
    this->Points->Modified();
    this->Points->GetData()->Modified();
  }

  void SetPicture(vtkImageData* picture)
  {
    if (!this->Actor->GetTexture())
    {
      vtkNew<vtkTexture> texture;
      texture->InterpolateOn();
      texture->SetColorModeToDirectScalars();
      this->Actor->SetTexture(texture);
    }
    this->Actor->GetTexture()->SetInputDataObject(picture);
  }

  vtkNew<vtkPoints> Points;
  vtkNew<vtkTexturedActor2D> Actor;
};

} // namespace measuredbrdf

namespace
{
// As much of a text as is not wider, with dots where some is missing.
void CutToWidth(vtkTextActor* actor, const std::string& text, vtkViewport* viewport, double width)
{
  double size[2];
  for (std::size_t length = text.size();; --length)
  {
    while (length > 0 && length < text.size() && (text[length] & 0xC0) == 0x80)
    {
      --length; // within a character of UTF-8
    }
    actor->SetInput((length == text.size() ? text : text.substr(0, length) + "...").c_str());
    actor->GetSize(viewport, size);
    if (size[0] <= width || length == 0)
    {
      return;
    }
  }
}

// A picture of a sphere of a material, RGBA in floats, radiance^(1/2.2), transparent around the
// sphere. Seen along -z from a great distance. Null where there is nothing to integrate with.
vtkSmartPointer<vtkImageData> MakeMaterialPicture(
  vtkBRDF* brdf, vtkEnvironment* environment, int pixels)
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
  vtkNew<vtkDoubleArray> normals;
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkDoubleArray> radiance;
  for (vtkDoubleArray* array : { normals.Get(), views.Get() })
  {
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(pixels) * pixels);
  }
  const double radius = 0.5 * pixels - 1.0; // room for a soft edge
  std::vector<double> coverage;
  for (int y = 0; y < pixels; ++y)
  {
    for (int x = 0; x < pixels; ++x)
    {
      double u = (x + 0.5 - 0.5 * pixels) / radius;
      double v = (y + 0.5 - 0.5 * pixels) / radius;
      const double r = std::hypot(u, v);
      coverage.push_back(std::clamp((1.0 - r) * radius + 0.5, 0.0, 1.0));
      const double inside = std::min(1.0, 0.999 / std::max(r, 1e-9));
      u *= inside;
      v *= inside;
      const vtkIdType k = static_cast<vtkIdType>(y) * pixels + x;
      normals->SetTuple3(k, u, v, std::sqrt(std::max(1.0 - u * u - v * v, 0.0)));
      views->SetTuple3(k, 0.0, 0.0, 1.0);
    }
  }
  if (!integrator || !integrator->Integrate(normals, views, radiance))
  {
    return nullptr;
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(pixels, pixels, 1);
  image->AllocateScalars(VTK_FLOAT, 4);
  auto* rgba = static_cast<float*>(image->GetScalarPointer());
  for (std::size_t k = 0; k < coverage.size(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double value = radiance->GetComponent(static_cast<vtkIdType>(k), c);
      *rgba++ = static_cast<float>(std::pow(std::max(value, 0.0), 1.0 / 2.2));
    }
    *rgba++ = static_cast<float>(coverage[k]);
  }
  return image;
}
}

struct vtkMaterialLegendActor::Internals
{
  struct Entry
  {
    std::string Label;
    vtkImageData* Picture; // null: it could not be made
    std::shared_ptr<LegendRectangle> Square;
    vtkSmartPointer<vtkTextActor> Text;
  };
  struct Picture
  {
    vtkSmartPointer<vtkImageData> Image;
    vtkMTimeType Time = 0; // of what it was made of
    int Resolution = 0;
  };

  vtkSmartPointer<vtkEnvironment> Sky; // where there is no environment
  std::map<vtkSmartPointer<vtkBRDF>, Picture> Pictures;
  vtkNew<vtkTextProperty> TextProperty;
  vtkSmartPointer<vtkTextActor> TitleActor; // made when it is drawn: it needs VTK's fonts
  std::vector<Entry> Entries;
  LegendRectangle Background{ true };
  LegendRectangle Frame{ false };
  bool HasBackground = false; // in the last layout
  bool HasFrame = false;
  bool HasTitle = false;
  std::vector<double> LayoutOf; // what the last layout depended on
  vtkMTimeType LayoutTime = 0;

  template <typename Visit>
  void ForEachActor(const Visit& visit)
  {
    if (this->HasBackground && !this->Entries.empty())
    {
      visit(this->Background.Actor);
    }
    if (this->HasFrame && !this->Entries.empty())
    {
      visit(this->Frame.Actor);
    }
    for (Entry& entry : this->Entries)
    {
      if (entry.Picture)
      {
        visit(entry.Square->Actor);
      }
      visit(entry.Text);
    }
    if (this->HasTitle && this->TitleActor && !this->Entries.empty())
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
measuredbrdfSetClampedMacro(vtkMaterialLegendActor, SphereResolution, int, 8, 512);

//------------------------------------------------------------------------------
vtkTextProperty* vtkMaterialLegendActor::GetTextProperty() { return this->Impl->TextProperty; }

//------------------------------------------------------------------------------
vtkProperty2D* vtkMaterialLegendActor::GetBackgroundProperty()
{
  return this->Impl->Background.Actor->GetProperty();
}

//------------------------------------------------------------------------------
vtkProperty2D* vtkMaterialLegendActor::GetFrameProperty()
{
  return this->Impl->Frame.Actor->GetProperty();
}

//------------------------------------------------------------------------------
vtkMTimeType vtkMaterialLegendActor::GetMTime()
{
  vtkMTimeType time = std::max(this->Superclass::GetMTime(), this->Impl->TextProperty->GetMTime());
  time = std::max(time, this->GetBackgroundProperty()->GetMTime());
  time = std::max(time, this->GetFrameProperty()->GetMTime());
  time = std::max(time, this->MaterialMap ? this->MaterialMap->GetMTime() : 0);
  return std::max(time, this->Environment ? this->Environment->GetMTime() : 0);
}

//------------------------------------------------------------------------------
// A picture is made anew only where its own material, the light or the resolution changed.
void vtkMaterialLegendActor::UpdateEntries()
{
  vtkEnvironment* light = this->Environment;
  if (!light)
  {
    if (!this->Impl->Sky)
    {
      this->Impl->Sky = vtkSmartPointer<vtkEnvironment>::New();
      this->Impl->Sky->SetToProceduralSky();
    }
    light = this->Impl->Sky;
  }
  std::map<vtkSmartPointer<vtkBRDF>, Internals::Picture> pictures; // those still in use
  std::size_t shown = 0;
  for (int k = 0; this->MaterialMap && k < this->MaterialMap->GetNumberOfMaterials(); ++k)
  {
    vtkBRDF* brdf = this->MaterialMap->GetBRDF(k);
    if (!brdf)
    {
      continue;
    }
    Internals::Picture& picture =
      pictures.try_emplace(brdf, this->Impl->Pictures[brdf]).first->second;
    const vtkMTimeType time = std::max(brdf->GetMTime(), light->GetMTime());
    if (picture.Time != time || picture.Resolution != this->SphereResolution)
    {
      picture = { MakeMaterialPicture(brdf, light, this->SphereResolution), time,
        this->SphereResolution };
      if (!picture.Image)
      {
        vtkErrorMacro("There is no picture of material " << k << ".");
      }
    }
    if (shown == this->Impl->Entries.size())
    {
      this->Impl->Entries.push_back({ "", nullptr, std::make_shared<LegendRectangle>(true),
        vtkSmartPointer<vtkTextActor>::New() });
    }
    Internals::Entry& entry = this->Impl->Entries[shown++];
    const std::string name = this->MaterialMap->GetName(k);
    entry.Label = name.empty() ? NumberText(this->MaterialMap->GetValue(k)) : name;
    entry.Picture = picture.Image;
    entry.Square->SetPicture(picture.Image);
  }
  this->Impl->Entries.resize(shown);
  this->Impl->Pictures = std::move(pictures);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::UpdateLayout(vtkViewport* viewport)
{
  const int* low = this->PositionCoordinate->GetComputedViewportValue(viewport);
  const double left = low[0];
  const double bottom = low[1];
  const int* high = this->Position2Coordinate->GetComputedViewportValue(viewport);
  const double width = std::max(high[0] - left, 8.0);
  const double height = std::max(high[1] - bottom, 8.0);
  vtkWindow* window = viewport->GetVTKWindow();
  const std::vector<double> from = { left, bottom, width, height,
    static_cast<double>(window ? window->GetDPI() : 0) };
  const vtkMTimeType time = this->GetMTime();
  if (from == this->Impl->LayoutOf && time == this->Impl->LayoutTime)
  {
    return; // fonts take time
  }
  this->Impl->LayoutOf = from;
  this->Impl->LayoutTime = time;
  this->UpdateEntries();
  this->Impl->HasBackground = this->DrawBackground;
  this->Impl->HasFrame = this->DrawFrame;
  this->Impl->HasTitle = !this->Title.empty();
  this->Impl->Background.Place(left, bottom, width, height);
  this->Impl->Frame.Place(left, bottom, width, height);
  if (this->Impl->Entries.empty())
  {
    return;
  }
  const double room = this->Title.empty() ? height : (1.0 - 1.2 * TitleShare) * height;
  if (!this->Title.empty())
  {
    this->PlaceTitle(viewport, left, bottom + height, width, TitleShare * height);
  }
  this->PlaceEntries(viewport, left, bottom, width, room);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::PlaceTitle(
  vtkViewport* viewport, double left, double top, double width, double height)
{
  if (!this->Impl->TitleActor)
  {
    this->Impl->TitleActor = vtkSmartPointer<vtkTextActor>::New();
  }
  vtkTextActor* title = this->Impl->TitleActor;
  title->SetInput(this->Title.c_str());
  title->GetTextProperty()->ShallowCopy(this->Impl->TextProperty);
  title->SetConstrainedFontSize(viewport, static_cast<int>(width), static_cast<int>(height));
  title->GetTextProperty()->SetVerticalJustificationToTop();
  title->SetPosition(left, top);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::PlaceEntries(
  vtkViewport* viewport, double left, double bottom, double width, double height)
{
  std::vector<Internals::Entry>& entries = this->Impl->Entries;
  const int count = static_cast<int>(entries.size());
  const LegendGrid grid = LegendGrid::Find(count, width, height, this->Horizontal);
  const double sphere = grid.Sphere;
  const double room = this->Horizontal ? (1.0 - LegendGap) * grid.Width
                                       : grid.Width - (1.0 + 2.0 * LegendGap) * sphere;
  this->SizeNames(viewport, std::max(room, 1.0),
    std::max(this->Horizontal ? LegendNameShare * grid.Height : LargestText * sphere, 1.0));
  for (int k = 0; k < count; ++k)
  {
    const int column = this->Horizontal ? k % grid.Columns : k / grid.Rows;
    const int row = this->Horizontal ? k / grid.Columns : k % grid.Rows;
    const double x = left + column * grid.Width;
    const double top = bottom + height - row * grid.Height; // the first one on top
    Internals::Entry& entry = entries[static_cast<std::size_t>(k)];
    vtkTextProperty* text = entry.Text->GetTextProperty();
    if (this->Horizontal)
    {
      const double middle = x + 0.5 * grid.Width;
      entry.Square->Place(middle - 0.5 * sphere, top - sphere, sphere, sphere);
      text->SetJustificationToCentered();
      text->SetVerticalJustificationToTop();
      entry.Text->SetPosition(middle, top - (1.0 + LegendGap) * sphere);
    }
    else
    {
      const double middle = top - 0.5 * grid.Height;
      entry.Square->Place(x, middle - 0.5 * sphere, sphere, sphere);
      text->SetJustificationToLeft();
      text->SetVerticalJustificationToCentered();
      entry.Text->SetPosition(x + (1.0 + LegendGap) * sphere, middle);
    }
  }
}

//------------------------------------------------------------------------------
// One size for all: the largest with which they fit, or names are cut.
void vtkMaterialLegendActor::SizeNames(vtkViewport* viewport, double width, double height)
{
  std::vector<vtkTextActor*> texts;
  for (Internals::Entry& entry : this->Impl->Entries)
  {
    entry.Text->SetInput(entry.Label.c_str());
    entry.Text->GetTextProperty()->ShallowCopy(this->Impl->TextProperty);
    texts.push_back(entry.Text);
  }
  int size[2];
  vtkTextActor::SetMultipleConstrainedFontSize(viewport, static_cast<int>(width),
    static_cast<int>(height), texts.data(), static_cast<int>(texts.size()), size);
  int font = texts.front()->GetTextProperty()->GetFontSize();
  if (font < SmallestText)
  {
    font = SmallestText;
    for (Internals::Entry& entry : this->Impl->Entries)
    {
      entry.Text->GetTextProperty()->SetFontSize(font);
      CutToWidth(entry.Text, entry.Label, viewport, width);
    }
  }
  if (!this->Title.empty())
  {
    vtkTextProperty* title = this->Impl->TitleActor->GetTextProperty();
    title->SetFontSize(std::min(title->GetFontSize(), static_cast<int>(TitleTimes * font)));
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
  return known ? this->Impl->Entries[static_cast<std::size_t>(entry)].Picture : nullptr;
}

//------------------------------------------------------------------------------
int vtkMaterialLegendActor::RenderOverlay(vtkViewport* viewport)
{
  int drawn = 0;
  if (!viewport)
  {
    return drawn;
  }
  this->Impl->ForEachActor(
    [&drawn, viewport](vtkActor2D* actor) { drawn += actor->RenderOverlay(viewport); });
  return drawn;
}

//------------------------------------------------------------------------------
int vtkMaterialLegendActor::RenderOpaqueGeometry(vtkViewport* viewport)
{
  if (!viewport || !measuredbrdf::RunGuarded(
                     this, "RenderOpaqueGeometry", [&]() { this->UpdateLayout(viewport); }))
  {
    return 0;
  }
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
  os << indent << "MaterialMap: " << this->MaterialMap.Get() << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
  os << indent << "Title: " << this->Title << "\n";
  os << indent << "Horizontal: " << (this->Horizontal ? "On" : "Off") << "\n";
  os << indent << "DrawBackground: " << (this->DrawBackground ? "On" : "Off") << "\n";
  os << indent << "DrawFrame: " << (this->DrawFrame ? "On" : "Off") << "\n";
  os << indent << "SphereResolution: " << this->SphereResolution << "\n";
}
