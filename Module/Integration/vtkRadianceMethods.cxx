// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceMethods.h"

#include "Printable.h"
#include "vtkBasisRadianceIntegrator.h"
#include "vtkExactRadianceIntegrator.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkObjectFactory.h"
#include "vtkTableRadianceIntegrator.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <mutex>

vtkStandardNewMacro(vtkRadianceMethods);

namespace
{
using Methods = std::vector<vtkSmartPointer<vtkRadianceIntegrator>>;

template <class... Types>
Methods MakeMethods()
{
  return { vtkSmartPointer<Types>::New()... };
}

// The module's own. Of candidates at equal cost, planners try those of the first one first.
Methods MakeOwnMethods()
{
  Methods methods = MakeMethods<vtkTableRadianceIntegrator, vtkHybridRadianceIntegrator,
    vtkLightSetRadianceIntegrator, vtkFilteredRadianceIntegrator, vtkBasisRadianceIntegrator,
    vtkExactRadianceIntegrator>();
  for (const auto& method : methods)
  {
    if (auto* lights = vtkLightSetRadianceIntegrator::SafeDownCast(method))
    {
      lights->SoftLightsOn(); // a planner's lights show no dots
    }
  }
  return methods;
}

// Never destroyed: programs may plan until their very end.
struct Registry
{
  std::mutex Mutex;
  Methods Added;
  const Methods Own = MakeOwnMethods();

  static Registry& Get()
  {
    static Registry* registry = new Registry;
    return *registry;
  }
};

bool IsName(const std::string& name)
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
  if (!IsName(name))
  {
    vtkGenericWarningMacro("vtkRadianceMethods::Register: found the name "
                           << measuredbrdf::Quote(name)
                           << ", expected lower case letters, digits and hyphens.");
    return false;
  }
  Registry& registry = Registry::Get();
  const std::lock_guard<std::mutex> lock(registry.Mutex);
  for (const Methods* known :
    std::initializer_list<const Methods*>{ &registry.Own, &registry.Added })
  {
    if (std::any_of(known->begin(), known->end(),
          [&name](const auto& other) { return other->GetMethodName() == name; }))
    {
      vtkGenericWarningMacro("vtkRadianceMethods::Register: a method is called '"
                             << name << "' already; expected another name.");
      return false;
    }
  }
  registry.Added.emplace_back(method);
  return true;
}

//------------------------------------------------------------------------------
bool vtkRadianceMethods::Unregister(vtkRadianceIntegrator* method)
{
  Registry& registry = Registry::Get();
  const std::lock_guard<std::mutex> lock(registry.Mutex);
  const auto found = std::find(registry.Added.begin(), registry.Added.end(), method);
  if (found == registry.Added.end())
  {
    return false;
  }
  registry.Added.erase(found);
  return true;
}

//------------------------------------------------------------------------------
std::vector<vtkSmartPointer<vtkRadianceIntegrator>> vtkRadianceMethods::GetMethods()
{
  Registry& registry = Registry::Get();
  const std::lock_guard<std::mutex> lock(registry.Mutex);
  Methods all = registry.Own;
  all.insert(all.end(), registry.Added.begin(), registry.Added.end());
  return all;
}

//------------------------------------------------------------------------------
bool vtkRadianceMethods::IsBuiltIn(const std::string& name)
{
  const Methods& own = Registry::Get().Own;
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
  const Methods methods = GetMethods();
  std::string line;
  for (std::size_t k = 0; k < methods.size(); ++k)
  {
    line += (k == 0 ? "" : k + 1 < methods.size() ? ", " : " or ") + methods[k]->GetMethodName();
  }
  return line;
}

//------------------------------------------------------------------------------
void vtkRadianceMethods::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Methods: " << GetNames() << "\n";
}
