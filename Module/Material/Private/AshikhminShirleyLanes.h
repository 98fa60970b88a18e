// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * vtkAshikhminShirleyBRDF's f of many lights and one view, in single precision, one light beside
 * the other. Private to the module.
 */

#ifndef AshikhminShirleyLanes_h
#define AshikhminShirleyLanes_h

#include "WideVectors.h"

namespace measuredbrdf
{
/// The model's parameters as its formula uses them.
struct AshikhminShirleyLanes
{
  static constexpr int Most = 64; // a multiple of every vector's width

  float Exponents[2]; // along and across the tangent
  float Specular[3];  // scale times the lobe's peak
  float Fresnel[3];   // reflectance of the normal, as Schlick's formula has it
  float Index;        // of a dielectric, in place of Fresnel; 0: none
  float Diffuse[3];   // all factors but those of the cosines

  /// f of any number of lights; lights: x, y and z of unit vectors above the horizon; f: red, green
  /// and blue. form: one that the processor has.
  void EvaluateMany(int count, const float* const lights[3], const double view[3],
    float* const f[3], VectorForm form = GetWidestForm()) const;

private:
  struct Steps;
  template <typename Vector>
  void EvaluateAll(
    Steps& steps, int whole, const float view[3], void (*takeRoots)(float*, int)) const;
  void EvaluateWide(Steps& steps, int whole, const float view[3]) const;
};
} // namespace measuredbrdf

#endif
