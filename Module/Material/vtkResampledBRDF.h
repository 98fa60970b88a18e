// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkResampledBRDF
 * @brief   abstract class of BRDFs without a GLSL form, which are resampled for graphics cards
 *
 * GetRenderable() is a vtkTabulatedBRDF, of anisotropic materials with the half vector's azimuth,
 * whose error is within ResamplingTolerance, or the best of some sizes and a warning. It is made
 * again where the data or the tolerance have changed. NewQuickRenderable() gives the same if it is
 * made, else a new table of a fixed, coarse size, and waits for no thread that makes the other.
 */

#ifndef vtkResampledBRDF_h
#define vtkResampledBRDF_h

#include "vtkBRDF.h"

#include <memory> // for tables

class VTKMEASUREDBRDF_EXPORT vtkResampledBRDF : public vtkBRDF
{
public:
  vtkAbstractTypeMacro(vtkResampledBRDF, vtkBRDF);

  vtkBRDF* GetRenderable() override;
  bool IsRenderable() override { return false; }
  VTK_NEWINSTANCE vtkBRDF* NewQuickRenderable() override;
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override;

protected:
  vtkResampledBRDF();
  ~vtkResampledBRDF() override;

  ///@{
  /**
   * For changed data: what was made is forgotten. For NewCopy: in another thread, too, a copy
   * shares what either makes; each keeps what it has handed out while its tolerance stays.
   */
  void ResetRenderable();
  void ShareRenderable(vtkResampledBRDF* original);
  ///@}

private:
  vtkResampledBRDF(const vtkResampledBRDF&) = delete;
  void operator=(const vtkResampledBRDF&) = delete;

  struct Made
  {
    vtkSmartPointer<vtkBRDF> Table;
    double Tolerance = 0.0;
  };
  struct Shared;
  bool HasRenderable();
  std::shared_ptr<Shared> Common;
  Made Own;
};

#endif
