// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Costs as text, that a program may have kept.
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
    for (int k = 0; k < model->GetNumberOfCosts(); ++k)
    {
      const std::string name = model->GetCostName(k);
      fuzz::Require(model->GetCost(name) > 0.0 && copy->GetCost(name) == model->GetCost(name));
    }
  }
  return 0;
}
