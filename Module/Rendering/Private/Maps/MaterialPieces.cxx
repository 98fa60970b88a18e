// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialPieces.h"

#include "HorizonCode.h"
#include "SurfacePoints.h"
#include "WeightImages.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkMaterialMap.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace measuredbrdf
{
namespace
{
constexpr double FarOff = 1000.0; // times a scale of values: what lies beyond is taken as this

// An array of numbers that a map reads.
struct MapArray
{
  vtkDataArray* Array = nullptr;
  int Component = 0;
  bool OfCells = false;

  double Get(vtkIdType tuple) const { return this->Array->GetComponent(tuple, this->Component); }

  // The classes or values, of points or cells.
  static MapArray Find(vtkPolyData* input, vtkMaterialMap* map)
  {
    return MapArray(input, map->GetArrayName(), map->GetArrayComponent(), true);
  }

  // A material's weights, of points.
  static MapArray FindWeights(vtkPolyData* input, vtkMaterialMap* map, int material)
  {
    const std::string own = map->GetWeightArrayName(material);
    return own.empty() ? MapArray(input, map->GetArrayName(), material, false)
                       : MapArray(input, own, 0, false);
  }

private:
  MapArray(vtkPolyData* input, const std::string& name, int component, bool mayBeOfCells)
    : Component(component)
  {
    const auto look = [&](vtkDataSetAttributes* data)
    { return name.empty() ? data->GetScalars() : data->GetArray(name.c_str()); };
    this->Array = look(input->GetPointData());
    this->OfCells = !this->Array && mayBeOfCells;
    this->Array = this->OfCells ? look(input->GetCellData()) : this->Array;
    const std::string owner = mayBeOfCells ? "the surface" : "the surface's points";
    const std::string kind = mayBeOfCells ? "point or cell array" : "point array";
    const std::string quoted = name.empty() ? "active scalars" : "array \"" + name + "\"";
    if (!this->Array)
    {
      throw MapProblem(name.empty()
                         ? owner + (mayBeOfCells ? " has" : " have") + " no active scalars"
                         : "the surface has no " + kind + " \"" + name + "\" of numbers");
    }
    if (component >= this->Array->GetNumberOfComponents())
    {
      throw MapProblem("it reads component " + std::to_string(component) + " of the " + quoted +
                       ", which has " + std::to_string(this->Array->GetNumberOfComponents()));
    }
    const vtkIdType tuples = this->OfCells ? input->GetNumberOfCells() : input->GetNumberOfPoints();
    if (this->Array->GetNumberOfTuples() < tuples)
    {
      throw MapProblem("the " + quoted + " has " +
                       std::to_string(this->Array->GetNumberOfTuples()) + " tuples for " +
                       std::to_string(tuples) + (this->OfCells ? " cells" : " points"));
    }
  }
};

// Calls visit(corners, cell) for each polygon, and for each triangle of strips.
template <typename Visit>
void ForEachPolygon(vtkPolyData* input, const Visit& visit)
{
  std::vector<vtkIdType> corners;
  ForEachFace(input, Faces::Polygons,
    [&](const vtkIdType* points, vtkIdType count, vtkIdType cell)
    {
      corners.assign(points, points + count);
      visit(corners, cell);
    });
}

// Horizon codes are no numbers to interpolate: their sectors turn with their normals, and either
// bound of a sector may be the lower one. VTK has interpolated the bytes of new points; where that
// is wrong, they get the code of the parent with the largest share.
template <typename NewPoints>
void MendHorizonCodes(vtkPointData* data, vtkIdType first, const NewPoints& points)
{
  for (const char* suffix : { "", "Back" })
  {
    const std::string name = vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName();
    auto* sky = vtkUnsignedCharArray::SafeDownCast(data->GetAbstractArray((name + suffix).c_str()));
    if (!sky || sky->GetNumberOfComponents() != HorizonCode::SectorBytes)
    {
      continue;
    }
    const auto isOpening = [](const unsigned char* bytes)
    {
      int width = 0;
      for (int s = 0; s < HorizonCode::Sectors; ++s)
      {
        width += bytes[4 + 2 * s] - bytes[3 + 2 * s];
      }
      return width < 0;
    };
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const auto& [parents, shares] = points[k];
      const auto heaviest = std::max_element(shares.begin(), shares.end()) - shares.begin();
      const unsigned char* own = sky->GetPointer(parents[heaviest] * HorizonCode::SectorBytes);
      glm::dvec3 normal(0.0);
      bool alike = true;
      for (std::size_t c = 0; c < 3 && parents[c] >= 0; ++c)
      {
        const unsigned char* bytes = sky->GetPointer(parents[c] * HorizonCode::SectorBytes);
        const glm::dvec3 n = HorizonCode::UnpackNormal(bytes);
        normal += shares[c] * n;
        alike = alike && isOpening(bytes) == isOpening(own) &&
                (n.z < 0.0) == (HorizonCode::UnpackNormal(own).z < 0.0); // frames turn about there
      }
      unsigned char* bytes =
        sky->GetPointer((first + static_cast<vtkIdType>(k)) * HorizonCode::SectorBytes);
      if (alike)
      {
        HorizonCode::PackNormal(normal, bytes);
      }
      else
      {
        std::copy_n(own, HorizonCode::SectorBytes, bytes);
      }
    }
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
  try
  {
    bool reads = mode != vtkMaterialMap::WEIGHTS && MapArray::Find(input, map).Array == array;
    for (int k = 0; mode == vtkMaterialMap::WEIGHTS && k < map->GetNumberOfMaterials(); ++k)
    {
      reads = reads || MapArray::FindWeights(input, map, k).Array == array;
    }
    return reads;
  }
  catch (const MapProblem&)
  {
    return false;
  }
}

MaterialPieces::MaterialPieces(vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others)
  : Input(input)
{
  this->Number(others);
  if (map->GetNumberOfMaterials() == 0)
  {
    throw MapProblem("it has no materials");
  }
  for (int k = 0; k < map->GetNumberOfMaterials(); ++k)
  {
    if (!map->GetBRDF(k) && map->GetMode() != vtkMaterialMap::CLASSES)
    {
      throw MapProblem(
        "material " + std::to_string(k) + " has no BRDF, which only classes may lack");
    }
  }
  switch (map->GetMode())
  {
    case vtkMaterialMap::CLASSES:
      this->FindClasses(map);
      break;
    case vtkMaterialMap::VALUES:
      this->FindValues(map);
      break;
    case vtkMaterialMap::WEIGHTS:
      this->FindWeights(map);
      break;
    default:
      this->FindImages(map);
  }
  this->MakePoints();
}

int MaterialPieces::Number(vtkBRDF* brdf)
{
  const auto [place, isNew] = this->Numbers.try_emplace(brdf, static_cast<int>(this->BRDFs.size()));
  if (isNew)
  {
    this->BRDFs.push_back(brdf);
  }
  return place->second;
}

void MaterialPieces::AddPiece(const std::vector<vtkIdType>& corners, vtkIdType cell, const Set& set)
{
  const auto [place, isNew] = this->KnownSets.try_emplace(set, this->Sets.size());
  if (isNew)
  {
    this->Sets.push_back(set);
  }
  const std::size_t begin = this->Corners.size();
  this->Corners.insert(this->Corners.end(), corners.begin(), corners.end());
  this->Pieces.push_back({ begin, this->Corners.size(), cell, place->second });
}

vtkIdType MaterialPieces::AddPoint(const NewPoint& point)
{
  this->NewPoints.push_back(point);
  return this->Input->GetNumberOfPoints() + static_cast<vtkIdType>(this->NewPoints.size()) - 1;
}

// Polygons that share an edge share its cuts, too: no gap shows.
vtkIdType MaterialPieces::FindPoint(vtkIdType a, vtkIdType b, vtkIdType which, double shareOfLarger)
{
  const auto [low, high] = std::minmax(a, b);
  const auto [place, isNew] = this->PointsOfEdges.try_emplace({ low, high, which }, 0);
  if (isNew)
  {
    place->second =
      this->AddPoint({ { low, high, -1 }, { 1.0 - shareOfLarger, shareOfLarger, 0.0 } });
  }
  return place->second;
}

void MaterialPieces::FindClasses(vtkMaterialMap* map)
{
  const MapArray array = MapArray::Find(this->Input, map);
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
  for (vtkIdType p = 0; p < this->Input->GetNumberOfPoints() && !array.OfCells; ++p)
  {
    this->Classes.push_back(classify(p));
  }
  ForEachPolygon(this->Input,
    [&](const std::vector<vtkIdType>& corners, vtkIdType cell)
    {
      const int first = array.OfCells ? classify(cell) : this->Classes[corners.front()];
      if (array.OfCells || std::all_of(corners.begin(), corners.end(),
                             [&](vtkIdType point) { return this->Classes[point] == first; }))
      {
        this->AddPiece(corners, cell, { first });
        return;
      }
      for (std::size_t c = 2; c < corners.size(); ++c) // as VTK draws it
      {
        this->CutBorders({ corners[0], corners[c - 1], corners[c] }, cell);
      }
    });
}

// A place is of the class whose corners have the largest share of it (barycentric coordinates,
// summed for each class). So borders are straight: between two classes from one edge's middle to
// another's, and where three meet, from the middles to the centroid.
void MaterialPieces::CutBorders(const std::array<vtkIdType, 3>& triangle, vtkIdType cell)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    const vtkIdType a = triangle[k];
    const vtkIdType b = triangle[(k + 1) % 3];
    const vtkIdType other = triangle[(k + 2) % 3];
    const int cls = this->Classes[a];
    if (this->Classes[b] == cls && this->Classes[other] == cls)
    {
      this->AddPiece({ a, b, other }, cell, { cls });
      return;
    }
    if (this->Classes[b] == cls)
    {
      const vtkIdType toB = this->FindPoint(b, other, 0, 0.5);
      const vtkIdType toA = this->FindPoint(other, a, 0, 0.5);
      this->AddPiece({ other, toA, toB }, cell, { this->Classes[other] });
      this->AddPiece({ a, b, toB, toA }, cell, { cls });
      return;
    }
  }
  const vtkIdType center = this->AddPoint({ triangle, { 1.0 / 3, 1.0 / 3, 1.0 / 3 } });
  for (std::size_t k = 0; k < 3; ++k)
  {
    const vtkIdType corner = triangle[k];
    const vtkIdType next = this->FindPoint(corner, triangle[(k + 1) % 3], 0, 0.5);
    const vtkIdType last = this->FindPoint(triangle[(k + 2) % 3], corner, 0, 0.5);
    this->AddPiece({ corner, next, center, last }, cell, { this->Classes[corner] });
  }
}

void MaterialPieces::FindValues(vtkMaterialMap* map)
{
  const MapArray array = MapArray::Find(this->Input, map);
  std::vector<int> order(map->GetNumberOfMaterials());
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
    this->KnotNumbers.push_back(this->Number(map->GetBRDF(k)));
    this->Knots.push_back(normalize(map->GetValue(k)));
  }
  const vtkIdType tuples =
    array.OfCells ? this->Input->GetNumberOfCells() : this->Input->GetNumberOfPoints();
  std::vector<double>& values = array.OfCells ? this->CellValues : this->Values;
  for (vtkIdType k = 0; k < tuples; ++k)
  {
    values.push_back(normalize(array.Get(k)));
  }
  ForEachPolygon(this->Input,
    [&](const std::vector<vtkIdType>& corners, vtkIdType cell) { this->CutBands(corners, cell); });
}

// Band k is from knot k - 1 to knot k: two materials meet there, and beyond the ends there is one.
MaterialPieces::Set MaterialPieces::GetBand(std::size_t band) const
{
  const int below = this->KnotNumbers[std::max<std::size_t>(band, 1) - 1];
  const int above = this->KnotNumbers[std::min(band, this->Knots.size() - 1)];
  return below == above ? Set{ below } : Set{ std::min(below, above), std::max(below, above) };
}

// The polygon's corners, with those of its edges' points between them that are on knots.
std::vector<vtkIdType> MaterialPieces::AddCuts(const std::vector<vtkIdType>& polygon)
{
  std::vector<vtkIdType> corners;
  for (std::size_t c = 0; c < polygon.size(); ++c)
  {
    const auto [a, b] = std::minmax(polygon[c], polygon[(c + 1) % polygon.size()]);
    const double from = this->Values[a];
    const double to = this->Values[b];
    corners.push_back(polygon[c]);
    const auto begin = corners.size();
    const auto first = std::upper_bound(this->Knots.begin(), this->Knots.end(), std::min(from, to));
    for (auto knot = first; knot != this->Knots.end() && *knot < std::max(from, to); ++knot)
    {
      corners.push_back(
        this->FindPoint(a, b, knot - this->Knots.begin(), (*knot - from) / (to - from)));
      this->Values.resize(this->Input->GetNumberOfPoints() + this->NewPoints.size(), *knot);
    }
    if (this->Values[polygon[c]] == std::max(from, to))
    {
      std::reverse(corners.begin() + begin, corners.end());
    }
  }
  return corners;
}

void MaterialPieces::CutBands(const std::vector<vtkIdType>& polygon, vtkIdType cell)
{
  const bool ofCell = this->AreWeightsOfPieces();
  std::vector<double> values;
  for (vtkIdType point : polygon)
  {
    values.push_back(ofCell ? this->CellValues[cell] : this->Values[point]);
  }
  if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
  {
    this->AddPiece(ofCell ? polygon : this->AddCuts(polygon), cell, { 0 });
    return;
  }
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const auto begin = this->Knots.begin();
  const std::size_t first = std::upper_bound(begin, this->Knots.end(), *least) - begin;
  const std::size_t last = std::lower_bound(begin, this->Knots.end(), *largest) - begin;
  if (last < first) // all on one knot
  {
    this->AddPiece(polygon, cell, { this->KnotNumbers[last] });
    return;
  }
  if (first == last)
  {
    this->AddPiece(polygon, cell, this->GetBand(first));
    return;
  }
  for (std::size_t c = 2; c < polygon.size() && polygon.size() > 3; ++c) // as VTK draws it
  {
    this->CutBands({ polygon[0], polygon[c - 1], polygon[c] }, cell);
  }
  const std::vector<vtkIdType> corners =
    polygon.size() > 3 ? std::vector<vtkIdType>() : this->AddCuts(polygon);
  for (std::size_t band = first; band <= last; ++band)
  {
    const double low = band > 0 ? this->Knots[band - 1] : -FarOff;
    const double high = band < this->Knots.size() ? this->Knots[band] : FarOff;
    std::vector<vtkIdType> piece;
    for (vtkIdType point : corners)
    {
      if (this->Values[point] >= low && this->Values[point] <= high)
      {
        piece.push_back(point);
      }
    }
    if (piece.size() > 2 && high > low)
    {
      this->AddPiece(piece, cell, this->GetBand(band));
    }
  }
}

void MaterialPieces::FindWeights(vtkMaterialMap* map)
{
  std::vector<MapArray> arrays;
  std::vector<int> numbers;
  for (int k = 0; k < map->GetNumberOfMaterials(); ++k)
  {
    arrays.push_back(MapArray::FindWeights(this->Input, map, k));
    numbers.push_back(this->Number(map->GetBRDF(k)));
  }
  std::vector<double> weights(this->BRDFs.size()); // number 0 has those of points without any
  vtkIdType bad = 0;
  for (vtkIdType p = 0; p < this->Input->GetNumberOfPoints(); ++p)
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
    this->Warning = std::to_string(bad) + " weights are negative, infinite or NaN and count as 0";
  }
  ForEachPolygon(this->Input,
    [&](const std::vector<vtkIdType>& corners, vtkIdType cell)
    {
      Set set;
      for (int material = 0; material < static_cast<int>(weights.size()); ++material)
      {
        if (std::any_of(corners.begin(), corners.end(),
              [&](vtkIdType p)
              { return this->PointWeights[p * weights.size() + material] > 0.0f; }))
        {
          set.push_back(material);
        }
      }
      // Colors of VTK's class do not blend with radiance: a polygon is one or the other.
      if (set.size() > 1 && set.front() == 0 && !this->BRDFs[0])
      {
        set = { 0 };
      }
      this->AddPiece(corners, cell, set);
    });
}

void MaterialPieces::FindImages(vtkMaterialMap* map)
{
  if (!this->Input->GetPointData()->GetTCoords())
  {
    throw MapProblem("the surface has no texture coordinates");
  }
  this->ImageShares = MeasureWeightImages(map, this->Warning);
  Set set;
  for (int k = 0; k <= map->GetNumberOfMaterials(); ++k)
  {
    if (k > 0)
    {
      this->BRDFs.push_back(map->GetBRDF(k - 1));
    }
    if (this->ImageShares[k] > 0.0)
    {
      set.push_back(k);
    }
  }
  ForEachPolygon(this->Input, [&](const std::vector<vtkIdType>& corners, vtkIdType cell)
    { this->AddPiece(corners, cell, set); });
}

// A rasterizer would interpolate as much: positions, normals and all else that drawing may read.
void MaterialPieces::MakePoints()
{
  this->Points = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPointData> from;
  from->ShallowCopy(this->Input->GetPointData());
  vtkPointData* to = this->Points->GetPointData();
  if (this->NewPoints.empty())
  {
    this->Points->SetPoints(this->Input->GetPoints());
    to->ShallowCopy(from);
    return;
  }
  const vtkIdType first = this->Input->GetNumberOfPoints();
  for (int k = from->GetNumberOfArrays(); k-- > 0;)
  {
    if (from->GetAbstractArray(k)->GetNumberOfTuples() < first) // VTK reads them unchecked
    {
      from->RemoveArray(k);
    }
  }
  const vtkIdType count = first + static_cast<vtkIdType>(this->NewPoints.size());
  vtkNew<vtkPoints> points;
  points->SetDataType(this->Input->GetPoints()->GetDataType());
  points->SetNumberOfPoints(count);
  points->GetData()->InsertTuples(0, first, 0, this->Input->GetPoints()->GetData());
  to->CopyAllOn();
  to->InterpolateAllocate(from, count);
  to->CopyData(from, 0, first, 0);
  vtkNew<vtkIdList> parents;
  for (std::size_t k = 0; k < this->NewPoints.size(); ++k)
  {
    NewPoint& made = this->NewPoints[k];
    const vtkIdType number = first + static_cast<vtkIdType>(k);
    glm::dvec3 place(0.0);
    parents->Reset();
    for (std::size_t c = 0; c < 3 && made.Parents[c] >= 0; ++c)
    {
      glm::dvec3 at;
      this->Input->GetPoint(made.Parents[c], &at.x);
      place += made.Shares[c] * at;
      parents->InsertNextId(made.Parents[c]);
    }
    points->SetPoint(number, &place.x);
    to->InterpolatePoint(from, number, parents, made.Shares.data());
  }
  this->Points->SetPoints(points);
  MendHorizonCodes(to, first, this->NewPoints);
}

double MaterialPieces::GetWeight(const Piece& piece, vtkIdType corner, int material) const
{
  const Set& set = this->Sets[piece.Set];
  if (set.size() == 1)
  {
    return set.front() == material ? 1.0 : 0.0;
  }
  if (this->Knots.empty())
  {
    return this->PointWeights[corner * this->BRDFs.size() + material];
  }
  const double value =
    this->AreWeightsOfPieces() ? this->CellValues[piece.Cell] : this->Values[corner];
  // A knot is of both bands beside it.
  std::size_t above =
    std::upper_bound(this->Knots.begin(), this->Knots.end(), value) - this->Knots.begin();
  if (above == 0 || above == this->Knots.size())
  {
    return this->KnotNumbers[above == 0 ? 0 : above - 1] == material ? 1.0 : 0.0;
  }
  const double share =
    (value - this->Knots[above - 1]) / (this->Knots[above] - this->Knots[above - 1]);
  return (this->KnotNumbers[above - 1] == material ? 1.0 - share : 0.0) +
         (this->KnotNumbers[above] == material ? share : 0.0);
}

double MaterialPieces::GetShare(const Piece& piece, int material) const
{
  if (!this->ImageShares.empty())
  {
    return this->ImageShares[material];
  }
  double sum = 0.0;
  for (std::size_t c = piece.Begin; c < piece.End; ++c)
  {
    sum += this->GetWeight(piece, this->Corners[c], material);
  }
  return piece.End > piece.Begin ? sum / static_cast<double>(piece.End - piece.Begin) : 0.0;
}

MaterialPieces::Set MaterialPieces::GetHeaviest(const Set& set, std::size_t most) const
{
  std::vector<double> totals(this->BRDFs.size(), 0.0);
  for (std::size_t k = 0; k < this->PointWeights.size(); ++k)
  {
    totals[k % totals.size()] += this->PointWeights[k];
  }
  totals = this->ImageShares.empty() ? totals : this->ImageShares;
  Set heaviest = set;
  std::stable_sort(
    heaviest.begin(), heaviest.end(), [&totals](int a, int b) { return totals[a] > totals[b]; });
  heaviest.resize(std::min(heaviest.size(), most));
  std::sort(heaviest.begin(), heaviest.end());
  return heaviest;
}
} // namespace measuredbrdf
