// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * --method thesis: the material as the thesis renders it, under 64 median-cut lights.
 */

#ifndef Thesis_h
#define Thesis_h

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <CLI/CLI.hpp>

#include <string>

namespace tool
{
struct ThesisOptions
{
  int Order = 6;

  /// Add --order to a subcommand.
  void AddTo(CLI::App* command);
};

/// The pair of a basis or the D-BRDF fit (vtkRepresentationAdvisor), with a progress bar; the
/// reason goes to stderr as a note. Throws Error, also where Ctrl-C was pressed (Interruptible).
vtkSmartPointer<vtkBRDF> RepresentAsThesis(
  vtkBRDF* material, const std::string& name, const ThesisOptions& options);
} // namespace tool

#endif
