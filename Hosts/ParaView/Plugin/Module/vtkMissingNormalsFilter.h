// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMissingNormalsFilter
 * @brief   gives surfaces without point normals some, and passes all others
 *
 * Edges that are sharper than the feature angle stay sharp (vtkPolyDataNormals). Surfaces that have
 * point normals are passed as they are. Cell normals do not count: ParaView makes some for all flat
 * cells.
 */

#ifndef vtkMissingNormalsFilter_h
#define vtkMissingNormalsFilter_h

#include "vtkPVMeasuredMaterialsModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

class VTKPVMEASUREDMATERIALS_EXPORT vtkMissingNormalsFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkMissingNormalsFilter* New();
  vtkTypeMacro(vtkMissingNormalsFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Whether to do anything (default on).
   */
  vtkSetMacro(Enabled, bool);
  vtkGetMacro(Enabled, bool);
  ///@}

  ///@{
  /**
   * In degrees, default 30, in [0, 180].
   */
  vtkSetClampMacro(FeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(FeatureAngle, double);
  ///@}

protected:
  vtkMissingNormalsFilter() = default;
  ~vtkMissingNormalsFilter() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  bool Enabled = true;
  double FeatureAngle = 30.0;

private:
  vtkMissingNormalsFilter(const vtkMissingNormalsFilter&) = delete;
  void operator=(const vtkMissingNormalsFilter&) = delete;
};

#endif
