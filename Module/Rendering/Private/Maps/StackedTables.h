// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Tables of several materials, also of different sizes, in one texture: where each lies, and GLSL
 * that reads one of them as if it were alone. Private to the rendering room.
 *
 * Coordinates are clamped as the texture unit would clamp those of a table alone, so that nothing
 * of a neighbor is filtered in. Along an axis that repeats, tables of one size have the texture's
 * whole length; others are repeated in GLSL and have a texel of their other end on either side.
 */

#ifndef StackedTables_h
#define StackedTables_h

#include "vtkBRDFShaderInputs.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
class StackedTables
{
public:
  using Texture = vtkBRDFShaderInputs::Texture;

  /// A vector that each table has a value of, in texels.
  struct Number
  {
    std::string Name; // without INSTANCE
    std::vector<std::vector<float>> Values;
  };

  /// Finds places for tables of the same name and format. mostTexels: of a side. Returns false
  /// where they do not fit, or would take more than twice their own memory.
  bool Arrange(const std::vector<const Texture*>& tables, int mostTexels);

  /// All of them, as arranged.
  Texture Fill() const;

  /// Every use of the sampler in the text becomes a use of a function that reads the table; its
  /// declaration moves to declarations. Returns false, with a text of no use, where there is a use
  /// that is not known.
  bool UseReaders(std::string& text, std::string& declarations) const;

  /// What the functions need, by table: global variables that the caller declares and sets.
  std::vector<Number> GetNumbers() const;

private:
  using Texels = std::array<int, 3>;

  void Sort();
  void Place(int width, int height);
  bool IsBordered(std::size_t axis) const; // a texel on either side
  bool IsShifted(std::size_t axis) const;  // coordinates are the table's, not the texture's
  Texels GetBox(std::size_t table) const;  // with the border
  std::string GetSize(std::size_t axis) const;
  std::string Shift(std::size_t axis) const;
  std::string DeclareReaders() const;
  template <typename Value>
  void Copy(std::vector<Value> Texture::*values, Texture& texture) const;

  std::vector<const Texture*> Tables;
  std::vector<std::size_t> Order; // in which they are placed
  std::array<bool, 3> OfOneSize = { true, true, true };
  Texels Dimensions = { 1, 1, 1 };
  std::vector<Texels> Boxes; // where each begins, border included
};
} // namespace measuredbrdf

#endif
