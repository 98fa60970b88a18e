// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How many pixels of a picture the reference can have in a limited time.
 */

#ifndef ReferenceLimit_h
#define ReferenceLimit_h

#include "Surface.h"

#include <string>

class vtkBRDF;
class vtkEnvironment;

namespace tool
{
/// How long the reference takes at most on this machine, in seconds: as if each pixel were
/// integrated. From few of them. Throws Error. Needs an Interruptible.
double EstimateReferenceSeconds(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface);

/// At most so many of the surface's pixels take the reference so many seconds (0: no limit). Where
/// that is not all of them, it prints this, with the option's name. Throws Error. Needs an
/// Interruptible.
int LimitReference(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface,
  double seconds, const std::string& option);
} // namespace tool

#endif
