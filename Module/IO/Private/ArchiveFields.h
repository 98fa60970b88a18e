// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material's members as an archive's options, numbers and arrays. ArchiveSaver fills an archive,
 * ArchiveLoader a material; both get a member's name, its getter and its setter, so that one
 * description of a representation serves both ways.
 */

#ifndef ArchiveFields_h
#define ArchiveFields_h

#include "MaterialArchive.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// A number as messages show it.
std::string ToText(double value);

/// All throw std::runtime_error naming what can't be stored.
class ArchiveSaver
{
public:
  explicit ArchiveSaver(MaterialArchive& archive)
    : Archive(archive)
  {
  }

  template <typename Get, typename Set>
  void Number(const std::string& name, Get get, Set)
  {
    const double value = get();
    this->CheckFinite(name, value);
    this->Archive.Numbers[name] = { value };
  }

  template <typename Get, typename Set>
  void Color(const std::string& name, Get get, Set)
  {
    double value[3];
    get(value);
    for (double channel : value)
    {
      this->CheckFinite(name, channel);
    }
    this->Archive.Numbers[name].assign(value, value + 3);
  }

  template <typename Get, typename Set>
  void Option(const std::string& name, const std::vector<std::string>& choices, Get get, Set)
  {
    this->Archive.Options[name] = choices.at(static_cast<std::size_t>(get()));
  }

  void Array(const std::string& name, std::vector<int> shape, int channels,
    const std::vector<float>& values);

private:
  void CheckFinite(const std::string& name, double value) const;

  MaterialArchive& Archive;
};

/// All throw std::runtime_error naming the field that is missing or out of range.
class ArchiveLoader
{
public:
  explicit ArchiveLoader(MaterialArchive& archive)
    : Archive(archive)
  {
  }

  template <typename Get, typename Set>
  void Number(const std::string& name, Get get, Set set)
  {
    const double value = this->GetNumbers(name, 1)[0];
    set(value);
    if (static_cast<double>(get()) != value) // it was clamped or refused
    {
      this->Fail("number '" + name + "' is out of range: " + ToText(value));
    }
  }

  template <typename Get, typename Set>
  void Color(const std::string& name, Get get, Set set)
  {
    const std::vector<double>& value = this->GetNumbers(name, 3);
    set(value.data());
    double taken[3];
    get(taken);
    if (!std::equal(taken, taken + 3, value.begin()))
    {
      this->Fail("number '" + name + "' is out of range");
    }
  }

  template <typename Get, typename Set>
  void Option(const std::string& name, const std::vector<std::string>& choices, Get, Set set)
  {
    set(this->FindOption(name, choices));
  }

  MaterialArchive::Array TakeArray(const std::string& name, std::size_t rank, int channels);

  [[noreturn]] void Fail(const std::string& what) const;

private:
  const std::vector<double>& GetNumbers(const std::string& name, std::size_t count) const;
  int FindOption(const std::string& name, const std::vector<std::string>& choices) const;

  MaterialArchive& Archive;
};
} // namespace measuredbrdf

#endif
