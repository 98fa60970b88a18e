// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CellMaterials.h"

#include "MapArrays.h"
#include "WeightImages.h"
#include "vtkBRDF.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkMaterialMap.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace measuredbrdf
{
namespace
{
constexpr double FarOff = 1000.0; // times a scale of values, from its ends: floats are exact enough

// Calls visit(polygon, number of corners, corners).
template <typename Visit>
void ForEachPolygon(vtkCellArray* polygons, const Visit& visit)
{
  const auto it = vtkSmartPointer<vtkCellArrayIterator>::Take(polygons->NewIterator());
  for (it->GoToFirstCell(); !it->IsDoneWithTraversal(); it->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    it->GetCurrentCell(count, points);
    visit(it->GetCurrentCellId(), count, points);
  }
}
}

// Same material, same number.
int CellMaterials::Number(vtkBRDF* brdf)
{
  const auto [place, isNew] = this->Numbers.try_emplace(brdf, static_cast<int>(this->BRDFs.size()));
  if (isNew)
  {
    this->BRDFs.push_back(brdf);
  }
  return place->second;
}

int CellMaterials::AddSet(const Set& set)
{
  const auto [place, isNew] = this->KnownSets.try_emplace(set, static_cast<int>(this->Sets.size()));
  if (isNew)
  {
    this->Sets.push_back(set);
  }
  return place->second;
}

std::string CellMaterials::Find(vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others,
  vtkCellArray* polygons, const std::vector<vtkIdType>& cells, std::string& warning)
{
  this->Number(others);
  this->SetOfPolygon.reserve(cells.size());
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
      return this->FindClasses(input, map, polygons, cells);
    case vtkMaterialMap::VALUES:
      return this->FindValues(input, map, polygons, cells);
    case vtkMaterialMap::WEIGHTS:
      return this->FindWeights(input, map, polygons, warning);
    default:
      return this->FindImages(input, map, polygons, warning);
  }
}

std::string CellMaterials::FindClasses(vtkPolyData* input, vtkMaterialMap* map,
  vtkCellArray* polygons, const std::vector<vtkIdType>& cells)
{
  MapArray array;
  const std::string problem = array.Find(input, map);
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
  if (array.IsOfCells())
  {
    for (vtkIdType cell : cells)
    {
      this->SetOfPolygon.push_back(this->AddSet({ classify(cell) }));
    }
    return "";
  }
  this->PointClasses.resize(static_cast<std::size_t>(input->GetNumberOfPoints()));
  for (std::size_t p = 0; p < this->PointClasses.size(); ++p)
  {
    this->PointClasses[p] = classify(static_cast<vtkIdType>(p));
  }
  Set set;
  ForEachPolygon(polygons,
    [&](vtkIdType, vtkIdType count, const vtkIdType* points)
    {
      set.clear();
      for (vtkIdType k = 0; k < count; ++k)
      {
        set.push_back(this->PointClasses[static_cast<std::size_t>(points[k])]);
      }
      std::sort(set.begin(), set.end());
      set.erase(std::unique(set.begin(), set.end()), set.end());
      this->SetOfPolygon.push_back(this->AddSet(set));
    });
  return "";
}

void CellMaterials::SetClasses(const std::vector<int>& ofPolygons)
{
  this->Sets.clear();
  this->KnownSets.clear();
  this->SetOfPolygon.clear();
  this->PointClasses.clear();
  for (int cls : ofPolygons)
  {
    this->SetOfPolygon.push_back(this->AddSet({ cls }));
  }
}

// The materials whose hats are not 0 somewhere between two values: numbers from 1, in the order of
// their values.
CellMaterials::Set CellMaterials::FindRange(vtkMaterialMap* map, double least, double largest) const
{
  const auto valueOf = [&](int place)
  { return map->GetValue(this->Order[static_cast<std::size_t>(place)]); };
  const int last = static_cast<int>(this->Order.size()) - 1;
  int first = 0;
  while (first < last && valueOf(first + 1) <= least)
  {
    ++first;
  }
  int end = first;
  while (end < last && valueOf(end) < largest)
  {
    ++end;
  }
  Set set(static_cast<std::size_t>(end - first) + 1);
  std::iota(set.begin(), set.end(), first + 1);
  return set;
}

std::string CellMaterials::FindValues(vtkPolyData* input, vtkMaterialMap* map,
  vtkCellArray* polygons, const std::vector<vtkIdType>& cells)
{
  MapArray array;
  const std::string problem = array.Find(input, map);
  if (!problem.empty())
  {
    return problem;
  }
  this->Order.resize(static_cast<std::size_t>(map->GetNumberOfMaterials()));
  std::iota(this->Order.begin(), this->Order.end(), 0);
  std::sort(this->Order.begin(), this->Order.end(),
    [map](int a, int b) { return map->GetValue(a) < map->GetValue(b); });
  const double low = map->GetValue(this->Order.front());
  const double span = map->GetValue(this->Order.back()) - low;
  // Values beyond the scale are interpolated as they are: where they enter it depends on them.
  const auto normalize = [&](double value)
  { return span > 0.0 ? std::clamp((value - low) / span, -FarOff, FarOff) : 0.0; };
  for (int k : this->Order)
  {
    this->BRDFs.push_back(map->GetBRDF(k)); // each place on the scale its own number
    this->Knots.push_back(normalize(map->GetValue(k)));
  }
  const auto add = [&](double least, double largest, bool isNumber)
  {
    this->SetOfPolygon.push_back(
      this->AddSet(isNumber ? this->FindRange(map, least, largest) : Set{ 0 }));
  };
  if (array.IsOfCells())
  {
    for (vtkIdType cell : cells)
    {
      const double value = array.Get(cell);
      this->PolygonValues.push_back(static_cast<float>(std::isnan(value) ? 0.0 : normalize(value)));
      add(value, value, !std::isnan(value));
    }
    return "";
  }
  this->PointValues.resize(static_cast<std::size_t>(input->GetNumberOfPoints()));
  for (std::size_t p = 0; p < this->PointValues.size(); ++p)
  {
    const double value = array.Get(static_cast<vtkIdType>(p));
    this->PointValues[p] = static_cast<float>(std::isnan(value) ? 0.0 : normalize(value));
  }
  ForEachPolygon(polygons,
    [&](vtkIdType, vtkIdType count, const vtkIdType* points)
    {
      double least = std::numeric_limits<double>::infinity();
      double largest = -least;
      bool isNumber = count > 0;
      for (vtkIdType k = 0; k < count; ++k)
      {
        const double value = array.Get(points[k]);
        isNumber = isNumber && !std::isnan(value);
        least = std::min(least, value);
        largest = std::max(largest, value);
      }
      add(least, largest, isNumber);
    });
  return "";
}

std::string CellMaterials::FindWeights(
  vtkPolyData* input, vtkMaterialMap* map, vtkCellArray* polygons, std::string& warning)
{
  std::vector<MapArray> arrays(static_cast<std::size_t>(map->GetNumberOfMaterials()));
  std::vector<int> numbers;
  for (std::size_t k = 0; k < arrays.size(); ++k)
  {
    const std::string problem = arrays[k].FindWeights(input, map, static_cast<int>(k));
    if (!problem.empty())
    {
      return problem;
    }
    numbers.push_back(this->Number(map->GetBRDF(static_cast<int>(k))));
  }
  const std::size_t columns = this->BRDFs.size(); // number 0 has those of points without any
  this->Columns = columns;
  const auto size = static_cast<std::size_t>(input->GetNumberOfPoints());
  this->PointWeights.assign(size * columns, 0.0f);
  vtkIdType bad = 0;
  std::vector<double> weights(columns);
  for (std::size_t p = 0; p < size; ++p)
  {
    std::fill(weights.begin(), weights.end(), 0.0);
    double sum = 0.0;
    for (std::size_t k = 0; k < arrays.size(); ++k)
    {
      double weight = arrays[k].Get(static_cast<vtkIdType>(p));
      if (!(weight >= 0.0) || std::isinf(weight))
      {
        ++bad;
        weight = 0.0;
      }
      weights[static_cast<std::size_t>(numbers[k])] += weight;
      sum += weight;
    }
    if (!(sum > 0.0))
    {
      weights[0] = sum = 1.0;
    }
    std::transform(weights.begin(), weights.end(),
      this->PointWeights.begin() + static_cast<std::ptrdiff_t>(p * columns),
      [sum](double weight) { return static_cast<float>(weight / sum); });
  }
  if (bad > 0)
  {
    warning = std::to_string(bad) + " weights are negative, infinite or NaN and count as 0";
  }
  Set set;
  ForEachPolygon(polygons,
    [&](vtkIdType, vtkIdType count, const vtkIdType* points)
    {
      set.clear();
      for (int material = 0; material < static_cast<int>(columns); ++material)
      {
        if (std::any_of(points, points + count,
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
      this->SetOfPolygon.push_back(this->AddSet(set));
    });
  return "";
}

std::string CellMaterials::FindImages(
  vtkPolyData* input, vtkMaterialMap* map, vtkCellArray* polygons, std::string& warning)
{
  if (!input->GetPointData()->GetTCoords())
  {
    return "the surface has no texture coordinates";
  }
  const WeightImages images(map);
  if (!images.GetProblem().empty())
  {
    return images.GetProblem();
  }
  warning = images.GetWarning();
  Set set;
  this->ImageShares.push_back(images.GetEmptyShare());
  for (int k = 0; k < map->GetNumberOfMaterials(); ++k)
  {
    this->BRDFs.push_back(map->GetBRDF(k)); // each component its own number
    this->ImageShares.push_back(images.GetMean(k));
    if (images.GetMean(k) > 0.0)
    {
      set.push_back(k + 1);
    }
  }
  if (images.GetEmptyShare() > 0.0)
  {
    set.insert(set.begin(), 0);
  }
  this->SetOfPolygon.assign(
    static_cast<std::size_t>(polygons->GetNumberOfCells()), this->AddSet(set));
  return "";
}

float CellMaterials::GetWeight(vtkIdType point, int material) const
{
  const auto p = static_cast<std::size_t>(point);
  if (!this->PointClasses.empty())
  {
    return this->PointClasses[p] == material ? 1.0f : 0.0f;
  }
  return this->PointWeights[p * this->Columns + static_cast<std::size_t>(material)];
}

int CellMaterials::GetMember(const Set& set, int slot) const
{
  int place = 0;
  for (const bool wanted : { true, false })
  {
    for (int material : set)
    {
      const bool has = this->BRDFs[static_cast<std::size_t>(material)] != nullptr;
      if (has == wanted && place++ == slot)
      {
        return material;
      }
    }
  }
  return -1;
}

CellMaterials::Set CellMaterials::GetHeaviest(int set, std::size_t most) const
{
  Set heaviest = this->Sets[static_cast<std::size_t>(set)];
  std::vector<double> totals(this->BRDFs.size(), 0.0);
  const std::size_t points =
    this->Columns > 0 ? this->PointWeights.size() / this->Columns : this->PointClasses.size();
  for (int material : heaviest)
  {
    double& total = totals[static_cast<std::size_t>(material)];
    for (std::size_t p = 0; p < points; ++p)
    {
      total += this->GetWeight(static_cast<vtkIdType>(p), material);
    }
    total +=
      this->ImageShares.empty() ? 0.0 : this->ImageShares[static_cast<std::size_t>(material)];
  }
  std::stable_sort(heaviest.begin(), heaviest.end(),
    [&totals](int a, int b)
    { return totals[static_cast<std::size_t>(a)] > totals[static_cast<std::size_t>(b)]; });
  heaviest.resize(std::min(heaviest.size(), most));
  std::sort(heaviest.begin(), heaviest.end());
  return heaviest;
}

double CellMaterials::GetShare(
  vtkIdType polygon, vtkIdType count, const vtkIdType* points, int material) const
{
  const Set& set =
    this->Sets[static_cast<std::size_t>(this->SetOfPolygon[static_cast<std::size_t>(polygon)])];
  if (set.size() == 1)
  {
    return set.front() == material ? 1.0 : 0.0;
  }
  if (!this->ImageShares.empty())
  {
    return this->ImageShares[static_cast<std::size_t>(material)];
  }
  if (this->HasPointWeights())
  {
    double sum = 0.0;
    for (vtkIdType k = 0; k < count; ++k)
    {
      sum += this->GetWeight(points[k], material);
    }
    return sum / static_cast<double>(count);
  }
  // The mean of the hat at the corners.
  const auto k = static_cast<std::size_t>(material - 1);
  const auto hat = [&](double value)
  {
    const bool above = value > this->Knots[k];
    if (above ? k + 1 == this->Knots.size() : k == 0)
    {
      return 1.0;
    }
    const double next = this->Knots[above ? k + 1 : k - 1];
    return std::max(1.0 - (value - this->Knots[k]) / (next - this->Knots[k]), 0.0);
  };
  if (!this->PolygonValues.empty())
  {
    return hat(this->PolygonValues[static_cast<std::size_t>(polygon)]);
  }
  double sum = 0.0;
  for (vtkIdType c = 0; c < count; ++c)
  {
    sum += hat(this->PointValues[static_cast<std::size_t>(points[c])]);
  }
  return sum / static_cast<double>(count);
}
} // namespace measuredbrdf
