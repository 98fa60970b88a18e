// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Options.h"
#include "Picture.h"
#include "Tool.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPictureDifference.h"
#include "vtkPictureReader.h"
#include "vtkSmartPointer.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <vector>

namespace
{
using Image = vtkSmartPointer<vtkImageData>;

struct DiffOptions
{
  std::string Picture;
  std::vector<std::string> Baselines;
  bool Alternatives = false;
  std::vector<std::string> Metrics;
  std::vector<double> Thresholds;
  int Border = 0;
  std::string Mask;
  bool IgnoreAlpha = false;
  std::string Output;
  bool Dart = false;
};

// A metric, its value that is still good, and what was found.
struct Test
{
  int Metric;
  double Threshold;
  double Value;
  bool Passed;
  double Badness; // 1 at the threshold
  Image HeatMap;

  std::string GetName() const { return vtkPictureDifference::GetMetricName(this->Metric); }
};

// All tests against one baseline.
struct PictureComparison
{
  std::string Baseline;
  std::vector<Test> Tests;

  // The one that is furthest beyond its threshold.
  const Test& FindWorst() const
  {
    return *std::max_element(this->Tests.begin(), this->Tests.end(),
      [](const Test& a, const Test& b) { return a.Badness < b.Badness; });
  }
  bool HasPassed() const
  {
    return std::all_of(
      this->Tests.begin(), this->Tests.end(), [](const Test& test) { return test.Passed; });
  }
};

//------------------------------------------------------------------------------
Image ReadPicture(const std::string& path)
{
  vtkNew<vtkPictureReader> reader;
  reader->SetFileName(path);
  if (!reader->Read())
  {
    tool::TakeErrorText(); // the same
    throw tool::InputError(reader->GetErrorMessage());
  }
  if (!reader->GetNotes().empty())
  {
    tool::PrintNote(path + ": " + reader->GetNotes());
  }
  return reader->GetPicture();
}

//------------------------------------------------------------------------------
PictureComparison Compare(
  const DiffOptions& options, vtkImageData* picture, vtkImageData* mask, const std::string& path)
{
  const Image baseline = ReadPicture(path);
  std::vector<std::string> metrics = options.Metrics;
  if (metrics.empty())
  {
    const bool hasFloats =
      picture->GetScalarType() == VTK_FLOAT && baseline->GetScalarType() == VTK_FLOAT;
    metrics.push_back(vtkPictureDifference::GetMetricName(
      hasFloats ? vtkPictureDifference::HDR_FLIP : vtkPictureDifference::FLIP));
  }
  vtkNew<vtkPictureDifference> difference;
  difference->SetBorder(options.Border);
  difference->SetMask(mask);
  difference->SetIgnoreAlpha(options.IgnoreAlpha);
  PictureComparison comparison{ path, {} };
  for (std::size_t k = 0; k < metrics.size(); ++k)
  {
    const int metric = vtkPictureDifference::FindMetric(metrics[k]);
    const double threshold = options.Thresholds.empty()
                               ? vtkPictureDifference::GetDefaultThreshold(metric)
                               : options.Thresholds[k];
    difference->SetMetric(metric);
    if (!difference->Compare(picture, baseline))
    {
      tool::TakeErrorText(); // the same
      throw tool::InputError(
        options.Picture + " against " + path + ": " + difference->GetErrorMessage());
    }
    const double value = difference->GetValue();
    const double best = vtkPictureDifference::IsSimilarity(metric) ? 1.0 : 0.0;
    const double error = std::abs(value - best);
    const double badness = error == 0.0 ? 0.0 : error / std::abs(threshold - best);
    comparison.Tests.push_back({ metric, threshold, value, difference->IsWithin(threshold), badness,
      Image::Take(difference->NewHeatMap()) });
  }
  return comparison;
}

//------------------------------------------------------------------------------
std::string FormatFindings(const PictureComparison& comparison)
{
  std::string text;
  for (const Test& test : comparison.Tests)
  {
    text += (text.empty() ? "" : ", ") + test.GetName() + "=" + tool::FormatNumber(test.Value) +
            (vtkPictureDifference::IsSimilarity(test.Metric) ? " (at least " : " (at most ") +
            tool::FormatNumber(test.Threshold) + ")";
  }
  return text;
}

//------------------------------------------------------------------------------
// CTest takes such elements, which vtkTesting writes, too, out of a test's output for CDash.
std::string FormatMeasurement(
  const std::string& name, const std::string& type, const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return "<DartMeasurement name=\"" + name + "\" type=\"" + type + "\">" + escaped +
         "</DartMeasurement>\n";
}

//------------------------------------------------------------------------------
std::string FormatMeasurementFile(const std::string& name, const std::string& path)
{
  const std::string extension = tool::Extension(path);
  const std::string type = extension == ".png"                           ? "image/png"
                           : extension == ".jpg" || extension == ".jpeg" ? "image/jpeg"
                                                                         : "file";
  // CTest looks for the file from where it runs itself.
  std::error_code ignored;
  return "<DartMeasurementFile name=\"" + name + "\" type=\"" + type + "\">" +
         std::filesystem::absolute(path, ignored).string() + "</DartMeasurementFile>\n";
}

//------------------------------------------------------------------------------
// For CDash: numbers always, pictures where the test failed, under the names that vtkTesting uses.
void PrintMeasurements(
  const DiffOptions& options, const PictureComparison& comparison, const std::string& heatMap)
{
  std::string text;
  for (const Test& test : comparison.Tests)
  {
    text += FormatMeasurement(test.GetName(), "numeric/double", tool::FormatNumber(test.Value)) +
            FormatMeasurement(
              test.GetName() + "_threshold", "numeric/double", tool::FormatNumber(test.Threshold));
  }
  text += FormatMeasurement("BaselineImage", "text/string", comparison.Baseline);
  if (!comparison.HasPassed())
  {
    text += FormatMeasurementFile("TestImage", options.Picture) +
            FormatMeasurementFile("DifferenceImage", heatMap) +
            FormatMeasurementFile("ValidImage", comparison.Baseline);
  }
  tool::PrintOut(text);
}

//------------------------------------------------------------------------------
// The best of all baselines.
PictureComparison CompareAll(const DiffOptions& options)
{
  const Image picture = ReadPicture(options.Picture);
  const Image mask = options.Mask.empty() ? Image() : ReadPicture(options.Mask);
  std::vector<std::string> baselines = options.Baselines;
  if (options.Alternatives) // valid_1.png, valid_2.png and so on, as far as there are files
  {
    const std::filesystem::path first = baselines.front();
    const std::string stem = (first.parent_path() / first.stem()).string() + "_";
    const auto getNext = [&]()
    { return stem + std::to_string(baselines.size()) + first.extension().string(); };
    std::error_code ignored;
    while (std::filesystem::exists(getNext(), ignored))
    {
      baselines.push_back(getNext());
    }
  }
  PictureComparison best;
  for (const std::string& path : baselines)
  {
    PictureComparison comparison = Compare(options, picture, mask, path);
    if (best.Tests.empty() || comparison.FindWorst().Badness < best.FindWorst().Badness)
    {
      best = std::move(comparison);
    }
  }
  return best;
}

//------------------------------------------------------------------------------
void Run(const DiffOptions& options)
{
  if (options.Alternatives && options.Baselines.size() > 1)
  {
    throw tool::UsageError("--alternatives looks for files beside one baseline; found " +
                           std::to_string(options.Baselines.size()));
  }
  if (!options.Thresholds.empty() &&
      options.Thresholds.size() != std::max<std::size_t>(options.Metrics.size(), 1))
  {
    throw tool::UsageError("--threshold: found " + std::to_string(options.Thresholds.size()) +
                           ", expected none or one for each --metric");
  }
  // CTest sets the first for every test, to 0 or 1; older ones set the second.
  const bool dart = options.Dart || std::getenv("CTEST_INTERACTIVE_DEBUG_MODE") ||
                    std::getenv("DASHBOARD_TEST_FROM_CTEST");
  PictureComparison comparison;
  std::string heatMap = options.Output;
  try
  {
    comparison = CompareAll(options);
    if (heatMap.empty() && dart && !comparison.HasPassed())
    {
      heatMap = std::filesystem::path(options.Picture).stem().string() + ".diff.png";
    }
    if (!heatMap.empty())
    {
      tool::WritePNG(heatMap, comparison.FindWorst().HeatMap);
    }
  }
  catch (const tool::InputError&)
  {
    std::error_code ignored;
    if (dart && std::filesystem::is_regular_file(options.Picture, ignored))
    {
      tool::PrintOut(FormatMeasurementFile("TestImage", options.Picture));
    }
    throw;
  }
  catch (const tool::Error& e) // of writing
  {
    throw tool::InputError(e.what());
  }
  const std::string found = FormatFindings(comparison);
  tool::PrintOut((comparison.HasPassed() ? "passed: " : "failed: ") + found + ", baseline " +
                 comparison.Baseline + "\n");
  if (dart)
  {
    PrintMeasurements(options, comparison, heatMap);
  }
  if (!comparison.HasPassed())
  {
    throw tool::Error(options.Picture + " differs from " + comparison.Baseline + ": " + found +
                      (heatMap.empty() ? "" : "; " + heatMap + " shows where"));
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddDiffCommand(CLI::App& app)
{
  std::vector<std::string> names;
  std::string thresholds;
  for (int metric = 0; metric < vtkPictureDifference::NUMBER_OF_METRICS; ++metric)
  {
    names.push_back(vtkPictureDifference::GetMetricName(metric));
    thresholds += (metric > 0 ? ", " : "") + names.back() + " " +
                  FormatNumber(vtkPictureDifference::GetDefaultThreshold(metric));
  }
  auto options = std::make_shared<DiffOptions>();
  CLI::App* command = app.add_subcommand(
    "diff", "Compare a picture with a baseline: the verdict of an image regression test");
  command->add_option("PICTURE", options->Picture, "The picture to test: PNG, JPEG, OpenEXR, ...")
    ->required();
  command
    ->add_option("BASELINE", options->Baselines,
      "What it should look like; of several files the nearest counts")
    ->required();
  command->add_flag("--alternatives", options->Alternatives,
    "Take BASELINE_1.png, BASELINE_2.png and so on for baselines, too, as far as there are files");
  command
    ->add_option("--metric", options->Metrics,
      "The error figure; several must all pass (default: hdr_flip if both pictures hold floats, "
      "else flip)")
    ->check(CLI::IsMember(names))
    ->allow_extra_args(false);
  command
    ->add_option("--threshold", options->Thresholds,
      "Largest value that passes; of ssim the least. One for each --metric (default: " +
        thresholds + ")")
    ->check(Between(0.0, std::numeric_limits<double>::max()))
    ->allow_extra_args(false);
  command->add_option("--border", options->Border, "Pixels along the edges that are not compared")
    ->check(CLI::Range(0, 65536));
  command->add_option("--mask", options->Mask,
    "Picture of the same size: where it is darker than a half, nothing is compared");
  command->add_flag("--ignore-alpha", options->IgnoreAlpha, "Take all pixels as opaque");
  command
    ->add_option("-o,--output", options->Output,
      "PNG picture to write: the error of each pixel in colors from black to yellow")
    ->check(EndsIn({ ".png" }));
  command->add_flag("--dart", options->Dart,
    "Print measurements and files for CDash (default: where CTest runs the command)");
  command->footer("Exit status: 0 within the threshold, 1 beyond it, 2 bad input.\n\nExample:\n"
                  "  measured-brdf diff out.png valid.png --metric flip --threshold 0.01 "
                  "-o heat.png");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
