// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkEnvironmentReader
 * @brief   a light probe in an image file -> vtkEnvironment
 *
 * Formats are OpenEXR, Radiance HDR, PNG, JPEG, TIFF, BMP, PNM and PFM, found by the file's
 * content.
 *
 * Probes are lat-long images, angular maps, mirror balls or cube maps: in one image (crosses,
 * strips), or as six files. vtkEnvironmentProjection says which way each looks and turns them into
 * lat-long images. A file name with %s in it stands for six files, one per face: %s is replaced by
 * px nx py ny pz nz, or posx negx posy negy posz negz, or right left top bottom front back,
 * whichever is there. A file whose name has %s in it is read as one.
 *
 * What the file's header says holds: exposure, orientation, chromaticities (converted to Rec. 709,
 * white to white by the Bradford transform), the display window (black where it has no data), and
 * OpenEXR's envmap attribute, by which cube faces and lat-long images are turned to its axes.
 *
 * Float formats are taken as linear; integer formats (8 and 16 bit) as sRGB-encoded unless the file
 * says it is linear. One-channel images become gray; alpha and further channels are dropped.
 * Lat-long images: any size from 1x1; an aspect other than 2:1 is kept and noted. +infinity, which
 * half floats have for a sun, is taken as the largest half float, or the file's largest value if
 * that is larger. Negative and other non-finite values are set to 0. Both are counted and noted.
 */

#ifndef vtkEnvironmentReader_h
#define vtkEnvironmentReader_h

#include "vtkEnvironment.h"        // for GetEnvironment
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for Environment

#include <string> // for names

class VTKMEASUREDBRDF_EXPORT vtkEnvironmentReader : public vtkObject
{
public:
  static vtkEnvironmentReader* New();
  vtkTypeMacro(vtkEnvironmentReader, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file.
   */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  /// Projection: found out by the aspect ratio.
  static constexpr int AUTOMATIC = -1;

  ///@{
  /**
   * The image's projection: one of vtkEnvironmentProjection's, or AUTOMATIC (default), which takes
   * the file's word where it has OpenEXR's envmap attribute, 4:3 and 3:4 for crosses and 6:1 and
   * 1:6 for strips where the faces have at least 8 texels a side, and everything else for lat-long:
   * of square images, which may be angular maps or mirror balls, a note says so. Not asked for six
   * files. Read refuses images that don't fit.
   */
  virtual void SetProjection(int projection);
  vtkGetMacro(Projection, int);
  ///@}

  ///@{
  /**
   * The layer or part of an OpenEXR file, by its name, such as "ViewLayer.Combined". Empty
   * (default): the one that is named Combined, else the channels R, G and B without a layer's name,
   * else the first layer; where there are several, a note says which were found and taken.
   */
  vtkSetMacro(Layer, std::string);
  vtkGetMacro(Layer, std::string);
  ///@}

  /**
   * Read. Returns whether it worked; if not, an error event and GetErrorMessage name the file and
   * what is wrong, and the environment that was read before stays.
   */
  bool Read();

  /**
   * The last environment that was read without error (a new object at each Read); null before.
   */
  vtkEnvironment* GetEnvironment() { return this->Environment; }

  ///@{
  /**
   * About the last Read.
   */
  vtkGetMacro(ErrorMessage, std::string);
  vtkGetMacro(Notes, std::string);
  ///@}

protected:
  vtkEnvironmentReader() = default;
  ~vtkEnvironmentReader() override = default;

  std::string FileName;
  int Projection = AUTOMATIC;
  std::string Layer;
  std::string ErrorMessage;
  std::string Notes;
  vtkSmartPointer<vtkEnvironment> Environment;

private:
  vtkEnvironmentReader(const vtkEnvironmentReader&) = delete;
  void operator=(const vtkEnvironmentReader&) = delete;
};

#endif
