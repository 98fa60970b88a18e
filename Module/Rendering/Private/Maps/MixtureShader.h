// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The shader's text that finds the weights of the materials that meet in a pixel. Private to the
 * rendering component. C++ twins: vtkMaterialMap::GetWeight and linear interpolation.
 */

#ifndef MixtureShader_h
#define MixtureShader_h

#include "MaterialParts.h"

#include <string>
#include <utility>
#include <vector>

namespace measuredbrdf
{
class MixtureShader
{
public:
  /// imageComponents: of each image of weights.
  MixtureShader(const MaterialPart& part, const std::vector<int>& imageComponents);

  /// Attributes that the vertex shader hands on: name and type in GLSL, which is also the name of
  /// the part's point array.
  const std::vector<std::pair<std::string, std::string>>& GetAttributes() const
  {
    return this->Attributes;
  }

  ///@{
  /// For the fragment shader: declarations, and what fills brdfWeights. drawn: which of the part's
  /// members have a share; the others' is divided among them. What is not this part's is discarded.
  std::string GetDeclarations() const;
  std::string GetImplementation(const std::vector<bool>& drawn) const;
  ///@}

private:
  std::string GetWeight(int slot) const;

  const MaterialPart& Part;
  std::vector<int> ImageComponents;
  std::vector<std::pair<std::string, std::string>> Attributes;
};
} // namespace measuredbrdf

#endif
