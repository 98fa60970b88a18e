// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What an OpenEXR material's header may say: a good material's data, changed in a few places.
#include "FuzzTarget.h"

#include "FuzzSeeds.h"
#include "vtkBRDFModels.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <vector>

namespace
{
// Takes values off the front; zeros behind the end.
class Input
{
public:
  Input(const std::uint8_t* data, std::size_t size)
    : Data(data)
    , Left(size)
  {
  }
  bool IsAtEnd() const { return this->Left == 0; }
  template <typename T>
  T Take()
  {
    T value{};
    const std::size_t count = std::min(sizeof(T), this->Left);
    std::memcpy(&value, this->Data, count);
    this->Data += count;
    this->Left -= count;
    return value;
  }
  std::string TakeText()
  {
    const std::size_t count = std::min<std::size_t>(this->Take<std::uint8_t>(), this->Left);
    const std::string text(reinterpret_cast<const char*>(this->Data), count);
    this->Data += count;
    this->Left -= count;
    return text;
  }

private:
  const std::uint8_t* Data;
  std::size_t Left;
};

template <typename Map>
typename Map::iterator Choose(Map& map, std::uint8_t which)
{
  return std::next(map.begin(), static_cast<long>(which % map.size()));
}

void Change(vtkBRDFData& material, Input& input)
{
  const auto what = input.Take<std::uint8_t>() % 8;
  const auto which = input.Take<std::uint8_t>();
  if (what == 0 && !material.Numbers.empty())
  {
    std::vector<double>& numbers = Choose(material.Numbers, which)->second;
    numbers.assign(input.Take<std::uint8_t>() % 4, input.Take<double>());
  }
  else if (what == 1 && !material.Options.empty())
  {
    Choose(material.Options, which)->second = input.TakeText();
  }
  else if (what >= 2 && what <= 5 && !material.Arrays.empty())
  {
    const auto chosen = Choose(material.Arrays, which);
    vtkBRDFData::Array& array = chosen->second;
    if (what == 2)
    {
      array.Shape.resize(input.Take<std::uint8_t>() % 6, 1);
      if (!array.Shape.empty())
      {
        array.Shape[input.Take<std::uint8_t>() % array.Shape.size()] = input.Take<std::uint8_t>();
      }
    }
    else if (what == 3 && !array.Values.empty())
    {
      array.Values[input.Take<std::uint16_t>() % array.Values.size()] = input.Take<float>();
    }
    else if (what == 4)
    {
      array.Channels = which & 1 ? 1 : 3;
    }
    else if (what == 5)
    {
      material.Arrays.erase(chosen);
    }
  }
  else if (what == 6 && material.Terms.empty()) // once: each sum takes its terms' time again
  {
    vtkBRDFData sum;
    sum.Model = "Sum";
    sum.Numbers = material.Numbers;
    sum.Terms.assign(which % 4, material);
    material = std::move(sum);
  }
  else if (what == 7 && !material.Terms.empty())
  {
    Change(material.Terms[which % material.Terms.size()], input);
  }
}

// The reader fills arrays by their shapes; false for more than a small file holds.
bool Fill(vtkBRDFData& material)
{
  std::size_t values = 0;
  for (auto& [name, array] : material.Arrays)
  {
    double count = array.Channels;
    for (const int size : array.Shape)
    {
      count *= size;
    }
    if (count < 1.0 || count > std::min(1e5, vtkBRDFModels::GetMaximumArraySize(material.Model)))
    {
      return false;
    }
    array.Values.resize(static_cast<std::size_t>(count), 0.25f);
    values += array.Values.size();
  }
  for (vtkBRDFData& term : material.Terms)
  {
    if (!Fill(term))
    {
      return false;
    }
  }
  return values < 100000;
}
}

int FuzzMaterialData(const std::uint8_t* data, std::size_t size)
{
  static const std::vector<vtkBRDFData>& good = *new std::vector<vtkBRDFData>(fuzz::MakeData());
  const fuzz::Silence silence;
  Input input(data, size);
  vtkBRDFData material = good[input.Take<std::uint8_t>() % good.size()];
  for (int changes = 0; changes < 16 && !input.IsAtEnd(); ++changes)
  {
    Change(material, input);
  }
  vtkSmartPointer<vtkBRDF> brdf;
  if (Fill(material) && vtkBRDFModels::Load(material, brdf).empty())
  {
    fuzz::Use(brdf, fuzz::IsRare(data, size));
  }
  return 0;
}
