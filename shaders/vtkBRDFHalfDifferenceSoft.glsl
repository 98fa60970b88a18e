// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The same table for soft lights, at growing widths along theta_h; after vtkBRDFHalfDifference. C++
// twin: vtkTabulatedBRDF::EvaluateSoftAbove.
uniform sampler3D brdfLevelsINSTANCE; // levels 1, 2, ... stacked along theta_h; 0 is brdfVolume
uniform float brdfNumberOfLevelsINSTANCE;
uniform float brdfFirstCountINSTANCE;  // samples of level 1 along theta_h; halved after each four
uniform float brdfOwnVarianceINSTANCE; // of the table's lobe: the levels' unit

vec4 brdfLevelINSTANCE(int level, vec3 u)
{
  if (level == 0)
  {
    return texture(brdfVolumeINSTANCE, u);
  }
  int firstCount = int(brdfFirstCountINSTANCE);
  int count = firstCount >> ((level - 1) / 4);
  int offset = 8 * (firstCount - count) + (level - 1) % 4 * count;
  float slice = float(offset) + clamp(u.z * float(count), 0.5, float(count) - 0.5);
  vec3 at = vec3(u.xy, slice / float(textureSize(brdfLevelsINSTANCE, 0).z));
  return texture(brdfLevelsINSTANCE, at);
}

vec3 brdfTermSoftINSTANCE(vec3 i, vec3 o, float spread)
{
  vec3 u = brdfHalfDifference(i, o);
  u.x *= brdfTurnsINSTANCE;
  float variance = brdfHalfVectorSpread(spread, dot(brdfHalfVector(i, o), o));
  float level = min(log2(1.0 + variance / brdfOwnVarianceINSTANCE), brdfNumberOfLevelsINSTANCE);
  int first = int(min(level, brdfNumberOfLevelsINSTANCE - 1.0));
  vec4 value =
    mix(brdfLevelINSTANCE(first, u), brdfLevelINSTANCE(first + 1, u), level - float(first));
  return brdfUnpremultiply(value) *
    (brdfScaleINSTANCE / mix(1.0, o.z, brdfCosineWeightedINSTANCE));
}
