// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Shader inputs of several materials as those of one, which evaluates in each pixel the material
 * whose number a variable has. Private to the rendering room.
 *
 * Terms of the same text are one term: tables lie in one texture (StackedTables.h), numbers that
 * differ in a small one (StackNumbers.h). A term that some materials do not have ends at once in
 * their pixels, so that they pay for their own terms only.
 */

#ifndef StackedTerms_h
#define StackedTerms_h

#include "vtkBRDFShaderInputs.h"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace measuredbrdf
{
class StackNumbers;

/// In GLSL.
struct StackNames
{
  std::string Number;  // global variable that holds the material's number
  std::string Texture; // of numbers that differ, without INSTANCE
  std::string Here;    // whether the material has a term, without INSTANCE
  /// What terms define: names without INSTANCE, their parameters and arguments.
  struct Function
  {
    std::string Name;
    std::string Parameters;
    std::string Arguments;
  };
  std::vector<Function> Functions;
};

class StackedTerms
{
public:
  using Term = vtkBRDFShaderInputs::Term;

  explicit StackedTerms(StackNames names)
    : Names(std::move(names))
  {
  }

  /// Find terms of the same text. The forms, one of each material, have to stay.
  void Align(const std::vector<vtkBRDFShaderInputs>& forms);

  /// After Align: samplers that the stack will need, at most.
  std::size_t CountSamplers() const;

  /// mostTexels: of a side of a 2D texture and of a 3D one. Returns false where the texts or tables
  /// do not allow a stack.
  bool Stack(const std::array<int, 2>& mostTexels);

  vtkBRDFShaderInputs& GetForm() { return this->Form; }

  /// Statements that fill the variables that differ, before a material is evaluated.
  const std::string& GetLoad() const { return this->Load; }

private:
  using Terms = std::vector<const Term*>; // of each material; null: it has none such

  // How one term is filled and evaluated.
  struct Text
  {
    std::string Declarations;
    std::string Load;
  };

  bool StackTerm(const Terms& terms, const std::array<int, 2>& mostTexels, StackNumbers& numbers);
  bool StackTextures(const Terms& terms, const std::array<int, 2>& mostTexels, Term& stacked,
    Text& text, StackNumbers& numbers);
  bool StackUniforms(const Terms& terms, Term& stacked, Text& text, StackNumbers& numbers);
  bool SkipElsewhere(Term& stacked, Text& text) const;
  void AddNumber(const std::string& name, const Terms& terms,
    const std::vector<std::vector<float>>& values, Text& text, StackNumbers& numbers) const;

  StackNames Names;
  std::vector<Terms> Aligned;
  vtkBRDFShaderInputs Form;
  std::string Load;
};
} // namespace measuredbrdf

#endif
