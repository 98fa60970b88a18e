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

#include <array>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

class vtkMaterialMap;
class vtkPolyData;

namespace measuredbrdf
{
/// How the weights of a part's materials are found in a pixel.
enum class MixtureKind
{
  Single,  // one material, or none
  Weights, // point attributes
  Nearest, // only where the material's own is the largest; elsewhere another part draws
  Value,   // hat functions of a point attribute
  Images   // images over the texture coordinates
};

struct MaterialPart
{
  vtkSmartPointer<vtkPolyData> Surface;          // all parts share the points, so that no gap shows
  std::vector<vtkSmartPointer<vtkBRDF>> Members; // none: the superclass draws
  MixtureKind Kind = MixtureKind::Single;
  bool HasRest = false; // Images: some pixels have no material; they are another part's,
  bool IsRest = false;  // that is drawn by the superclass, this one
  int NumberOfWeights = 0;
  int Slot = 0; // Nearest: the weight that is the largest where the pixel is this part's
  std::vector<double> Knots; // Value: each member's place on the scale, from 0 to 1, rising
  bool IsBand = false;       // Value: places out of Band are another part's, its end, too
  std::array<float, 2> Band = { -1e30f, 1e30f };
  std::vector<int> Components; // Images: each member's, counted over all images
};

class MaterialParts
{
public:
  /// Most weights that meet in a part: vertex attributes have room for no more.
  static constexpr int MaximumNumberOfWeights = 32;

  /// The same on a scale of values, so that their textures fit into the 16 units that every
  /// graphics card has. Polygons of more of them are drawn in bands (MaterialPartition).
  static constexpr int MaximumNumberInBand = 5;

  /// Parts are merged, where weights allow that, until there are no more of them than this.
  static constexpr int WantedNumberOfParts = 32;

  /// Whether polygons are cut along the borders between classes of points (ClassBorders). Until
  /// this is called they stay whole. Where they once may not be cut, they stay whole until the
  /// input or the map change: actors and windows that share a mapper may differ in it.
  void SetMayCut(bool may)
  {
    this->MayCut = may;
    this->IsCutForbidden = this->IsCutForbidden || !may;
  }

  /// Divide anew if the input, the map or the material for the rest changed. Returns why the map
  /// cannot be used (there are no parts then), or "". warning: what is odd about the data, or "".
  std::string Update(
    vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others, std::string& warning);

  void Clear();

  /// Whether the last Update ran out of memory, say: the next one tries again.
  bool HasFailed() const { return !this->Input; }

  const std::vector<MaterialPart>& Get() const { return this->Parts; }

  /// Rises with each division.
  unsigned long GetRevision() const { return this->Revision; }

  /// Those that are seen somewhere.
  const std::vector<vtkBRDF*>& GetBRDFs() const { return this->BRDFs; }

  /// The share of the surface's area that is of a material, of the area that is of any.
  double GetShare(vtkBRDF* brdf) const { return this->Find(brdf).Share; }

  /// All surfaces on which a material may be seen.
  const std::vector<vtkPolyData*>& GetSurfaces(vtkBRDF* brdf) const
  {
    return this->Find(brdf).Surfaces;
  }

private:
  std::string Divide(vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others);
  void AddPart(MaterialPart part);
  void Drop();
  void MeasureShares(const std::map<vtkBRDF*, double>& areas);

  // Looked up in every frame.
  struct Use
  {
    double Share = 0.0;
    std::vector<vtkPolyData*> Surfaces;
  };
  const Use& Find(vtkBRDF* brdf) const;

  std::vector<MaterialPart> Parts;
  std::vector<vtkBRDF*> BRDFs;
  std::unordered_map<vtkBRDF*, Use> Uses;
  std::string Problem;
  std::string Warning;
  vtkPolyData* Input = nullptr; // only compared
  vtkMTimeType InputTime = 0;
  vtkSmartPointer<vtkMaterialMap> Map;
  vtkMTimeType MapTime = 0;
  vtkSmartPointer<vtkBRDF> Others;
  unsigned long Revision = 0;
  bool MayCut = false;
  bool IsCutForbidden = false;
  bool IsCut = false; // as was wanted and allowed
};
} // namespace measuredbrdf

#endif
