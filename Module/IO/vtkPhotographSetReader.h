// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPhotographSetReader
 * @brief   photographs of a flat sample, from a list or a folder of image files
 *
 * FileName is one of:
 *
 * - a list in JSON: `{"photographs": [{"file": "a.exr", "light": {"theta": 15, "phi": 30}, "view":
 *   [0, 0, 1], "exposure": 1}, ...]}`. Directions are angles in degrees or vectors; exposure is 1
 *   where it is left out. Beside the array may stand irradiance, transfer ("automatic", "linear",
 *   "srgb", "power"), gamma, saturation, black and levels_for_floats (vtkPhotographSet), and a
 *   comment.
 * - a folder of files named by the convention of the Bonn and UTIA databases, such as "00000 tl015
 *   pl030 tv045 pv060.jpg" or "tl015_pl030_tv045_pv060.exr": polar angle and azimuth of light and
 *   view. Its folders are looked into, too. Other files are ignored and counted.
 *
 * Files of a list are relative to its folder. Images are of vtkPictureReader's formats. They are
 * read when a picture is asked for, one at a time, and again each time.
 */

#ifndef vtkPhotographSetReader_h
#define vtkPhotographSetReader_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for Photographs

#include <string> // for names

class vtkPhotographSet;

class VTKMEASUREDBRDF_EXPORT vtkPhotographSetReader : public vtkObject
{
public:
  static vtkPhotographSetReader* New();
  vtkTypeMacro(vtkPhotographSetReader, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The list or folder.
   */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  /**
   * Read the list, or the files' names, and check that all files are there. Returns whether it
   * worked; if not, an error event and GetErrorMessage name the file, the entry and what is wrong,
   * and the photographs that were read before stay.
   */
  bool Read();

  /**
   * The photographs, a new object at each Read; null before.
   */
  vtkPhotographSet* GetPhotographs();

  /**
   * Files of a folder whose names say no directions.
   */
  vtkGetMacro(NumberOfIgnoredFiles, vtkIdType);

  /**
   * What was wrong in the last Read; empty if nothing.
   */
  vtkGetMacro(ErrorMessage, std::string);

protected:
  vtkPhotographSetReader();
  ~vtkPhotographSetReader() override;

  std::string FileName;
  std::string ErrorMessage;
  vtkIdType NumberOfIgnoredFiles = 0;
  vtkSmartPointer<vtkPhotographSet> Photographs;

private:
  vtkPhotographSetReader(const vtkPhotographSetReader&) = delete;
  void operator=(const vtkPhotographSetReader&) = delete;
};

#endif
