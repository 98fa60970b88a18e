// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Pre-integrated basis: sum_k U_k(o) E_k(n), every texel of the environment in each E_k. C++ twin:
// vtkBasisRadianceIntegrator.
uniform sampler2D brdfMapsINSTANCE;  // E_k: one row of tiles a function, charts n.z >= 0 and < 0
uniform sampler2D brdfViewsINSTANCE; // a row a term: (m, kind, 0), then U over theta_o

vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)
{
  vec3 n = frame[2];
  // Azimuth of the view in the frame that the maps were made with.
  vec3 d = (frame * o) * brdfFrameAbout(n);
  float l = length(d.xy);
  vec2 turn = l > 1e-6 ? d.xy / l : vec2(1.0, 0.0);

  // Equal-area charts, a border of one texel beyond their rim.
  vec2 mapSize = vec2(textureSize(brdfMapsINSTANCE, 0));
  float side = 0.5 * mapSize.x;
  vec2 p = n.xy * (inversesqrt(1.0 + abs(n.z)) * (0.5 - 1.0 / side)) + 0.5;
  vec2 u = vec2(0.5 * (p.x + (n.z >= 0.0 ? 0.0 : 1.0)), p.y * side / mapSize.y);
  float tile = side / mapSize.y;

  // cos(theta_o) = 0.02 + 0.98 cos^2(alpha/2); one texel for (m, kind), one mirrored at alpha = 0.
  vec2 viewSize = vec2(textureSize(brdfViewsINSTANCE, 0));
  float x = clamp((o.z - 0.02) / 0.98, 0.0, 1.0);
  float t = brdfQuadrant(sqrt(1.0 - x), sqrt(x));
  vec2 s = vec2((t * (viewSize.x - 2.0) + 2.0) / viewSize.x, 0.5 / viewSize.y);

  vec3 sum = vec3(0.0);
  vec3 even = vec3(0.0);
  vec3 odd = vec3(0.0);
  vec2 angle = vec2(1.0, 0.0); // cosine and sine of m phi
  float m = 0.0;
  int rows = int(viewSize.y);
  for (int row = 0; row < rows; ++row)
  {
    vec2 head = texelFetch(brdfViewsINSTANCE, ivec2(0, row), 0).xy;
    for (; m < head.x; m += 1.0)
    {
      angle = vec2(angle.x * turn.x - angle.y * turn.y, angle.x * turn.y + angle.y * turn.x);
    }
    vec3 view = texture(brdfViewsINSTANCE, s).rgb;
    s.y += 1.0 / viewSize.y;
    if (head.y > 0.5)
    {
      sum += view * odd; // the sine part of the row before
    }
    else
    {
      even = texture(brdfMapsINSTANCE, u).rgb;
      u.y += tile;
      if (head.x > 0.5)
      {
        vec3 sine = texture(brdfMapsINSTANCE, u).rgb;
        u.y += tile;
        odd = sine * angle.x - even * angle.y;
        even = even * angle.x + sine * angle.y;
      }
      sum += view * even;
    }
  }
  return max(sum, vec3(0.0));
}
