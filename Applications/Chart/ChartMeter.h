// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Measures what `chart` draws: error, frame time, set-up time and memory of every method and size
 * on a material under an environment.
 */

#ifndef ChartMeter_h
#define ChartMeter_h

#include "ChartMethods.h"
#include "ChartResults.h"
#include "Inputs.h"
#include "Measuring.h"
#include "Options.h"
#include "Scenes.h"
#include "Surface.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkRadiancePlanner;

namespace tool
{
class OffscreenScene;

/// What is drawn and how long it is timed.
struct ChartScene
{
  vtkSmartPointer<vtkPolyData> Mesh;
  tool::Stage Stage;
  int ReferencePixels; // at most
  int Rounds;          // of frames
  double Slowest; // ms: sizes whose frames take longer by what the one before took are left out
};

class ChartMeter
{
public:
  ChartMeter(const ChartScene& scene, const std::vector<ChartSize>& sizes);

  /// Which pixels are compared, for people.
  std::string DescribePixels() const;

  /// What the graphics driver says of itself.
  nlohmann::ordered_json DescribeRenderer() const;

  /// Of all that a pair's figures depend on but the machine: 16 hexadecimal digits.
  std::string GetFingerprint(const Material& material, vtkEnvironment* environment) const;

  /**
   * Measure a pair: set-up and errors of each, then frames of all in rounds, so that whatever slows
   * the machine down slows all. show gets the share done. Throws Error, also where Ctrl-C was
   * pressed. Needs an Interruptible.
   */
  ChartJson Measure(
    const Material& material, vtkEnvironment* environment, const std::function<void(double)>& show);

private:
  struct Timed; // a window with its frames

  // plan: of what is drawn while somebody interacts, or null.
  Timed Begin(const ChartSize& size, const Material& material, vtkEnvironment* environment,
    const std::vector<double>& reference, vtkRadiancePlanner* plan);
  Timed BeginStock(vtkEnvironment* environment, const std::vector<double>& reference);
  void TimeFrames(std::vector<Timed>& all, const std::function<void(double)>& show) const;
  void Place(OffscreenScene& stage) const;
  double FillErrors( // returns what its frame took, in ms
    ChartJson& point, OffscreenScene& stage, const std::vector<double>& reference) const;

  ChartScene Scene;
  std::vector<ChartSize> Sizes;
  Surface Visible;
};
} // namespace tool

#endif
