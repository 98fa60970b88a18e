// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Tables for graphics cards, of materials that have no form of their own there.
 */

#ifndef RenderableTable_h
#define RenderableTable_h

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <mutex>
#include <string>

namespace measuredbrdf
{
/// A material resampled within its ResamplingTolerance, made again where that has changed. Copies
/// of the material, in other threads, share what was made last; each has what it handed out last,
/// which is never changed, for as long as its own tolerance stays.
class RenderableTable
{
public:
  RenderableTable();
  /// For a copy of the material.
  RenderableTable(const RenderableTable& other);
  void operator=(const RenderableTable&) = delete;

  /// A vtkTabulatedBRDF or, where it is anisotropic, a vtkAnisotropicTabulatedBRDF, with the
  /// material's name and source, prepared. problem: what to warn of where a new one misses the
  /// tolerance.
  vtkBRDF* Get(vtkBRDF* material, std::string& problem);

  /// That table if it is made; else a new one of a fixed, coarse size, whose error nobody measures.
  /// Waits for no thread that makes the other. The caller has to release it.
  vtkBRDF* NewQuick(vtkBRDF* material);

private:
  struct Made
  {
    vtkSmartPointer<vtkBRDF> Table;
    double Tolerance = 0.0;
    bool Fits(double tolerance) const { return this->Table && this->Tolerance == tolerance; }
  };
  struct Shared
  {
    std::mutex Mutex; // guards both
    Made Last;
  };
  bool TakeUp(double tolerance);

  std::shared_ptr<Shared> Common;
  Made Own;
};
} // namespace measuredbrdf

#endif
