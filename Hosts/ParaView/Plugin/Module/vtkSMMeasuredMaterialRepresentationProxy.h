// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMMeasuredMaterialRepresentationProxy
 * @brief   gets the plan from the process that draws
 *
 * Information properties of representations are asked of the client. It has no plan while a server
 * draws.
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
  vtkSMMeasuredMaterialRepresentationProxy();
  ~vtkSMMeasuredMaterialRepresentationProxy() override;

  void UpdatePropertyInformationInternal(vtkSMProperty* property) override;

private:
  vtkSMMeasuredMaterialRepresentationProxy(
    const vtkSMMeasuredMaterialRepresentationProxy&) = delete;
  void operator=(const vtkSMMeasuredMaterialRepresentationProxy&) = delete;
};

#endif
