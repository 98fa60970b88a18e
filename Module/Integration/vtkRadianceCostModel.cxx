// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceCostModel.h"

#include "NumberText.h"
#include "Printable.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cstddef>
#include <locale>
#include <sstream>

namespace
{
constexpr char Title[] = "vtkRadianceCostModel 3"; // the number rises with the format
constexpr double LeastCost = 1e-6;
constexpr double LargestCost = 1e6;
constexpr std::size_t BuiltIn = 6;
constexpr std::size_t MostCosts = 64;
constexpr std::size_t LongestName = 32;

bool IsCost(double nanoseconds) { return nanoseconds >= LeastCost && nanoseconds <= LargestCost; }

bool IsCostName(const std::string& name)
{
  return !name.empty() && name.size() <= LongestName &&
         std::all_of(name.begin(), name.end(),
           [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
}
}

vtkStandardNewMacro(vtkRadianceCostModel);

//------------------------------------------------------------------------------
int vtkRadianceCostModel::GetNumberOfCosts() { return static_cast<int>(this->Costs.size()); }

//------------------------------------------------------------------------------
std::string vtkRadianceCostModel::GetCostName(int index)
{
  return index >= 0 && index < this->GetNumberOfCosts()
           ? this->Costs[static_cast<std::size_t>(index)].first
           : "";
}

//------------------------------------------------------------------------------
bool vtkRadianceCostModel::SetCost(const std::string& name, double nanoseconds)
{
  const auto found = std::find_if(this->Costs.begin(), this->Costs.end(),
    [&name](const auto& cost) { return cost.first == name; });
  const bool isNew = found == this->Costs.end();
  if (!IsCostName(name) || !IsCost(nanoseconds) || (isNew && this->Costs.size() >= MostCosts))
  {
    vtkErrorMacro("SetCost: found " << measuredbrdf::Quote(name) << " of " << nanoseconds
                                    << " ns, expected one of at most " << MostCosts
                                    << " names, of lower case letters, digits and hyphens, and "
                                       "1e-6 to 1e6 ns.");
    return false;
  }
  if (isNew)
  {
    this->Costs.emplace_back(name, nanoseconds);
    this->Modified();
  }
  else if (found->second != nanoseconds)
  {
    found->second = nanoseconds;
    this->Modified();
  }
  return true;
}

//------------------------------------------------------------------------------
double vtkRadianceCostModel::GetCost(const std::string& name, double unknown)
{
  const auto found = std::find_if(this->Costs.begin(), this->Costs.end(),
    [&name](const auto& cost) { return cost.first == name; });
  return found == this->Costs.end() ? unknown : found->second;
}

//------------------------------------------------------------------------------
std::string vtkRadianceCostModel::GetText()
{
  measuredbrdf::TextStream text;
  text.precision(17);
  text << Title << "\n" << this->Name << "\n";
  for (const auto& [name, cost] : this->Costs)
  {
    text << name << " " << cost << "\n";
  }
  return text.str();
}

//------------------------------------------------------------------------------
bool vtkRadianceCostModel::SetText(const std::string& text)
{
  std::istringstream lines(text);
  lines.imbue(std::locale::classic());
  std::string title;
  std::string name;
  std::getline(lines, title);
  std::getline(lines, name);
  // A last line without an end may be cut in the middle of its number.
  if (title != Title || text.back() != '\n')
  {
    return false;
  }
  std::vector<std::pair<std::string, double>> costs;
  std::string word;
  double cost = 0.0;
  while (costs.size() < MostCosts && lines >> word)
  {
    const bool known = std::any_of(
      costs.begin(), costs.end(), [&word](const auto& other) { return other.first == word; });
    const bool expected = costs.size() >= BuiltIn || word == this->Costs[costs.size()].first;
    if (!(lines >> cost) || !IsCost(cost) || !IsCostName(word) || known || !expected)
    {
      return false;
    }
    costs.emplace_back(word, cost);
  }
  if (costs.size() < BuiltIn || !(lines >> std::ws).eof())
  {
    return false;
  }
  this->Name = name;
  this->Costs = std::move(costs);
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
void vtkRadianceCostModel::DeepCopy(vtkRadianceCostModel* source)
{
  if (!source)
  {
    vtkErrorMacro("DeepCopy: there is no cost model to copy.");
    return;
  }
  this->Costs = source->Costs;
  this->Name = source->Name;
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRadianceCostModel::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Name: " << this->Name << "\n";
  for (const auto& [name, cost] : this->Costs)
  {
    os << indent << name << ": " << cost << " ns\n";
  }
}
