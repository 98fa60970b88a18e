// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCompositeMeasuredBRDFMapper
 * @brief   draws composite polydata, each block of the measured material that it is given
 *
 * Use it where vtkCompositePolyDataMapper stood (up to VTK 9.2: vtkCompositePolyDataMapper2): for
 * multi-block data sets, partitioned data sets and their collections, nested as they may be, with
 * empty and missing blocks. Its properties are those of vtkMeasuredBRDFMapper. SetBRDF gives the
 * material of every block; SetBlockBRDF gives single blocks, and all that lies below them, one of
 * their own.
 *
 * vtkCompositeDataDisplayAttributes works as with the superclass: visibility, opacity and
 * pickability as they are, a block's color multiplies its radiance (SetScalarColoringMode). Blocks
 * without a material are drawn as the superclass draws them.
 *
 * Blocks are drawn in the superclass's few batches, once for each material in a batch; blocks of
 * one material share its plan and textures, however many they are.
 */

#ifndef vtkCompositeMeasuredBRDFMapper_h
#define vtkCompositeMeasuredBRDFMapper_h

#include "vtkMeasuredBRDFMapper.h" // for enumerations
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkVersionMacros.h"      // for the superclass
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper.h"
#else
#include "vtkCompositePolyDataMapper2.h"
#endif

#include <memory> // for Internals
#include <string> // for names

class vtkBRDF;
class vtkEnvironment;
class vtkMaterialMap;
class vtkProperty;
class vtkRadianceIntegrator;

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
class VTKMEASUREDBRDF_EXPORT vtkCompositeMeasuredBRDFMapper : public vtkCompositePolyDataMapper
{
public:
  vtkTypeMacro(vtkCompositeMeasuredBRDFMapper, vtkCompositePolyDataMapper);
#else
class VTKMEASUREDBRDF_EXPORT vtkCompositeMeasuredBRDFMapper : public vtkCompositePolyDataMapper2
{
public:
  vtkTypeMacro(vtkCompositeMeasuredBRDFMapper, vtkCompositePolyDataMapper2);
#endif
  static vtkCompositeMeasuredBRDFMapper* New();
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material of all blocks that have none of their own; null (default): they are drawn as the
   * superclass does.
   */
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF();
  ///@}

  ///@{
  /**
   * The material of a block and of all blocks below it, by flat index (as
   * vtkDataObjectTreeIterator and vtkCompositeDataDisplayAttributes count: the root is 0, missing
   * blocks count) or by the name in its meta data (vtkCompositeDataSet::NAME; all blocks of that
   * name). A block's own material goes before its parent's, an index before a name. Null: drawn as
   * the superclass does, whatever SetBRDF says. An index or a name that the data do not have is
   * said once, when they are drawn.
   */
  void SetBlockBRDF(unsigned int flatIndex, vtkBRDF* brdf);
  vtkBRDF* GetBlockBRDF(unsigned int flatIndex);
  bool HasBlockBRDF(unsigned int flatIndex);
  void RemoveBlockBRDF(unsigned int flatIndex);
  void SetBlockBRDFByName(const std::string& name, vtkBRDF* brdf);
  void RemoveBlockBRDFs();
  ///@}

  ///@{
  /**
   * As vtkMeasuredBRDFMapper has them.
   */
  void SetMaterialMap(vtkMaterialMap* map);
  vtkMaterialMap* GetMaterialMap();
  void SetEnvironment(vtkEnvironment* environment);
  vtkEnvironment* GetEnvironment();
  void SetIntegrator(vtkRadianceIntegrator* integrator);
  vtkRadianceIntegrator* GetIntegrator();
  void SetErrorTolerance(double tolerance);
  double GetErrorTolerance();
  void SetMaximumCost(double cost);
  double GetMaximumCost();
  void SetPlanningMode(int mode);
  int GetPlanningMode();
  void SetPlanningModeToForeground() { this->SetPlanningMode(vtkMeasuredBRDFMapper::FOREGROUND); }
  void SetPlanningModeToBackground() { this->SetPlanningMode(vtkMeasuredBRDFMapper::BACKGROUND); }
  void SetPlanningModeToBackgroundFromStart()
  {
    this->SetPlanningMode(vtkMeasuredBRDFMapper::BACKGROUND_FROM_START);
  }
  void SetPlanForView(bool view);
  bool GetPlanForView();
  void PlanForViewOn() { this->SetPlanForView(true); }
  void PlanForViewOff() { this->SetPlanForView(false); }
  void SetAbortPlanning(bool abort);
  bool GetAbortPlanning();
  void SetScalarColoringMode(int mode);
  int GetScalarColoringMode();
  void SetOcclusionMode(int mode);
  int GetOcclusionMode();
  void SetOcclusionModeToOff() { this->SetOcclusionMode(vtkMeasuredBRDFMapper::OCCLUSION_OFF); }
  void SetOcclusionModeToAuto() { this->SetOcclusionMode(vtkMeasuredBRDFMapper::OCCLUSION_AUTO); }
  void SetOcclusionModeToOn() { this->SetOcclusionMode(vtkMeasuredBRDFMapper::OCCLUSION_ON); }
  void SetOcclusionModeToArrays()
  {
    this->SetOcclusionMode(vtkMeasuredBRDFMapper::OCCLUSION_ARRAYS);
  }
  void SetOcclusionBounce(bool bounce);
  bool GetOcclusionBounce();
  void OcclusionBounceOn() { this->SetOcclusionBounce(true); }
  void OcclusionBounceOff() { this->SetOcclusionBounce(false); }
  void SetUseSceneLights(bool use);
  bool GetUseSceneLights();
  void UseSceneLightsOn() { this->SetUseSceneLights(true); }
  void UseSceneLightsOff() { this->SetUseSceneLights(false); }
  ///@}

  ///@{
  /**
   * About the last render, as vtkMeasuredBRDFMapper has it; of the plan a line for each material.
   */
  std::string GetPlan();
  bool GetPlanPending();
  bool GetPlanReady();
  vtkIdType GetTextureBytes();
  ///@}

  /**
   * As vtkMeasuredBRDFMapper has it, for the material of all blocks (SetBRDF).
   */
  double FitProperty(vtkProperty* property);

  void ShallowCopy(vtkAbstractMapper* mapper) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  void Render(vtkRenderer* renderer, vtkActor* actor) override;

  /**
   * Also when anything last changed that the picture depends on (vtkMeasuredBRDFMapper).
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkCompositeMeasuredBRDFMapper();
  ~vtkCompositeMeasuredBRDFMapper() override;

  /// Called by the superclass for each of its batches.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  vtkCompositePolyDataMapperDelegator* CreateADelegator() override;
#else
  vtkCompositeMapperHelper2* CreateHelper() override;
#endif

private:
  vtkCompositeMeasuredBRDFMapper(const vtkCompositeMeasuredBRDFMapper&) = delete;
  void operator=(const vtkCompositeMeasuredBRDFMapper&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
