// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeSplit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
double GetSum(const glm::dvec3& rgb) { return rgb.x + rgb.y + rgb.z; }
}

LobeSplit::LobeSplit(vtkBRDF* brdf, double solidAngle)
  : LobeSplit(LobeViews(brdf), solidAngle)
{
}

LobeSplit::LobeSplit(const LobeViews& views, double solidAngle)
{
  std::size_t known = 0; // the last view that has cells
  for (const LobeViews::View& view : views.GetViews())
  {
    this->Views.push_back({ view.Means.Floor, 0.0, 0.0 });
    if (view.Cells.empty())
    {
      continue;
    }
    double energy = 0.0;
    for (const LobeViews::Cell& cell : view.Cells)
    {
      energy += cell.Energy;
    }
    View& cut = this->Views.back();
    cut.Height = energy / solidAngle;
    double above = 0.0;
    for (const LobeViews::Cell& cell : view.Cells)
    {
      above += std::max(cell.Energy - cut.Height * cell.SolidAngle, 0.0);
    }
    cut.Share = view.Means.Albedo > 0.0 ? above / view.Means.Albedo : 0.0;
    this->SharpShare = std::max(this->SharpShare, cut.Share);
    const std::size_t last = this->Views.size() - 1;
    for (std::size_t k = known + 1; k < last; ++k)
    {
      const double t = static_cast<double>(k - known) / static_cast<double>(last - known);
      this->Views[k].Height = glm::mix(this->Views[known].Height, cut.Height, t);
      this->Views[k].Share = glm::mix(this->Views[known].Share, cut.Share, t);
    }
    known = last;
  }
}

LobeSplit::View LobeSplit::GetView(const glm::dvec3& o) const
{
  const double at = LobeViews::GetPosition(std::atan2(std::hypot(o.x, o.y), o.z));
  const int low = std::clamp(static_cast<int>(at), 0, LobeViews::NumberOfViews - 2);
  const double t = std::min(at - low, 1.0);
  const View& a = this->Views[static_cast<std::size_t>(low)];
  const View& b = this->Views[static_cast<std::size_t>(low) + 1];
  return { glm::mix(a.Floor, b.Floor, t), glm::mix(a.Height, b.Height, t),
    glm::mix(a.Share, b.Share, t) };
}

glm::dvec3 LobeSplit::View::GetBroad(const glm::dvec3& f, double cosine) const
{
  const glm::dvec3 floor = glm::min(this->Floor, f);
  const double rest = GetSum(f - floor) * cosine;
  return rest > this->Height ? floor + (f - floor) * (this->Height / rest) : f;
}
} // namespace measuredbrdf
