// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A folder of one test's own: ctest runs the tests of one program side by side.
 */

#ifndef TestFolder_h
#define TestFolder_h

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <random>
#include <string>

/// A new folder of this test's own, removed at its end.
class TestFolder
{
public:
  explicit TestFolder(const std::filesystem::path& parent = std::filesystem::temp_directory_path())
    : Path(parent / ("measuredbrdf-test-" + std::to_string(std::random_device()()) +
                      std::to_string(std::random_device()())))
  {
    std::filesystem::create_directories(this->Path);
  }
  ~TestFolder()
  {
    std::error_code error;
    std::filesystem::remove_all(this->Path, error);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  const std::filesystem::path& GetPath() const { return this->Path; }

  /// The path of a file in it.
  std::string operator()(const std::string& name) const { return (this->Path / name).string(); }

  /// Files in it and in its folders.
  std::size_t CountFiles() const
  {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(this->Path))
    {
      count += entry.is_regular_file() ? 1 : 0;
    }
    return count;
  }

private:
  std::filesystem::path Path;
};

#endif
