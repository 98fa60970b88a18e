// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkEnvironmentProjection
 * @brief   conversion between light probes in the usual projections and environments
 *
 * A probe is an image of all directions (thesis 3.2.1). Image coordinates (u,v) lie in [0,1]^2, u
 * to the right, v up; row 0 of the pixels is the bottom. Directions are the environment's own (y
 * up; vtkEnvironment). A probe is read as if a camera that looks towards -z, with +x on its right,
 * had made it:
 *
 * - LAT_LONG, the projection of vtkEnvironment: u = atan2(z,x)/(2 pi) + 1/2, v = asin(y)/pi + 1/2.
 * Its middle is +x; forward (-z) is at u = 1/4.
 * - ANGULAR_MAP (Debevec 1998): the disc in the square, X = 2u - 1, Y = 2v - 1, r = |(X,Y)| =
 *   (angle from -z)/pi. Its middle is forward; all of its rim is backward (+z).
 *   dOmega = pi sin(pi r)/r dX dY.
 * - MIRROR_BALL: the distant camera's view of a mirroring ball that fills the disc, r = sin(angle
 *   from +z / 2). Its middle is backward, where the camera stands; all of its rim is forward (-z),
 *   straight behind the ball, of which a photograph shows next to nothing. dOmega = 4 dX dY.
 * - Cubes: six square faces named as OpenGL's: +x -x +y -y +z -z, seen from inside. OpenGL's cubes
 *   are left-handed: face +z is forward (-z here), -z backward; x and y are the same. (VTK's skybox
 *   and image-based lighting follow this since 9.2.) Upright faces have +y up; +y has the
 *   upper edge of +z at its bottom, -y the lower edge of +z at its top.
 *   dOmega = 4 / (1 + a^2 + b^2)^(3/2) ds dt, a = 2s - 1, b = 2t - 1, per face.
 *   Horizontal cross (4 x 3 faces): +y above and -y below the second of -x +z +x -z. Vertical cross
 *   (3 x 4): +y above and -y below the middle of -x +z +x, lowest -z turned upside down. Horizontal
 *   (6 x 1) and vertical strip (1 x 6): +x -x +y -y +z -z from the left or the top, upright.
 *
 * Images are resampled by first-order conservative remapping (Jones 1999): the outline of every new
 * texel is projected into the other image, and the texel gets the light of the area that it covers
 * there, weighted by exact solid angles. A constant image stays constant. Energy is kept whether
 * the image grows or shrinks (to 5e-3 for a single bright texel, 4e-4 for a photograph). Texels
 * whose center lies outside the disc are ignored.
 *
 * Raises vtkCommand::ProgressEvent (call data: double in [0,1]) from the calling thread; an
 * observer may SetAbort(true).
 */

#ifndef vtkEnvironmentProjection_h
#define vtkEnvironmentProjection_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

#include <atomic> // for Abort
#include <string> // for names
#include <vector> // for pixels

class vtkEnvironment;
class vtkImageData;

class VTKMEASUREDBRDF_EXPORT vtkEnvironmentProjection : public vtkObject
{
public:
  static vtkEnvironmentProjection* New();
  vtkTypeMacro(vtkEnvironmentProjection, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ProjectionType
  {
    LAT_LONG = 0,
    ANGULAR_MAP,
    MIRROR_BALL,
    CUBE_HORIZONTAL_CROSS,
    CUBE_VERTICAL_CROSS,
    CUBE_HORIZONTAL_STRIP,
    CUBE_VERTICAL_STRIP,
    NUMBER_OF_PROJECTIONS
  };

  ///@{
  /**
   * The probe's projection; default LAT_LONG. Values that are not a ProjectionType are refused with
   * an error event.
   */
  void SetProjection(int projection);
  vtkGetMacro(Projection, int);
  ///@}

  ///@{
  /**
   * Number of rows of the environment that Convert makes; it has twice as many columns. With 0 (the
   * default) its texels get the mean solid angle of the probe's texels, and lat-long probes keep
   * their size.
   */
  virtual void SetHeight(int height);
  vtkGetMacro(Height, int);
  ///@}

  /**
   * Probe (width x height RGB triples, row 0 at the bottom) -> output's pixels, repaired
   * and counted as vtkEnvironment's. Returns false with an error event, output unchanged, when the
   * size does not fit the projection or the number of values, or when aborted.
   */
  bool Convert(int width, int height, std::vector<float> rgb, vtkEnvironment* output);

  /**
   * Six cube faces of size x size RGB triples each, +x -x +y -y +z -z, row 0 at the bottom (VTK's
   * cube map textures hold the top row first). Projection is not used. Errors are as for Convert.
   */
  bool ConvertFaces(int size, const std::vector<std::vector<float>>& faces, vtkEnvironment* output);

  /**
   * Make a probe of the given size from the environment (without its rotation: in its own frame),
   * float RGB, row 0 at the bottom, 0 outside discs and crosses. The caller owns the new object. It
   * is null, with an error event, when the environment is empty, the size does not fit the
   * projection or is beyond 2^28 texels, or when aborted.
   */
  VTK_NEWINSTANCE vtkImageData* NewProbe(vtkEnvironment* environment, int width, int height);

  ///@{
  /**
   * Number of channel values of the last converted probe that were negative or not finite. Values
   * outside discs and crosses are not counted.
   */
  vtkGetMacro(NumberOfNegativeValues, vtkIdType);
  vtkGetMacro(NumberOfNonFiniteValues, vtkIdType);
  ///@}

  ///@{
  /**
   * Set this from an observer or another thread to stop a running conversion. Each conversion
   * clears it first.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() { return this->Abort; }
  ///@}

  ///@{
  /**
   * A projection's name ("angular map"), empty for an invalid projection; the size that it needs,
   * in words; and whether a size fits.
   */
  static std::string GetProjectionName(int projection);
  static std::string GetExpectedSize(int projection);
  static bool FitsSize(int projection, int width, int height);
  ///@}

  ///@{
  /**
   * Convert image coordinates to a unit direction; returns false and zeros outside discs, crosses
   * and [0,1]^2. Convert a direction of any length to image coordinates; returns false and zeros
   * for zero and non-finite directions. Where the whole rim of a disc is one direction, the result
   * is the rim's rightmost point.
   */
  static bool GetDirection(int projection, double u, double v, double direction[3]);
  static bool GetCoordinates(int projection, const double direction[3], double& u, double& v);
  ///@}

  /**
   * Solid angle per area of the unit square, dOmega/(du dv), in sr; 0 outside discs and crosses.
   */
  static double GetJacobian(int projection, double u, double v);

  /**
   * Exact solid angle that a texel shows, in sr; for texels on a disc's rim, that of the part
   * inside. All texels together: 4 pi.
   */
  static double GetTexelSolidAngle(int projection, int width, int height, int x, int y);

  /**
   * Number of rows of a lat-long image (twice as wide) whose texels have the same mean solid angle;
   * at least 1.
   */
  static int GetLatLongHeight(int projection, int width, int height);

protected:
  vtkEnvironmentProjection() = default;
  ~vtkEnvironmentProjection() override = default;

  int Projection = LAT_LONG;
  int Height = 0;
  vtkIdType NumberOfNegativeValues = 0;
  vtkIdType NumberOfNonFiniteValues = 0;
  std::atomic<bool> Abort{ false };

private:
  vtkEnvironmentProjection(const vtkEnvironmentProjection&) = delete;
  void operator=(const vtkEnvironmentProjection&) = delete;

  void Repair(int projection, int width, int height, std::vector<float>& rgb);
  bool Resample(int sourceProjection, int sourceWidth, int sourceHeight,
    const std::vector<float>& source, int projection, int width, int height,
    std::vector<float>& result);
};

#endif
