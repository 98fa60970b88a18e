// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Lamps beside a table: the window that shares their light with the table, what a material shows of
 * lamps that are as wide as its lobe, and their sum in each pixel.
 */

#ifndef Lamps_h
#define Lamps_h

#include "LocalFrame.h"
#include "vtkBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkBRDF;
class vtkLightSet;

namespace measuredbrdf
{
/// A weight w over the angle between a lamp and the lobe's axis: 1 at the axis, flat there, and 0
/// from the window's radius on, to which it falls without an edge (C1). A pixel adds w f
/// cos(theta_i) of the lamps that its window holds; a table takes (1 - w) f cos(theta_i), which is
/// as smooth as the window is wide.
struct LampWindow
{
  /// Where it ends, in radians (docs/methods/hybrids.md).
  static constexpr double Radius = 0.7;

  /// 1 / the squared distance of unit directions at which it ends.
  static double GetReach()
  {
    static const double reach = 0.25 / std::pow(std::sin(0.5 * Radius), 2);
    return reach;
  }

  /// Of unit directions. The shader's vtkBRDFEnvironmentLamps.glsl does the same.
  static double GetWeight(const glm::dvec3& lamp, const glm::dvec3& axis)
  {
    const double x = 1.0 - GetNearness(lamp, axis);
    const double root = 1.0 - x * x;
    return x < 1.0 ? root * root : 0.0;
  }

  /// Of unit directions: 1 where the lamp is on the axis, 0 where the window ends, negative beyond.
  static double GetNearness(const glm::dvec3& lamp, const glm::dvec3& axis)
  {
    const glm::dvec3 away = lamp - axis;
    return 1.0 - GetReach() * glm::dot(away, away);
  }

  /// A lamp nearer than this, 10 degrees, is the sum of its parts; else one light. In a lobe's tail
  /// nobody tells, and frames under many lamps take a third less (docs/methods/lamps.md).
  static constexpr double PartsNearness = 0.935;

  /// How much of all directions the window covers: half of 1 - cos(radius).
  static double GetShare() { return 0.25 / GetReach(); }
};

class LobeViews;

/**
 * The mean of an isotropic material's f over a lamp, by the lamp's middle: f(i, o) averaged over
 * directions that are normally distributed about i. It comes from a table of f cos(theta_o) over
 * half and difference angles, half a turn of phi_d: both sides of the plane of incidence are alike.
 */
class LampBRDF : public vtkBRDF
{
public:
  static LampBRDF* New();
  vtkTypeMacro(LampBRDF, vtkBRDF);

  /// spread: the directions' variance along each axis (square radians), vtkLightSet's
  /// 1 / concentration. On several threads.
  static vtkSmartPointer<LampBRDF> Make(vtkBRDF* material, double spread);

  /// Whether the width of such lamps shows: more than 5 % of some view's albedo lie in lobes
  /// narrower than twelve times the lamp, seen at most 60 degrees from the normal.
  static bool IsWidthSeen(const LobeViews& views, double spread);

  ///@{
  /// Whether the parts of a lamp are to be told apart; default: no.
  void SetSeesParts(bool seesParts) { this->SeesParts = seesParts; }
  bool GetSeesParts() const { return this->SeesParts; }
  ///@}

  /// Of the texture.
  static vtkIdType GetTextureBytes();

  /// The name of the function in the text: brdfTermINSTANCE is the material's own.
  static std::string GetFunction() { return "brdfLampINSTANCE"; }

  /// One term. Its function is GetFunction().
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override;

  /// The term before another one's, which calls the function.
  void AddTo(vtkBRDFShaderInputs::Term& term);

  bool IsReciprocal() override { return false; }

protected:
  LampBRDF();
  ~LampBRDF() override;

  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;

private:
  LampBRDF(const LampBRDF&) = delete;
  void operator=(const LampBRDF&) = delete;

  struct Mean;
  std::unique_ptr<Mean> Sampled;     // while the table is made
  std::vector<std::uint32_t> Texels; // phi_d fastest, with shared exponents
  double Scale = 1.0;                // of their values
  bool SeesParts = false;
};

/// 1/kappa of a light's own region; 0 for light from the direction itself.
double GetSpread(vtkLightSet* lights, int index);

/// "brdfLights": two texels for each light, direction and 1/kappa, irradiance; at most so many
/// lights in a row.
constexpr int LightsPerRow = 512;
vtkBRDFShaderInputs::Texture MakeLightTexture(vtkLightSet* lights);

class TableLamps
{
public:
  /// shaded: what the graphics card evaluates; prepared. A LampBRDF sees the parts of a LampSet.
  TableLamps(vtkLightSet* lights, vtkBRDF* shaded);
  ~TableLamps();

  /// Sum of w (f - lambert) cos(theta_i) E, of either sign: the Lambert part of all light is the
  /// table's. view: in the frame; axis: of the lobe, in the environment's.
  glm::dvec3 Sum(const Frame& frame, const glm::dvec3& view, const glm::dvec3& axis,
    const glm::dvec3& lambert) const;

  /// The same as GLSL, which the table's text calls.
  void AddTo(vtkBRDFShaderInputs::Term& table) const;

private:
  vtkBRDFShaderInputs::Texture MakeTexture() const;

  struct Part
  {
    glm::dvec3 Direction;
    glm::dvec3 Irradiance;
  };

  struct Lamp
  {
    std::vector<Part> Whole; // one
    std::vector<Part> Parts; // none: it is seen whole
  };

  vtkSmartPointer<vtkBRDF> Shaded;
  std::vector<Lamp> Lamps;
  bool HaveParts;
};
} // namespace measuredbrdf

#endif
