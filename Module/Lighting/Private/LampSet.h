// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The lamps of an environment, and the parts that each consists of.
 */

#ifndef LampSet_h
#define LampSet_h

#include "ExtractedEmitters.h"
#include "vtkLightSet.h"

#include <vector>

namespace measuredbrdf
{
/// A light for each lamp. Its parts are a few smaller lights that add up to it.
class LampSet : public vtkLightSet
{
public:
  static LampSet* New();
  vtkTypeMacro(LampSet, vtkLightSet);

  std::vector<std::vector<ExtractedEmitters::Part>> Parts; // by lamp

protected:
  LampSet() = default;
  ~LampSet() override = default;

private:
  LampSet(const LampSet&) = delete;
  void operator=(const LampSet&) = delete;
};
} // namespace measuredbrdf

#endif
