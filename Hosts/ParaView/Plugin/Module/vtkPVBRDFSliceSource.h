// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVBRDFSliceSource
 * @brief   vtkBRDFSliceSource whose material is named, as ParaView's panels do it
 */

#ifndef vtkPVBRDFSliceSource_h
#define vtkPVBRDFSliceSource_h

#include "vtkBRDFSliceSource.h"
#include "vtkPVMeasuredMaterialsModule.h" // for export macro

#include <string> // for names

class VTKPVMEASUREDMATERIALS_EXPORT vtkPVBRDFSliceSource : public vtkBRDFSliceSource
{
public:
  static vtkPVBRDFSliceSource* New();
  vtkTypeMacro(vtkPVBRDFSliceSource, vtkBRDFSliceSource);
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
