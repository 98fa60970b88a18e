// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Fields of a state file's objects: each is taken, or refused by its name. Without Qt.
 */

#ifndef StateFields_h
#define StateFields_h

#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <vector>

namespace explorer
{
/// What is absent keeps its value; what is wrong throws tool::Error, which names the field and what
/// was expected.
class Fields
{
public:
  /// name: of the file and, of an object in it, its field.
  Fields(const nlohmann::ordered_json& object, std::string name);

  [[noreturn]] void Fail(const std::string& key, const std::string& expected) const;

  void Take(const char* key, double& value, double least, double largest) const;
  void Take(const char* key, int& value, int least, int largest) const;
  void Take(const char* key, bool& value) const;
  void Take(const char* key, std::string& value) const;
  void Take(const char* key, std::vector<std::string>& values) const;
  void Take(const char* key, std::array<double, 3>& values) const;

  /// As many numbers as there are values; one of them may stand alone.
  void Take(
    const std::string& key, std::vector<double>& values, double least, double largest) const;

  /// An object in it; null where it is absent.
  const nlohmann::ordered_json* FindObject(const std::string& key) const;

  const nlohmann::ordered_json& GetObject() const { return this->Object; }
  const std::string& GetName() const { return this->Name; }

private:
  const nlohmann::ordered_json& Object;
  std::string Name;
};
} // namespace explorer

#endif
