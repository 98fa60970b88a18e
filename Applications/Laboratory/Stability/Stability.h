// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The stability laboratory: known ways to fail, each a case that provokes one and measures it.
 */

#ifndef Stability_h
#define Stability_h

#include "Inputs.h"
#include "Picture.h"

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tool::stability
{
/// For known limits: shown, whatever comes out.
constexpr double Unlimited = std::numeric_limits<double>::infinity();

/// One measured figure. It passes at or below its threshold, is a known limit up to another bound,
/// and fails beyond it or where it is not finite.
struct Finding
{
  std::string Method; // of integrating, of fitting, a representation ...
  std::string Figure; // what was measured, in words
  double Value = 0.0;
  double Threshold = 0.0;
  double Bound = 0.0; // of the known limit; the threshold where there is none
  std::string Note;
  std::string Why; // it is a known limit

  /// What is known to fail, how far it may, and why.
  void KnownUpTo(double bound, const std::string& why);

  /// "pass", "known limit" or "fail".
  std::string GetStatus() const;
};

/// Thresholds of the methods of a case: one for all, and how far some are known to miss it.
struct Limits
{
  double Threshold;
  std::map<std::string, double> Known; // method -> bound
  std::string Why;                     // these miss it
};

/// What cases are given and what they hand back.
class Context
{
public:
  /// The user's material or else this one.
  vtkSmartPointer<vtkBRDF> Choose(vtkBRDF* otherwise) const;

  /// The user's environment, else "sky" or "hall", averaged down to width x width / 2.
  vtkSmartPointer<vtkEnvironment> MakeEnvironment(const std::string& otherwise, int width) const;

  Finding& Add(const std::string& method, const std::string& figure, double value, double threshold,
    const std::string& note = "");
  void Add(
    const std::string& method, const std::string& figure, double value, const Limits& limits);

  vtkSmartPointer<vtkBRDF> BRDF;               // the user's, or null
  vtkSmartPointer<vtkEnvironment> Environment; // the user's, or null
  bool Short = false;
  std::string Renderer; // set by cases that draw
  std::vector<Finding> Findings;
  std::optional<Picture> Shown; // in linear display light
};

struct Case
{
  std::string Name;
  std::string Group;
  std::string Question; // what is provoked, in one line
  std::function<void(Context&)> Run;
};

/// All cases, in the order of docs/stability.md.
std::vector<Case> GetCases();

///@{
/// The groups, one file each.
void AddBasesCases(std::vector<Case>& cases);
void AddRangeCases(std::vector<Case>& cases);
void AddSamplingCases(std::vector<Case>& cases);
void AddGeometryCases(std::vector<Case>& cases);
void AddTemporalCases(std::vector<Case>& cases);
void AddScaleCases(std::vector<Case>& cases);
void AddDataCases(std::vector<Case>& cases);
void AddConvergenceCases(std::vector<Case>& cases);
void AddNumericCases(std::vector<Case>& cases);
///@}
} // namespace tool::stability

#endif
