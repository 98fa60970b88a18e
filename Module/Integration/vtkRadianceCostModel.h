// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadianceCostModel
 * @brief   what a pixel costs by each way to integrate an environment's light
 *
 * Nanoseconds per covered pixel, linear in the counts: "base" for the pixel itself, and on top of
 * it "table" for a table of radiance, "light" per light, "sample" per sample, "function" per
 * pre-integrated function, "map" per map of a table's sharp part. Methods of a program's own may
 * have costs under other names (vtkRadianceIntegrator::GetCostName). Defaults are Mesa's llvmpipe
 * on 2 cores (docs/methods/planner.md); vtkRadianceCostCalibrator measures a renderer's own.
 */

#ifndef vtkRadianceCostModel_h
#define vtkRadianceCostModel_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

#include <string>  // for names
#include <utility> // for costs
#include <vector>  // for costs

class VTKMEASUREDBRDF_EXPORT vtkRadianceCostModel : public vtkObject
{
public:
  static vtkRadianceCostModel* New();
  vtkTypeMacro(vtkRadianceCostModel, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A cost in nanoseconds per covered pixel, in [1e-6, 1e6]. SetCost adds a name that is new: up to
   * 32 lower case letters, digits and hyphens. It returns false with an error event for any other
   * name or cost. GetCost gives `unknown` for a name that the model does not have.
   */
  bool SetCost(const std::string& name, double nanoseconds);
  double GetCost(const std::string& name, double unknown = 0.0);
  ///@}

  ///@{
  /**
   * The names in the model; index in [0, GetNumberOfCosts()), "" for others. The six above come
   * first and are always there.
   */
  int GetNumberOfCosts();
  std::string GetCostName(int index);
  ///@}

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

  std::vector<std::pair<std::string, double>> Costs = { { "base", 55.0 }, { "table", 52.0 },
    { "light", 20.0 }, { "sample", 28.0 }, { "function", 12.0 }, { "map", 7.0 } };
  std::string Name = "Mesa llvmpipe, built in";

private:
  vtkRadianceCostModel(const vtkRadianceCostModel&) = delete;
  void operator=(const vtkRadianceCostModel&) = delete;
};

#endif
