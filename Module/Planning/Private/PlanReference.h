// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the planner measures its candidates against: nearly exact, in a few hundred milliseconds.
 * Private to the module.
 */

#ifndef PlanReference_h
#define PlanReference_h

#include "PlanSearch.h"

namespace measuredbrdf
{
/// Largest number of suns and lamps that are lights of their own.
constexpr int MostReferenceSuns = 64;

/**
 * Find what the comparison's pairs reflect, and measure on some of them how far that is from the
 * truth (ReferenceError, relative L1 with two standard errors): by a sum over lights for an
 * isotropic material of which nothing is sharper than a light is wide, and which half as many
 * lights reflect nearly alike; else by the adaptive integral, each pair to half the tolerance that
 * plans are made for, at most 1 %, against an eighth of that.
 *
 * Returns what computed the comparison's Reference; null, with the task's Problem, where that
 * failed or was aborted.
 */
vtkSmartPointer<vtkRadianceIntegrator> MakeReference(PlanTask& task, PlanComparison& comparison);
} // namespace measuredbrdf

#endif
