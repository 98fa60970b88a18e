// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPhotographSet
 * @brief   photographs of a flat sample, each under one light and from one view
 *
 * The discrete bidirectional texture function (Dana et al. 1999): all photographs are rectified, so
 * that a pixel shows the same place of the sample in each of them. Light and camera are far away.
 * The sample's frame is that of vtkBRDF: x to the right of the pictures, y up, z the normal.
 *
 * A pixel's linear value is Exposure Irradiance f(i,o) cos(theta_i): the light's irradiance falls
 * on a surface that faces it. With the default irradiance, pi, a perfect white diffuse surface
 * below the light has the value Exposure.
 *
 * Pictures are of one size and of 1, 3 or 4 components; the fourth is ignored. Unsigned integers
 * are shares of their type's largest value.
 *
 * Subclasses make their pictures when they are asked for (NewPicture): files are read one at a
 * time, so that thousands of photographs need no memory.
 */

#ifndef vtkPhotographSet_h
#define vtkPhotographSet_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for pictures

#include <string> // for names
#include <vector> // for photographs

class vtkImageData;

class VTKMEASUREDBRDF_EXPORT vtkPhotographSet : public vtkObject
{
public:
  static vtkPhotographSet* New();
  vtkTypeMacro(vtkPhotographSet, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum TransferType
  {
    AUTOMATIC = 0, // integers by sRGB's curve, floats are linear
    LINEAR = 1,
    SRGB = 2,
    POWER = 3 // value = stored^Gamma
  };

  /// Most photographs of a set.
  static constexpr int MaximumNumberOfPhotographs = 1 << 20;

  ///@{
  /**
   * Add a photograph. light and view: directions to the light and to the camera, of any length,
   * above the horizon (z > 0); exposure: finite and > 0. name: what messages call it. The picture
   * is shared, not copied. Returns its number, -1 after an error event.
   */
  int AddPhotograph(vtkImageData* picture, const double light[3], const double view[3],
    double exposure, const std::string& name);
  int AddPhotograph(
    vtkImageData* picture, const double light[3], const double view[3], double exposure)
  {
    return this->AddPhotograph(picture, light, view, exposure, "");
  }
  int AddPhotograph(vtkImageData* picture, const double light[3], const double view[3])
  {
    return this->AddPhotograph(picture, light, view, 1.0, "");
  }
  ///@}

  virtual void RemoveAllPhotographs();
  int GetNumberOfPhotographs() { return static_cast<int>(this->Photographs.size()); }

  ///@{
  /**
   * About a photograph: unit directions; zeros or "" where there is none of that number.
   */
  void GetLight(int index, double light[3]);
  void GetView(int index, double view[3]);
  double GetExposure(int index);
  std::string GetName(int index);
  ///@}

  /**
   * What a pixel's linear value is where f is 1 in 1/sr: exposure times irradiance times
   * cos(theta_i). 0 where there is no such photograph.
   */
  double GetScale(int index);

  /**
   * A photograph's picture; the caller owns it. Null with an error event where there is none.
   */
  VTK_NEWINSTANCE virtual vtkImageData* NewPicture(int index);

  ///@{
  /**
   * Irradiance of a surface that faces the light; default pi. Finite and > 0, else refused.
   */
  virtual void SetIrradiance(double irradiance);
  vtkGetMacro(Irradiance, double);
  ///@}

  ///@{
  /**
   * How stored values become linear ones; default AUTOMATIC. Gamma, in [0.1, 10], default 2.2, is
   * for POWER.
   */
  virtual void SetTransfer(int transfer);
  vtkGetMacro(Transfer, int);
  virtual void SetGamma(double gamma);
  vtkGetMacro(Gamma, double);
  ///@}

  ///@{
  /**
   * Stored values (shares of the largest for integers) that say nothing: a pixel with a channel at
   * or above SaturationLevel (default 1) is saturated, one whose channels are all at or below
   * BlackLevel (default 0) is black. They hold for floats only where LevelsForFloats is on (default
   * off). Values that are not finite are never used.
   */
  virtual void SetSaturationLevel(double level);
  vtkGetMacro(SaturationLevel, double);
  virtual void SetBlackLevel(double level);
  vtkGetMacro(BlackLevel, double);
  vtkSetMacro(LevelsForFloats, bool);
  vtkGetMacro(LevelsForFloats, bool);
  vtkBooleanMacro(LevelsForFloats, bool);
  ///@}

  /**
   * What is wrong with a direction or an exposure, for error messages; "" if nothing. what: its
   * name.
   */
  static std::string FindDirectionProblem(const double direction[3], const std::string& what);
  static std::string FindExposureProblem(double exposure);

  /// The unit direction of a polar angle and an azimuth in degrees.
  static void GetDirection(double theta, double phi, double direction[3]);

protected:
  vtkPhotographSet();
  ~vtkPhotographSet() override;

  struct Photograph
  {
    vtkSmartPointer<vtkImageData> Picture; // null: made when asked for
    double Light[3] = { 0.0, 0.0, 0.0 };
    double View[3] = { 0.0, 0.0, 0.0 };
    double Exposure = 1.0;
    std::string Name;
  };
  const Photograph& Get(int index) const; // an empty one where there is none
  int Insert(Photograph photograph);      // checked and normalized

  std::vector<Photograph> Photographs;
  double Irradiance = 3.14159265358979323846;
  int Transfer = AUTOMATIC;
  double Gamma = 2.2;
  double SaturationLevel = 1.0;
  double BlackLevel = 0.0;
  bool LevelsForFloats = false;

private:
  vtkPhotographSet(const vtkPhotographSet&) = delete;
  void operator=(const vtkPhotographSet&) = delete;
};

#endif
