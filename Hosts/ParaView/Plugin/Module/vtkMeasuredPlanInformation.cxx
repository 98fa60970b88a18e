// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeasuredPlanInformation.h"

#include "vtkMeasuredMaterialRepresentation.h"

#include "vtkClientServerStream.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMeasuredPlanInformation);

//------------------------------------------------------------------------------
vtkMeasuredPlanInformation::vtkMeasuredPlanInformation() = default;

//------------------------------------------------------------------------------
vtkMeasuredPlanInformation::~vtkMeasuredPlanInformation() = default;

//------------------------------------------------------------------------------
void vtkMeasuredPlanInformation::CopyFromObject(vtkObject* object)
{
  auto* representation = vtkMeasuredMaterialRepresentation::SafeDownCast(object);
  this->Plan = representation ? representation->GetPlan() : "";
}

//------------------------------------------------------------------------------
void vtkMeasuredPlanInformation::AddInformation(vtkPVInformation* other)
{
  auto* information = vtkMeasuredPlanInformation::SafeDownCast(other);
  if (information && this->Plan.empty())
  {
    this->Plan = information->Plan;
  }
}

//------------------------------------------------------------------------------
void vtkMeasuredPlanInformation::CopyToStream(vtkClientServerStream* stream)
{
  stream->Reset();
  *stream << vtkClientServerStream::Reply << this->Plan.c_str() << vtkClientServerStream::End;
}

//------------------------------------------------------------------------------
void vtkMeasuredPlanInformation::CopyFromStream(const vtkClientServerStream* stream)
{
  const char* text = nullptr;
  if (!stream->GetArgument(0, 0, &text))
  {
    vtkErrorMacro("CopyFromStream: the message has no plan.");
    return;
  }
  this->Plan = text ? text : "";
}

//------------------------------------------------------------------------------
void vtkMeasuredPlanInformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Plan: " << this->Plan << "\n";
}
