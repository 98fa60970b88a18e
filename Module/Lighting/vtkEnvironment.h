// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkEnvironment
 * @brief   distant lighting: a lat-long image of linear RGB radiance
 *
 * As in VTK's image-based lighting, a unit direction d in the environment's frame (y up) has
 * u = atan2(d.z, d.x)/(2 pi) + 1/2, v = asin(d.y)/pi + 1/2. Row 0 of the pixels is at the bottom,
 * v = 0; texel centers lie at (k + 1/2)/N. Between them radiance is bilinear in (u,v), as textures
 * and other renderers have it: u goes on around the seam, v stops at the outer rows' centers.
 *
 * On the way in, +infinity becomes the largest half float, or the largest value if that is larger;
 * negative and other non-finite values become 0. All of these are counted.
 */

#ifndef vtkEnvironment_h
#define vtkEnvironment_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for Subdivided

#include <memory> // for pixels
#include <string> // for Name
#include <vector> // for pixels

class vtkImageData;

class VTKMEASUREDBRDF_EXPORT vtkEnvironment : public vtkObject
{
public:
  static vtkEnvironment* New();
  vtkTypeMacro(vtkEnvironment, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The environment's name, such as a file's name. It has no effect on the light.
   */
  vtkSetMacro(Name, std::string);
  vtkGetMacro(Name, std::string);
  ///@}

  /**
   * Copy a lat-long image: point scalars of any type with 1 (gray), 3 or 4 components (alpha is
   * dropped), one slice, row 0 at the bottom. Integer types are scaled by their maximum. Pass true
   * for sRGB if the values are sRGB-encoded: they are then made linear. Returns false with an error
   * event and keeps the old pixels when the image does not fit this description.
   */
  bool SetImage(vtkImageData* image, bool sRGB = false);

  /**
   * Set width x height RGB triples, row 0 at the bottom. Returns false when sizes do not match.
   */
  bool SetPixels(int width, int height, std::vector<float> rgb);

  ///@{
  /**
   * Built-in environments that need no file because they are computed: a sky with a sun (256 x
   * 128), and a dark hall with bright windows and lamps (512 x 256).
   */
  void SetToProceduralSky();
  void SetToProceduralHall();
  ///@}

  ///@{
  /**
   * Size in texels (0 x 0 before anything is set) and values, RGB per texel, row 0 at the bottom.
   * GetPixel gives 0 outside.
   */
  vtkGetMacro(Width, int);
  vtkGetMacro(Height, int);
  const std::vector<float>& GetPixels() const { return *this->Pixels; }
  void GetPixel(int x, int y, double rgb[3]);
  ///@}

  ///@{
  /**
   * Number of channel values that were negative or not finite in the pixels that were set last.
   */
  vtkGetMacro(NumberOfNegativeValues, vtkIdType);
  vtkGetMacro(NumberOfNonFiniteValues, vtkIdType);
  ///@}

  ///@{
  /**
   * Direction of a texel's center, or of any (u,v) in [0,1]^2, in the environment's frame; and the
   * (u,v) of a direction.
   */
  void GetTexelDirection(int x, int y, double direction[3]);
  static void GetDirection(double u, double v, double direction[3]);
  static void GetCoordinates(const double direction[3], double& u, double& v);
  ///@}

  /**
   * Exact solid angle of a texel of row y, in sr; all texels together: 4 pi.
   */
  double GetTexelSolidAngle(int y);

  /**
   * The environment to use for sums over texels. It is this environment if it has at least 128 x 64
   * texels. Otherwise it is one of 256 x 128 or more, interpolated from this one's texels. Texels
   * that small stand for the sky between them: a sum over their centers has an error of at most
   * 3e-4 of a white map's irradiance, whichever way the surface faces. The result has no rotation.
   * Integrators and light set generators call this themselves.
   */
  vtkEnvironment* GetSubdivided() { return this->Subdivided ? this->Subdivided.Get() : this; }

  /**
   * Radiance that comes from a direction (environment frame).
   */
  void GetRadiance(const double direction[3], double rgb[3]);

  /**
   * Integral of the radiance over the sphere, RGB, summed over GetSubdivided: light sets' total.
   */
  void GetTotal(double rgb[3]);

  /**
   * Luminance of linear Rec. 709 RGB: .2126 R + .7152 G + .0722 B.
   */
  static double GetLuminance(const double rgb[3]);

  ///@{
  /**
   * Rotation from world directions to environment directions, given by its rows; default identity.
   * A matrix that is not orthonormal to 1e-6 is refused with an error event. SetRotationY rotates
   * the environment by an angle in degrees about +y (world), counterclockwise seen from above.
   */
  void SetWorldToEnvironment(const double matrix[9]);
  void GetWorldToEnvironment(double matrix[9]);
  void SetRotationY(double degrees);
  ///@}

  /**
   * Time of the last change of the pixels. GetMTime also includes rotations, after which light sets
   * need not be computed anew.
   */
  vtkMTimeType GetPixelsMTime() { return this->PixelsTime.GetMTime(); }

  /**
   * The pixels as float RGB image data, row 0 at the bottom. The caller owns the new object.
   */
  VTK_NEWINSTANCE vtkImageData* NewImageData();

  /**
   * A copy that another thread may use while this thread changes the original. It takes no memory:
   * both share the pixels until one of them gets new pixels. The caller has to release the copy.
   */
  VTK_NEWINSTANCE vtkEnvironment* NewSnapshot();

#ifndef __VTK_WRAP__
  /**
   * For integrators: data that depends on these pixels alone, computed once for all integrators and
   * all snapshots.
   */
  struct TexelChanges; // some texels with other values
  struct Precomputation;
  Precomputation& GetParts() { return *this->Parts; }
#endif

protected:
  vtkEnvironment();
  ~vtkEnvironment() override;

  std::string Name;
  int Width = 0;
  int Height = 0;
  std::shared_ptr<const std::vector<float>> Pixels; // replaced, never changed: snapshots share them
  std::shared_ptr<Precomputation> Parts;            // of these pixels
  vtkIdType NumberOfNegativeValues = 0;
  vtkIdType NumberOfNonFiniteValues = 0;
  double WorldToEnvironment[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  vtkTimeStamp PixelsTime;

private:
  /// Set pixels that were cleaned, and the numbers of values that were not valid before.
  void Adopt(
    int width, int height, std::vector<float> rgb, vtkIdType negative, vtkIdType notFinite);

  /// Where nothing is computed yet. Defined beside Precomputation, which uses environments.
  static std::shared_ptr<Precomputation> MakeParts();

  /// Make Subdivided from the pixels.
  void Subdivide();

  vtkSmartPointer<vtkEnvironment> Subdivided; // null: the texels are small enough

  vtkEnvironment(const vtkEnvironment&) = delete;
  void operator=(const vtkEnvironment&) = delete;
};

#endif
