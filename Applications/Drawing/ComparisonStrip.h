// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One mesh, drawn in several ways in front of the same environment: panels in a row, with labels.
 */

#ifndef ComparisonStrip_h
#define ComparisonStrip_h

#include "ContactSheet.h"
#include "OffscreenScene.h"
#include "Sizes.h"
#include "Surface.h"

#include <string>
#include <vector>

class vtkEnvironment;

namespace tool
{
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
} // namespace tool

#endif
