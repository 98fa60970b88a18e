// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackNumbers.h"

#include <algorithm>
#include <utility>

namespace measuredbrdf
{
StackNumbers::StackNumbers(std::string texture, std::string number, std::size_t materials)
  : Texture(std::move(texture))
  , Number(std::move(number))
  , Materials(materials)
{
}

std::string StackNumbers::Declare(const std::string& variable, const std::vector<float>& value)
{
  return (value.size() == 1 ? "float " : "vec3 ") + variable + ";\n";
}

std::string StackNumbers::Add(const std::string& variable,
  const std::vector<std::size_t>& materials, const std::vector<std::vector<float>>& values)
{
  std::vector<float> column(4 * this->Materials, 0.0f);
  for (std::size_t k = 0; k < materials.size(); ++k)
  {
    std::copy(values[k].begin(), values[k].end(),
      column.begin() + static_cast<std::ptrdiff_t>(4 * materials[k]));
  }
  this->Columns.push_back(std::move(column));
  return variable + " = texelFetch(" + this->Texture + "0, ivec2(" +
         std::to_string(this->Columns.size() - 1) + ", " + this->Number + "), 0)." +
         (values.front().size() == 1 ? "r" : "rgb") + ";\n";
}

bool StackNumbers::Finish(int mostTexels, vtkBRDFShaderInputs::Term& term) const
{
  if (this->Columns.empty())
  {
    return true;
  }
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = this->Texture;
  texture.Components = 4;
  texture.Dimensions = { static_cast<int>(this->Columns.size()), static_cast<int>(this->Materials),
    1 };
  for (std::size_t k = 0; k < this->Materials; ++k)
  {
    for (const std::vector<float>& column : this->Columns)
    {
      const auto row = column.begin() + static_cast<std::ptrdiff_t>(4 * k);
      texture.Data.insert(texture.Data.end(), row, row + 4);
    }
  }
  term.Source = "uniform sampler2D " + this->Texture + "INSTANCE;\n" + term.Source;
  const bool fits = std::max(texture.Dimensions[0], texture.Dimensions[1]) <= mostTexels;
  term.Textures.push_back(std::move(texture));
  return fits;
}
} // namespace measuredbrdf
