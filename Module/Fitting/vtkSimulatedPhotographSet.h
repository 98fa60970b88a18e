// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSimulatedPhotographSet
 * @brief   simulates photographs of a flat sample whose materials are known
 *
 * A texel's linear value is the photograph's scale times sum of w_k f_k(i,o), with the materials
 * and weight images of a vtkMaterialMap (mode TEXTURES); each f_k is evaluated exactly, not from
 * tables. The pictures have the size of the first weight image; other images of weights must have
 * that size. Light and view are the same everywhere on the sample: both are far away. There is no
 * relief, so no shadow, and no light from one place of the sample to another. Places without a
 * material (weights that are all 0) are black.
 *
 * Noise is Gaussian with a standard deviation of Noise, in linear values (1: full scale). With
 * Bits, values are clipped to [0, 1], rounded, and stored as unsigned short; Transfer is LINEAR.
 * The same Seed gives the same pictures, in whatever order they are asked for.
 */

#ifndef vtkSimulatedPhotographSet_h
#define vtkSimulatedPhotographSet_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkPhotographSet.h"
#include "vtkSmartPointer.h" // for the map

class vtkMaterialMap;

class VTKMEASUREDBRDF_EXPORT vtkSimulatedPhotographSet : public vtkPhotographSet
{
public:
  static vtkSimulatedPhotographSet* New();
  vtkTypeMacro(vtkSimulatedPhotographSet, vtkPhotographSet);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The sample. It is shared, not copied.
   */
  void SetMaterialMap(vtkMaterialMap* map);
  vtkMaterialMap* GetMaterialMap();
  ///@}

  ///@{
  /**
   * Take a photograph with this light, view and exposure; see AddPhotograph. An exposure of 0: the
   * one with which the brightest material, where it is alone, has the value 0.9. Returns its
   * number, -1 after an error event.
   */
  int AddDirections(const double light[3], const double view[3], double exposure);
  int AddDirections(const double light[3], const double view[3])
  {
    return this->AddDirections(light, view, 1.0);
  }
  ///@}

  /**
   * Add pairs of the Bonn database's 81 x 81 directions (GetBonnDirection): count of them, spread
   * evenly over all pairs by a fixed stride, at most 6561. Returns how many were added.
   */
  int AddBonnDirections(int count, double exposure);

  /**
   * Add count pairs spread over half and difference angles, dense about the mirror direction, none
   * of them beyond 80 degrees: sharp lobes are seen, which 15 degrees between directions miss. The
   * same count gives the same pairs. Returns how many were added.
   */
  int AddHalfVectorDirections(int count, double exposure);

  ///@{
  /**
   * Standard deviation of the noise, finite and >= 0; default 0. Bits of a pixel, 1 to 16; 0
   * (default): floats. Other values are refused.
   */
  virtual void SetNoise(double noise);
  vtkGetMacro(Noise, double);
  virtual void SetBits(int bits);
  vtkGetMacro(Bits, int);
  ///@}

  ///@{
  /**
   * Seed of the noise; default 1.
   */
  vtkSetMacro(Seed, unsigned int);
  vtkGetMacro(Seed, unsigned int);
  ///@}

  /**
   * Take the photograph; the caller owns the picture. Null with an error event where the map has no
   * weight image or they differ in size.
   */
  VTK_NEWINSTANCE vtkImageData* NewPicture(int index) override;

protected:
  vtkSimulatedPhotographSet();
  ~vtkSimulatedPhotographSet() override;

  vtkSmartPointer<vtkMaterialMap> MaterialMap;
  double Noise = 0.0;
  int Bits = 0;
  unsigned int Seed = 1;

private:
  vtkSimulatedPhotographSet(const vtkSimulatedPhotographSet&) = delete;
  void operator=(const vtkSimulatedPhotographSet&) = delete;

  double GetBrightest(const Photograph& photograph); // f times cosine of the brightest material
};

#endif
