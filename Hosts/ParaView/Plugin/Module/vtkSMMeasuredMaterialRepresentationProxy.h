// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMMeasuredMaterialRepresentationProxy
 * @brief   gets the plan from the process that draws
 *
 * Information properties of representations are asked of the client. While a server draws, the plan
 * is that of its first process.
 */

#ifndef vtkSMMeasuredMaterialRepresentationProxy_h
#define vtkSMMeasuredMaterialRepresentationProxy_h

#include "vtkPVMeasuredMaterialsModule.h" // for export macro
#include "vtkSMRepresentationProxy.h"

class VTKPVMEASUREDMATERIALS_EXPORT vtkSMMeasuredMaterialRepresentationProxy
  : public vtkSMRepresentationProxy
{
public:
  static vtkSMMeasuredMaterialRepresentationProxy* New();
  vtkTypeMacro(vtkSMMeasuredMaterialRepresentationProxy, vtkSMRepresentationProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSMMeasuredMaterialRepresentationProxy() = default;
  ~vtkSMMeasuredMaterialRepresentationProxy() override = default;

  void UpdatePropertyInformationInternal(vtkSMProperty* property) override;

private:
  vtkSMMeasuredMaterialRepresentationProxy(
    const vtkSMMeasuredMaterialRepresentationProxy&) = delete;
  void operator=(const vtkSMMeasuredMaterialRepresentationProxy&) = delete;
};

#endif
