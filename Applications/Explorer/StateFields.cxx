// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StateFields.h"

#include "Tool.h"

#include <algorithm>
#include <cmath>
#include <utility>

using nlohmann::ordered_json;

namespace
{
constexpr std::size_t MostFiles = 10000;
}

namespace explorer
{
//------------------------------------------------------------------------------
Fields::Fields(const ordered_json& object, std::string name)
  : Object(object)
  , Name(std::move(name))
{
}

//------------------------------------------------------------------------------
void Fields::Fail(const std::string& key, const std::string& expected) const
{
  throw tool::Error(this->Name + ": \"" + key + "\": expected " + expected);
}

//------------------------------------------------------------------------------
void Fields::Take(const char* key, double& value, double least, double largest) const
{
  const auto found = this->Object.find(key);
  if (found == this->Object.end())
  {
    return;
  }
  const double given = found->is_number() ? found->get<double>() : NAN;
  if (!(given >= least && given <= largest))
  {
    this->Fail(
      key, "a number from " + tool::FormatNumber(least) + " to " + tool::FormatNumber(largest));
  }
  value = given;
}

//------------------------------------------------------------------------------
void Fields::Take(const char* key, int& value, int least, int largest) const
{
  double given = value;
  this->Take(key, given, least, largest);
  if (given != std::floor(given))
  {
    this->Fail(key, "a whole number");
  }
  value = static_cast<int>(given);
}

//------------------------------------------------------------------------------
void Fields::Take(const char* key, bool& value) const
{
  const auto found = this->Object.find(key);
  if (found != this->Object.end() && !found->is_boolean())
  {
    this->Fail(key, "true or false");
  }
  value = found != this->Object.end() ? found->get<bool>() : value;
}

//------------------------------------------------------------------------------
void Fields::Take(const char* key, std::string& value) const
{
  const auto found = this->Object.find(key);
  if (found == this->Object.end())
  {
    return;
  }
  if (!found->is_string() || found->get<std::string>().empty())
  {
    this->Fail(key, "a text");
  }
  value = found->get<std::string>();
}

//------------------------------------------------------------------------------
void Fields::Take(const char* key, std::vector<std::string>& values) const
{
  const auto found = this->Object.find(key);
  if (found == this->Object.end())
  {
    return;
  }
  const bool good = found->is_array() && found->size() <= MostFiles &&
                    std::all_of(found->begin(), found->end(),
                      [](const ordered_json& item) { return item.is_string(); });
  if (!good)
  {
    this->Fail(key, "a list of texts");
  }
  values = found->get<std::vector<std::string>>();
}

//------------------------------------------------------------------------------
void Fields::Take(const char* key, std::array<double, 3>& values) const
{
  const auto found = this->Object.find(key);
  if (found == this->Object.end())
  {
    return;
  }
  const bool good = found->is_array() && found->size() == 3 &&
                    std::all_of(found->begin(), found->end(),
                      [](const ordered_json& item)
                      { return item.is_number() && std::abs(item.get<double>()) < 1e30; });
  if (!good)
  {
    this->Fail(key, "three numbers");
  }
  values = found->get<std::array<double, 3>>();
}

//------------------------------------------------------------------------------
void Fields::Take(
  const std::string& key, std::vector<double>& values, double least, double largest) const
{
  const auto found = this->Object.find(key);
  if (found == this->Object.end())
  {
    return;
  }
  const ordered_json given = found->is_array() ? *found : ordered_json::array({ *found });
  const bool good =
    given.size() == values.size() &&
    std::all_of(given.begin(), given.end(),
      [&](const ordered_json& item)
      { return item.is_number() && item.get<double>() >= least && item.get<double>() <= largest; });
  if (!good)
  {
    this->Fail(key,
      (values.size() == 1 ? std::string("a number") : std::to_string(values.size()) + " numbers") +
        " from " + tool::FormatNumber(least) + " to " + tool::FormatNumber(largest));
  }
  values = given.get<std::vector<double>>();
}

//------------------------------------------------------------------------------
const ordered_json* Fields::FindObject(const std::string& key) const
{
  const auto found = this->Object.find(key);
  if (found == this->Object.end())
  {
    return nullptr;
  }
  if (!found->is_object())
  {
    this->Fail(key, "an object");
  }
  return &*found;
}
} // namespace explorer
