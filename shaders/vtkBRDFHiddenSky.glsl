// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What of the sky is hidden from a point, for the vertex shader. C++ twin (tests):
// Testing/Unit/Support/HorizonLight.h.

// Three bytes of a code, which one float holds.
vec3 brdfSkyBytes(float three)
{
  float high = floor(three * (1.0 / 65536.0));
  three -= high * 65536.0;
  float middle = floor(three * (1.0 / 256.0));
  return vec3(three - middle * 256.0, middle, high);
}

vec3 brdfSkyNormal(vec3 bytes)
{
  float high = floor(bytes.y * (1.0 / 16.0));
  vec2 cell = vec2(bytes.x + 256.0 * (bytes.y - 16.0 * high), high + 16.0 * bytes.z);
  vec3 n = vec3((2.0 * cell + 1.0) * (1.0 / 4096.0) - 1.0, 0.0);
  n.z = 1.0 - abs(n.x) - abs(n.y);
  if (n.z < 0.0)
  {
    n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  }
  return normalize(n);
}

// Frame about unit n, columns tangent, bitangent, normal (Duff et al. 2017).
mat3 brdfSkyFrame(vec3 n)
{
  float s = n.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + n.z);
  float b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// What a lobe's exponent grows by in the model's axes, times log2(e): turned, not stretched. normal
// and across: unit, across towards the viewer.
vec3 brdfSkySlope(vec2 lobe, mat3 toModel, vec3 normal, vec3 across)
{
  vec3 slope = lobe.y * normal - lobe.x * across;
  vec3 turned = toModel * slope;
  return turned * (1.442695041 * length(slope) / max(length(turned), 1e-12));
}

// Six elevations of a sector, nearly in the middles of even steps of the sine: their cosines are
// 0.3948 + 0.0301 (20, 19, 17, 14, 9, 0), so that two exponentials make all six (HorizonLight.h), and
// their reciprocals those of the opposite sector.
const vec3 brdfSkySine0 = vec3(0.07993597437950033, 0.2559123091998511, 0.4222058147396838);
const vec3 brdfSkySine1 = vec3(0.5777694695983857, 0.7462194784378119, 0.9187670869159387);

// What the nodes of all sectors have in common: cosine times exp2(slope.z sine - kappa).
void brdfSkyRise(float slope, float kappa, out vec3 low, out vec3 high)
{
  low = vec3(1.0, 3.0, 5.0) / 12.0 * exp2(slope * brdfSkySine0 - kappa);
  high = vec3(7.0, 9.0, 11.0) / 12.0 * exp2(slope * brdfSkySine1 - kappa);
}

// Add a sector's share of a lobe cos(theta) exp2(slope . d - kappa) to sum: within bounds, all. one,
// last: exp2 of the slope in the sector's azimuth, times a step of the nodes' cosines and the last
// one.
void brdfSkySector(float one, float last, vec2 bounds, vec3 rise0, vec3 rise1, inout vec2 sum)
{
  float two = one * one;
  float three = two * one;
  float five = three * two;
  vec3 low, high;
  high.z = last;
  high.y = high.z * (five * two * two);
  high.x = high.y * five;
  low.z = high.x * three;
  low.y = low.z * two;
  low.x = low.y * one;
  low *= rise0;
  high *= rise1;
  // What of each step is within the bounds.
  const vec3 below = vec3(0.0, 42.5, 85.0);
  const vec3 above = vec3(127.5, 170.0, 212.5);
  vec3 first = max(min(vec3(bounds.y), below + 42.5) - max(vec3(bounds.x), below), 0.0);
  vec3 second = max(min(vec3(bounds.y), above + 42.5) - max(vec3(bounds.x), above), 0.0);
  sum += vec2(dot(low, first) + dot(high, second), dot(low + high, vec3(42.5)));
}

// Add a sector and the opposite one; across: the slope in the first one's azimuth.
void brdfSkySectors(
  float across, vec2 bounds, vec2 opposite, vec3 rise0, vec3 rise1, inout vec2 sum)
{
  float one = exp2(0.0301 * across);
  float last = exp2(0.3948 * across);
  brdfSkySector(one, last, bounds, rise0, rise1, sum);
  brdfSkySector(1.0 / one, 1.0 / last, opposite, rise0, rise1, sum);
}

// Nearly tangents of elevation of a sector's bounds, which are interpolated between sectors, and
// back.
vec2 brdfSkyTangents(vec2 bounds)
{
  return bounds * inversesqrt(65025.0 - 0.96 * bounds * bounds);
}

vec2 brdfSkySines(vec2 tangents)
{
  return tangents * inversesqrt(1.0 + 0.96 * tangents * tangents);
}

// Add a sector's tangents to sum, by how near it is to an azimuth (unit).
void brdfSkyLampSector(vec2 along, vec2 tangents, vec2 azimuth, inout vec3 sum)
{
  float weight = max(dot(along, azimuth) - 0.9238795325112867, 0.0);
  sum += weight * vec3(tangents, 1.0);
}

// Of a lamp with this sine of elevation: how far it is outside of the bounds, in widths of an edge.
float brdfSkyLampMargin(vec3 sum, float sine)
{
  vec2 bounds = brdfSkySines(sum.xy / max(sum.z, 1e-6));
  float below = bounds.x > 0.5 / 255.0 ? (bounds.x - sine) / 0.04 : -3.0;
  float above = bounds.y < 254.5 / 255.0 ? (sine - bounds.y) / 0.04 : -3.0;
  return bounds.y > bounds.x ? clamp(max(below, above), -3.0, 3.0) : 3.0;
}

// Where a panel is, in the code's frame: azimuth (unit), the cosine of azimuths that are too far
// from it, below -1 where none is, and how much more than a sector it covers: 0 to 1.
vec4 brdfSkyPanelAzimuth(vec3 d, float radius)
{
  float sine = max(length(d.xy), 1e-6);
  float width = max(max(radius, 0.04) / max(sine, 1e-3), 0.39269908169872414);
  return vec4(d.xy / sine,
    cos(min(width, 3.14159265358979)) - max(width - 3.14159265358979, 0.0),
    1.0 - 0.39269908169872414 / width);
}

// The irradiance from a uniform sky within a sector's bounds.
float brdfSkySquare(vec2 bounds)
{
  return (bounds.y * bounds.y - bounds.x * bounds.x) * (1.0 / (16.0 * 255.0 * 255.0));
}

// Where a panel begins and ends above the horizon, in the sine of elevation. rise: by how much a
// lobe moves it.
vec2 brdfSkyPanelEnds(float z, float radius, float rise)
{
  float extent = max(radius * sqrt(max(1.0 - z * z, 0.0)), 0.03);
  float low = max(z + rise - extent, 0.0);
  return vec2(low, max(min(z + rise + extent, 1.0), low));
}

// Add a sector's tangents to sum, what of a panel's irradiance is within its bounds, and its weight.
void brdfSkyPanelSector(
  vec2 along, vec2 bounds, vec2 tangents, vec3 azimuth, vec2 ends, inout vec4 sum)
{
  float weight = max(dot(along, azimuth.xy) - azimuth.z, 0.0);
  vec2 part = clamp(bounds * (1.0 / 255.0), ends.x, ends.y);
  sum += weight * vec4(tangents, part.y * part.y - part.x * part.x, 1.0);
}

// The edge of what is hidden in the azimuth of a panel, the one nearer to its middle (sine z), moved
// by what of the panel lies beyond the other one: below it, 0 to 0.5 (half of its sine), or above
// it, 0.5 to 1. wide: as brdfSkyPanelAzimuth has it. opening: whether bounds are of what is visible.
float brdfSkyPanelEdge(vec4 sum, float z, vec2 ends, float wide, bool opening)
{
  float weight = max(sum.w, 1e-6);
  float bottom = ends.x * ends.x;
  float all = ends.y * ends.y - bottom;
  float top = sqrt(bottom + clamp(sum.z / weight, 0.0, all));
  vec2 bounds = mix(brdfSkySines(sum.xy / weight), vec2(ends.x, top), wide);
  bool isRoof = bounds.x > 0.5 / 255.0 &&
    (bounds.y > 254.5 / 255.0 || z < 0.5 * (bounds.x + bounds.y));
  vec2 squares = bounds * bounds;
  float edge = sqrt(isRoof ? squares.x + max(ends.y * ends.y - squares.y, 0.0)
                           : squares.y - max(squares.x - bottom, 0.0));
  float inside = bounds.y > bounds.x ? (isRoof ? 0.5 + 0.5 * edge : 0.5 * edge) : 0.0;
  return opening ? (inside < 0.5 ? inside + 0.5 : inside - 0.5) : inside;
}

// Hidden share of a panel.
float brdfSkyPanelHidden(float edge, vec2 ends)
{
  float low = clamp(2.0 * edge - 1.0, ends.x, ends.y);
  float high = edge < 0.5 ? clamp(2.0 * edge, ends.x, ends.y) : ends.y;
  return (high * high - low * low) / max(ends.y * ends.y - ends.x * ends.x, 1e-6);
}

// A panel of this radius (radians) whose middle has sine z of elevation: its mean max(z, 0).
float brdfSkyPanelRise(float z, float radius)
{
  float rise = max(z + radius, 0.0);
  return z > radius ? z : rise * rise / (4.0 * radius);
}

// The mean of exp2(slope . d - kappa) over a panel about unit d. rises: the normal's component of d
// and of the slope; seen: the radius of the product (OcclusionLight.cxx), and how much higher than d
// its middle is.
float brdfSkyPanelInLobe(
  vec3 d, float concentration, vec3 slope, float kappa, vec2 rises, out vec2 seen)
{
  float own = concentration * 1.442695041;
  float both = max(length(slope + own * d), 1e-3);
  seen = vec2(1.201122 * inversesqrt(both), (rises.y + own * rises.x) / both - rises.x);
  return own / both * exp2(both - own - kappa);
}

// How much of a lamp's light a table holds, by its distance from the lobe's axis, both unit
// (vtkBRDFEnvironmentLamps.glsl, LampWindow): 0 at the axis, 1 where the window ends. reach: 2 / the
// squared distance of that.
float brdfSkyLampInTable(vec3 lamp, vec3 axis, float reach)
{
  float x = min(reach * (1.0 - dot(lamp, axis)), 1.0);
  float root = 1.0 - x * x;
  return 1.0 - root * root;
}

// A lamp's radiance in a lobe cos(theta) exp2(slope . d - kappa) of this integral, over its
// irradiance.
float brdfSkyLampInLobe(vec3 lamp, vec3 normal, vec3 slope, float kappa, float integral)
{
  return max(dot(lamp, normal), 0.0) * exp2(dot(slope, lamp) - kappa) / integral;
}

// Odds of the hidden irradiance over those of a uniform sky (cosine: its hidden share), as a
// logarithm of base 2, within +-5.65: how much brighter than the rest the hidden sky is.
vec3 brdfSkyContrast(vec3 hidden, vec3 irradiance, float cosine)
{
  vec3 part = clamp(hidden / max(irradiance, vec3(1e-30)), 0.0, 0.999);
  vec3 odds = part * (1.0 - cosine) / max((1.0 - part) * cosine, vec3(1e-6));
  return log2(clamp(odds, 1.0 / 50.0, 50.0));
}

// Hidden share of a lobe's light: odds of the lobe's hidden share, times that contrast where the
// lobe is wide.
vec3 brdfSkyLobe(float share, float kappa, vec3 contrast)
{
  vec3 factor = exp2(contrast * (12.0 / (12.0 + kappa)));
  return share * factor / max(share * factor + max(1.0 - share, 0.0), vec3(1e-12));
}

// Add a panel's light in a lobe, and what is hidden of it. shine: the lobe's mean over the panel.
void brdfSkyAddPanel(vec3 light, float hidden, float shine, inout vec3 all, inout vec3 lost)
{
  all += light * shine;
  lost += hidden * light * shine;
}

// Hidden shares as what is interpolated between points: the logarithm (of base 2) of their odds,
// within +-8.963. Inverse: OcclusionShader's.
vec3 brdfSkyOdds(vec3 hidden)
{
  vec3 share = 0.002 + 0.996 * clamp(hidden, 0.0, 1.0);
  return log2(share / (1.0 - share));
}

// Irradiance about n: a quadratic form for each channel (Ramamoorthi, Hanrahan 2001, eq. 11).
vec3 brdfSkyIrradiance(mat4 red, mat4 green, mat4 blue, vec3 n)
{
  vec4 v = vec4(n, 1.0);
  return max(vec3(dot(v, red * v), dot(v, green * v), dot(v, blue * v)), vec3(0.0));
}
