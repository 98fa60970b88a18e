// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a composite data set says of a block.
 */

#ifndef BlockStyle_h
#define BlockStyle_h

#include "vtkScalarsToColors.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>

class vtkMapper;

namespace measuredbrdf
{
/// How a mapper colors by scalars; since VTK 9.3 each block may have its own.
struct ScalarStyle
{
  /// Take a mapper's.
  void Read(vtkMapper* mapper);

  /// Those of one of VTK's records of a block, which names them as its mapper does.
  template <typename Record>
  void ReadRecord(const Record& block)
  {
    this->Visibility = block.ScalarVisibility;
    this->UsesTableRange = block.UseLookupTableScalarRange;
    this->InterpolatesFirst = block.InterpolateScalarsBeforeMapping;
    this->ColorMode = block.ColorMode;
    this->ScalarMode = block.ScalarMode;
    this->ArrayAccessMode = block.ArrayAccessMode;
    this->ArrayComponent = block.ArrayComponent;
    this->ArrayId = block.ArrayId;
    this->ArrayName = block.ArrayName;
    this->FieldDataTupleId = block.FieldDataTupleId;
    this->Range[0] = block.ScalarRange[0];
    this->Range[1] = block.ScalarRange[1];
    this->Table = block.LookupTable;
  }

  /// Give them to a mapper.
  void Write(vtkMapper* mapper) const;

  bool operator==(const ScalarStyle& other) const;

  bool Visibility = true;
  bool UsesTableRange = false;
  bool InterpolatesFirst = false;
  int ColorMode = 0;
  int ScalarMode = 0;
  int ArrayAccessMode = 0;
  int ArrayComponent = 0;
  int ArrayId = -1;
  std::string ArrayName;
  vtkIdType FieldDataTupleId = -1;
  double Range[2] = { 0.0, 1.0 };
  vtkSmartPointer<vtkScalarsToColors> Table;
};

struct BlockStyle
{
  bool IsVisible = true;
  bool IsOpaque = true;
  double Opacity = 1.0;
  bool OverridesColor = false;
  double AmbientColor[3] = { 1.0, 1.0, 1.0 };
  double DiffuseColor[3] = { 1.0, 1.0, 1.0 };
  ScalarStyle Scalars;
};
} // namespace measuredbrdf

#endif
