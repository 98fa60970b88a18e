// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVBRDFLobeSource
 * @brief   vtkBRDFLobeSource whose material is named, as ParaView's panels do it
 */

#ifndef vtkPVBRDFLobeSource_h
#define vtkPVBRDFLobeSource_h

#include "vtkBRDFLobeSource.h"
#include "vtkPVMeasuredMaterialsModule.h" // for export macro

#include <string> // for names

class VTKPVMEASUREDMATERIALS_EXPORT vtkPVBRDFLobeSource : public vtkBRDFLobeSource
{
public:
  static vtkPVBRDFLobeSource* New();
  vtkTypeMacro(vtkPVBRDFLobeSource, vtkBRDFLobeSource);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A name of vtkEmbeddedMaterials, or "File" (default "gold-paint"), and the file. What cannot be
   * read gives an error and an empty output.
   */
  vtkSetStdStringFromCharMacro(Material);
  vtkSetStdStringFromCharMacro(MaterialFile);
  ///@}

protected:
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  std::string Material = "gold-paint";
  std::string MaterialFile;
};

#endif
