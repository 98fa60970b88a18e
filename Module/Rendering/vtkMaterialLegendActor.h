// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMaterialLegendActor
 * @brief   a legend of materials: a lit sphere and a name for each
 *
 * What vtkScalarBarActor is for colors: add it to a renderer (AddActor2D), give it the mapper's
 * vtkMaterialMap, and each material of the map shows as a sphere under an environment, with its
 * name beside it, or with its class or value where it has none. Materials without a BRDF are left
 * out.
 *
 * The spheres are pictures computed on the CPU, within 5 % of the exact radiance where that is
 * possible, seen along the environment's -z axis from a great distance. They are made when a
 * material or the environment changes: in some 0.1 s each, more for mirror-like ones. Colors are
 * radiance^(1/2.2), as the mappers write them: a tone mapping pass exposes both alike.
 *
 * Position is the lower left corner and Position2 the size, in shares of the viewport (defaults:
 * 0.8, 0.1 and 0.18, 0.8).
 */

#ifndef vtkMaterialLegendActor_h
#define vtkMaterialLegendActor_h

#include "vtkActor2D.h"
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkSmartPointer.h"       // for the map

#include <memory> // for Impl
#include <string> // for labels

class vtkEnvironment;
class vtkMaterialMap;
class vtkTextProperty;

class VTKMEASUREDBRDF_EXPORT vtkMaterialLegendActor : public vtkActor2D
{
public:
  static vtkMaterialLegendActor* New();
  vtkTypeMacro(vtkMaterialLegendActor, vtkActor2D);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The materials; null (default): nothing is drawn.
   */
  void SetMaterialMap(vtkMaterialMap* map);
  vtkMaterialMap* GetMaterialMap();
  ///@}

  ///@{
  /**
   * The light; null (default): a procedural sky, so that legends of different scenes can be
   * compared. Its rotation applies.
   */
  void SetEnvironment(vtkEnvironment* environment);
  vtkEnvironment* GetEnvironment();
  ///@}

  ///@{
  /**
   * A line above the spheres; "" (default): none.
   */
  void SetTitle(const std::string& title);
  std::string GetTitle() { return this->Title; }
  ///@}

  /**
   * Font, color and style of the names and the title. Sizes are found so that all fit.
   */
  vtkTextProperty* GetTextProperty();

  int RenderOverlay(vtkViewport* viewport) override;
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderTranslucentPolygonalGeometry(vtkViewport*) override { return 0; }
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  void ReleaseGraphicsResources(vtkWindow* window) override;
  vtkMTimeType GetMTime() override;

protected:
  vtkMaterialLegendActor();
  ~vtkMaterialLegendActor() override;

private:
  vtkMaterialLegendActor(const vtkMaterialLegendActor&) = delete;
  void operator=(const vtkMaterialLegendActor&) = delete;

  void UpdateLayout(vtkViewport* viewport);

  vtkSmartPointer<vtkMaterialMap> MaterialMap;
  vtkSmartPointer<vtkEnvironment> Environment;
  std::string Title;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
