// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFWriter
 * @brief   vtkBRDF -> file: MERL `.binary` or this project's OpenEXR format, by extension
 *
 * `.binary`: tables over half and difference angles with phi_d over half a turn and no cosine
 * weight only (resample others with vtkBRDFResampler, Reciprocal on, first), written with their own
 * sizes; MERL's programs expect 90 x 90 x 180. Reading it back gives the same floats, invalid cells
 * stay invalid. Tables with negative valid values are refused: the format marks invalid cells by
 * them.
 *
 * `.exr`: any material. Parts hold the tables as 32-bit floats, the header a JSON text with
 * representation, sizes and parameters; reading it back is bit-exact. With HalfFloats the tables
 * are rounded to 16-bit floats (relative 2^-11; values beyond 65504 are refused): a third of the
 * bytes.
 *
 * The file is written beside its place and renamed when it is whole: a failed write leaves an old
 * file as it was.
 */

#ifndef vtkBRDFWriter_h
#define vtkBRDFWriter_h

#include "vtkBRDF.h"               // for BRDF
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for BRDF

#include <string> // for names

class VTKMEASUREDBRDF_EXPORT vtkBRDFWriter : public vtkObject
{
public:
  static vtkBRDFWriter* New();
  vtkTypeMacro(vtkBRDFWriter, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file, ending in .binary or .exr.
   */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /**
   * The material.
   */
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF() { return this->BRDF; }
  ///@}

  ///@{
  /**
   * Tables of `.exr` as 16-bit instead of 32-bit floats; default off.
   */
  vtkSetMacro(HalfFloats, bool);
  vtkGetMacro(HalfFloats, bool);
  vtkBooleanMacro(HalfFloats, bool);
  ///@}

  /**
   * Write. Returns whether it worked; if not, an error event and GetErrorMessage say why.
   */
  bool Write();
  vtkGetMacro(ErrorMessage, std::string);

protected:
  vtkBRDFWriter() = default;
  ~vtkBRDFWriter() override = default;

  std::string FileName;
  bool HalfFloats = false;
  std::string ErrorMessage;
  vtkSmartPointer<vtkBRDF> BRDF;

private:
  vtkBRDFWriter(const vtkBRDFWriter&) = delete;
  void operator=(const vtkBRDFWriter&) = delete;
};

#endif
