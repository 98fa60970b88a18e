// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceCostModel.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <locale>
#include <sstream>

namespace
{
constexpr char Title[] = "vtkRadianceCostModel 1"; // the number rises with the format
constexpr double LeastCost = 1e-6;
constexpr double LargestCost = 1e6;
const char* const Names[] = { "base", "table", "light", "sample", "function" };

bool IsCost(double nanoseconds) { return nanoseconds >= LeastCost && nanoseconds <= LargestCost; }
}

vtkStandardNewMacro(vtkRadianceCostModel);

//------------------------------------------------------------------------------
std::string vtkRadianceCostModel::GetCostName(int type)
{
  return type >= 0 && type < NUMBER_OF_COSTS ? Names[type] : "";
}

//------------------------------------------------------------------------------
bool vtkRadianceCostModel::SetCost(int type, double nanoseconds)
{
  if (type < 0 || type >= NUMBER_OF_COSTS || !IsCost(nanoseconds))
  {
    vtkErrorMacro("SetCost: cost " << type << " of " << nanoseconds
                                   << " ns, expected a type in [0, 4] and 1e-6 to 1e6 ns.");
    return false;
  }
  if (this->Costs[type] != nanoseconds)
  {
    this->Costs[type] = nanoseconds;
    this->Modified();
  }
  return true;
}

//------------------------------------------------------------------------------
double vtkRadianceCostModel::GetCost(int type)
{
  return type >= 0 && type < NUMBER_OF_COSTS ? this->Costs[type] : 0.0;
}

//------------------------------------------------------------------------------
std::string vtkRadianceCostModel::GetText()
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << Title << "\n" << this->Name << "\n";
  for (int type = 0; type < NUMBER_OF_COSTS; ++type)
  {
    text << Names[type] << " " << this->Costs[type] << "\n";
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
  double costs[NUMBER_OF_COSTS];
  for (int type = 0; type < NUMBER_OF_COSTS; ++type)
  {
    std::string word;
    if (!(lines >> word >> costs[type]) || word != Names[type] || !IsCost(costs[type]))
    {
      return false;
    }
  }
  // A last line without an end may be cut in the middle of its number.
  if (title != Title || text.back() != '\n' || !(lines >> std::ws).eof())
  {
    return false;
  }
  this->Name = name;
  std::copy_n(costs, static_cast<int>(NUMBER_OF_COSTS), this->Costs);
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
void vtkRadianceCostModel::DeepCopy(vtkRadianceCostModel* source)
{
  std::copy_n(source->Costs, static_cast<int>(NUMBER_OF_COSTS), this->Costs);
  this->Name = source->Name;
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRadianceCostModel::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Name: " << this->Name << "\n";
  for (int type = 0; type < NUMBER_OF_COSTS; ++type)
  {
    os << indent << Names[type] << ": " << this->Costs[type] << " ns\n";
  }
}
