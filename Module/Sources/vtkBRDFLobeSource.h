// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFLobeSource
 * @brief   the lobe that a BRDF reflects of light from one direction, as polydata
 *
 * Each point lies in a direction o of the upper hemisphere, as far from the origin as much light is
 * reflected into o: the surface's normal is z, its tangent x. With light from theta_i, phi_i, point
 * data are
 *
 * | array | components | |
 * |---|---|---|
 * | BRDF | 3 | f(i,o) in 1/sr, linear RGB |
 * | Radiance | 3 | f(i,o) cos(theta_i): radiance per irradiance perpendicular to the light |
 * | Luminance | 1, the active scalars | that radiance's luminance (Rec. 709) |
 * | Direction | 3 | the unit vector o |
 *
 * Points lie on half circles from the mirror direction to the horizon, close together near the
 * mirror direction, where lobes are sharp. The surface is closed: f is 0 at the horizon. Without a
 * BRDF the output is empty, with an error event.
 *
 * With a vtkBTDF the lobe of what goes through follows, as a second closed surface of as many
 * points below the first: point k there lies in the direction of point k mirrored at the surface,
 * close together where light goes straight on. All arrays hold what is transmitted there, on one
 * scale with the reflection; a further array Transmitted (1 component) is 1 there, else 0.
 */

#ifndef vtkBRDFLobeSource_h
#define vtkBRDFLobeSource_h

#include "vtkBRDF.h"               // for BRDF
#include "vtkBTDF.h"               // for Transmission
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for BRDF

class VTKMEASUREDBRDF_EXPORT vtkBRDFLobeSource : public vtkPolyDataAlgorithm
{
public:
  static vtkBRDFLobeSource* New();
  vtkTypeMacro(vtkBRDFLobeSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material; null by default.
   */
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF() { return this->BRDF; }
  ///@}

  ///@{
  /**
   * What the material lets through of light on its front; null, the default: nothing is shown.
   */
  void SetTransmission(vtkBTDF* transmission);
  vtkBTDF* GetTransmission() { return this->Transmission; }
  ///@}

  ///@{
  /**
   * Where the light comes from: its angle from the normal in degrees (default 45, clamped to
   * [0, 89.9]) and its azimuth from the tangent in degrees (default 180, clamped to [-360, 360]):
   * the mirror direction then has azimuth 0.
   */
  virtual void SetThetaI(double degrees);
  vtkGetMacro(ThetaI, double);
  virtual void SetPhiI(double degrees);
  vtkGetMacro(PhiI, double);
  ///@}

  ///@{
  /**
   * Points from the mirror direction to the horizon (default 128, clamped to [2, 2048]) and around
   * the mirror direction (default 128, clamped to [3, 2048]).
   */
  virtual void SetRadialResolution(int count);
  vtkGetMacro(RadialResolution, int);
  virtual void SetCircularResolution(int count);
  vtkGetMacro(CircularResolution, int);
  ///@}

  enum ScalingType
  {
    LINEAR = 0,
    LOGARITHMIC = 1
  };

  ///@{
  /**
   * How a point's distance follows from its luminance L: ScaleFactor L (LINEAR, default), or
   * ScaleFactor ln(1 + 100 L) (LOGARITHMIC), which shows the matte part beside a highlight that is
   * a thousand times as bright.
   */
  virtual void SetScaling(int scaling);
  vtkGetMacro(Scaling, int);
  void SetScalingToLinear() { this->SetScaling(LINEAR); }
  void SetScalingToLogarithmic() { this->SetScaling(LOGARITHMIC); }
  ///@}

  ///@{
  /**
   * The factor above; default 1, clamped to [1e-6, 1e6].
   */
  virtual void SetScaleFactor(double factor);
  vtkGetMacro(ScaleFactor, double);
  ///@}

  ///@{
  /**
   * Whether ScaleFactor is the distance of the farthest point instead (default off). Lobes of
   * different materials then have one size.
   */
  vtkSetMacro(Normalize, bool);
  vtkGetMacro(Normalize, bool);
  vtkBooleanMacro(Normalize, bool);
  ///@}

  /**
   * Also when the material last changed.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkBRDFLobeSource();
  ~vtkBRDFLobeSource() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkBTDF> Transmission;
  double ThetaI = 45.0;
  double PhiI = 180.0;
  int RadialResolution = 128;
  int CircularResolution = 128;
  int Scaling = LINEAR;
  double ScaleFactor = 1.0;
  bool Normalize = false;

private:
  void Fill(vtkPolyData* output);

  vtkBRDFLobeSource(const vtkBRDFLobeSource&) = delete;
  void operator=(const vtkBRDFLobeSource&) = delete;
};

#endif
