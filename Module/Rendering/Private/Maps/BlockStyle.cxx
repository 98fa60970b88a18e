// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockStyle.h"

#include "vtkMapper.h"

#include <algorithm>

namespace measuredbrdf
{
void ScalarStyle::Read(vtkMapper* mapper)
{
  this->Visibility = mapper->GetScalarVisibility();
  this->UsesTableRange = mapper->GetUseLookupTableScalarRange();
  this->InterpolatesFirst = mapper->GetInterpolateScalarsBeforeMapping();
  this->ColorMode = mapper->GetColorMode();
  this->ScalarMode = mapper->GetScalarMode();
  this->ArrayAccessMode = mapper->GetArrayAccessMode();
  this->ArrayComponent = mapper->GetArrayComponent();
  this->ArrayId = mapper->GetArrayId();
  this->ArrayName = mapper->GetArrayName() ? mapper->GetArrayName() : "";
  this->FieldDataTupleId = mapper->GetFieldDataTupleId();
  mapper->GetScalarRange(this->Range);
  this->Table = mapper->GetLookupTable();
}

void ScalarStyle::Write(vtkMapper* mapper) const
{
  mapper->SetScalarVisibility(this->Visibility);
  mapper->SetUseLookupTableScalarRange(this->UsesTableRange);
  mapper->SetInterpolateScalarsBeforeMapping(this->InterpolatesFirst);
  mapper->SetColorMode(this->ColorMode);
  mapper->SetScalarMode(this->ScalarMode);
  mapper->SetArrayAccessMode(this->ArrayAccessMode);
  mapper->SetArrayComponent(this->ArrayComponent);
  mapper->SetArrayId(this->ArrayId);
  mapper->SetArrayName(this->ArrayName.c_str());
  mapper->SetFieldDataTupleId(this->FieldDataTupleId);
  mapper->SetScalarRange(this->Range[0], this->Range[1]);
  mapper->SetLookupTable(this->Table);
}

bool ScalarStyle::operator==(const ScalarStyle& other) const
{
  return this->Visibility == other.Visibility && this->UsesTableRange == other.UsesTableRange &&
         this->InterpolatesFirst == other.InterpolatesFirst && this->ColorMode == other.ColorMode &&
         this->ScalarMode == other.ScalarMode && this->ArrayAccessMode == other.ArrayAccessMode &&
         this->ArrayComponent == other.ArrayComponent && this->ArrayId == other.ArrayId &&
         this->ArrayName == other.ArrayName && this->FieldDataTupleId == other.FieldDataTupleId &&
         std::equal(this->Range, this->Range + 2, other.Range) && this->Table == other.Table;
}
} // namespace measuredbrdf
