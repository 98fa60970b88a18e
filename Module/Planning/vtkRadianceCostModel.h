// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadianceCostModel
 * @brief   what a pixel costs by each way to integrate an environment's light
 *
 * Nanoseconds per covered pixel, linear in the counts: BASE for the pixel itself, and on top of it
 * TABLE for a table of radiance, LIGHT per light, SAMPLE per sample, FUNCTION per pre-integrated
 * function. Defaults are Mesa's llvmpipe on 2 cores (docs/methods.md); vtkRadianceCostCalibrator
 * measures a renderer's own.
 */

#ifndef vtkRadianceCostModel_h
#define vtkRadianceCostModel_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

#include <string> // for Name

class VTKMEASUREDBRDF_EXPORT vtkRadianceCostModel : public vtkObject
{
public:
  static vtkRadianceCostModel* New();
  vtkTypeMacro(vtkRadianceCostModel, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum CostType
  {
    BASE = 0,
    TABLE = 1,
    LIGHT = 2,
    SAMPLE = 3,
    FUNCTION = 4,
    NUMBER_OF_COSTS = 5
  };

  ///@{
  /**
   * A cost in nanoseconds per covered pixel, in [1e-6, 1e6]: others are refused with an error event
   * (SetCost then returns false). GetCost gives 0 for a type that is none.
   */
  bool SetCost(int type, double nanoseconds);
  double GetCost(int type);
  ///@}

  /**
   * "base", "table", "light", "sample", "function"; "" for a type that is none.
   */
  static std::string GetCostName(int type);

  ///@{
  /**
   * The renderer that it is of, one line (default: "Mesa llvmpipe, built in"); only carried along.
   */
  vtkSetMacro(Name, std::string);
  vtkGetMacro(Name, std::string);
  ///@}

  ///@{
  /**
   * The model as lines of text, which SetText reads back bit-exactly. SetText returns false,
   * nothing changed, for anything else; without an error event: files may be damaged.
   */
  std::string GetText();
  bool SetText(const std::string& text);
  ///@}

  /**
   * Take another's costs and name.
   */
  void DeepCopy(vtkRadianceCostModel* source);

protected:
  vtkRadianceCostModel() = default;
  ~vtkRadianceCostModel() override = default;

  double Costs[NUMBER_OF_COSTS] = { 55.0, 52.0, 20.0, 28.0, 12.0 };
  std::string Name = "Mesa llvmpipe, built in";

private:
  vtkRadianceCostModel(const vtkRadianceCostModel&) = delete;
  void operator=(const vtkRadianceCostModel&) = delete;
};

#endif
