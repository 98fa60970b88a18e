// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackedTables.h"

#include "ReplacedText.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace measuredbrdf
{
namespace
{
using Texels = std::array<int, 3>;

constexpr const char* Axes = "xyz";

// Of all materials' tables of one kind together; beyond that they are not stacked.
constexpr std::size_t MostBytes = std::size_t(1) << 28;

// Times what the tables take alone.
constexpr std::size_t MostWaste = 2;

std::size_t CountTexels(const Texels& sides)
{
  return static_cast<std::size_t>(sides[0]) * static_cast<std::size_t>(sides[1]) *
         static_cast<std::size_t>(sides[2]);
}

std::size_t GetBytesPerTexel(const vtkBRDFShaderInputs::Texture& table)
{
  return table.GetBytes() / CountTexels(table.Dimensions);
}

// Lengths to try for the texture, from a table's to what so many tables take or the limit: four
// between doubles, for boxes of half a length and a border.
std::vector<int> GetRooms(int largest, std::size_t count, int most)
{
  std::vector<int> rooms;
  const double last =
    std::min(static_cast<double>(largest) * static_cast<double>(count), static_cast<double>(most));
  for (int step = 4; rooms.size() < 64; step < 7 ? ++step : step = 4)
  {
    const auto doublings = static_cast<int>(rooms.size() / 4);
    const double room = std::ldexp(0.25 * step * largest, doublings);
    rooms.push_back(static_cast<int>(std::min(room, last)));
    if (room >= last)
    {
      break;
    }
  }
  return rooms;
}

std::string Float(int value) { return std::to_string(value) + ".0"; }
}

bool StackedTables::IsBordered(std::size_t axis) const
{
  return this->Tables.front()->Repeat[axis] && !this->OfOneSize[axis];
}

bool StackedTables::IsShifted(std::size_t axis) const
{
  return !this->OfOneSize[axis] || this->Dimensions[axis] != this->Tables.front()->Dimensions[axis];
}

StackedTables::Texels StackedTables::GetBox(std::size_t table) const
{
  Texels box = this->Tables[table]->Dimensions;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box[axis] += this->IsBordered(axis) ? 2 : 0;
  }
  return box;
}

// The deepest and, of these, the highest first.
void StackedTables::Sort()
{
  this->Boxes.resize(this->Tables.size());
  this->Order.resize(this->Tables.size());
  std::iota(this->Order.begin(), this->Order.end(), std::size_t(0));
  std::stable_sort(this->Order.begin(), this->Order.end(),
    [this](std::size_t a, std::size_t b)
    {
      const Texels& first = this->Tables[a]->Dimensions;
      const Texels& second = this->Tables[b]->Dimensions;
      return std::lexicographical_compare(
        second.rbegin(), second.rend(), first.rbegin(), first.rend());
    });
}

// Boxes in rows along x, rows in slabs along y, slabs along z.
void StackedTables::Place(int width, int height)
{
  const std::array<int, 2> room = { width, height };
  Texels next = { 0, 0, 0 };
  Texels high = { 0, 0, 0 }; // y: of the row, z: of the slab
  this->Dimensions = { 0, 0, 0 };
  for (std::size_t k : this->Order)
  {
    const Texels box = this->GetBox(k);
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      if (next[axis] + box[axis] > room[axis])
      {
        std::fill_n(next.begin(), axis + 1, 0);
        next[axis + 1] += high[axis + 1];
        std::fill_n(high.begin(), axis + 2, 0);
      }
    }
    this->Boxes[k] = next;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      high[axis] = std::max(high[axis], box[axis]);
      this->Dimensions[axis] = std::max(this->Dimensions[axis], next[axis] + box[axis]);
    }
    next[0] += box[0];
  }
}

bool StackedTables::Arrange(const std::vector<const Texture*>& tables, int mostTexels)
{
  this->Tables = tables;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->OfOneSize[axis] = std::all_of(tables.begin(), tables.end(),
      [&](const Texture* table)
      { return table->Dimensions[axis] == tables.front()->Dimensions[axis]; });
  }
  this->Sort();
  Texels largest = { 1, 1, 1 };
  std::size_t own = 0;
  for (std::size_t k = 0; k < tables.size(); ++k)
  {
    const Texels box = this->GetBox(k);
    own += CountTexels(box);
    std::transform(box.begin(), box.end(), largest.begin(), largest.begin(),
      [](int a, int b) { return std::max(a, b); });
  }
  const auto getRooms = [&](std::size_t axis) // a repeating axis of one size stays whole
  {
    return tables.front()->Repeat[axis] && this->OfOneSize[axis]
             ? std::vector<int>{ largest[axis] }
             : GetRooms(largest[axis], tables.size(), mostTexels);
  };
  const int deepest = tables.front()->ThreeD ? getRooms(2).back() : 1;
  StackedTables best;
  std::size_t least = MostWaste * own + 1;
  for (int x : getRooms(0))
  {
    for (int y : getRooms(1))
    {
      this->Place(x, y);
      const Texels& sides = this->Dimensions;
      const bool fits = std::max(sides[0], sides[1]) <= mostTexels && sides[2] <= deepest;
      if (fits && CountTexels(sides) < least)
      {
        least = CountTexels(sides);
        best = *this;
      }
    }
  }
  *this = best;
  return !best.Tables.empty() && least * GetBytesPerTexel(*tables.front()) <= MostBytes;
}

template <typename Value>
void StackedTables::Copy(std::vector<Value> Texture::*values, Texture& texture) const
{
  const std::size_t parts =
    (this->Tables.front()->*values).size() / CountTexels(this->Tables.front()->Dimensions);
  std::vector<Value>& to = texture.*values;
  to.assign(CountTexels(this->Dimensions) * parts, Value(0));
  for (std::size_t k = 0; k < this->Tables.size() && parts > 0; ++k)
  {
    const Texels& size = this->Tables[k]->Dimensions;
    const std::vector<Value>& from = this->Tables[k]->*values;
    const Texels box = this->GetBox(k);
    const auto find = [&](const Texels& at) // the texel there of a table that repeats
    {
      std::size_t place = 0;
      for (std::size_t axis = 3; axis-- > 0;)
      {
        const int inside = at[axis] - (this->IsBordered(axis) ? 1 : 0) + size[axis];
        place = place * static_cast<std::size_t>(size[axis]) +
                static_cast<std::size_t>(inside % size[axis]);
      }
      return from.begin() + static_cast<std::ptrdiff_t>(place * parts);
    };
    Texels at;
    for (at[2] = 0; at[2] < box[2]; ++at[2])
    {
      for (at[1] = 0; at[1] < box[1]; ++at[1])
      {
        const Texels& begin = this->Boxes[k];
        const std::size_t row = CountTexels({ this->Dimensions[0], this->Dimensions[1], 1 }) *
                                  static_cast<std::size_t>(begin[2] + at[2]) +
                                static_cast<std::size_t>(this->Dimensions[0]) *
                                  static_cast<std::size_t>(begin[1] + at[1]) +
                                static_cast<std::size_t>(begin[0]);
        for (at[0] = 0; at[0] < box[0]; ++at[0])
        {
          std::copy_n(find(at), parts,
            to.begin() +
              static_cast<std::ptrdiff_t>((row + static_cast<std::size_t>(at[0])) * parts));
        }
      }
    }
  }
}

StackedTables::Texture StackedTables::Fill() const
{
  Texture texture = *this->Tables.front();
  texture.Dimensions = this->Dimensions;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    texture.Repeat[axis] = texture.Repeat[axis] && !this->IsShifted(axis);
  }
  this->Copy(&Texture::Data, texture);
  this->Copy(&Texture::SharedExponents, texture);
  return texture;
}

std::string StackedTables::GetSize(std::size_t axis) const
{
  return this->OfOneSize[axis] ? Float(this->Tables.front()->Dimensions[axis])
                               : this->Tables.front()->Name + "SizeINSTANCE." + Axes[axis];
}

// A coordinate's statement: in texels of the table, clamped or repeated, then of all tables.
std::string StackedTables::Shift(std::size_t axis) const
{
  const std::string p = std::string("p.") + Axes[axis];
  const std::string size = this->GetSize(axis);
  const std::string inside = this->IsBordered(axis)
                               ? "fract(" + p + ") * " + size
                               : "clamp(" + p + " * " + size + ", 0.5, " + size + " - 0.5)";
  return "  " + p + " = (" + inside + " + " + this->Tables.front()->Name + "BeginINSTANCE." +
         Axes[axis] + ") / " + Float(this->Dimensions[axis]) + ";\n";
}

// Functions that read the number's table, to be used instead of the sampler.
std::string StackedTables::DeclareReaders() const
{
  const Texture& table = *this->Tables.front();
  const std::string name = table.Name + "INSTANCE";
  const std::string place = table.ThreeD ? "vec3" : "vec2";
  std::string text = "vec4 read_" + name + "(" + place + " p)\n{\n";
  for (std::size_t axis = 0; axis < (table.ThreeD ? 3 : 2); ++axis)
  {
    text += this->IsShifted(axis) ? this->Shift(axis) : "";
  }
  text += "  return textureLod(" + name + ", p, 0.0);\n}\n";
  text +=
    "vec4 read_" + name + "(" + place + " p, float lod)\n{\n  return read_" + name + "(p);\n}\n";
  if (!table.ThreeD)
  {
    const std::string begin = "ivec2(" + table.Name + "BeginINSTANCE.xy)";
    text += "vec4 fetch_" + name + "(ivec2 at, int lod)\n{\n  return texelFetch(" + name +
            ", at + " + begin + ", lod);\n}\n";
  }
  return text;
}

bool StackedTables::UseReaders(std::string& text, std::string& declarations) const
{
  const Texture& table = *this->Tables.front();
  const std::string name = table.Name + "INSTANCE";
  const std::string type = table.ThreeD ? "sampler3D" : "sampler2D";
  const std::string declaration = "uniform " + type + " " + name + ";";
  std::string size = table.ThreeD ? "ivec3(" : "ivec2(";
  for (std::size_t axis = 0; axis < (table.ThreeD ? 3 : 2); ++axis)
  {
    size += (axis > 0 ? ", " : "") + this->GetSize(axis);
  }
  size += ")";
  ReplaceAll(text, "textureSize(" + name + ", 0)", size);
  ReplaceAll(text, "textureLod(" + name + ", ", "read_" + table.Name + "_(");
  ReplaceAll(text, "texture(" + name + ", ", "read_" + table.Name + "_(");
  if (!table.ThreeD)
  {
    ReplaceAll(text, "texelFetch(" + name + ", ", "fetch_" + table.Name + "_(");
  }
  if (ReplaceAll(text, declaration, "") != 1 || text.find(name) != std::string::npos)
  {
    return false;
  }
  for (const char* use : { "read_", "fetch_" })
  {
    ReplaceAll(text, use + table.Name + "_(", use + name + "(");
  }
  declarations += declaration + "\n" + this->DeclareReaders();
  return true;
}

std::vector<StackedTables::Number> StackedTables::GetNumbers() const
{
  const std::string& name = this->Tables.front()->Name;
  Number begins{ name + "Begin", {} };
  Number sizes{ name + "Size", {} };
  for (std::size_t k = 0; k < this->Tables.size(); ++k)
  {
    std::vector<float> begin;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      begin.push_back(static_cast<float>(this->Boxes[k][axis] + (this->IsBordered(axis) ? 1 : 0)));
    }
    begins.Values.push_back(begin);
    const Texels& size = this->Tables[k]->Dimensions;
    sizes.Values.emplace_back(size.begin(), size.end());
  }
  std::vector<Number> numbers = { begins };
  if (!(this->OfOneSize[0] && this->OfOneSize[1] && this->OfOneSize[2]))
  {
    numbers.push_back(sizes);
  }
  return numbers;
}
} // namespace measuredbrdf
