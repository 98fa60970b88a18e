// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFExchange.h"

#include "NumberText.h"

#include <algorithm>
#include <cmath>
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
void vtkBRDFExchange::Fail(const std::string& problem)
{
  if (this->Problem.empty())
  {
    this->Problem = this->Data.Model + ": " + problem;
  }
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Check(const std::string& problem)
{
  if (!problem.empty())
  {
    this->Fail(problem);
  }
}

//------------------------------------------------------------------------------
bool vtkBRDFExchange::FindNumbers(const std::string& name, std::size_t count, const double*& values)
{
  const auto found = this->Data.Numbers.find(name);
  if (found == this->Data.Numbers.end() || found->second.size() != count)
  {
    this->Fail("number '" + name + "' is missing or not of " + std::to_string(count) + " values");
    return false;
  }
  values = found->second.data();
  if (!std::all_of(values, values + count, [](double value) { return std::isfinite(value); }))
  {
    this->Fail("number '" + name + "' is not finite");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::SaveNumbers(const std::string& name, const double* values, std::size_t count)
{
  if (!std::all_of(values, values + count, [](double value) { return std::isfinite(value); }))
  {
    this->Fail("'" + name + "' is not finite");
  }
  this->Data.Numbers[name].assign(values, values + count);
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Number(
  const std::string& name, const double& member, const std::function<void(double)>& set)
{
  this->Named = true;
  const double* values = nullptr;
  if (this->HasFailed())
  {
    return;
  }
  if (!this->Loading)
  {
    this->SaveNumbers(name, &member, 1);
  }
  else if (this->FindNumbers(name, 1, values))
  {
    set(values[0]);
    if (member != values[0]) // it was clamped or refused
    {
      this->Fail("number '" + name + "' is out of range: " + measuredbrdf::NumberText(values[0]));
    }
  }
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Triple(
  const std::string& name, const double (&member)[3], const std::function<void(const double*)>& set)
{
  this->Named = true;
  const double* values = nullptr;
  if (this->HasFailed())
  {
    return;
  }
  if (!this->Loading)
  {
    this->SaveNumbers(name, member, 3);
  }
  else if (this->FindNumbers(name, 3, values))
  {
    set(values);
    if (!std::equal(member, member + 3, values))
    {
      this->Fail("number '" + name + "' is out of range");
    }
  }
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Option(const std::string& name, const std::vector<std::string>& choices,
  int value, const std::function<void(int)>& set)
{
  this->Named = true;
  if (this->HasFailed())
  {
    return;
  }
  if (!this->Loading)
  {
    if (value < 0 || value >= static_cast<int>(choices.size()))
    {
      this->Fail("option '" + name + "' has no choice " + std::to_string(value));
      return;
    }
    this->Data.Options[name] = choices[static_cast<std::size_t>(value)];
    return;
  }
  const auto found = this->Data.Options.find(name);
  const auto choice = found == this->Data.Options.end()
                        ? choices.end()
                        : std::find(choices.begin(), choices.end(), found->second);
  if (choice == choices.end())
  {
    this->Fail("option '" + name + "' is missing or unknown");
    return;
  }
  set(static_cast<int>(choice - choices.begin()));
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::SaveArray(const std::string& name, const std::vector<int>& shape,
  int channels, const std::vector<float>& values)
{
  this->Named = true;
  if (this->HasFailed())
  {
    return;
  }
  std::size_t count = static_cast<std::size_t>(channels);
  for (const int size : shape)
  {
    count *= static_cast<std::size_t>(std::max(size, 0));
  }
  if (count == 0 || count != values.size())
  {
    this->Fail("array '" + name + "' is empty or not of its shape");
    return;
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
  else if (found->second.Shape.size() != axes || found->second.Channels != channels)
  {
    this->Fail("array '" + name + "' has " + std::to_string(found->second.Shape.size()) +
               " axes and " + std::to_string(found->second.Channels) + " channels, expected " +
               std::to_string(axes) + " and " + std::to_string(channels));
  }
  if (this->HasFailed())
  {
    return { std::vector<int>(axes, 0), channels, {} };
  }
  return std::move(found->second);
}

//------------------------------------------------------------------------------
void vtkBRDFExchange::Terms(const std::vector<vtkSmartPointer<vtkBRDF>>& terms, int maximum,
  const std::function<void(vtkBRDF*)>& add)
{
  this->Named = true;
  if (this->HasFailed())
  {
    return;
  }
  if (!this->Loading)
  {
    for (vtkBRDF* term : terms)
    {
      vtkBRDFData& data = this->Data.Terms.emplace_back();
      const std::string problem = this->SaveTerm(term, data);
      if (!problem.empty())
      {
        this->Problem = problem; // names its own model
        return;
      }
    }
    return;
  }
  if (this->Data.Terms.size() > static_cast<std::size_t>(maximum))
  {
    this->Fail(std::to_string(this->Data.Terms.size()) + " terms, expected at most " +
               std::to_string(maximum));
    return;
  }
  for (vtkBRDFData& data : this->Data.Terms)
  {
    vtkSmartPointer<vtkBRDF> term;
    const std::string problem = this->LoadTerm(data, term);
    if (!problem.empty())
    {
      this->Problem = problem;
      return;
    }
    add(term);
  }
}
