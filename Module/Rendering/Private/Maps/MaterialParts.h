// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A surface in parts, so that the same few materials meet in all pixels of a part.
 *
 * Each part is drawn by a shader with its own materials only: a class map costs what one material
 * costs, whatever the number of classes, and a blend what the materials that meet cost.
 */

#ifndef MaterialParts_h
#define MaterialParts_h

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <unordered_map>
#include <vector>

class vtkMaterialMap;
class vtkPolyData;

namespace measuredbrdf
{
class MaterialPieces;

/// How the weights of a part's materials are found in a pixel.
enum class MixtureKind
{
  Single,  // one material, or none
  Weights, // point attributes
  Images   // images over the texture coordinates
};

struct MaterialPart
{
  vtkSmartPointer<vtkPolyData> Surface;          // polygons; all parts have the points in common
  std::vector<vtkSmartPointer<vtkBRDF>> Members; // none: VTK's class draws
  MixtureKind Kind = MixtureKind::Single;
  bool HasRest = false;        // Images: some pixels have no material; they are another part's,
  bool IsRest = false;         // that is drawn by VTK's class, this one
  int NumberOfWeights = 0;     // of the members, and of the rest
  std::vector<int> Components; // Images: each weight's, counted over all images; -1: the rest
};

/// Names of the point arrays of parts, and of the vertex attributes that they become.
namespace partarrays
{
/// Weights in an array: components of a vertex attribute.
constexpr int WeightsPerArray = 4;

/// The weights of members from WeightsPerArray times number on.
inline std::string GetWeights(int number) { return "brdfWeights" + std::to_string(number); }

/// Texture coordinates of weights in images.
constexpr const char* Coordinates = "brdfCoordinates";
} // namespace partarrays

class MaterialParts
{
public:
  /// Most weights that meet in a part: vertex attributes have room for no more.
  static constexpr int MaximumNumberOfWeights = 32;

  /// Parts are merged, where weights allow that, until there are no more of them than this.
  static constexpr int WantedNumberOfParts = 32;

  /// Divide anew if the input, the map or the material for the rest changed. Returns why the map
  /// cannot be used (there are no parts then), or "". warning: what is odd about the data, or "".
  std::string Update(
    vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others, std::string& warning);

  void Clear();

  /// Whether the last Update ran out of memory, say: the next one tries again.
  bool HasFailed() const { return !this->Input; }

  const std::vector<MaterialPart>& Get() const { return this->Parts; }

  /// The polygons of all parts, one after the other, and the input's vertices and lines.
  vtkPolyData* GetWhole() const { return this->Whole; }

  /// Rises with each division.
  unsigned long GetRevision() const { return this->Revision; }

  /// Those that are seen somewhere.
  const std::vector<vtkBRDF*>& GetBRDFs() const { return this->BRDFs; }

  /// The share of the surface's area that is of a material, of the area that is of any.
  double GetShare(vtkBRDF* brdf) const
  {
    const auto found = this->Shares.find(brdf);
    return found == this->Shares.end() ? 0.0 : found->second;
  }

private:
  struct Group
  {
    std::vector<int> Materials; // as MaterialPieces numbers them
    std::vector<std::size_t> Pieces;
  };

  void Divide(vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others);
  std::vector<Group> MakeGroups(const MaterialPieces& pieces);
  void MakeSurfaces(
    vtkPolyData* input, const MaterialPieces& pieces, const std::vector<Group>& groups);
  void AddPart(MaterialPart part);
  void MeasureShares(const MaterialPieces& pieces);
  void Drop();

  std::vector<MaterialPart> Parts;
  vtkSmartPointer<vtkPolyData> Whole;
  std::vector<vtkBRDF*> BRDFs;
  std::unordered_map<vtkBRDF*, double> Shares;
  std::string Problem;
  std::string Warning;
  vtkPolyData* Input = nullptr; // only compared
  vtkMTimeType InputTime = 0;
  vtkSmartPointer<vtkMaterialMap> Map;
  vtkMTimeType MapTime = 0;
  vtkSmartPointer<vtkBRDF> Others;
  unsigned long Revision = 0;
};
} // namespace measuredbrdf

#endif
