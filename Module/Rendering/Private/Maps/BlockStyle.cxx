// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockStyle.h"

#include "vtkMapper.h"

#include <tuple>

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
  const auto tie = [](const ScalarStyle& style)
  {
    return std::tie(style.Visibility, style.UsesTableRange, style.InterpolatesFirst,
      style.ColorMode, style.ScalarMode, style.ArrayAccessMode, style.ArrayComponent, style.ArrayId,
      style.ArrayName, style.FieldDataTupleId, style.Range[0], style.Range[1], style.Table);
  };
  return tie(*this) == tie(other);
}
} // namespace measuredbrdf
