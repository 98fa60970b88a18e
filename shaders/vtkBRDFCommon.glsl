// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Directions in the local frame: z = normal, x = tangent, i to the light, o to the viewer.
// C++ twins: LocalFrame.h, HalfVector.h, LobePlacement.h.

const float brdfPi = 3.14159265358979;

// Frame about unit n, columns tangent, bitangent, normal (Duff et al. 2017).
mat3 brdfFrameAbout(vec3 n)
{
  float s = n.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + n.z);
  float b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// The same with the tangent along t's part perpendicular to n.
mat3 brdfFrameAbout(vec3 n, vec3 t)
{
  vec3 p = t - n * dot(n, t);
  float l = length(p);
  if (l > 1e-6 && l < 1e30) // not so where it is NaN
  {
    return mat3(p / l, cross(n, p / l), n);
  }
  return brdfFrameAbout(n);
}

// Interpolated normals can turn away from the viewer: shade those as if just above the horizon.
vec3 brdfLiftView(vec3 o)
{
  const float minimum = 0.02;
  if (o.z >= minimum)
  {
    return o;
  }
  float l = length(o.xy);
  float s = sqrt(1.0 - minimum * minimum);
  return l > 1e-12 ? vec3(o.xy * (s / l), minimum) : vec3(s, 0.0, minimum);
}

vec3 brdfHalfVector(vec3 i, vec3 o)
{
  vec3 h = i + o;
  float l = length(h);
  return l > 1e-6 ? h / l : vec3(0.0, 0.0, 1.0);
}

// ln(1 - s) / s: cos^n theta = exp(n/2 s brdfLogCosineRatio(s)) with s = sin^2 theta. The series
// keeps the digits that 1 - s loses near the normal.
float brdfLogCosineRatio(float s)
{
  if (s < 0.04)
  {
    return -(1.0 + s * (0.5 + s * (1.0 / 3.0 + s * (0.25 + s * (0.2 + s / 6.0)))));
  }
  return log(1.0 - min(s, 0.9999999)) / s;
}

// Variance in h of light of the given spread (1/kappa), seen from o.h = c; and the exponent of a lobe
// that it widens.
float brdfHalfVectorSpread(float spread, float c)
{
  return spread / (4.0 * max(c, 1e-2));
}

float brdfWidenedExponent(float n, float variance)
{
  return n / (1.0 + n * variance);
}

float brdfSchlickFifth(float c)
{
  float m = clamp(1.0 - c, 0.0, 1.0);
  float m2 = m * m;
  return m2 * m2 * m;
}

// Unpolarized Fresnel reflectance of a dielectric (Cook, Torrance 1982).
float brdfDielectricFresnel(float eta, float c)
{
  float g = sqrt(max(eta * eta + c * c - 1.0, 0.0));
  float a = (g - c) / (g + c);
  float b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return 0.5 * a * a * (1.0 + b * b);
}

// atan(y/x) in right angles, for x, y >= 0; relative error 7e-7 (minimax fit). Tables want angles in
// these units, and the general atan costs several times as much.
float brdfQuadrant(float y, float x)
{
  float r = min(x, y) / max(max(x, y), 1e-30);
  float s = r * r;
  float a = r * (0.636619357 + s * (-0.212163183 + s * (0.126569445 + s * (-0.0858621121 +
    s * (0.0533940294 + s * (-0.0235631824 + s * 0.0050059724))))));
  return y > x ? 1.0 - a : a;
}

// Azimuth of v in turns, in (-1/2, 1/2].
float brdfTurn(vec2 v)
{
  float q = brdfQuadrant(abs(v.y), abs(v.x));
  q = v.x >= 0.0 ? q : 2.0 - q;
  return 0.25 * (v.y >= 0.0 ? q : -q);
}

// Azimuth in turns and polar angle in half turns of unit d about the environment's y, and the
// directions in which they grow.
vec2 brdfMapPosition(vec3 d, out vec3 meridian, out vec3 parallel)
{
  float s = length(d.zx);
  vec2 azimuth = s > 1e-7 ? d.zx / s : vec2(1.0, 0.0);
  meridian = vec3(azimuth.y * d.y, -s, azimuth.x * d.y);
  parallel = vec3(azimuth.x, 0.0, -azimuth.y);
  float polar = brdfQuadrant(s, abs(d.y));
  return vec2(brdfTurn(azimuth), 0.5 * (d.y >= 0.0 ? polar : 2.0 - polar));
}

// Unit d in the unit square: the octahedron about the environment's y, its lower half folded out
// (Engelhardt, Dachsbacher 2008). No angles: a third of the time of the above.
vec2 brdfOctahedralPosition(vec3 d)
{
  vec2 p = d.zx / (abs(d.x) + abs(d.y) + abs(d.z));
  vec2 side = vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return 0.5 + 0.5 * (d.y < 0.0 ? side * (1.0 - abs(p.yx)) : p);
}

// Rusinkiewicz 1998 in table coordinates: phi_d in turns, theta_d in right angles, the square root
// of theta_h in right angles. |i - o| / |i + o| = tan theta_d.
vec3 brdfHalfDifference(vec3 i, vec3 o)
{
  vec3 h = brdfHalfVector(i, o);
  float s = length(h.xy);
  vec2 p = s > 1e-7 ? h.xy / s : vec2(1.0, 0.0);
  vec2 d = vec2(h.z * dot(p, i.xy) - s * i.z, p.x * i.y - p.y * i.x);
  return vec3(brdfTurn(d), brdfQuadrant(length(i - o), length(i + o)), sqrt(brdfQuadrant(s, h.z)));
}

// Values of valid cells are premultiplied by their validity (alpha): the quotient skips the rest.
// Textures without alpha read 1 there.
vec3 brdfUnpremultiply(vec4 v)
{
  return v.a > 1e-4 ? max(v.rgb / v.a, vec3(0.0)) : vec3(0.0);
}

// A texel of an sRGB texture, which the graphics card has made linear, as the display color that
// multiplies encoded radiance: (L t)^(1/2.2) = L^(1/2.2) t^(1/2.2).
vec4 brdfDisplayTexel(sampler2D image, vec2 place)
{
  vec4 texel = texture(image, place);
  return vec4(pow(max(texel.rgb, vec3(0.0)), vec3(1.0 / 2.2)), texel.a);
}
