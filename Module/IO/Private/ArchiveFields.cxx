// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ArchiveFields.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace measuredbrdf
{
//------------------------------------------------------------------------------
std::string ToText(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

//------------------------------------------------------------------------------
void ArchiveSaver::Array(
  const std::string& name, std::vector<int> shape, int channels, const std::vector<float>& values)
{
  std::size_t count = static_cast<std::size_t>(channels);
  for (const int size : shape)
  {
    count *= static_cast<std::size_t>(std::max(size, 0));
  }
  if (count == 0 || count != values.size())
  {
    throw std::runtime_error(this->Archive.Representation + ": array '" + name + "' is empty");
  }
  this->Archive.Arrays[name] = { std::move(shape), channels, values };
}

//------------------------------------------------------------------------------
void ArchiveSaver::CheckFinite(const std::string& name, double value) const
{
  if (!std::isfinite(value))
  {
    throw std::runtime_error(this->Archive.Representation + ": '" + name + "' is not finite");
  }
}

//------------------------------------------------------------------------------
MaterialArchive::Array ArchiveLoader::TakeArray(
  const std::string& name, std::size_t rank, int channels)
{
  const auto found = this->Archive.Arrays.find(name);
  if (found == this->Archive.Arrays.end())
  {
    this->Fail("array '" + name + "' is missing");
  }
  if (found->second.Shape.size() != rank || found->second.Channels != channels)
  {
    this->Fail("array '" + name + "' has " + std::to_string(found->second.Shape.size()) +
               " axes and " + std::to_string(found->second.Channels) + " channels, expected " +
               std::to_string(rank) + " and " + std::to_string(channels));
  }
  return std::move(found->second);
}

//------------------------------------------------------------------------------
void ArchiveLoader::Fail(const std::string& what) const
{
  throw std::runtime_error(this->Archive.Representation + ": " + what);
}

//------------------------------------------------------------------------------
const std::vector<double>& ArchiveLoader::GetNumbers(
  const std::string& name, std::size_t count) const
{
  const auto found = this->Archive.Numbers.find(name);
  if (found == this->Archive.Numbers.end() || found->second.size() != count)
  {
    this->Fail("number '" + name + "' is missing or not of " + std::to_string(count) + " values");
  }
  return found->second;
}

//------------------------------------------------------------------------------
int ArchiveLoader::FindOption(
  const std::string& name, const std::vector<std::string>& choices) const
{
  const auto found = this->Archive.Options.find(name);
  const auto choice = found == this->Archive.Options.end()
                        ? choices.end()
                        : std::find(choices.begin(), choices.end(), found->second);
  if (choice == choices.end())
  {
    this->Fail("option '" + name + "' is missing or unknown");
  }
  return static_cast<int>(choice - choices.begin());
}
} // namespace measuredbrdf
