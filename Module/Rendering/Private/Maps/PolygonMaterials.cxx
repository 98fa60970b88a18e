// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PolygonMaterials.h"

#include "WeightImages.h"
#include "vtkBRDF.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkMaterialMap.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace measuredbrdf
{
namespace
{
constexpr double FarOff = 1000.0; // times a scale of values, from its ends: floats are exact enough

// An array of numbers that a map reads.
struct MapArray
{
  vtkDataArray* Array = nullptr;
  int Component = 0;
  bool OfCells = false;

  double Get(vtkIdType tuple) const { return this->Array->GetComponent(tuple, this->Component); }

  // Of classes or values, of points or cells. Returns why there is none, or "".
  std::string Find(vtkPolyData* input, vtkMaterialMap* map)
  {
    const std::string name = map->GetArrayName();
    this->Look(input->GetPointData(), name);
    this->OfCells = !this->Array;
    if (this->OfCells)
    {
      this->Look(input->GetCellData(), name);
    }
    if (!this->Array)
    {
      return name.empty() ? "the surface has no active scalars"
                          : "the surface has no point or cell array \"" + name + "\" of numbers";
    }
    return this->Check(map->GetArrayComponent(),
      this->OfCells ? input->GetNumberOfCells() : input->GetNumberOfPoints(), name);
  }

  // Of a material's weights, of points.
  std::string FindWeights(vtkPolyData* input, vtkMaterialMap* map, int material)
  {
    const std::string own = map->GetWeightArrayName(material);
    const std::string name = own.empty() ? map->GetArrayName() : own;
    this->Look(input->GetPointData(), name);
    if (!this->Array)
    {
      return name.empty() ? "the surface's points have no active scalars"
                          : "the surface has no point array \"" + name + "\" of numbers";
    }
    return this->Check(own.empty() ? material : 0, input->GetNumberOfPoints(), name);
  }

private:
  void Look(vtkDataSetAttributes* data, const std::string& name)
  {
    this->Array = name.empty() ? data->GetScalars() : data->GetArray(name.c_str());
  }

  std::string Check(int component, vtkIdType tuples, const std::string& name)
  {
    const std::string quoted = name.empty() ? "active scalars" : "array \"" + name + "\"";
    this->Component = component;
    if (component >= this->Array->GetNumberOfComponents())
    {
      return "it reads component " + std::to_string(component) + " of the " + quoted +
             ", which has " + std::to_string(this->Array->GetNumberOfComponents());
    }
    if (this->Array->GetNumberOfTuples() < tuples)
    {
      return "the " + quoted + " has " + std::to_string(this->Array->GetNumberOfTuples()) +
             " tuples for " + std::to_string(tuples) + (this->OfCells ? " cells" : " points");
    }
    return "";
  }
};

// Calls visit(corners) of each polygon.
template <typename Visit>
void ForEachPolygon(vtkCellArray* polygons, const Visit& visit)
{
  const auto it = vtkSmartPointer<vtkCellArrayIterator>::Take(polygons->NewIterator());
  std::vector<vtkIdType> corners;
  for (it->GoToFirstCell(); !it->IsDoneWithTraversal(); it->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    it->GetCurrentCell(count, points);
    corners.assign(points, points + count);
    visit(corners);
  }
}
}

bool IsReadByMap(vtkPolyData* input, vtkMaterialMap* map, vtkAbstractArray* array)
{
  const int mode = map->GetMode();
  if (!array || mode == vtkMaterialMap::TEXTURES)
  {
    return false;
  }
  MapArray own;
  if (mode != vtkMaterialMap::WEIGHTS)
  {
    return own.Find(input, map).empty() && own.Array == array;
  }
  for (int k = 0; k < map->GetNumberOfMaterials(); ++k)
  {
    if (own.FindWeights(input, map, k).empty() && own.Array == array)
    {
      return true;
    }
  }
  return false;
}

std::array<float, 4> MakeHat(const std::vector<double>& knots, std::size_t k)
{
  std::array<float, 4> hat = { 1.0f, 0.0f, 1.0f, 0.0f };
  if (k > 0)
  {
    const double slope = 1.0 / (knots[k] - knots[k - 1]);
    hat[0] = static_cast<float>(-knots[k - 1] * slope);
    hat[1] = static_cast<float>(slope);
  }
  if (k + 1 < knots.size())
  {
    const double slope = 1.0 / (knots[k + 1] - knots[k]);
    hat[2] = static_cast<float>(knots[k + 1] * slope);
    hat[3] = static_cast<float>(-slope);
  }
  return hat;
}

// Same material, same number.
int PolygonMaterials::Number(vtkBRDF* brdf)
{
  const auto [place, isNew] = this->Numbers.try_emplace(brdf, static_cast<int>(this->BRDFs.size()));
  if (isNew)
  {
    this->BRDFs.push_back(brdf);
  }
  return place->second;
}

void PolygonMaterials::AddPolygon(const Set& set)
{
  const auto [place, isNew] = this->KnownSets.try_emplace(set, static_cast<int>(this->Sets.size()));
  if (isNew)
  {
    this->Sets.push_back(set);
  }
  this->SetOfPolygon.push_back(place->second);
}

std::string PolygonMaterials::Find(
  const Surface& surface, vtkMaterialMap* map, vtkBRDF* others, std::string& warning)
{
  this->Number(others);
  if (map->GetNumberOfMaterials() == 0)
  {
    return "it has no materials";
  }
  for (int k = 0; k < map->GetNumberOfMaterials(); ++k)
  {
    if (!map->GetBRDF(k) && map->GetMode() != vtkMaterialMap::CLASSES)
    {
      return "material " + std::to_string(k) + " has no BRDF, which only classes may lack";
    }
  }
  switch (map->GetMode())
  {
    case vtkMaterialMap::CLASSES:
      return this->FindClasses(surface, map);
    case vtkMaterialMap::VALUES:
      return this->FindValues(surface, map);
    case vtkMaterialMap::WEIGHTS:
      return this->FindWeights(surface, map, warning);
    default:
      return this->FindImages(surface, map, warning);
  }
}

std::string PolygonMaterials::FindClasses(const Surface& surface, vtkMaterialMap* map)
{
  MapArray array;
  const std::string problem = array.Find(surface.Input, map);
  if (!problem.empty())
  {
    return problem;
  }
  std::unordered_map<double, int> known;
  const auto classify = [&](vtkIdType tuple)
  {
    const double value = array.Get(tuple);
    if (std::isnan(value))
    {
      return 0;
    }
    const auto [place, isNew] = known.try_emplace(value, 0);
    if (isNew)
    {
      const int index = map->FindClass(value);
      place->second = index < 0 ? 0 : this->Number(map->GetBRDF(index));
    }
    return place->second;
  };
  if (array.OfCells)
  {
    for (vtkIdType cell : surface.Cells)
    {
      this->AddPolygon({ classify(cell) });
    }
    return "";
  }
  for (vtkIdType p = 0; p < surface.Input->GetNumberOfPoints(); ++p)
  {
    this->PointClasses.push_back(classify(p));
  }
  Set set;
  ForEachPolygon(surface.Polygons,
    [&](const std::vector<vtkIdType>& corners)
    {
      set.clear();
      for (vtkIdType point : corners)
      {
        set.push_back(this->PointClasses[static_cast<std::size_t>(point)]);
      }
      std::sort(set.begin(), set.end());
      set.erase(std::unique(set.begin(), set.end()), set.end());
      this->AddPolygon(set);
    });
  return "";
}

void PolygonMaterials::SetClasses(const std::vector<int>& ofPolygons)
{
  this->Sets.clear();
  this->KnownSets.clear();
  this->SetOfPolygon.clear();
  this->PointClasses.clear();
  for (int cls : ofPolygons)
  {
    this->AddPolygon({ cls });
  }
}

std::string PolygonMaterials::FindValues(const Surface& surface, vtkMaterialMap* map)
{
  MapArray array;
  const std::string problem = array.Find(surface.Input, map);
  if (!problem.empty())
  {
    return problem;
  }
  std::vector<int> order(static_cast<std::size_t>(map->GetNumberOfMaterials()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [map](int a, int b) { return map->GetValue(a) < map->GetValue(b); });
  const double low = map->GetValue(order.front());
  const double span = map->GetValue(order.back()) - low;
  // Values beyond the scale are interpolated as they are: where they enter it depends on them.
  const auto normalize = [&](double value)
  {
    return span > 0.0 || std::isnan(value) ? std::clamp((value - low) / span, -FarOff, FarOff)
                                           : 0.0;
  };
  for (int k : order)
  {
    this->BRDFs.push_back(map->GetBRDF(k)); // each place on the scale its own number
    this->Knots.push_back(normalize(map->GetValue(k)));
  }
  // The materials whose hats are not 0 somewhere between two values.
  const auto add = [&](double least, double largest)
  {
    if (std::isnan(least) || std::isnan(largest))
    {
      this->AddPolygon({ 0 });
      return;
    }
    const auto above = std::upper_bound(this->Knots.begin(), this->Knots.end(), least);
    const auto first = above == this->Knots.begin() ? above : above - 1;
    const auto last =
      std::min(std::lower_bound(first, this->Knots.end(), largest), this->Knots.end() - 1);
    Set set(static_cast<std::size_t>(last - first) + 1);
    std::iota(set.begin(), set.end(), static_cast<int>(first - this->Knots.begin()) + 1);
    this->AddPolygon(set);
  };
  const auto toFloat = [](double value)
  { return static_cast<float>(std::isnan(value) ? 0.0 : value); };
  if (array.OfCells)
  {
    for (vtkIdType cell : surface.Cells)
    {
      const double value = normalize(array.Get(cell));
      this->PolygonValues.push_back(toFloat(value));
      add(value, value);
    }
    return "";
  }
  std::vector<double> values;
  for (vtkIdType p = 0; p < surface.Input->GetNumberOfPoints(); ++p)
  {
    values.push_back(normalize(array.Get(p)));
    this->PointValues.push_back(toFloat(values.back()));
  }
  ForEachPolygon(surface.Polygons,
    [&](const std::vector<vtkIdType>& corners)
    {
      double least = corners.empty() ? std::nan("") : values[static_cast<std::size_t>(corners[0])];
      double largest = least;
      for (vtkIdType point : corners)
      {
        const double value = values[static_cast<std::size_t>(point)];
        // A value that is NaN stays.
        least = value >= least || std::isnan(least) ? least : value;
        largest = value <= largest || std::isnan(largest) ? largest : value;
      }
      add(least, largest);
    });
  return "";
}

std::string PolygonMaterials::FindWeights(
  const Surface& surface, vtkMaterialMap* map, std::string& warning)
{
  std::vector<MapArray> arrays(static_cast<std::size_t>(map->GetNumberOfMaterials()));
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < arrays.size(); ++k)
  {
    const std::string problem = arrays[k].FindWeights(surface.Input, map, static_cast<int>(k));
    if (!problem.empty())
    {
      return problem;
    }
    numbers.push_back(static_cast<std::size_t>(this->Number(map->GetBRDF(static_cast<int>(k)))));
  }
  this->Columns = this->BRDFs.size(); // number 0 has those of points without any
  const vtkIdType points = surface.Input->GetNumberOfPoints();
  this->PointWeights.reserve(static_cast<std::size_t>(points) * this->Columns);
  vtkIdType bad = 0;
  std::vector<double> weights(this->Columns);
  for (vtkIdType p = 0; p < points; ++p)
  {
    std::fill(weights.begin(), weights.end(), 0.0);
    double sum = 0.0;
    for (std::size_t k = 0; k < arrays.size(); ++k)
    {
      const double weight = arrays[k].Get(p);
      const bool isGood = weight >= 0.0 && !std::isinf(weight);
      bad += isGood ? 0 : 1;
      weights[numbers[k]] += isGood ? weight : 0.0;
      sum += isGood ? weight : 0.0;
    }
    if (!(sum > 0.0))
    {
      weights[0] = sum = 1.0;
    }
    for (double weight : weights)
    {
      this->PointWeights.push_back(static_cast<float>(weight / sum));
    }
  }
  if (bad > 0)
  {
    warning = std::to_string(bad) + " weights are negative, infinite or NaN and count as 0";
  }
  Set set;
  ForEachPolygon(surface.Polygons,
    [&](const std::vector<vtkIdType>& corners)
    {
      set.clear();
      for (int material = 0; material < static_cast<int>(this->Columns); ++material)
      {
        if (std::any_of(corners.begin(), corners.end(),
              [&](vtkIdType p) { return this->GetWeight(p, material) > 0.0f; }))
        {
          set.push_back(material);
        }
      }
      // Colors of the superclass do not blend with radiance: a polygon is one or the other.
      if (set.size() > 1 && set.front() == 0 && !this->BRDFs[0])
      {
        set = { 0 };
      }
      this->AddPolygon(set);
    });
  return "";
}

std::string PolygonMaterials::FindImages(
  const Surface& surface, vtkMaterialMap* map, std::string& warning)
{
  if (!surface.Input->GetPointData()->GetTCoords())
  {
    return "the surface has no texture coordinates";
  }
  const WeightShares images = MeasureWeightImages(map);
  if (!images.Problem.empty())
  {
    return images.Problem;
  }
  warning = images.Warning;
  this->ImageShares = images.Means;
  Set set;
  for (int k = 0; k <= map->GetNumberOfMaterials(); ++k)
  {
    if (k > 0)
    {
      this->BRDFs.push_back(map->GetBRDF(k - 1)); // each component its own number
    }
    if (this->ImageShares[static_cast<std::size_t>(k)] > 0.0)
    {
      set.push_back(k);
    }
  }
  for (vtkIdType k = 0; k < surface.Polygons->GetNumberOfCells(); ++k)
  {
    this->AddPolygon(set);
  }
  return "";
}

float PolygonMaterials::GetWeight(vtkIdType point, int material) const
{
  const auto p = static_cast<std::size_t>(point);
  if (!this->PointClasses.empty())
  {
    return this->PointClasses[p] == material ? 1.0f : 0.0f;
  }
  return this->PointWeights[p * this->Columns + static_cast<std::size_t>(material)];
}

PolygonMaterials::Set PolygonMaterials::GetHeaviest(int set, std::size_t most) const
{
  Set heaviest = this->Sets[static_cast<std::size_t>(set)];
  std::vector<double> totals =
    this->ImageShares.empty() ? std::vector<double>(this->BRDFs.size(), 0.0) : this->ImageShares;
  for (std::size_t k = 0; k < this->PointWeights.size(); ++k)
  {
    totals[k % this->Columns] += this->PointWeights[k];
  }
  std::stable_sort(heaviest.begin(), heaviest.end(),
    [&totals](int a, int b)
    { return totals[static_cast<std::size_t>(a)] > totals[static_cast<std::size_t>(b)]; });
  heaviest.resize(std::min(heaviest.size(), most));
  std::sort(heaviest.begin(), heaviest.end());
  return heaviest;
}

double PolygonMaterials::GetShare(
  vtkIdType polygon, vtkIdType count, const vtkIdType* points, int material) const
{
  const Set& set = this->GetSet(polygon);
  if (set.size() == 1)
  {
    return set.front() == material ? 1.0 : 0.0;
  }
  if (!this->ImageShares.empty())
  {
    return this->ImageShares[static_cast<std::size_t>(material)];
  }
  const auto hatAt = [&](float value)
  {
    const std::array<float, 4> hat = MakeHat(this->Knots, static_cast<std::size_t>(material - 1));
    return std::clamp(std::min(hat[0] + hat[1] * value, hat[2] + hat[3] * value), 0.0f, 1.0f);
  };
  double sum = 0.0; // of the corners
  for (vtkIdType k = 0; k < count; ++k)
  {
    sum += this->HasPointWeights() ? this->GetWeight(points[k], material)
           : this->PolygonValues.empty()
             ? hatAt(this->PointValues[static_cast<std::size_t>(points[k])])
             : hatAt(this->PolygonValues[static_cast<std::size_t>(polygon)]);
  }
  return sum / static_cast<double>(count);
}
} // namespace measuredbrdf
