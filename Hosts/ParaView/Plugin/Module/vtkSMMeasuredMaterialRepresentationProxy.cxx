// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMMeasuredMaterialRepresentationProxy.h"

#include "vtkMeasuredPlanInformation.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"

vtkStandardNewMacro(vtkSMMeasuredMaterialRepresentationProxy);

//------------------------------------------------------------------------------
vtkSMMeasuredMaterialRepresentationProxy::vtkSMMeasuredMaterialRepresentationProxy() = default;

//------------------------------------------------------------------------------
vtkSMMeasuredMaterialRepresentationProxy::~vtkSMMeasuredMaterialRepresentationProxy() = default;

//------------------------------------------------------------------------------
void vtkSMMeasuredMaterialRepresentationProxy::UpdatePropertyInformationInternal(
  vtkSMProperty* property)
{
  this->Superclass::UpdatePropertyInformationInternal(property);
  vtkSMProperty* plan = this->GetProperty("MeasuredPlan");
  if (plan && (!property || property == plan) && this->ObjectsCreated)
  {
    vtkNew<vtkMeasuredPlanInformation> information;
    this->GatherInformation(information);
    vtkSMPropertyHelper(plan).Set(information->GetPlan());
  }
}

//------------------------------------------------------------------------------
void vtkSMMeasuredMaterialRepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
