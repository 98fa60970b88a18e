// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An environment at every resolution: an equal-area octahedral map (Clarberg 2008, "Fast Equal-Area
 * Mapping of the (Hemi)Sphere using SIMD") and its halvings, so that the mean radiance about a
 * direction over a given solid angle costs two bilinear fetches, without poles or seams. Private to
 * the module (GLSL twin: shaders/vtkBRDFEnvironmentPyramid.glsl).
 */

#ifndef EnvironmentPyramid_h
#define EnvironmentPyramid_h

#include "TexelChanges.h"
#include "vtkType.h"

#include <glm/glm.hpp>

#include <vector>

class vtkEnvironment;

namespace measuredbrdf
{
class EnvironmentPyramid
{
public:
  /**
   * From an environment that is not empty, with some texels changed. size: texels a side of the
   * finest level, a power of two or 768; 0: as ChooseSize.
   */
  explicit EnvironmentPyramid(
    vtkEnvironment* environment, const TexelChanges& changes = {}, int size = 0);

  /// About as fine as the environment: a power of two up to 512, or 768.
  static int ChooseSize(vtkEnvironment* environment);

  /// Of its textures in 16 bits, with all levels and their borders.
  static vtkIdType EstimateBytes(vtkEnvironment* environment);

  /// Mean radiance about unit d on level lod (0: finest; fractions in between; clamped).
  glm::vec3 Sample(const glm::vec3& d, float lod) const;

  /// The level whose texels have this solid angle in sr.
  float GetLevel(double solidAngle) const;

  int GetSize() const { return this->Size; }
  int GetNumberOfLevels() const { return static_cast<int>(this->Origins.size()); }

  /// The finest level and on its right all others below each other, each with a border of one texel
  /// that continues it across the octahedron's edges. RGBA (A unused).
  const std::vector<glm::vec4>& GetAtlas() const { return this->Atlas; }
  int GetAtlasWidth() const { return this->Size + this->Size / 2 + 4; }
  int GetAtlasHeight() const { return this->AtlasHeight; }

  /// The direction of (u,v) in [0,1]^2.
  static glm::dvec3 ToSphere(const glm::dvec2& uv);

private:
  std::size_t Locate(int level, int x, int y) const;
  glm::vec4& At(int level, int x, int y) { return this->Atlas[this->Locate(level, x, y)]; }
  glm::vec3 Bilinear(int level, const glm::vec2& uv) const;
  std::vector<glm::dvec4> Gather(vtkEnvironment* environment, const TexelChanges& changes) const;
  void Fill(vtkEnvironment* environment, const TexelChanges& changes);
  void Halve(int level);
  void ContinueBorder(int level);

  int Size = 0;
  int AtlasHeight = 0;
  std::vector<glm::ivec2> Origins; // the place of each level in the atlas
  std::vector<glm::vec4> Atlas;
};
} // namespace measuredbrdf

#endif
