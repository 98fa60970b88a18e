// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Costs that a calibration left in the plan cache's folder.
#include "FuzzTarget.h"

#include "vtkNew.h"
#include "vtkRadianceCostModel.h"

MEASUREDBRDF_FUZZ_TARGET(CostModel)(const std::uint8_t* data, std::size_t size)
{
  vtkNew<vtkRadianceCostModel> model;
  if (model->SetText(std::string(fuzz::ToView(data, size))))
  {
    vtkNew<vtkRadianceCostModel> copy;
    fuzz::Require(copy->SetText(model->GetText()));
    for (int type = 0; type < vtkRadianceCostModel::NUMBER_OF_COSTS; ++type)
    {
      fuzz::Require(model->GetCost(type) > 0.0 && copy->GetCost(type) == model->GetCost(type));
    }
  }
  return 0;
}
