// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMaterialMap
 * @brief   data choose and mix the materials of a surface
 *
 * Give it to a mapper (vtkMeasuredBRDFMapper::SetMaterialMap), and an array of the surface decides
 * what each place is made of. Reflected radiance is linear in the BRDF, so a mixture of measured
 * materials reflects exactly the mixture of what each one reflects: sum of w_k f_k, a convex
 * combination (Lawrence et al. 2006, "Inverse shade trees for non-parametric material
 * representation and editing").
 *
 * - CLASSES: each material has a class, a value of a point or cell array. Cells with a class are of
 *   its material up to their borders; between points of different classes the nearest one's counts.
 *   A class without a BRDF (null) is drawn in the superclass's colors.
 * - VALUES: each material has a value on the scale of a scalar point or cell array. Between two
 *   values the materials are blended linearly, as vtkColorTransferFunction blends colors; below the
 *   first and above the last value that material is alone.
 * - WEIGHTS: each material has a point array of weights (SetWeightArrayName) or, where it has none,
 *   the component of its number of the array ArrayName.
 * - TEXTURES: weights are in images over the surface's texture coordinates: the components of the
 *   images, one after the other, belong to the materials in their order. VTK's own range of texture
 *   coordinates, [0, 1] across an image.
 *
 * Weights are divided by their sum. Negative and NaN weights count as 0, with a warning of the
 * mapper. Places without a material, which are those of a class that the map does not know, a NaN
 * value, or weights that are all 0, are of the mapper's own BRDF (vtkMeasuredBRDFMapper::SetBRDF),
 * or in the superclass's colors if that is null.
 */

#ifndef vtkMaterialMap_h
#define vtkMaterialMap_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for materials

#include <map>    // for values
#include <string> // for names
#include <vector> // for materials

class vtkBRDF;
class vtkImageData;

class VTKMEASUREDBRDF_EXPORT vtkMaterialMap : public vtkObject
{
public:
  static vtkMaterialMap* New();
  vtkTypeMacro(vtkMaterialMap, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ModeType
  {
    CLASSES = 0,
    VALUES = 1,
    WEIGHTS = 2,
    TEXTURES = 3
  };

  ///@{
  /**
   * What the data hold (default: CLASSES).
   */
  virtual void SetMode(int mode);
  vtkGetMacro(Mode, int);
  void SetModeToClasses() { this->SetMode(CLASSES); }
  void SetModeToValues() { this->SetMode(VALUES); }
  void SetModeToWeights() { this->SetMode(WEIGHTS); }
  void SetModeToTextures() { this->SetMode(TEXTURES); }
  ///@}

  ///@{
  /**
   * The array of classes, values or weights: a point array of that name or, for classes and values,
   * a cell array where the points have none. "" (default): the active scalars. Not for TEXTURES.
   */
  virtual void SetArrayName(const std::string& name);
  std::string GetArrayName() { return this->ArrayName; }
  ///@}

  ///@{
  /**
   * The array's component with the class or value (default: 0, the first).
   */
  virtual void SetArrayComponent(int component);
  vtkGetMacro(ArrayComponent, int);
  ///@}

  /// Most materials of a map.
  static constexpr int MaximumNumberOfMaterials = 1024;

  ///@{
  /**
   * Add a material. value: its class or its place on the scale, with which it takes the place of
   * the one that has it; a finite number, else nothing is added, with an error event. Weights take
   * none: those materials count from 0 up, in the order in which they are added. brdf is shared,
   * not copied; null in CLASSES only. Returns its number, -1 after an error.
   */
  int AddMaterial(vtkBRDF* brdf, double value, const std::string& name);
  int AddMaterial(vtkBRDF* brdf, double value) { return this->AddMaterial(brdf, value, ""); }
  int AddMaterial(vtkBRDF* brdf, const std::string& name);
  int AddMaterial(vtkBRDF* brdf);
  ///@}

  void RemoveAllMaterials();
  int GetNumberOfMaterials() { return static_cast<int>(this->Materials.size()); }

  ///@{
  /**
   * About a material; null, 0 or "" where there is none of that number.
   */
  vtkBRDF* GetBRDF(int index);
  double GetValue(int index);
  std::string GetName(int index);
  std::string GetWeightArrayName(int index);
  ///@}

  ///@{
  /**
   * Change one. An error event, nothing changed, where there is none of that number.
   */
  void SetBRDF(int index, vtkBRDF* brdf);
  void SetName(int index, const std::string& name);
  void SetWeightArrayName(int index, const std::string& name);
  ///@}

  ///@{
  /**
   * Images of weights, of 1 to 4 components of any scalar type: integers are divided by their
   * type's largest value. They repeat beyond [0, 1] unless RepeatWeightImages is off (default: on).
   */
  void AddWeightImage(vtkImageData* image);
  void RemoveAllWeightImages();
  int GetNumberOfWeightImages() { return static_cast<int>(this->WeightImages.size()); }
  vtkImageData* GetWeightImage(int index);
  vtkSetMacro(RepeatWeightImages, bool);
  vtkGetMacro(RepeatWeightImages, bool);
  vtkBooleanMacro(RepeatWeightImages, bool);
  ///@}

  /**
   * The material's weight in the mixture at a value of the scale (VALUES), or 1 where the value is
   * its class (CLASSES); 0 for NaN.
   */
  double GetWeight(int index, double value);

  /**
   * The material of a class; -1: none.
   */
  int FindClass(double value);

  /// Also when one of the materials or an image last changed.
  vtkMTimeType GetMTime() override;

  /// When it last changed which materials are where: everything but the materials' own parameters.
  vtkMTimeType GetDivisionMTime();

protected:
  vtkMaterialMap();
  ~vtkMaterialMap() override;

private:
  vtkMaterialMap(const vtkMaterialMap&) = delete;
  void operator=(const vtkMaterialMap&) = delete;

  struct Material
  {
    vtkSmartPointer<vtkBRDF> BRDF;
    double Value = 0.0;
    std::string Name;
    std::string WeightArrayName;
  };
  const Material& Get(int index) const; // an empty one where there is none
  template <typename Member, typename T>
  void Change(int index, Member member, const T& value, const char* caller);

  int Mode = CLASSES;
  int ArrayComponent = 0;
  std::string ArrayName;
  std::vector<Material> Materials;
  std::map<double, int> ByValue; // materials' numbers
  std::vector<vtkSmartPointer<vtkImageData>> WeightImages;
  bool RepeatWeightImages = true;
};

#endif
