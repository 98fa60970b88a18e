// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * --method thesis: the material as the thesis renders it, under 64 median-cut lights.
 */

#ifndef Thesis_h
#define Thesis_h

#include "Inputs.h"

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <string>

namespace CLI
{
class App;
}

namespace tool
{
struct ThesisOptions
{
  int Order = 6;

  /// Add --order to a subcommand.
  void AddTo(CLI::App* command);

  /// Throws UsageError where --order is given with another method.
  void Check(const CLI::App* command, const std::string& method) const;
};

/// What vtkRepresentationAdvisor makes of a material: "basis" or "fit", the one that it is, and
/// why.
struct Representation
{
  vtkSmartPointer<vtkBRDF> BRDF;
  std::string Kind;
  std::string Description; // of the shader inputs, in one line
  std::string Reason;
};

/// Measure and make it, with a progress bar. Throws Error naming its file, also where Ctrl-C
/// was pressed. Needs an Interruptible.
Representation Represent(const Material& material, int order);

/// The same for --method thesis; the reason goes to stderr as a note.
Representation RepresentAsThesis(const Material& material, const ThesisOptions& options);
} // namespace tool

#endif
