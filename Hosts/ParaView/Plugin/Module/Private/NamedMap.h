// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The material map that a representation's properties name.
 */

#ifndef NamedMap_h
#define NamedMap_h

#include "vtkBRDF.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkMultiProcessController;

namespace measuredmaterials
{
struct NamedMap
{
  using Say = std::function<void(const std::string&)>;

  // The properties. Whoever changes the mode or the array sets IsChanged; names are found anew.
  int Mode = 0; // 0 there is no map, 1 classes, 2 values, 3 weights, 4 images
  std::string Array;
  std::vector<std::pair<std::string, std::string>> Materials; // value, name
  std::vector<std::string> Images;
  bool IsChanged = true;

  /// Find what the names mean; say takes what cannot be read. Collective with a controller.
  void Find(vtkMultiProcessController* controller, const Say& say);

  /// Draw without materials: there is no light.
  void DropMaterials();

  /**
   * The map; null where there is none, or where something cannot be read that the weights of the
   * others depend on. Classes of materials that cannot be read are left out.
   */
  vtkMaterialMap* Get(const Say& say);

  /// Whether data have what the map reads, in all blocks.
  bool CanRead(vtkDataObject* data) const;

  void Print(std::ostream& os, const std::string& indent) const;

private:
  bool HasWeights() const; // materials go by the order of their numbers

  std::vector<vtkSmartPointer<vtkBRDF>> FoundMaterials;
  std::vector<vtkSmartPointer<vtkImageData>> FoundImages;
  vtkSmartPointer<vtkMaterialMap> Map;
};
} // namespace measuredmaterials

#endif
