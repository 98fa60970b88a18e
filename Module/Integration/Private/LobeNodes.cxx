// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeNodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
std::vector<LobeNode> MakeLobeNodes(
  const std::vector<glm::dvec2>& energy, double last, int resolution)
{
  constexpr int Bins = 1024;
  std::vector<double> histogram(Bins, 0.0);
  double total = 0.0;
  for (const glm::dvec2& cell : energy)
  {
    histogram[static_cast<std::size_t>(
      std::clamp(static_cast<int>(cell.x / last * Bins), 0, Bins - 1))] += cell.y;
    total += cell.y;
  }
  // Cells are wider than bins: a few passes of a short filter close the gaps between them.
  for (int pass = 0; pass < 4; ++pass)
  {
    std::vector<double> smooth(Bins);
    for (int k = 0; k < Bins; ++k)
    {
      smooth[static_cast<std::size_t>(k)] =
        0.25 * histogram[static_cast<std::size_t>(std::max(k - 1, 0))] +
        0.5 * histogram[static_cast<std::size_t>(k)] +
        0.25 * histogram[static_cast<std::size_t>(std::min(k + 1, Bins - 1))];
    }
    histogram.swap(smooth);
  }
  std::vector<double> edges;
  const int intervals = std::max(resolution / 2, 1);
  double sum = 0.0;
  for (int k = 0; k < Bins; ++k)
  {
    const double next =
      sum + (total > 0.0 ? 0.5 * histogram[static_cast<std::size_t>(k)] / total : 0.5 / Bins) +
      0.5 / Bins;
    while (static_cast<double>(edges.size()) < next * intervals)
    {
      edges.push_back(
        last * (k + (static_cast<double>(edges.size()) / intervals - sum) / (next - sum)) / Bins);
    }
    sum = next;
  }
  edges.resize(static_cast<std::size_t>(intervals));
  edges.push_back(last);
  std::vector<LobeNode> nodes;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
  {
    const double middle = 0.5 * (edges[k] + edges[k + 1]);
    const double half = 0.5 * (edges[k + 1] - edges[k]);
    nodes.push_back({ middle - half / std::sqrt(3.0), half });
    nodes.push_back({ middle + half / std::sqrt(3.0), half });
  }
  return nodes;
}
} // namespace measuredbrdf
