// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMMeasuredMaterialRepresentationProxy.h"

#include "vtkClientServerStream.h"
#include "vtkObjectFactory.h"
#include "vtkPVSession.h"
#include "vtkSMPropertyHelper.h"

#include <string>

vtkStandardNewMacro(vtkSMMeasuredMaterialRepresentationProxy);

//------------------------------------------------------------------------------
void vtkSMMeasuredMaterialRepresentationProxy::UpdatePropertyInformationInternal(
  vtkSMProperty* property)
{
  this->Superclass::UpdatePropertyInformationInternal(property);
  vtkSMProperty* plan = this->GetProperty("MeasuredPlan");
  if (!plan || (property && property != plan) || !this->ObjectsCreated)
  {
    return;
  }
  std::string text;
  for (const vtkTypeUInt32 place : { vtkPVSession::CLIENT, vtkPVSession::RENDER_SERVER_ROOT })
  {
    vtkClientServerStream stream;
    stream << vtkClientServerStream::Invoke << VTKOBJECT(this) << "GetPlan"
           << vtkClientServerStream::End;
    const char* answer = nullptr;
    if (text.empty())
    {
      this->ExecuteStream(stream, true, place);
      this->GetLastResult(place).GetArgument(0, 0, &answer);
      text = answer ? answer : "";
    }
  }
  vtkSMPropertyHelper(plan).Set(text.c_str());
}

//------------------------------------------------------------------------------
void vtkSMMeasuredMaterialRepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
