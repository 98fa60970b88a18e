// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPBRPropertyFitter
 * @brief   fits a vtkProperty whose physically based shading is closest to a material
 *
 * Use it for code that draws a vtkProperty without this module's shaders: exporters (glTF, OBJ,
 * X3D), OSPRay, ANARI, glyphs, and the levels of detail that vtkLODActor makes itself.
 *
 * The fit minimises the relative L1 distance, sum |model - exact| / sum exact, between two pictures
 * of a sphere under a neutral light (a gray studio: a ceiling, a key light, a fill light and a rim
 * light, all soft). One is drawn by the material's f, the other by VTK's shading of a vtkProperty
 * without the approximations of image-based lighting. The search varies base color, roughness and
 * metallic part; then also the base's index of refraction and edge tint; then also a clear coat.
 * The later parameters are used only if they reduce the error by at least 30 %, because not all
 * renderers and exporters support them. The search is deterministic and takes some tenths of a
 * second. Anisotropic materials get the isotropic shading that is closest over all tangents; the
 * error includes the difference.
 */

#ifndef vtkPBRPropertyFitter_h
#define vtkPBRPropertyFitter_h

#include "vtkBRDF.h"               // for BRDF
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for BRDF

class vtkEnvironment;
class vtkProperty;

class VTKMEASUREDBRDF_EXPORT vtkPBRPropertyFitter : public vtkObject
{
public:
  static vtkPBRPropertyFitter* New();
  vtkTypeMacro(vtkPBRPropertyFitter, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material.
   */
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF() { return this->BRDF; }
  ///@}

  ///@{
  /**
   * Whether the values are such as people set by hand (default on): a metallic part of 0, or of 0.3
   * to 1 (metals, and paint with flakes) with a roughness of at most 0.6; indices of refraction up
   * to 2. Off: all that vtkProperty takes, such as a felt with a metallic part of 0.46, which is
   * closer to the material.
   */
  vtkSetMacro(UsualValues, bool);
  vtkGetMacro(UsualValues, bool);
  vtkBooleanMacro(UsualValues, bool);
  ///@}

  /**
   * Fit. Returns false with an error event and keeps the results if there is no material.
   */
  bool Update();

  ///@{
  /**
   * The results, named as vtkProperty names them. Colors are linear, as VTK's shading takes them.
   */
  vtkGetVector3Macro(BaseColor, double);
  vtkGetMacro(Roughness, double);
  vtkGetMacro(Metallic, double);
  vtkGetMacro(BaseIOR, double);
  vtkGetMacro(EdgeTint, double);
  vtkGetMacro(CoatStrength, double);
  vtkGetMacro(CoatRoughness, double);
  vtkGetMacro(CoatIOR, double);
  ///@}

  /**
   * Relative L1 distance of the two pictures.
   */
  vtkGetMacro(RelativeError, double);

  /**
   * The same without UsualValues: what is more in RelativeError is the price of usual values.
   */
  vtkGetMacro(ClosestError, double);

  /**
   * Set the results: interpolation PBR, colors, roughness, metallic part, indices of refraction,
   * gray edge tint, clear coat, no anisotropy. For code that only supports Phong's model, also set
   * the specular color, strength and power of a highlight of about that height and width. Opacity,
   * edges, textures, representation and all other properties stay.
   */
  void Apply(vtkProperty* property);

  /**
   * Update and Apply in one call: sets the property and returns the relative error. Without a
   * material or a property, returns a negative number and leaves the property unchanged.
   */
  static double Fit(vtkBRDF* brdf, vtkProperty* property);

  /**
   * Make the environment the neutral light, with that many rows, 1 to 2048: +y up, the picture is
   * seen from +z.
   */
  static void SetToNeutralStudio(vtkEnvironment* environment, int rows = 128);

protected:
  vtkPBRPropertyFitter() = default;
  ~vtkPBRPropertyFitter() override = default;

  vtkSmartPointer<vtkBRDF> BRDF;
  double BaseColor[3] = { 1.0, 1.0, 1.0 };
  double Roughness = 0.5;
  double Metallic = 0.0;
  double BaseIOR = 1.5;
  double EdgeTint = 1.0;
  double CoatStrength = 0.0;
  double CoatRoughness = 0.0;
  double CoatIOR = 2.0;
  double RelativeError = 0.0;
  bool UsualValues = true;
  double ClosestError = 0.0;

private:
  vtkPBRPropertyFitter(const vtkPBRPropertyFitter&) = delete;
  void operator=(const vtkPBRPropertyFitter&) = delete;
};

#endif
