// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceMethods.h"

#include "Printable.h"
#include "Registry.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkObjectFactory.h"
#include "vtkTableRadianceIntegrator.h"

#include <algorithm>

vtkStandardNewMacro(vtkRadianceMethods);

namespace
{
using measuredbrdf::Registry;
using Methods = Registry<vtkRadianceIntegrator>::Items;

// The module's own, in the order in which programs and lists show them.
Methods MakeOwnMethods()
{
  Methods methods = Registry<vtkRadianceIntegrator>::Make<vtkTableRadianceIntegrator,
    vtkHybridRadianceIntegrator, vtkLightSetRadianceIntegrator, vtkFilteredRadianceIntegrator,
    vtkAdaptiveRadianceIntegrator>();
  for (const auto& method : methods)
  {
    if (auto* lights = vtkLightSetRadianceIntegrator::SafeDownCast(method))
    {
      lights->SoftLightsOn(); // a planner's lights show no dots
    }
  }
  return methods;
}

Registry<vtkRadianceIntegrator>& GetRegistry()
{
  static auto& registry = Registry<vtkRadianceIntegrator>::MakeShared(MakeOwnMethods());
  return registry;
}

bool IsMethodName(const std::string& name)
{
  return !name.empty() &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
}
}

//------------------------------------------------------------------------------
bool vtkRadianceMethods::Register(vtkRadianceIntegrator* method)
{
  if (!method)
  {
    vtkGenericWarningMacro("vtkRadianceMethods::Register: there is no integrator.");
    return false;
  }
  const std::string name = method->GetMethodName();
  if (!IsMethodName(name))
  {
    vtkGenericWarningMacro("vtkRadianceMethods::Register: found the name "
                           << measuredbrdf::Quote(name)
                           << ", expected lower case letters, digits and hyphens.");
    return false;
  }
  if (!GetRegistry().Add(
        method, [](vtkRadianceIntegrator* other) { return other->GetMethodName(); }))
  {
    vtkGenericWarningMacro("vtkRadianceMethods::Register: a method is called '"
                           << name << "' already; expected another name.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkRadianceMethods::Unregister(vtkRadianceIntegrator* method)
{
  return GetRegistry().Remove(method);
}

//------------------------------------------------------------------------------
std::vector<vtkSmartPointer<vtkRadianceIntegrator>> vtkRadianceMethods::GetMethods()
{
  return GetRegistry().GetAll();
}

//------------------------------------------------------------------------------
bool vtkRadianceMethods::IsBuiltIn(const std::string& name)
{
  const Methods& own = GetRegistry().GetOwn();
  return std::any_of(own.begin(), own.end(),
    [&name](const auto& method) { return method->GetMethodName() == name; });
}

//------------------------------------------------------------------------------
vtkRadianceIntegrator* vtkRadianceMethods::NewIntegrator(const std::string& name)
{
  for (const auto& method : GetMethods())
  {
    if (method->GetMethodName() == name)
    {
      return method->NewCopy();
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
std::string vtkRadianceMethods::GetNames()
{
  return measuredbrdf::JoinNames(
    GetMethods(), [](const auto& method) { return method->GetMethodName(); });
}

//------------------------------------------------------------------------------
void vtkRadianceMethods::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Methods: " << GetNames() << "\n";
}
