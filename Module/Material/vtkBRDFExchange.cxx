// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFExchange.h"

#include "NumberText.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

//------------------------------------------------------------------------------
vtkBRDFExchange::vtkBRDFExchange(vtkBRDFData& data, bool loading)
  : Data(data)
  , Loading(loading)
{
}

//------------------------------------------------------------------------------
vtkBRDFExchange::~vtkBRDFExchange() = default;

//------------------------------------------------------------------------------
void vtkBRDFExchange::Fail(const std::string& problem) const
{
  throw std::runtime_error(this->Data.Model + ": " + problem);
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Check(const std::string& problem) const
{
  if (!problem.empty())
  {
    this->Fail(problem);
  }
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Numbers(const std::string& name, const double* member, std::size_t count,
  const std::function<void(const double*)>& set)
{
  this->Named = true;
  std::vector<double>& values = this->Data.Numbers[name];
  if (!this->Loading)
  {
    values.assign(member, member + count);
  }
  if (values.size() != count)
  {
    this->Fail("number '" + name + "' is missing or not of " + std::to_string(count) + " values");
  }
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
  {
    this->Fail("number '" + name + "' is not finite");
  }
  if (this->Loading)
  {
    set(values.data());
    if (!std::equal(values.begin(), values.end(), member)) // it was clamped or refused
    {
      this->Fail("number '" + name + "' is out of range: " + measuredbrdf::NumberText(values[0]));
    }
  }
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Number(
  const std::string& name, const double& member, const std::function<void(double)>& set)
{
  this->Numbers(name, &member, 1, [&set](const double* values) { set(values[0]); });
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Triple(
  const std::string& name, const double (&member)[3], const std::function<void(const double*)>& set)
{
  this->Numbers(name, member, 3, set);
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Flag(
  const std::string& name, bool value, const std::function<void(bool)>& set)
{
  this->Option(name, { "off", "on" }, value ? 1 : 0, [&set](int on) { set(on == 1); });
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Option(const std::string& name, const std::vector<std::string>& choices,
  int value, const std::function<void(int)>& set)
{
  this->Named = true;
  std::string& option = this->Data.Options[name];
  if (!this->Loading)
  {
    if (value < 0 || value >= static_cast<int>(choices.size()))
    {
      this->Fail("option '" + name + "' has no choice " + std::to_string(value));
    }
    option = choices[value];
    return;
  }
  const auto choice = std::find(choices.begin(), choices.end(), option);
  if (choice == choices.end())
  {
    this->Fail("option '" + name + "' is missing or unknown");
  }
  set(static_cast<int>(choice - choices.begin()));
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::SaveArray(const std::string& name, const std::vector<int>& shape,
  int channels, const std::vector<float>& values)
{
  this->Named = true;
  std::size_t count = channels;
  for (const int size : shape)
  {
    count *= std::max(size, 0);
  }
  if (count == 0 || count != values.size())
  {
    this->Fail("array '" + name + "' is empty or not of its shape");
  }
  this->Data.Arrays[name] = { shape, channels, values };
}

//------------------------------------------------------------------------------
vtkBRDFData::Array vtkBRDFExchange::LoadArray(
  const std::string& name, std::size_t axes, int channels)
{
  this->Named = true;
  const auto found = this->Data.Arrays.find(name);
  if (found == this->Data.Arrays.end())
  {
    this->Fail("array '" + name + "' is missing");
  }
  vtkBRDFData::Array& array = found->second;
  if (array.Shape.size() != axes || array.Channels != channels)
  {
    this->Fail("array '" + name + "' has " + std::to_string(array.Shape.size()) + " axes and " +
               std::to_string(array.Channels) + " channels, expected " + std::to_string(axes) +
               " and " + std::to_string(channels));
  }
  return std::move(array);
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Terms(
  const std::vector<vtkBRDF*>& terms, int maximum, const std::function<void(vtkBRDF*)>& add)
{
  this->Named = true;
  if (!this->Loading)
  {
    for (vtkBRDF* term : terms)
    {
      this->SaveTerm(term, this->Data.Terms.emplace_back());
    }
    return;
  }
  if (this->Data.Terms.size() > static_cast<std::size_t>(maximum))
  {
    this->Fail(std::to_string(this->Data.Terms.size()) + " terms, expected at most " +
               std::to_string(maximum));
  }
  for (vtkBRDFData& data : this->Data.Terms)
  {
    this->LoadTerm(data, add);
  }
}
