// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Any vtkBRDF as plain data: its representation's name, options, numbers, arrays and terms.
 * MaterialExchange makes one of a material and back; ExrMaterialFile puts it into a file.
 */

#ifndef MaterialArchive_h
#define MaterialArchive_h

#include <map>
#include <string>
#include <vector>

namespace measuredbrdf
{
struct MaterialArchive
{
  struct Array
  {
    std::vector<int> Shape; // slowest axis first
    int Channels = 1;       // 1 or 3, interleaved
    std::vector<float> Values;
  };

  std::string Representation; // "Lambert", "Tabulated", ...
  std::string Name;
  std::string Source;
  std::map<std::string, std::string> Options;
  std::map<std::string, std::vector<double>> Numbers;
  std::map<std::string, Array> Arrays;
  std::vector<MaterialArchive> Terms;
};
} // namespace measuredbrdf

#endif
