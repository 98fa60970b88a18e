// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which of many (normal, view) pairs a planner compares its candidates on. A few pairs often hold
 * most of the error, those that see a lamp's edge for instance, and uniform samples miss them.
 * Private to the module.
 */

#ifndef PlanSample_h
#define PlanSample_h

#include "PlanSearch.h"

#include <vector>

namespace measuredbrdf
{
/// How many pairs candidates are compared on.
constexpr int PairsToCompare = 512;

/// Of more pairs than PairsToCompare, about that many: drawn by how much two cheap candidates
/// differ, by radiance, by weight, and some of all alike. Weights make up for it: sums are unbiased
/// for all pairs that were drawn (Horvitz, Thompson 1952, "A Generalization of Sampling Without
/// Replacement from a Finite Universe"). The two candidates are the first of the module's own and
/// the first of its method that is larger; they are prepared for it. Where there are no such two,
/// all pairs are alike. picture: they are some of a picture's pixels, between which others are
/// drawn (PlanPoints). Repeatable. False, with the task's Problem, where that failed or was
/// aborted.
bool SamplePairs(
  PlanTask& task, std::vector<PlanCandidate>& candidates, bool picture, PlanPairs& pairs);

/// Such a sample of about so many pairs, by what two methods say that they reflect (null: all pairs
/// are alike).
PlanPairs ChoosePairs(
  const PlanPairs& pairs, vtkDoubleArray* coarse, vtkDoubleArray* fine, int count);
} // namespace measuredbrdf

#endif
