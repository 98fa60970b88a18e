// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Terms of several materials as those of one: where tables and numbers are, what is left out where
// a material has no such term, and what cannot be stacked. What the stacks show is tested with
// pixels (TestMaterialMapBorders.cxx, TestMaterialMapStacks.cxx).

#include "StackedTerms.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace
{
using measuredbrdf::StackedTerms;
using Term = vtkBRDFShaderInputs::Term;
using Texture = vtkBRDFShaderInputs::Texture;

// value: of the first texel.
Texture MakeVolume(float value, const std::array<int, 3>& sides = { 2, 2, 2 })
{
  Texture texture;
  texture.Name = "volume";
  texture.Dimensions = sides;
  texture.ThreeD = true;
  texture.Components = 1;
  texture.Repeat[0] = true;
  for (int k = 0; k < sides[0] * sides[1] * sides[2]; ++k)
  {
    texture.Data.push_back(value + static_cast<float>(k));
  }
  return texture;
}

class ClassStacking : public testing::Test
{
protected:
  ClassStacking()
  {
    for (int k = 0; k < 3; ++k)
    {
      Term term;
      term.Source =
        "uniform sampler3D volumeINSTANCE;\nuniform float scaleINSTANCE;\n"
        "uniform vec3 sameINSTANCE;\n"
        "vec3 fINSTANCE(vec3 p) { return scaleINSTANCE * texture(volumeINSTANCE, p).rgb * "
        "vec3(textureSize(volumeINSTANCE, 0)); }\n";
      term.Uniforms = { { "scale", { 1.0f + static_cast<float>(k) } },
        { "same", { 1.0f, 2.0f, 3.0f } } };
      term.Textures = { MakeVolume(10.0f * static_cast<float>(k)) };
      this->Terms.push_back(term);
    }
  }

  bool Stack(int mostTexels)
  {
    std::vector<vtkBRDFShaderInputs> forms(this->Terms.size());
    for (std::size_t k = 0; k < forms.size(); ++k)
    {
      forms[k].Terms = { this->Terms[k] };
    }
    return this->Stack(forms, mostTexels);
  }

  bool Stack(const std::vector<vtkBRDFShaderInputs>& forms, int mostTexels)
  {
    StackedTerms terms({ "number", "numbers", "here", { { "f", "vec3 p", "p" } } });
    terms.Align(forms);
    const bool stacked = terms.Stack({ mostTexels, mostTexels });
    this->Samplers = terms.CountSamplers();
    this->Form = terms.GetForm();
    this->Stacked = this->Form.Terms.empty() ? Term() : this->Form.Terms.front();
    this->Load = terms.GetLoad();
    return stacked;
  }

  bool Has(const std::string& text) const
  {
    return this->Stacked.Source.find(text) != std::string::npos;
  }

  std::vector<Term> Terms;
  vtkBRDFShaderInputs Form;
  Term Stacked; // the first one
  std::size_t Samplers = 0;
  std::string Load;
};

TEST_F(ClassStacking, TablesLieSideBySide)
{
  ASSERT_TRUE(this->Stack(4)); // room for two of two rows each: the third lies in the next slices
  ASSERT_EQ(this->Stacked.Textures.size(), 2u);
  const Texture& volume = this->Stacked.Textures[0];
  EXPECT_EQ(volume.Dimensions, (std::array<int, 3>{ 2, 4, 4 }));
  ASSERT_EQ(volume.Data.size(), 32u);
  for (std::size_t k = 0; k < 3; ++k)
  {
    for (std::size_t texel = 0; texel < 8; ++texel)
    {
      const std::size_t x = texel % 2;
      const std::size_t y = texel / 2 % 2 + 2 * (k % 2);
      const std::size_t z = texel / 4 + 2 * (k / 2);
      EXPECT_EQ(volume.Data[x + 2 * (y + 4 * z)], 10.0f * static_cast<float>(k) + texel) << k;
    }
  }
  // Clamped within the own table, along both axes; x repeats as before.
  EXPECT_TRUE(this->Has("p.y = (clamp(p.y * 2.0, 0.5, 2.0 - 0.5) + volumeBeginINSTANCE.y) / 4.0;"));
  EXPECT_TRUE(this->Has("p.z = (clamp(p.z * 2.0, 0.5, 2.0 - 0.5) + volumeBeginINSTANCE.z) / 4.0;"));
  EXPECT_FALSE(this->Has("p.x"));
  EXPECT_TRUE(volume.Repeat[0]);
  EXPECT_TRUE(this->Has("read_volumeINSTANCE(p).rgb * vec3(ivec3(2.0, 2.0, 2.0))"));
  EXPECT_FALSE(this->Has("volumeSize"));
  const Texture& numbers = this->Stacked.Textures[1];
  EXPECT_EQ(numbers.Data[1 * 8 + 1], 2.0f); // the second table's rows
  EXPECT_EQ(numbers.Data[2 * 8 + 2], 2.0f); // the third one's slices
}

// The larger one first; what repeats has its other end on either side.
TEST_F(ClassStacking, TablesOfSeveralSizesLieBesideEachOther)
{
  this->Terms[1].Textures = { MakeVolume(100.0f, { 3, 4, 3 }) };
  this->Terms.pop_back();
  ASSERT_TRUE(this->Stack(64));
  const Texture& volume = this->Stacked.Textures[0];
  EXPECT_EQ(volume.Repeat, (std::array<bool, 3>{ false, false, false }));
  const Texture& numbers = this->Stacked.Textures.back();
  EXPECT_EQ(numbers.Dimensions, (std::array<int, 3>{ 3, 2, 1 })); // begin, size, scale
  EXPECT_TRUE(this->Has("p.x = (fract(p.x) * volumeSizeINSTANCE.x + volumeBeginINSTANCE.x) / "));
  EXPECT_TRUE(this->Has("p.y = (clamp(p.y * volumeSizeINSTANCE.y, 0.5, volumeSizeINSTANCE.y - 0.5)"
                        " + volumeBeginINSTANCE.y) / "));
  std::size_t width = static_cast<std::size_t>(volume.Dimensions[0]);
  std::size_t height = static_cast<std::size_t>(volume.Dimensions[1]);
  for (std::size_t k = 0; k < 2; ++k)
  {
    const Texture& table = this->Terms[k].Textures[0];
    const auto number = [&](std::size_t column, std::size_t axis)
    { return static_cast<int>(numbers.Data[12 * k + 4 * column + axis]); };
    int begin[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      begin[axis] = number(0, axis);
      ASSERT_EQ(number(1, axis), table.Dimensions[axis]);
      ASSERT_LE(begin[axis] + table.Dimensions[axis], volume.Dimensions[axis]);
    }
    const int columns = table.Dimensions[0];
    for (int z = 0; z < table.Dimensions[2]; ++z)
    {
      for (int y = 0; y < table.Dimensions[1]; ++y)
      {
        for (int x = -1; x <= columns; ++x)
        {
          const auto at = static_cast<std::size_t>(begin[0] + x) +
                          width * (static_cast<std::size_t>(begin[1] + y) +
                                    height * static_cast<std::size_t>(begin[2] + z));
          const int from = (x + columns) % columns + columns * (y + table.Dimensions[1] * z);
          EXPECT_EQ(volume.Data[at], table.Data[static_cast<std::size_t>(from)])
            << k << ": " << x << " " << y << " " << z;
        }
      }
    }
  }
}

// A flat and wide one and a deep and high one: the box about both is nearly empty.
TEST_F(ClassStacking, NotMuchMemoryIsLost)
{
  this->Terms.pop_back();
  for (Term& term : this->Terms)
  {
    term.Textures = { MakeVolume(1.0f, { 2, 2, 60 }) };
  }
  this->Terms[1].Textures = { MakeVolume(1.0f, { 2, 60, 2 }) };
  EXPECT_FALSE(this->Stack(64));
  this->Terms[1].Textures = { MakeVolume(2.0f, { 2, 2, 30 }) };
  EXPECT_TRUE(this->Stack(256));
}

TEST_F(ClassStacking, NumbersThatDifferAreInATexture)
{
  ASSERT_TRUE(this->Stack(64));
  ASSERT_EQ(this->Stacked.Uniforms.size(), 1u);
  EXPECT_EQ(this->Stacked.Uniforms[0].Name, "same");
  const Texture& numbers = this->Stacked.Textures.back();
  EXPECT_EQ(numbers.Dimensions, (std::array<int, 3>{ 2, 3, 1 })); // where tables begin, and scale
  EXPECT_EQ(numbers.Data[2 * 8 + 4], 3.0f);                       // the third one's
  EXPECT_NE(
    this->Load.find("scale0 = texelFetch(numbers0, ivec2(1, number), 0).r;"), std::string::npos)
    << this->Load;
  EXPECT_FALSE(this->Has("uniform float scaleINSTANCE"));
}

TEST_F(ClassStacking, WhatAllHaveInCommonStays)
{
  for (Term& term : this->Terms)
  {
    term.Textures = { MakeVolume(1.0f) };
  }
  ASSERT_TRUE(this->Stack(64));
  EXPECT_EQ(this->Stacked.Textures[0].Data, MakeVolume(1.0f).Data);
  EXPECT_TRUE(this->Has("texture(volumeINSTANCE, p)"));
}

TEST_F(ClassStacking, WhatDoesNotFitIsNotStacked)
{
  EXPECT_FALSE(this->Stack(2));
  EXPECT_TRUE(this->Stack(64));
  for (Term& term : this->Terms)
  {
    term.Textures[0].Repeat = { true, true, true };
  }
  EXPECT_FALSE(this->Stack(64)) << "no axis is left";
  for (Term& term : this->Terms)
  {
    term.Textures[0].Repeat = { true, false, false };
    term.Source += "vec4 g(vec3 p) { return helper(volumeINSTANCE, p); }\n";
  }
  EXPECT_FALSE(this->Stack(64)) << "a use of the sampler that is not known";
}

// Each is a term of its own, which the others' pixels skip.
TEST_F(ClassStacking, TermsOfOtherTextsAreSkippedElsewhere)
{
  this->Terms[1].Constants = { { "scale", "factor" } };
  this->Terms[1].Uniforms[0].Name = "factor";
  ASSERT_TRUE(this->Stack(64));
  ASSERT_EQ(this->Form.Terms.size(), 2u);
  EXPECT_EQ(this->Samplers, 3u);
  EXPECT_TRUE(this->Has("vec3 fHereINSTANCE(vec3 p) { return scaleINSTANCE"));
  EXPECT_TRUE(this->Has("vec3 fINSTANCE(vec3 p)\n{\n  vec3 sum = vec3(0.0);\n"
                        "  for (int once = 0; once < int(hereINSTANCE); ++once)\n"
                        "  {\n    sum += fHereINSTANCE(p);\n"));
  // Rows: materials. Columns: where the first term's table begins, its scale, whether it is there,
  // and whether the second one is, which has its own table and numbers.
  const Texture& numbers = this->Stacked.Textures.back();
  ASSERT_EQ(numbers.Dimensions, (std::array<int, 3>{ 4, 3, 1 }));
  const auto number = [&numbers](std::size_t row, std::size_t column)
  { return numbers.Data[16 * row + 4 * column]; };
  EXPECT_EQ(number(0, 1), 1.0f);
  EXPECT_EQ(number(1, 1), 0.0f);
  EXPECT_EQ(number(2, 1), 3.0f);
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_EQ(number(k, 2), k == 1 ? 0.0f : 1.0f);
    EXPECT_EQ(number(k, 3), k == 1 ? 1.0f : 0.0f);
  }
  const Term& other = this->Form.Terms[1];
  EXPECT_EQ(other.Textures.size(), 1u);
  EXPECT_EQ(other.Textures[0].Data, this->Terms[1].Textures[0].Data);
  EXPECT_EQ(other.Uniforms[0].Values, this->Terms[1].Uniforms[0].Values);
  EXPECT_NE(
    this->Load.find("here1 = texelFetch(numbers0, ivec2(3, number), 0).r;"), std::string::npos)
    << this->Load;
}

// Whatever of a term is no number tells terms apart.
TEST_F(ClassStacking, TermsDifferByEachOfTheirTexts)
{
  const std::vector<Term> alike = this->Terms;
  ASSERT_TRUE(this->Stack(64));
  ASSERT_EQ(this->Form.Terms.size(), 1u);
  this->Terms[1].Constants = { { "COUNT", "3" } };
  ASSERT_TRUE(this->Stack(64));
  EXPECT_EQ(this->Form.Terms.size(), 2u) << "constants";
  this->Terms = alike;
  this->Terms[1].Textures[0].HalfFloat = !this->Terms[1].Textures[0].HalfFloat;
  ASSERT_TRUE(this->Stack(64));
  EXPECT_EQ(this->Form.Terms.size(), 2u) << "the texture's format";
  this->Terms = alike;
  this->Terms[1].Source += " ";
  ASSERT_TRUE(this->Stack(64));
  EXPECT_EQ(this->Form.Terms.size(), 2u) << "text";
}

// A material may have several, or none.
TEST_F(ClassStacking, TermsOfOneTextStandTogether)
{
  std::vector<vtkBRDFShaderInputs> forms(3);
  forms[0].Terms = { this->Terms[0], this->Terms[1] };
  forms[2].Terms = { this->Terms[2] };
  ASSERT_TRUE(this->Stack(forms, 64));
  ASSERT_EQ(this->Form.Terms.size(), 2u);
  EXPECT_TRUE(this->Has("hereINSTANCE")) << "the second material has none";
  EXPECT_EQ(this->Stacked.Textures[0].Data.size(), 16u) << "of the first and the third";
  EXPECT_EQ(this->Form.Terms[1].Textures[0].Data, this->Terms[1].Textures[0].Data);
}

// The function's name is not where it could be replaced.
TEST_F(ClassStacking, TermsThatCannotBeSkippedAreNotStacked)
{
  this->Terms[1].Source = "#define NAME fINSTANCE\nvec3 NAME(vec3 p) { return p; }\n";
  this->Terms[1].Textures.clear();
  this->Terms[1].Uniforms.clear();
  EXPECT_FALSE(this->Stack(64));
}
}
