// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMaterialMapFitter
 * @brief   from photographs of a flat sample to a material map
 *
 * Factors a sample's reflectance into a few materials and their weights at each texel, all
 * non-negative, the weights of a texel with a sum of 1 (Lawrence et al. 2006, "Inverse shade trees
 * for non-parametric material representation and editing"). A texel of photograph p is then
 *
 *   value_p(texel) = scale_p sum_k w_k(texel) f_k(i_p, o_p)
 *
 * with vtkPhotographSet::GetScale. Two methods:
 *
 * - LIBRARY chooses at most MaximumNumberOfMaterials of the materials that AddMaterial adds:
 *   forward selection by least squares with convex weights, then exchanges. A material is taken if
 *   it lowers the sum of squares by the share Tolerance.
 * - TABLES finds the materials: alternating constrained least squares on a sample of texels, from
 *   those that lie farthest apart. The values in the photographs become tables over half and
 *   difference angles (vtkTabulatedBRDF), smooth where no photograph looks. They are isotropic and
 *   reciprocal. There are MaximumNumberOfMaterials of them.
 *
 * Then the weights of every texel are solved for. Each photograph's squares are divided by those of
 * what it shows on the average, plus 1 % of full scale: bright and dark photographs count alike.
 * Pixels that are saturated, black or not finite (vtkPhotographSet) are left out and counted.
 *
 * Pictures are read one at a time, twice. A texel takes 4 bytes for each material of the map, and
 * some 60, and 8 more for each material while it is fitted. The same input and seed give the same
 * bits on any number of threads.
 */

#ifndef vtkMaterialMapFitter_h
#define vtkMaterialMapFitter_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for members

#include <string>  // for names
#include <utility> // for materials
#include <vector>  // for materials

class vtkBRDF;
class vtkImageData;
class vtkMaterialMap;
class vtkPhotographSet;

class VTKMEASUREDBRDF_EXPORT vtkMaterialMapFitter : public vtkObject
{
public:
  static vtkMaterialMapFitter* New();
  vtkTypeMacro(vtkMaterialMapFitter, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    LIBRARY = 0,
    TABLES = 1
  };

  ///@{
  /**
   * The photographs. They are shared, not copied.
   */
  void SetPhotographs(vtkPhotographSet* photographs);
  vtkPhotographSet* GetPhotographs();
  ///@}

  ///@{
  /**
   * Choose materials from a library (default), or find tables.
   */
  virtual void SetMethod(int method);
  vtkGetMacro(Method, int);
  void SetMethodToLibrary() { this->SetMethod(LIBRARY); }
  void SetMethodToTables() { this->SetMethod(TABLES); }
  ///@}

  /// Most materials of the library.
  static constexpr int MaximumLibrarySize = 4096;

  ///@{
  /**
   * The library. brdf is shared, not copied; an error event and no change for null and beyond
   * MaximumLibrarySize.
   */
  void AddMaterial(vtkBRDF* brdf, const std::string& name);
  void RemoveAllMaterials();
  int GetNumberOfLibraryMaterials() { return static_cast<int>(this->Library.size()); }
  ///@}

  ///@{
  /**
   * Most materials of the map (TABLES: how many), in [1, 32]; default 4. Others are refused.
   */
  virtual void SetMaximumNumberOfMaterials(int number);
  vtkGetMacro(MaximumNumberOfMaterials, int);
  ///@}

  ///@{
  /**
   * LIBRARY: a further material must lower the sum of squares by this share; in [0, 1], default
   * 0.02.
   */
  virtual void SetTolerance(double tolerance);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * TABLES: weight of the tables' squared second differences against the photographs, in [1e-8,
   * 1e4]; default 1e-2.
   */
  virtual void SetSmoothness(double smoothness);
  vtkGetMacro(Smoothness, double);
  ///@}

  ///@{
  /**
   * TABLES: cells along phi_d, theta_d and theta_h, 4 to 90 each; default 8 x 16 x 64. Others are
   * clamped.
   */
  virtual void SetTableDimensions(int phiD, int thetaD, int thetaH);
  vtkGetVector3Macro(TableDimensions, int);
  ///@}

  ///@{
  /**
   * Texels of the sample by which materials are chosen or found, in [64, 2^20]; default 4096, one
   * in each of as many equal parts of the picture.
   */
  virtual void SetNumberOfSampleTexels(int number);
  vtkGetMacro(NumberOfSampleTexels, int);
  ///@}

  ///@{
  /**
   * Seed of the sample; default 1.
   */
  vtkSetMacro(Seed, unsigned int);
  vtkGetMacro(Seed, unsigned int);
  ///@}

  ///@{
  /**
   * Set this in an observer of ProgressEvent (calldata: double*) to stop: Fit returns false.
   */
  vtkSetMacro(Abort, bool);
  vtkGetMacro(Abort, bool);
  vtkBooleanMacro(Abort, bool);
  ///@}

  /**
   * Fit. Returns false with an error event without photographs or library, for a photograph that
   * can't be used or has another size than the first one, and where no pixel is valid; without one
   * when aborted. The results stay as they were then.
   */
  bool Fit();

  ///@{
  /**
   * The map, mode TEXTURES, with weight images of floats; a new object at each Fit. Null before.
   * ErrorImage: floats, the relative error of each texel, sqrt(sum of squares left / sum of
   * squares); -1 where no photograph is valid (there, all weights are 0).
   */
  vtkMaterialMap* GetOutput();
  vtkImageData* GetErrorImage();
  ///@}

  ///@{
  /**
   * Mean, 95th percentile and largest of the texels' errors, and where that is (x, y from the lower
   * left).
   */
  double GetMeanError() { return this->Found.MeanError; }
  double GetError95() { return this->Found.Error95; }
  double GetWorstError() { return this->Found.WorstError; }
  vtkGetVector2Macro(WorstTexel, int);
  ///@}

  ///@{
  /**
   * Pixels of all photographs that were left out, and texels without any valid one.
   */
  vtkIdType GetNumberOfSaturatedPixels() { return this->Found.SaturatedPixels; }
  vtkIdType GetNumberOfBlackPixels() { return this->Found.BlackPixels; }
  vtkIdType GetNumberOfInvalidPixels() { return this->Found.InvalidPixels; }
  vtkIdType GetNumberOfTexelsWithoutData() { return this->Found.TexelsWithoutData; }
  ///@}

  ///@{
  /**
   * About a material of the output: the mean of its weights, the largest of them, and the standard
   * deviation of a weight by the residual's variance, which is infinite where the photographs do
   * not tell. 0 where there is none of that number.
   */
  double GetCoverage(int material) { return this->Found.GetMaterial(material).Coverage; }
  double GetLargestWeight(int material) { return this->Found.GetMaterial(material).LargestWeight; }
  double GetUncertainty(int material) { return this->Found.GetMaterial(material).Uncertainty; }
  ///@}

  ///@{
  /**
   * TABLES: relative error of the factorization on the sample, before the values became tables;
   * share of the tables' cells that the photographs touch; iterations, and whether they converged.
   */
  double GetFactorizationError() { return this->Found.FactorizationError; }
  double GetSeenShare() { return this->Found.SeenShare; }
  int GetNumberOfIterations() { return this->Found.Iterations; }
  bool GetConverged() { return this->Found.Converged; }
  ///@}

  ///@{
  /**
   * What the photographs leave open, a sentence each: materials that look alike, weights that are
   * hardly determined, materials that are nowhere pure, another brightness.
   */
  int GetNumberOfFindings() { return static_cast<int>(this->Found.Findings.size()); }
  std::string GetFinding(int index);
  ///@}

protected:
  vtkMaterialMapFitter();
  ~vtkMaterialMapFitter() override;

  vtkSmartPointer<vtkPhotographSet> Photographs;
  vtkSmartPointer<vtkMaterialMap> Output;
  vtkSmartPointer<vtkImageData> ErrorImage;
  int Method = LIBRARY;
  int MaximumNumberOfMaterials = 4;
  double Tolerance = 0.02;
  double Smoothness = 1e-2;
  int TableDimensions[3] = { 8, 16, 64 };
  int NumberOfSampleTexels = 4096;
  unsigned int Seed = 1;
  bool Abort = false;
  int WorstTexel[2] = { 0, 0 };

private:
  vtkMaterialMapFitter(const vtkMaterialMapFitter&) = delete;
  void operator=(const vtkMaterialMapFitter&) = delete;

  struct MaterialFigures
  {
    double Coverage = 0.0;
    double LargestWeight = 0.0;
    double Uncertainty = 0.0;
  };
  struct Figures
  {
    std::vector<MaterialFigures> Materials;
    double MeanError = 0.0;
    double Error95 = 0.0;
    double WorstError = 0.0;
    double FactorizationError = 0.0;
    double SeenShare = 0.0;
    int Iterations = 0;
    bool Converged = false;
    vtkIdType SaturatedPixels = 0;
    vtkIdType BlackPixels = 0;
    vtkIdType InvalidPixels = 0;
    vtkIdType TexelsWithoutData = 0;
    std::vector<std::string> Findings;

    MaterialFigures GetMaterial(int k) const
    {
      const bool exists = k >= 0 && k < static_cast<int>(this->Materials.size());
      return exists ? this->Materials[static_cast<std::size_t>(k)] : MaterialFigures();
    }
  };
  struct Run; // a fit while it runs

  std::vector<std::pair<vtkSmartPointer<vtkBRDF>, std::string>> Library;
  Figures Found; // by the last Fit that succeeded
};

#endif
