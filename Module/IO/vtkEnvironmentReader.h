// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkEnvironmentReader
 * @brief   a light probe in an image file -> vtkEnvironment
 *
 * Formats are OpenEXR, Radiance HDR, PNG, JPEG, TIFF, BMP, PNM and PFM, found by the file's
 * content.
 *
 * Probes (thesis 3.2.1) are lat-long images, angular maps, mirror balls or cube maps: in one image
 * (crosses, strips), or as six files. All but lat-long images are resampled to such, by solid
 * angle. A file name with %s in it stands for six files, one per face: %s is replaced by
 * px nx py ny pz nz, or posx negx posy negy posz negz, or right left top bottom front back,
 * whichever is there. A file whose name has %s in it is read as one.
 *
 * A probe is read as if a camera that looks towards -z, with +x on its right and +y up, had made
 * it. Image coordinates (u,v) lie in [0,1]^2, u to the right, v up:
 *
 * - LAT_LONG: u = atan2(z,x)/(2 pi) + 1/2, v = asin(y)/pi + 1/2. The middle is +x; forward (-z) is
 *   at u = 1/4.
 * - ANGULAR_MAP (Debevec 1998): the disc in the square, X = 2u - 1, Y = 2v - 1, r = |(X,Y)| =
 *   (angle from -z)/pi. Its middle is forward; all of its rim is backward (+z).
 * - MIRROR_BALL: the distant camera's view of a mirroring ball that fills the disc, r = sin(angle
 *   from +z / 2). Its middle is backward, where the camera stands; all of its rim is forward (-z),
 *   straight behind the ball, of which a photograph shows next to nothing.
 * - Cubes: six square faces named as OpenGL's: +x -x +y -y +z -z, seen from inside. OpenGL's cubes
 *   are left-handed: face +z is forward (-z here), -z backward; x and y are the same. (VTK's skybox
 *   and image-based lighting follow this since 9.2.) Upright faces have +y up; +y has the
 *   upper edge of +z at its bottom, -y the lower edge of +z at its top.
 *   Horizontal cross (4 x 3 faces): +y above and -y below the second of -x +z +x -z. Vertical cross
 *   (3 x 4): +y above and -y below the middle of -x +z +x, lowest -z turned upside down. Horizontal
 *   (6 x 1) and vertical strip (1 x 6): +x -x +y -y +z -z from the left or the top, upright.
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

  enum ProjectionType
  {
    AUTOMATIC = -1, // found out by the aspect ratio
    LAT_LONG = 0,
    ANGULAR_MAP,
    MIRROR_BALL,
    CUBE_HORIZONTAL_CROSS,
    CUBE_VERTICAL_CROSS,
    CUBE_HORIZONTAL_STRIP,
    CUBE_VERTICAL_STRIP
  };

  ///@{
  /**
   * The image's projection, or AUTOMATIC (default), which takes
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
