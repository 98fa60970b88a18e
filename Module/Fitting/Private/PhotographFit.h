// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From photographs of a flat sample to materials and their weights. Passes over all photographs of
 * a set, one picture in memory at a time, as linear values with what each pixel is good for; what
 * they say of each texel, its convex weights, and which of many materials to mix; materials that
 * are found in photographs, as tables.
 */

#ifndef PhotographFit_h
#define PhotographFit_h

#include "LinearLeastSquares.h"
#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

class vtkPhotographSet;

namespace measuredbrdf
{
enum class PixelState : std::uint8_t
{
  Valid,
  Saturated,
  Black,
  Invalid // not finite
};

struct PhotographPixels
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Values;      // RGB, linear, row 0 at the bottom; 0 where a pixel is not valid
  std::vector<PixelState> States; // of each pixel
};

/// The user stopped the fit.
struct MapFitStopped
{
};

class PhotographPasses
{
public:
  /// Reads the first photograph, for the size. report: with the share done; false: stop.
  PhotographPasses(vtkPhotographSet* set, std::function<bool(double)> report);

  /// use(number, pixels) for each photograph in turn, while progress goes from one share to the
  /// other. Throws MapFitStopped, and std::runtime_error for a photograph that cannot be used, with
  /// its name.
  void Run(double from, double to, const std::function<void(int, const PhotographPixels&)>& use);

  /// Report progress. Throws MapFitStopped.
  void Proceed(double share) const;

  int Width = 0;
  int Height = 0;
  /// Pixels of each PixelState in all photographs, as the last pass found them.
  std::array<std::uint64_t, 4> PixelCounts{};

private:
  PhotographPixels Read(int index) const;

  vtkPhotographSet* Set;
  std::function<bool(double)> Report;
};

using NamedMaterial = std::pair<vtkSmartPointer<vtkBRDF>, std::string>;

/// A photograph's unit of error is what it shows on the average plus this, as a linear value (1:
/// full scale): photographs count alike, but for those too dark to say much.
constexpr double NoiseFloor = 0.01;

/// A pixel's linear value of each material in each photograph, divided by the photograph's scale of
/// errors: 3 rows (RGB) a photograph, a column for each material.
struct MaterialValues
{
  Eigen::MatrixXd Values;
  std::vector<double> Scales; // of each photograph: its unit of error, as a linear value
};

/**
 * Materials' linear values in the photographs, over each photograph's unit of error. scales: these
 * units; empty: made from the materials, as their geometric mean plus NoiseFloor.
 */
MaterialValues EvaluateMaterials(vtkPhotographSet* set, const std::vector<NamedMaterial>& materials,
  const std::vector<double>& scales);

/**
 * For each texel t and its valid photographs: H = sum m m', g = sum m b, and sum b^2, where m are
 * the materials' values and b is the pixel's. H is the same for all texels but for their masked
 * photographs, which are listed.
 */
class TexelSums
{
public:
  /// texels: their numbers in the pictures.
  TexelSums(const MaterialValues& materials, std::vector<std::size_t> texels);

  /// Add the next photograph, on several threads.
  void Add(int photograph, const PhotographPixels& pixels);

  int GetNumberOfMaterials() const { return static_cast<int>(this->Matrix.rows()); }
  std::size_t GetNumberOfTexels() const { return this->Texels.size(); }
  std::size_t GetTexel(std::size_t k) const { return this->Texels[k]; }

  /// Of the materials at some of the columns, at most MaximumNumberOfUnknowns.
  SmallMatrix GetMatrix(std::size_t k, const std::vector<int>& columns) const;
  SmallVector GetRight(std::size_t k, const std::vector<int>& columns) const
  {
    return this->Right(columns, static_cast<Eigen::Index>(k));
  }
  double GetSquares(std::size_t k) const { return this->Squares[k]; }

  /// Valid photographs of a texel.
  std::size_t GetNumberOfPhotographs(std::size_t k) const
  {
    return this->Materials.Scales.size() - this->Masked[k].size();
  }

private:
  const MaterialValues& Materials;
  std::vector<std::size_t> Texels;
  Eigen::MatrixXd Matrix;               // of all photographs
  Eigen::MatrixXd Right;                // [material, texel]
  std::vector<double> Squares;          // of each texel
  std::vector<std::vector<int>> Masked; // photographs of each texel, ascending
};

struct WeightSolution
{
  SmallVector Weights; // all 0: no photograph of this texel is valid
  double Residual = 0; // sum of squares that is left
};

/// The best convex weights of some of the materials for a texel.
WeightSolution SolveTexel(const TexelSums& sums, std::size_t k, const std::vector<int>& columns);

/**
 * Which materials, `most` at most, describe all texels best: forward selection, that is orthogonal
 * matching pursuit (Tropp, Gilbert, Strauss 2006, for many signals at once) with convex weights,
 * then exchanges of one material for another and removals while they pay. A material is taken if it
 * lowers the sum of squares by the share tolerance. Empty if there is no texel with a valid
 * photograph. proceed: called with the share done; may throw.
 */
std::vector<int> SelectMaterials(
  const TexelSums& sums, int most, double tolerance, const std::function<void(double)>& proceed);

/// As vtkMaterialMapFitter has them.
struct TableOptions
{
  int Materials;
  unsigned int Seed;
  double Smoothness;
  std::array<int, 3> Dimensions;
};

struct TableMaterials
{
  std::vector<NamedMaterial> Materials;
  std::vector<double> Scales; // each photograph's unit of error: the mean of its valid pixels plus
                              // NoiseFloor
  double FactorError = 0.0;
  int Iterations = 0;
  bool Converged = false;
  double SeenShare = 0.0; // of the tables' cells
};

/// A sample of texels is factored; each material's values in the photographs become a table.
/// Progress goes to 0.6. Throws what passes do, and std::runtime_error.
TableMaterials FindTableMaterials(vtkPhotographSet* photographs, const TableOptions& options,
  PhotographPasses& passes, const std::vector<std::size_t>& sample);
} // namespace measuredbrdf

#endif
