// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures that are put together: sheets of labelled tiles, a method beside the reference, a mesh
 * drawn in several ways, and an environment with the lights that stand for it.
 */

#ifndef Sheets_h
#define Sheets_h

#include "Inputs.h"
#include "Measuring.h"
#include "Picture.h"
#include "Scenes.h"
#include "Surface.h"

#include <string>
#include <vector>

class vtkEnvironment;
class vtkLightSet;

namespace tool
{
constexpr RGB White = { 1.0, 1.0, 1.0 };
constexpr RGB Gray = { 0.5, 0.5, 0.52 };

/// A sheet of dark paper.
Picture MakePaper(int width, int height);

/// Put a tile with its lower left corner at (x0, y0); what lies outside the sheet is left out.
void Paste(Picture& sheet, const Picture& tile, int x0, int y0);

/// RollOff of every value.
void RollOff(Picture& picture);

/// Scale that makes a white diffuse ball's mean brightness under this light a light gray.
double ChooseExposure(vtkEnvironment* environment);

/// A title above columns x rows of equal tiles, each with a name and up to three lines below.
class ContactSheet
{
public:
  ContactSheet(const std::string& title, int columns, int rows, int tileWidth, int tileHeight);

  /// A tile of display light, any size up to the tiles'; row 0 is the top one.
  void Add(
    int column, int row, const Picture& tile, const std::string& name, const std::string& note);

  /// As PNG.
  void Write(const std::string& path) const;

  /// Display light, as it would be written.
  const Picture& GetPicture() const { return this->Paper; }

private:
  int TileWidth;
  int TileHeight;
  int Font;
  int Gap;
  int CaptionHeight;
  Picture Paper;
  int Top;
};

/// What was drawn, and the figures that its caption gives.
struct ComparedPicture
{
  std::string Name;
  Picture Drawn = Picture(1, 1);
  double RelativeL1 = 0.0;
  double Frame = 0.0; // ms
  double Setup = 0.0; // ms, on the clock
};

/**
 * Method, reference, signed error and VTK's shading beside each other, as PNG. rgb, reference: the
 * method's and the exact radiance of the grid's pixels, 3 doubles each.
 */
void WriteComparisonSheet(const std::string& path, const std::string& title, const Grid& grid,
  const std::vector<double>& rgb, const std::vector<double>& reference,
  const ComparedPicture& method, const ComparedPicture& stock);
/// A sphere by a material and by what stands for it, under one light.
struct ComparedLight
{
  std::string Name;
  std::vector<double> Reference; // 3 doubles a pixel of the grid
  std::vector<double> Radiance;
  double RelativeL1;
  double Flip;
};

/**
 * A row for each light: the reference, what stands for it (both with the same exposure) and the
 * signed error, as PNG. The grid is a square that the sphere's disc touches.
 */
void WriteLightSheet(const std::string& path, const std::string& title, const std::string& name,
  const Grid& grid, const std::vector<ComparedLight>& lights);

/// One mesh, drawn in several ways in front of the same environment: panels in a row, with labels.
class ComparisonStrip
{
public:
  /// So many panels of the given size. The environment sets the exposure, too.
  ComparisonStrip(
    const std::string& title, vtkEnvironment* environment, const Size& size, int panels = 3);

  /// Add a panel: what a scene renders, with smooth edges. Throws Error.
  void AddRendered(OffscreenScene& scene, const std::string& name, const std::string& note);

  /**
   * Add a panel: the radiance of a surface that holds every covered pixel, 3 doubles a pixel. The
   * scene, which shows the same mesh, gives the camera and the coverage of the edges. Throws Error.
   */
  void AddRadiance(OffscreenScene& scene, const Surface& surface,
    const std::vector<double>& radiance, const std::string& name, const std::string& note);

  /// As PNG.
  void Write(const std::string& path) const { this->Sheet.Write(path); }

private:
  void Add(Picture picture, const OffscreenScene& scene, int factor, const std::string& name,
    const std::string& note);

  tool::Size PanelSize;
  Backdrop Background;
  double Exposure;
  ContactSheet Sheet;
  int NumberOfPanels = 0;
};

/// The tone-mapped map with the lights and, if asked for, their regions; display light. Its height
/// follows from the map's aspect, from 16 to largestHeight pixels.
Picture DrawLightMap(vtkEnvironment* environment, vtkLightSet* lights, bool regions,
  int previewWidth, int largestHeight);
} // namespace tool

#endif
