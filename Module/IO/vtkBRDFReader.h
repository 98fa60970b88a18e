// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFReader
 * @brief   a material file of any known format -> vtkBRDF
 *
 * The format is told by the file's first bytes, never by its name alone:
 *
 * | format | becomes |
 * |---|---|
 * | MERL `.binary` (Matusik et al. 2003) | vtkTabulatedBRDF, half/difference, half turn |
 * | RGL `.bsdf` tensor file, RGB (Dupuy and Jakob 2018) | vtkAdaptiveWarpBRDF |
 * | NVIDIA `.mbsdf` (MDL specification, appendix B) | vtkTabulatedBRDF, incident/outgoing |
 * | BSDF `.xml` of Radiance and WINDOW | vtkAngleBasisBRDF or vtkTensorTreeBRDF; vtkBTDF |
 * | UTIA `.bin`, OpenMATERIAL 3D `.xompt`, ASTM E1392 `.astm` | vtkAngularTableBRDF |
 * | published fits, text (`name = Aggregate(...)`, as BBM has them) | vtkSumBRDF |
 * | this project's OpenEXR format | what was written |
 *
 * Values are converted to f in 1/sr, linear RGB, without cosine. A file that can't be read gives
 * one error event that names the file, the byte or field and what was expected; the material that
 * was read before stays. Memory is bounded by the file's size: sizes are checked against it before
 * anything is allocated.
 */

#ifndef vtkBRDFReader_h
#define vtkBRDFReader_h

#include "vtkBRDF.h"               // for GetBRDF
#include "vtkBTDF.h"               // for GetTransmission
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for BRDF

#include <string> // for names
#include <vector> // for names

class VTKMEASUREDBRDF_EXPORT vtkBRDFReader : public vtkObject
{
public:
  static vtkBRDFReader* New();
  vtkTypeMacro(vtkBRDFReader, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file. `path#name` picks one material of a file of fits.
   */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  /**
   * Read. Returns whether it worked. Raises ProgressEvent.
   */
  bool Read();

  /**
   * The last material that was read without error; null before.
   */
  vtkBRDF* GetBRDF() { return this->BRDF; }

  /**
   * What the same file says of transmission; null where it says nothing, and before. Of BSDF XML
   * files only: in other files transmission is left out. A file that holds transmission only gives
   * no material: Read fails and GetBRDF stays the earlier file's, but its transmission is here.
   */
  vtkBTDF* GetTransmission() { return this->Transmission; }

  ///@{
  /**
   * About the last Read: empty error message = it worked; the format's name ("MERL binary", "RGL
   * tensor file", ...); notes for people (what was converted, scaled, clamped, repaired); counts of
   * channel values (of RGL files also of densities: what rounding made negative). Message and notes
   * are fit for a terminal whatever the file holds (GetPrintable).
   */
  vtkGetMacro(ErrorMessage, std::string);
  vtkGetMacro(FormatName, std::string);
  vtkGetMacro(Notes, std::string);
  vtkGetMacro(NumberOfNegativeValues, vtkIdType);
  vtkGetMacro(NumberOfInvalidValues, vtkIdType);
  ///@}

  /**
   * The text as a terminal may show it: control characters and bytes that are no UTF-8 as `\xNN`,
   * line ends and tabs as they are. Names and sources of materials are kept as the file has them.
   */
  static std::string GetPrintable(const std::string& text);

  /**
   * Names of the materials in a text of published fits (the file FileName without `#name`); empty
   * where it is not such a file.
   */
  std::vector<std::string> GetMaterialNames();

protected:
  vtkBRDFReader() = default;
  ~vtkBRDFReader() override = default;

  std::string FileName;
  std::string ErrorMessage;
  std::string FormatName;
  std::string Notes;
  vtkIdType NumberOfNegativeValues = 0;
  vtkIdType NumberOfInvalidValues = 0;
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkBTDF> Transmission;

private:
  vtkBRDFReader(const vtkBRDFReader&) = delete;
  void operator=(const vtkBRDFReader&) = delete;
};

#endif
