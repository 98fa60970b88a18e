// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A function of one or two tuples, applied to arrays of them by several threads. Private to the
 * module.
 */

#ifndef TupleMap_h
#define TupleMap_h

#include "vtkDataArray.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// One to three numbers.
template <typename From, typename To>
void CopyTuple(const From* from, To* to, int components)
{
  to[0] = static_cast<To>(from[0]);
  if (components > 1)
  {
    to[1] = static_cast<To>(from[1]);
  }
  if (components > 2)
  {
    to[2] = static_cast<To>(from[2]);
  }
}

/// The tuples of an array as doubles. Contiguous doubles are read where they lie.
class TupleReader
{
public:
  TupleReader(vtkDataArray* array, int components);

  /// Tuple k, in the array itself or in the buffer; of an array with one tuple always that one.
  const double* Get(vtkIdType k, double* buffer) const
  {
    if (this->Doubles)
    {
      return this->Doubles + k * this->Stride;
    }
    if (this->Floats)
    {
      CopyTuple(this->Floats + k * this->Stride, buffer, this->Components);
    }
    else
    {
      this->Array->GetTuple(this->Stride == 0 ? 0 : k, buffer);
    }
    return buffer;
  }

private:
  vtkDataArray* Array;
  const double* Doubles;
  const float* Floats;
  int Components;
  vtkIdType Stride; // 0: one tuple serves for all
};

/// Writes tuples of doubles to an array of floats or doubles.
class TupleWriter
{
public:
  TupleWriter(vtkDataArray* array, int components);

  void Set(vtkIdType k, const double* tuple) const
  {
    if (this->Doubles)
    {
      CopyTuple(tuple, this->Doubles + k * this->Components, this->Components);
    }
    else if (this->Floats)
    {
      CopyTuple(tuple, this->Floats + k * this->Components, this->Components);
    }
    else
    {
      this->Array->SetTuple(k, tuple);
    }
  }

private:
  vtkDataArray* Array;
  double* Doubles = nullptr;
  float* Floats = nullptr;
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
    vtkSMPTools::For(0, this->Count, grain,
      [&](vtkIdType begin, vtkIdType end)
      {
        double buffers[2][3];
        const double* inputs[2] = {};
        double result[3];
        for (vtkIdType k = begin; k < end; ++k)
        {
          for (std::size_t a = 0; a < readers.size(); ++a)
          {
            inputs[a] = readers[a].Get(k, buffers[a]);
          }
          function(inputs, result);
          writer.Set(k, result);
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
