// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeasuredBRDFMapper
 * @brief   draws polydata made of a measured material, lit by an environment and the scene's lights
 *
 * Use it where vtkPolyDataMapper stood: give it a vtkBRDF, and the surface reflects the renderer's
 * environment texture (vtkRenderer::SetEnvironmentTexture, the one that VTK's own physically based
 * rendering uses, lat-long or cube map; UseImageBasedLighting need not be on) or an environment of
 * its own, plus the renderer's vtkLights. Per pixel the shader adds up BRDF x light x cosine over a
 * set of directional lights made from the environment (O'Toole 2007).
 *
 * - A vtkLight of colour c and intensity k gives irradiance k c on a surface that faces it, as in
 *   VTK's PBR: a white Lambert surface then shows k c / pi.
 * - Output is radiance^(1/2.2), as VTK's PBR writes it; vtkToneMappingPass expects that.
 * - Opacity, edges, clipping planes, picking, scalars (as a factor), back faces: as the superclass.
 *   Points, lines, wireframe, and actors with vtkProperty::Lighting off are left to the superclass.
 * - Without a material it is the superclass.
 * - Anisotropic materials use the polydata's float point tangents (PointData::SetTangents); without
 *   them the tangent turns about the environment's up axis, with a warning.
 * - Composite datasets: one actor and mapper per block.
 *
 * The setters below do not call Modified(): that would rebuild vertex buffers and shaders. What
 * they set shows at the next Render. Changing the material's parameters, the environment, its
 * rotation or the number of lights costs no shader rebuild and no new vertex buffers. Mappers that
 * share a BRDF share its textures; mappers that share an environment share its light sets.
 */

#ifndef vtkMeasuredBRDFMapper_h
#define vtkMeasuredBRDFMapper_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkOpenGLPolyDataMapper.h"

#include <memory> // for Internals
#include <string> // for descriptions

class vtkBRDF;
class vtkEnvironment;
class vtkLightSet;
class vtkRadianceIntegrator;

class VTKMEASUREDBRDF_EXPORT vtkMeasuredBRDFMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkMeasuredBRDFMapper* New();
  vtkTypeMacro(vtkMeasuredBRDFMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material; null (default): draw as the superclass does.
   */
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF();
  ///@}

  ///@{
  /**
   * An environment for this mapper alone; null (default): the renderer's environment texture. The
   * environment's own rotation comes on top of the renderer's EnvironmentUp and EnvironmentRight.
   */
  void SetEnvironment(vtkEnvironment* environment);
  vtkEnvironment* GetEnvironment();
  ///@}

  ///@{
  /**
   * A ready-made light set in the environment's frame, used instead of making one; null (default):
   * make one from the environment.
   */
  void SetLightSet(vtkLightSet* lights);
  vtkLightSet* GetLightSet();
  ///@}

  ///@{
  /**
   * How the environment's light is added up; null (default): by a light set, see below. The mapper
   * hands its material and its current environment to the integrator, so mappers that draw
   * different ones must not share it. Not asked without an environment.
   */
  void SetIntegrator(vtkRadianceIntegrator* integrator);
  vtkRadianceIntegrator* GetIntegrator();
  ///@}

  enum LightSetMethodType
  {
    MEDIAN_CUT = 0,
    IMPORTANCE_SAMPLING = 1
  };

  ///@{
  /**
   * How the environment becomes lights: median cut (default) or importance sampling; how many
   * (default 64, in [1, 1048576]; median cut takes the next power of two, with a warning); and the
   * seed of importance sampling (default 1).
   */
  void SetLightSetMethod(int method);
  int GetLightSetMethod() { return this->LightSetMethod; }
  void SetLightSetMethodToMedianCut() { this->SetLightSetMethod(MEDIAN_CUT); }
  void SetLightSetMethodToImportanceSampling() { this->SetLightSetMethod(IMPORTANCE_SAMPLING); }
  void SetNumberOfLights(int count);
  int GetNumberOfLights() { return this->NumberOfLights; }
  void SetSeed(unsigned int seed);
  unsigned int GetSeed() { return this->Seed; }
  ///@}

  enum ScalarColoringModeType
  {
    IGNORE_SCALARS = 0,
    MODULATE = 1
  };

  ///@{
  /**
   * What scalar colours do to the material: multiply it (default; colours are taken as display
   * colours and made linear) or nothing. Without scalars the property's colours have no effect.
   */
  void SetScalarColoringMode(int mode);
  int GetScalarColoringMode() { return this->ScalarColoringMode; }
  ///@}

  ///@{
  /**
   * About the last render: bytes of the textures in use (material and lights), the lights in use
   * (null before the first render or without an environment), a line on the material's GPU form
   * (sizes, precision, errors), and those errors: relative L2 by resampling into a table, and the
   * largest relative rounding of a stored value (vtkBRDFGPUForm).
   */
  vtkIdType GetTextureBytes();
  vtkLightSet* GetCurrentLightSet();
  std::string GetMaterialDescription();
  double GetResamplingError();
  double GetQuantizationError();
  ///@}

  void ShallowCopy(vtkAbstractMapper* m) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkMeasuredBRDFMapper();
  ~vtkMeasuredBRDFMapper() override;

  bool GetNeedToRebuildShaders(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderColor(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderNormal(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderPositionVC(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderLight(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor) override;
  void SetMapperShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;
  void RenderPieceStart(vtkRenderer* ren, vtkActor* actor) override;
  void RenderPieceFinish(vtkRenderer* ren, vtkActor* actor) override;

  /// Whether the primitives now being set up are shaded by the material.
  bool UsesMaterial(vtkActor* actor, const vtkOpenGLHelper* cellBO);

  /// Whether the material's tangents come with the data.
  bool HasTangents();

  int LightSetMethod = MEDIAN_CUT;
  int NumberOfLights = 64;
  unsigned int Seed = 1;
  int ScalarColoringMode = MODULATE;

private:
  vtkMeasuredBRDFMapper(const vtkMeasuredBRDFMapper&) = delete;
  void operator=(const vtkMeasuredBRDFMapper&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
