// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Numbers in which materials differ, in one texture: a row for each material. Private to the
 * rendering room.
 */

#ifndef StackNumbers_h
#define StackNumbers_h

#include "vtkBRDFShaderInputs.h"

#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
class StackNumbers
{
public:
  /// texture: the sampler, without the 0 that Finish's term stands for; number: the global variable
  /// that holds the material's number.
  StackNumbers(std::string texture, std::string number, std::size_t materials);

  /// values: of those materials, one or three each. The statement that fills a variable with those
  /// of the pixel's material.
  std::string Add(const std::string& variable, const std::vector<std::size_t>& materials,
    const std::vector<std::vector<float>>& values);

  /// The declaration of such a variable.
  static std::string Declare(const std::string& variable, const std::vector<float>& value);

  /// Give all to the term of the number 0. Returns whether its texture's sides have mostTexels at
  /// most.
  bool Finish(int mostTexels, vtkBRDFShaderInputs::Term& term) const;

private:
  std::string Texture;
  std::string Number;
  std::size_t Materials;
  std::vector<std::vector<float>> Columns; // four numbers a row
};
} // namespace measuredbrdf

#endif
