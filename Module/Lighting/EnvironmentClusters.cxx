// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentClusters.h"

#include "TexelDirections.h"
#include "vtkEnvironment.h"

#include <algorithm>
#include <cstddef>
#include <queue>

namespace measuredbrdf
{
namespace
{
struct Node
{
  glm::dvec3 Irradiance = glm::dvec3(0.0);
  glm::dvec3 Moment = glm::dvec3(0.0); // sum of direction times weight
  double Weight = 0.0;                 // R + G + B: every channel's error counts

  void Add(const Node& other)
  {
    this->Irradiance += other.Irradiance;
    this->Moment += other.Moment;
    this->Weight += other.Weight;
  }
  // Second moment about the centroid: unit vectors' own is 1.
  double GetSpread() const
  {
    return this->Weight > 0.0
             ? std::max(this->Weight - glm::dot(this->Moment, this->Moment) / this->Weight, 0.0)
             : 0.0;
  }
};

struct Level
{
  int Width;
  int Height;
  std::vector<Node> Nodes;
  const Node& At(int x, int y) const
  {
    return this->Nodes[static_cast<std::size_t>(y) * static_cast<std::size_t>(this->Width) +
                       static_cast<std::size_t>(x)];
  }
};

Level MakeFinest(vtkEnvironment* environment)
{
  Level level{ environment->GetWidth(), environment->GetHeight(), {} };
  const TexelDirections directions(level.Width, level.Height);
  for (int y = 0; y < level.Height; ++y)
  {
    const double solidAngle = environment->GetTexelSolidAngle(y);
    for (int x = 0; x < level.Width; ++x)
    {
      Node node;
      environment->GetPixel(x, y, &node.Irradiance.x);
      node.Irradiance *= solidAngle;
      node.Weight = node.Irradiance.x + node.Irradiance.y + node.Irradiance.z;
      node.Moment = node.Weight * directions.Get(x, y);
      level.Nodes.push_back(node);
    }
  }
  return level;
}

// Halves both sides, rounded up.
Level MakeCoarser(const Level& fine)
{
  Level level{ (fine.Width + 1) / 2, (fine.Height + 1) / 2, {} };
  for (int y = 0; y < level.Height; ++y)
  {
    for (int x = 0; x < level.Width; ++x)
    {
      Node node;
      for (int v = 2 * y; v < std::min(2 * y + 2, fine.Height); ++v)
      {
        for (int u = 2 * x; u < std::min(2 * x + 2, fine.Width); ++u)
        {
          node.Add(fine.At(u, v));
        }
      }
      level.Nodes.push_back(node);
    }
  }
  return level;
}

struct Candidate
{
  double Spread;
  std::size_t Level;
  int X;
  int Y;
  bool operator<(const Candidate& other) const { return this->Spread < other.Spread; }
};
} // namespace

std::vector<EnvironmentCluster> MakeEnvironmentClusters(vtkEnvironment* environment, int count)
{
  std::vector<Level> levels{ MakeFinest(environment) };
  while (levels.back().Width > 1 || levels.back().Height > 1)
  {
    levels.push_back(MakeCoarser(levels.back()));
  }
  std::vector<EnvironmentCluster> clusters;
  const auto emit = [&clusters](const Node& node)
  {
    if (glm::dot(node.Moment, node.Moment) > 0.0)
    {
      clusters.push_back({ glm::normalize(node.Moment), node.Irradiance });
    }
  };
  std::priority_queue<Candidate> queue;
  const auto push = [&](std::size_t level, int x, int y)
  {
    const Node& node = levels[level].At(x, y);
    if (level == 0)
    {
      emit(node);
    }
    else if (node.Weight > 0.0)
    {
      queue.push({ node.GetSpread(), level, x, y });
    }
  };
  push(levels.size() - 1, 0, 0);
  while (!queue.empty() && queue.size() + clusters.size() < static_cast<std::size_t>(count))
  {
    const Candidate top = queue.top();
    queue.pop();
    const Level& fine = levels[top.Level - 1];
    for (int y = 2 * top.Y; y < std::min(2 * top.Y + 2, fine.Height); ++y)
    {
      for (int x = 2 * top.X; x < std::min(2 * top.X + 2, fine.Width); ++x)
      {
        push(top.Level - 1, x, y);
      }
    }
  }
  for (; !queue.empty(); queue.pop())
  {
    emit(levels[queue.top().Level].At(queue.top().X, queue.top().Y));
  }
  return clusters;
}
} // namespace measuredbrdf
