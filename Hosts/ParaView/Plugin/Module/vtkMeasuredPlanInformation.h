// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeasuredPlanInformation
 * @brief   the plan of a vtkMeasuredMaterialRepresentation, from whichever process drew it
 *
 * A client that draws has its own plan; else the first server process that has one tells it.
 */

#ifndef vtkMeasuredPlanInformation_h
#define vtkMeasuredPlanInformation_h

#include "vtkPVInformation.h"
#include "vtkPVMeasuredMaterialsModule.h" // for export macro

#include <string> // for Plan

class VTKPVMEASUREDMATERIALS_EXPORT vtkMeasuredPlanInformation : public vtkPVInformation
{
public:
  static vtkMeasuredPlanInformation* New();
  vtkTypeMacro(vtkMeasuredPlanInformation, vtkPVInformation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * vtkMeasuredMaterialRepresentation::GetPlan; empty where nothing was drawn.
   */
  const char* GetPlan() { return this->Plan.c_str(); }

  ///@{
  /**
   * As vtkPVInformation has them.
   */
  void CopyFromObject(vtkObject* object) override;
  void AddInformation(vtkPVInformation* other) override;
  void CopyToStream(vtkClientServerStream* stream) override;
  void CopyFromStream(const vtkClientServerStream* stream) override;
  ///@}

protected:
  vtkMeasuredPlanInformation();
  ~vtkMeasuredPlanInformation() override;

  std::string Plan;

private:
  vtkMeasuredPlanInformation(const vtkMeasuredPlanInformation&) = delete;
  void operator=(const vtkMeasuredPlanInformation&) = delete;
};

#endif
