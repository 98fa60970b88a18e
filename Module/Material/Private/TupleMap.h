// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A function of one or two tuples, applied to arrays of them by several threads. Private to the
 * module.
 */

#ifndef TupleMap_h
#define TupleMap_h

#include "ParallelFor.h"
#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
/**
 * Tuples are converted to and from doubles in blocks, ahead of their use. One at a time, the
 * processor would wait for each: loading two doubles that were just stored one by one is slow.
 */
constexpr vtkIdType TupleBlock = 64;

/// The tuples of an array as doubles. Contiguous doubles are read where they lie.
class TupleReader
{
public:
  TupleReader(vtkDataArray* array, int components);

  /// How far apart the tuples of a block are: 0 if the array's only tuple serves for all.
  vtkIdType GetStride() const { return this->Stride; }

  /// Tuples begin to end, at most a block of them, in the array itself or in the buffer.
  const double* Get(vtkIdType begin, vtkIdType end, double* buffer) const;

private:
  vtkDataArray* Array;
  const double* Doubles;
  const float* Floats;
  int Components;
  vtkIdType Stride;
};

/// Writes blocks of doubles to an array of floats or doubles. They are not made in the array
/// itself: it may share its memory with an input.
class TupleWriter
{
public:
  TupleWriter(vtkDataArray* array, int components);

  /// Tuples begin to end.
  void Set(vtkIdType begin, vtkIdType end, const double* buffer) const;

private:
  vtkDataArray* Array;
  double* Doubles;
  float* Floats;
  int Components;
};

class TupleMap
{
public:
  struct Argument
  {
    const char* Name; // for messages
    vtkDataArray* Array;
    int Components; // at most 3
  };

  /**
   * One or two inputs of n tuples, or of one tuple that serves for all; the result, of floats or
   * doubles, may be one of the inputs.
   */
  TupleMap(std::vector<Argument> inputs, const Argument& result);

  /// What is wrong with the arrays, or "".
  const std::string& GetProblem() const { return this->Problem; }

  /**
   * Resize the result, and let function(const double* const inputs[2], double result[3]) fill its
   * tuples. A thread takes at least `grain` of them. Only where there is no problem.
   */
  template <typename Function>
  void Run(vtkIdType grain, const Function& function)
  {
    this->ResizeResult();
    std::vector<TupleReader> readers;
    for (const Argument& input : this->Inputs)
    {
      readers.emplace_back(input.Array, input.Components);
    }
    const TupleWriter writer(this->Result.Array, this->Result.Components);
    measuredbrdf::ParallelFor(0, this->Count, grain,
      [&](vtkIdType begin, vtkIdType end)
      {
        double buffers[3][3 * TupleBlock];
        const double* inputs[2] = {};
        for (vtkIdType from = begin; from < end; from += TupleBlock)
        {
          const vtkIdType to = std::min(end, from + TupleBlock);
          for (std::size_t a = 0; a < readers.size(); ++a)
          {
            inputs[a] = readers[a].Get(from, to, buffers[a]);
          }
          double* result = buffers[2];
          for (vtkIdType k = from; k < to; ++k)
          {
            function(inputs, result);
            for (std::size_t a = 0; a < readers.size(); ++a)
            {
              inputs[a] += readers[a].GetStride();
            }
            result += this->Result.Components;
          }
          writer.Set(from, to, buffers[2]);
        }
      });
    this->Result.Array->Modified();
  }

private:
  void FindProblem();
  void ResizeResult();

  std::vector<Argument> Inputs;
  Argument Result;
  std::array<vtkSmartPointer<vtkDataArray>, 2> Copies; // of an input that is the result, too
  vtkIdType Count = 0;
  std::string Problem;
};
} // namespace measuredbrdf

#endif
