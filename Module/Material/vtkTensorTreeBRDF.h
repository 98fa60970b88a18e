// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTensorTreeBRDF
 * @brief   BRDF as a tree of cubes over both directions, constant within each: Radiance's tensor
 * tree
 *
 * Ward, Kurt, Bonneel 2012, "A Practical Framework for Sharing and Rendering Real-World
 * Bidirectional Scattering Distribution Functions"; the files of Radiance's genBSDF -t3 and -t4.
 * Directions are mapped from the disk to the unit square (Shirley, Chiu 1997). With v the view's
 * direction continued through the surface, -o, and i the light, a place in the tree is
 *
 * 4 dimensions: (square(v), square(i)), an anisotropic material;
 * 3 dimensions: (1/2 - |v| / 2, square(i turned by minus the azimuth of v)), an isotropic one.
 *
 * It is not interpolated, as in Radiance. For lights graphics cards get a resampled table, with one
 * warning where its error exceeds ResamplingTolerance.
 */

#ifndef vtkTensorTreeBRDF_h
#define vtkTensorTreeBRDF_h

#include "vtkResampledBRDF.h"

#include <vector> // for the tree

class VTKMEASUREDBRDF_EXPORT vtkTensorTreeBRDF : public vtkResampledBRDF
{
public:
  static vtkTensorTreeBRDF* New();
  vtkTypeMacro(vtkTensorTreeBRDF, vtkResampledBRDF);

  /**
   * Nodes, children before their parents, the root last. A branch (Side 0) has 2^dimensions
   * children; child k is the half with the larger values along each axis whose bit is set in k. A
   * leaf has Side^dimensions values (Side a power of two), those of the last axis fastest.
   */
  struct Tree
  {
    struct Node
    {
      int Side = 1;
      int First = 0; // into Children or Values
    };
    int Dimensions = 3;
    std::vector<Node> Nodes;
    std::vector<int> Children;
    std::vector<float> Values; // 1/sr, the same for red, green and blue
  };

  /// Of Nodes, Children and Values: what files hold exactly.
  static constexpr int MaximumSize = 1 << 24;

  /**
   * Set the tree. Returns an empty string, or what is wrong, the material unchanged. Negative
   * values are kept and count as 0.
   */
  std::string SetTree(Tree tree);
  const Tree& GetTree() const { return this->Data; }

  bool IsIsotropic() override { return this->Data.Dimensions == 3; }
  bool IsReciprocal() override { return false; }
  std::string GetModelName() override { return "TensorTree"; }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;

protected:
  vtkTensorTreeBRDF() = default;
  ~vtkTensorTreeBRDF() override = default;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;

  Tree Data;

private:
  vtkTensorTreeBRDF(const vtkTensorTreeBRDF&) = delete;
  void operator=(const vtkTensorTreeBRDF&) = delete;
};

#endif
