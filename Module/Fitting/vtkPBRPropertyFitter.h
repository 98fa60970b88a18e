// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPBRPropertyFitter
 * @brief   the vtkProperty whose physically based shading comes nearest to a material
 *
 * For everything that draws a vtkProperty and not this module's shaders: exporters (glTF, OBJ,
 * X3D), OSPRay, ANARI, glyphs, the levels of detail that vtkLODActor makes itself.
 *
 * The fit minimises the relative L1 distance, sum |model - exact| / sum exact, between two pictures
 * of a sphere under a neutral light (a gray studio: a ceiling, a key light, a fill light and a rim
 * light, all soft), drawn by the material's f and by VTK's shading of a vtkProperty without
 * image-based light's approximations. Base color, roughness and metallic part are
 * searched; then the base's index of refraction and edge tint with them; then a clear coat, too:
 * each only where it takes at least 30 % of the error away, since not all that draws a
 * vtkProperty knows it. The search is deterministic and takes some tenths of a second. Anisotropic
 * materials get the isotropic shading that is nearest over all tangents; the error counts what is
 * missing.
 */

#ifndef vtkPBRPropertyFitter_h
#define vtkPBRPropertyFitter_h

#include "vtkBRDF.h"               // for BRDF
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for BRDF

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

  /**
   * Fit. Returns false with an error event where there is no material; the results stay then.
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
   * Set the results: interpolation PBR, colors, roughness, metallic part, indices of refraction,
   * gray edge tint, clear coat, no anisotropy; and for what knows Phong's model only, the specular
   * color, strength and power of a highlight of about that height and width. Opacity, edges,
   * textures, representation and all else stay.
   */
  void Apply(vtkProperty* property);

  /**
   * Update and Apply in one: sets the property and returns the relative error; negative, with the
   * property as it was, where there is no material or no property.
   */
  static double Fit(vtkBRDF* brdf, vtkProperty* property);

  /**
   * The neutral light: gray radiance from a direction; +y up, the picture is seen from +z.
   */
  static double GetNeutralRadiance(const double direction[3]);

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

private:
  vtkPBRPropertyFitter(const vtkPBRPropertyFitter&) = delete;
  void operator=(const vtkPBRPropertyFitter&) = delete;
};

#endif
