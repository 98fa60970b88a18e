// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLightSetRadianceIntegrator
 * @brief   the thesis's light loop: the sum over a light set (CPU twin of the mapper's shader)
 *
 * L_o = sum_j f(i_j,o) cos(theta_j) E_j (thesis 2.3.2). The lights come from the environment by a
 * generator; as many lights as the environment has texels are the sum over the texels' centers. A
 * light set of the program's own may take their place: it lives in the environment's
 * frame, and an environment is then only needed for its rotation and may be missing. Views closer
 * to the horizon than 1.1 degrees are taken there, as the shader takes them.
 *
 * A sharp lobe shows a few lights as dots. Soft lights spread each by its concentration: the lobe
 * is evaluated as wide as lobe and light together (vtkBRDF::EvaluateSoft). Closed forms, D-BRDFs
 * and tables over half and difference angles have that form; measured materials that are resampled
 * for the graphics card are shaded with the table (vtkBRDF::GetRenderable). All else stays hard.
 */

#ifndef vtkLightSetRadianceIntegrator_h
#define vtkLightSetRadianceIntegrator_h

#include "vtkRadianceIntegrator.h"

#include <memory> // for Internals

class vtkLightSet;
class vtkLightSetGenerator;

class VTKMEASUREDBRDF_EXPORT vtkLightSetRadianceIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkLightSetRadianceIntegrator* New();
  vtkTypeMacro(vtkLightSetRadianceIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How the environment becomes lights, e.g. vtkLightSetGenerator's median cut, the thesis's; null
   * (default): cells of least variance, by vtkLightSetGenerator's method of that name. Integrators
   * that share a generator and an environment share the lights.
   */
  void SetGenerator(vtkLightSetGenerator* generator);
  vtkLightSetGenerator* GetGenerator();
  ///@}

  ///@{
  /**
   * Lights to make, default 64, in [1, vtkLightSetGenerator::MaximumNumberOfLights]. Median cut
   * makes powers of two only.
   */
  virtual void SetNumberOfLights(int numberOfLights);
  vtkGetMacro(NumberOfLights, int);
  ///@}

  ///@{
  /**
   * A ready-made light set that is used instead of making one; null (default): none.
   */
  void SetLightSet(vtkLightSet* lights);
  vtkLightSet* GetLightSet();
  ///@}

  /**
   * The lights of the last preparation; null before the first.
   */
  vtkLightSet* GetCurrentLightSet();

  ///@{
  /**
   * Whether lights are as wide as their concentration says; default off. Changing it costs the
   * shader a rebuild.
   */
  vtkSetMacro(SoftLights, bool);
  vtkGetMacro(SoftLights, bool);
  vtkBooleanMacro(SoftLights, bool);
  ///@}

#ifndef __VTK_WRAP__
  /// For planners: evaluate hard lights many at a time, in single precision, where the material
  /// can.
  void SetInLanes(bool inLanes) { this->InLanes = inLanes; }
#endif

  ///@{
  /**
   * Whether the shader has up to 16 lights written one by one; default off. Software renderers draw
   * one light a third faster so, but another number of lights costs the shader a rebuild.
   */
  vtkSetMacro(Unrolled, bool);
  vtkGetMacro(Unrolled, bool);
  vtkBooleanMacro(Unrolled, bool);
  ///@}

  bool GetShaderInputs(vtkBRDFShaderInputs& inputs) override;
  bool UsesBRDFOnGPU() override { return true; }
  bool UsesSoftLights() override { return this->SoftLights; }
  bool NeedsEnvironment() override;
  vtkMTimeType GetInputsMTime() override;

  ///@{
  /**
   * As a method: "light-set", by the number of lights. Planners try it for anisotropic materials.
   */
  std::string GetMethodName() override { return "light-set"; }
  std::string GetMethodDescription() override;
  std::vector<Size> GetSizes() override;
  std::string GetSizesText() override;
  std::vector<std::vector<int>> GetCandidateSizes(bool all) override;
  double EstimateCost() override;
  vtkIdType EstimateTextureBytes() override;
  ///@}

protected:
  vtkLightSetRadianceIntegrator();
  ~vtkLightSetRadianceIntegrator() override;

  void CopyProperties(vtkRadianceIntegrator* source) override;
  bool Begin() override;
  void IntegratePair(
    const double n[3], const double o[3], const double t[3], double radiance[3]) override;

  vtkSmartPointer<vtkLightSetGenerator> Generator;
  int NumberOfLights = 64;
  vtkSmartPointer<vtkLightSet> LightSet;
  bool SoftLights = false;
  bool Unrolled = false;

private:
  bool InLanes = false;
  vtkSmartPointer<vtkLightSet> MakeLights(std::string& problem);
  struct Internals;
  std::unique_ptr<Internals> Prepared; // null: nothing yet

  vtkLightSetRadianceIntegrator(const vtkLightSetRadianceIntegrator&) = delete;
  void operator=(const vtkLightSetRadianceIntegrator&) = delete;
};

#endif
