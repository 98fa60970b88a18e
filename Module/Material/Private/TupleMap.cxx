// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TupleMap.h"

#include "vtkAOSDataArrayTemplate.h"

#include <algorithm>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Where the values lie, if they are contiguous and of this type.
template <typename T>
T* GetValues(vtkDataArray* array)
{
  auto* typed = vtkAOSDataArrayTemplate<T>::FastDownCast(array);
  return typed ? typed->GetPointer(0) : nullptr;
}

std::string GetProblemOf(const TupleMap::Argument& argument)
{
  const std::string name = argument.Name;
  const std::string expected =
    std::to_string(argument.Components) + (argument.Components == 1 ? " component" : " components");
  if (!argument.Array)
  {
    return name + ": found no array, expected one of " + expected + ".";
  }
  const int found = argument.Array->GetNumberOfComponents();
  if (found != argument.Components)
  {
    return name + ": found tuples of " + std::to_string(found) + ", expected " + expected + ".";
  }
  return "";
}
} // namespace

//------------------------------------------------------------------------------
TupleReader::TupleReader(vtkDataArray* array, int components)
  : Array(array)
  , Doubles(GetValues<double>(array))
  , Floats(GetValues<float>(array))
  , Components(components)
  , Stride(array->GetNumberOfTuples() == 1 ? 0 : components)
{
}

//------------------------------------------------------------------------------
TupleWriter::TupleWriter(vtkDataArray* array, int components)
  : Array(array)
  , Doubles(GetValues<double>(array))
  , Floats(GetValues<float>(array))
  , Components(components)
{
}

//------------------------------------------------------------------------------
const double* TupleReader::Get(vtkIdType begin, vtkIdType end, double* buffer) const
{
  if (this->Doubles)
  {
    return this->Doubles + begin * this->Stride;
  }
  if (this->Stride == 0)
  {
    begin = 0;
    end = 1;
  }
  if (this->Floats)
  {
    std::copy(
      this->Floats + begin * this->Components, this->Floats + end * this->Components, buffer);
    return buffer;
  }
  for (vtkIdType k = begin; k < end; ++k)
  {
    this->Array->GetTuple(k, buffer + (k - begin) * this->Components);
  }
  return buffer;
}

//------------------------------------------------------------------------------
void TupleWriter::Set(vtkIdType begin, vtkIdType end, const double* buffer) const
{
  if (this->Doubles)
  {
    std::copy(
      buffer, buffer + (end - begin) * this->Components, this->Doubles + begin * this->Components);
    return;
  }
  if (this->Floats)
  {
    std::transform(buffer, buffer + (end - begin) * this->Components,
      this->Floats + begin * this->Components,
      [](double value) { return static_cast<float>(value); });
    return;
  }
  for (vtkIdType k = begin; k < end; ++k)
  {
    this->Array->SetTuple(k, buffer + (k - begin) * this->Components);
  }
}

//------------------------------------------------------------------------------
TupleMap::TupleMap(std::vector<Argument> inputs, const Argument& result)
  : Inputs(std::move(inputs))
  , Result(result)
{
  this->FindProblem();
}

//------------------------------------------------------------------------------
void TupleMap::FindProblem()
{
  this->Count = 1;
  const char* longest = "";
  for (const Argument& input : this->Inputs)
  {
    this->Problem = GetProblemOf(input);
    if (!this->Problem.empty())
    {
      return;
    }
    const vtkIdType count = input.Array->GetNumberOfTuples();
    if (count != 1 && this->Count != 1 && count != this->Count)
    {
      this->Problem = std::string(input.Name) + ": found " + std::to_string(count) +
                      " tuples, expected " + std::to_string(this->Count) + ", as " + longest +
                      " has, or 1.";
      return;
    }
    if (count != 1)
    {
      this->Count = count;
      longest = input.Name;
    }
  }
  if (!this->Result.Array)
  {
    this->Problem = std::string(this->Result.Name) + ": found no array, expected one to fill.";
    return;
  }
  const int type = this->Result.Array->GetDataType();
  if (type != VTK_FLOAT && type != VTK_DOUBLE)
  {
    this->Problem = std::string(this->Result.Name) + ": found an array of type " +
                    this->Result.Array->GetDataTypeAsString() + ", expected float or double.";
  }
}

//------------------------------------------------------------------------------
void TupleMap::ResizeResult()
{
  vtkDataArray* result = this->Result.Array;
  for (std::size_t a = 0; a < this->Inputs.size(); ++a)
  {
    if (this->Inputs[a].Array == result)
    {
      this->Copies[a] = vtkSmartPointer<vtkDataArray>::Take(result->NewInstance());
      this->Copies[a]->DeepCopy(result);
      this->Inputs[a].Array = this->Copies[a];
    }
  }
  // Memory of another owner (vtkDataArray::SetVoidArray) stays in use where it has the right size.
  if (result->GetNumberOfComponents() != this->Result.Components)
  {
    result->Initialize(); // or vtkSOADataArrayTemplate does not allocate the new components
    result->SetNumberOfComponents(this->Result.Components);
  }
  if (result->GetNumberOfTuples() != this->Count)
  {
    result->SetNumberOfTuples(this->Count);
  }
}
} // namespace measuredbrdf
