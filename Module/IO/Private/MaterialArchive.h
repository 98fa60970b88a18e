// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Any vtkBRDF as plain data: its representation's name, options, numbers, arrays and terms. The one
 * place that knows what each representation is made of; ExrMaterialFile puts it into a file.
 */

#ifndef MaterialArchive_h
#define MaterialArchive_h

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

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

/**
 * To call before an array's values are read: throws std::runtime_error where they are more than a
 * representation takes.
 */
void CheckShape(const std::string& representation, const std::vector<int>& shape);

/// Throws std::runtime_error naming what can't be stored.
MaterialArchive ToArchive(vtkBRDF* brdf);

/// Throws std::runtime_error naming the field that is missing or out of range.
vtkSmartPointer<vtkBRDF> FromArchive(MaterialArchive archive);
} // namespace measuredbrdf

#endif
