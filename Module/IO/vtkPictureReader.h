// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPictureReader
 * @brief   a picture in an image file -> vtkImageData, for comparing
 *
 * Formats are OpenEXR, Radiance HDR, PNG, JPEG, TIFF, BMP, PNM and PFM, found by the file's
 * content. What the file's header says holds, as in vtkEnvironmentReader. The picture is as
 * vtkPictureDifference takes it: integers become unsigned char (8 bits) or unsigned short, RGB or
 * RGBA, sRGB-encoded; integers that the file says are linear, and floats, become linear floats.
 * Gray becomes RGB. Row 0 is at the bottom. Colors of integers are not multiplied by alpha; those
 * of OpenEXR are, as stored.
 *
 * vtkEnvironmentReader reads light probes.
 */

#ifndef vtkPictureReader_h
#define vtkPictureReader_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for Picture

#include <string> // for names

class vtkImageData;

class VTKMEASUREDBRDF_EXPORT vtkPictureReader : public vtkObject
{
public:
  static vtkPictureReader* New();
  vtkTypeMacro(vtkPictureReader, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file.
   */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /**
   * Whether a gray image keeps its one component (two with alpha), as weights do, instead of three
   * equal ones (four with alpha), as colors do (default: off).
   */
  vtkSetMacro(KeepsGray, bool);
  vtkGetMacro(KeepsGray, bool);
  vtkBooleanMacro(KeepsGray, bool);
  ///@}

  /**
   * Read. Returns whether it worked; if not, an error event and GetErrorMessage name the file and
   * what is wrong (a value that is not finite, too), and the picture that was read before stays.
   */
  bool Read();

  /**
   * The last picture that was read without error (a new object at each Read); null before.
   */
  vtkImageData* GetPicture();

  ///@{
  /**
   * About the last Read: what was wrong; what was chosen or lost. Empty if nothing.
   */
  vtkGetMacro(ErrorMessage, std::string);
  vtkGetMacro(Notes, std::string);
  ///@}

protected:
  vtkPictureReader();
  ~vtkPictureReader() override;

  std::string FileName;
  bool KeepsGray = false;
  std::string ErrorMessage;
  std::string Notes;
  vtkSmartPointer<vtkImageData> Picture;

private:
  vtkPictureReader(const vtkPictureReader&) = delete;
  void operator=(const vtkPictureReader&) = delete;
};

#endif
