// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReflectionGuide.h"

#include "HalfVector.h" // for Pi
#include "LobeSampler.h"
#include "LowDiscrepancy.h"
#include "vtkBRDF.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace measuredbrdf
{
namespace
{
constexpr std::uint32_t NumberOfDraws = 64;
constexpr int NumberOfViews = 256; // over theta_o

glm::dvec2 GetPoint(std::uint32_t k)
{
  return glm::dvec2((k + 0.5) / NumberOfDraws, RadicalInverse(k, 2));
}

double GetTheta(int view) { return 0.5 * Pi * (view + 0.5) / NumberOfViews; }
}

ReflectionGuide::ReflectionGuide(vtkBRDF* brdf)
  : BRDF(brdf)
{
  if (!brdf->IsIsotropic())
  {
    return;
  }
  const LobeTable table(brdf);
  std::vector<std::vector<Draw>> views(NumberOfViews);
  vtkSMPTools::For(0, NumberOfViews,
    [&](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType view = first; view < last; ++view)
      {
        const double theta = GetTheta(static_cast<int>(view));
        const LobeSampler sampler(brdf, glm::dvec3(std::sin(theta), 0.0, std::cos(theta)), &table);
        for (std::uint32_t k = 0; k < NumberOfDraws && !sampler.IsBlack(); ++k)
        {
          double density = 0.0;
          const glm::dvec3 i = sampler.Sample(GetPoint(k), density);
          if (i.z > 0.0 && density > 0.0)
          {
            views[static_cast<std::size_t>(view)].push_back({ i, 1.0 / (NumberOfDraws * density) });
          }
        }
      }
    });
  this->Views = std::move(views);
}

void ReflectionGuide::Draws(const glm::dvec3& o, std::vector<Draw>& draws) const
{
  draws.clear();
  if (this->Views.empty())
  {
    for (std::uint32_t k = 0; k < NumberOfDraws; ++k)
    {
      const glm::dvec2 u = GetPoint(k);
      glm::dvec3 i;
      if (this->BRDF->Sample(&o.x, u.x, u.y, &i.x))
      {
        const double density = this->BRDF->Pdf(&i.x, &o.x);
        if (density > 0.0)
        {
          draws.push_back({ i, 1.0 / (NumberOfDraws * density) });
        }
      }
    }
    return;
  }
  const int view = static_cast<int>(std::acos(std::min(o.z, 1.0)) / (0.5 * Pi) * NumberOfViews);
  draws = this->Views[static_cast<std::size_t>(std::clamp(view, 0, NumberOfViews - 1))];
  const double s = std::hypot(o.x, o.y);
  if (s > 0.0)
  {
    for (Draw& draw : draws) // about the normal, to the view's azimuth
    {
      const glm::dvec3 d = draw.Direction;
      draw.Direction.x = (o.x * d.x - o.y * d.y) / s;
      draw.Direction.y = (o.y * d.x + o.x * d.y) / s;
    }
  }
}
} // namespace measuredbrdf
