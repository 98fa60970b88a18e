// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBTDF
 * @brief   what a material lets through, as its bidirectional transmittance distribution function
 *
 * The BTDF f(i,o) in 1/sr, linear RGB with Rec. 709 primaries, *without* the cosine: the radiance
 * that leaves one side of a surface towards o, per irradiance by light from i on the other side
 * (Nicodemus et al. 1977; Bartell et al. 1981). It is no vtkBRDF: nothing draws it. Readers give it
 * beside the reflection (vtkBRDFReader::GetTransmission).
 *
 * Local frame of every direction, as vtkBRDF's: z = the normal of the side whose reflection stands
 * beside it, the front; x = tangent; i points to the light, o to the viewer.
 *
 * Its values are those of folded BRDFs, one for light on each side: with both directions mirrored
 * to z > 0, what goes through is a function of two upper hemispheres, so that each of the module's
 * representations can hold it. Where one side is missing, it is that of the other side with light
 * and view exchanged (Helmholtz reciprocity: the same medium is on both sides), as in Radiance.
 *
 * The queries may be called from many threads at once as long as no thread changes the object, and
 * after Prepare where it or its values were changed.
 */

#ifndef vtkBTDF_h
#define vtkBTDF_h

#include "vtkBRDF.h"               // for the values
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for the values

class VTKMEASUREDBRDF_EXPORT vtkBTDF : public vtkObject
{
public:
  static vtkBTDF* New();
  vtkTypeMacro(vtkBTDF, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The sides on which light can fall: z > 0, and z < 0.
  enum SideType
  {
    FRONT = 0,
    BACK = 1
  };

  ///@{
  /**
   * The values for light on that side, as a folded BRDF: f(i,o) = folded(i', o'), where ' mirrors a
   * direction to z > 0 where it is not there already. Null (default): by reciprocity, from the
   * other side. Another side is refused with an error event.
   */
  void SetFolded(int side, vtkBRDF* folded);
  vtkBRDF* GetFolded(int side);
  ///@}

  /**
   * Build the data that the values otherwise build on demand (vtkBRDF::Prepare).
   */
  void Prepare();

  /**
   * f(i,o) in 1/sr, RGB. Zero where both directions are on one side or one is at the horizon, and
   * without values. Never negative, NaN or infinite. Vectors of any length.
   */
  void Evaluate(const double i[3], const double o[3], double f[3]);

  ///@{
  /**
   * Directional-hemispherical transmittance, RGB: the share of light from i that leaves the other
   * side, the integral of f(i,o) |cos(theta_o)| do; in [0,1] unless the data break energy
   * conservation. And the same with the roles exchanged: the radiance towards o under a white sky
   * on the other side. Both are equal where data are reciprocal. Exact for vtkAngleBasisBRDF; for
   * others as nearly as vtkBRDF::GetDirectionalAlbedo.
   */
  void GetTransmittance(const double i[3], double rgb[3]);
  void GetSkyTransmittance(const double o[3], double rgb[3]);
  ///@}

  /**
   * Whether f only depends on the difference of the azimuths.
   */
  bool IsIsotropic();

  /**
   * How far both sides differ from reciprocity: integral |f(i,o) - f(o,i)| / integral f(i,o) over
   * light on the front, RGB, with both cosines as weights, estimated with 2^16 pairs. 0 where one
   * side's values are those of the other by reciprocity.
   */
  double GetReciprocityError();

  /**
   * Also when the values last changed.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkBTDF() = default;
  ~vtkBTDF() override = default;

  vtkSmartPointer<vtkBRDF> Folded[2];

private:
  vtkBTDF(const vtkBTDF&) = delete;
  void operator=(const vtkBTDF&) = delete;

  void Integrate(const double direction[3], bool isLight, double rgb[3]);
};

#endif
