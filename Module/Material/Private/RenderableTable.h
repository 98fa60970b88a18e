// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Tables for graphics cards, of materials that have no form of their own there. Private to the
 * module.
 */

#ifndef RenderableTable_h
#define RenderableTable_h

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <mutex>
#include <string>

namespace measuredbrdf
{
/// A material resampled within its ResamplingTolerance, made again where that has changed. Copies
/// of the material, in other threads, may share one.
class RenderableTable
{
public:
  /// A vtkTabulatedBRDF or, where it is anisotropic, a vtkAnisotropicTabulatedBRDF, with the
  /// material's name and source, prepared. problem: what to warn of where a new one misses the
  /// tolerance.
  vtkBRDF* Get(vtkBRDF* material, std::string& problem);

  /// That table if it is made; else a new one of a fixed, coarse size, whose error nobody measures.
  /// Waits for no thread that makes the other. The caller has to release it.
  vtkBRDF* NewQuick(vtkBRDF* material);

private:
  bool IsMade(double tolerance) const { return this->Table && this->Tolerance == tolerance; }

  std::mutex Mutex;
  vtkSmartPointer<vtkBRDF> Table;
  double Tolerance = 0.0;
};
} // namespace measuredbrdf

#endif
