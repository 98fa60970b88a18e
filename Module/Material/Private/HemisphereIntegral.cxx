// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HemisphereIntegral.h"

#include "HalfVector.h"
#include "RetroLobe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
using Function = std::function<glm::dvec3(const glm::dvec3&)>;

constexpr int FirstLevel = 5; // 32 x 32 squares of 16 points
constexpr int LastLevel = 18; // 0.0004 degrees a side
constexpr std::size_t MostSquares = 1 << 16;
constexpr std::size_t MostSquaresOfPeaks = 1 << 13;
// Of a square's error, where its quarters agree by chance.
constexpr double InheritedError = 0.125;
// Of the spread of a first square's quarters: a straight edge, as of a tree's cell, near a square's
// middle lies between the same points of the square and of its quarters, which agree then.
constexpr double UnseenEdge = 0.2;

double GetBrightness(const glm::dvec3& f) { return f.x + f.y + f.z; }

// Over a square, of 2^level along a side of all, by Gauss's rule of 2 x 2 points.
glm::dvec3 Sum(const Function& f, int level, int x, int y)
{
  constexpr double offset = 0.28867513459481287; // 1 / sqrt(12)
  const double side = std::ldexp(2.0, -level);
  glm::dvec3 sum(0.0);
  for (int k = 0; k < 4; ++k)
  {
    const double a = (x + 0.5 + (k % 2 == 0 ? -offset : offset)) * side - 1.0;
    const double b = (y + 0.5 + (k / 2 == 0 ? -offset : offset)) * side - 1.0;
    const glm::dvec2 p = SquareToDisc({ a, b });
    sum += f(glm::dvec3(p, std::sqrt(std::max(1.0 - glm::dot(p, p), 0.0))));
  }
  return sum * (Pi / 16.0 * side * side); // a quarter of its part of the disc
}

struct Square
{
  Square(const Function& f, int level, int x, int y)
    : Level(level)
    , X(x)
    , Y(y)
  {
    for (int k = 0; k < 4; ++k)
    {
      this->Quarters[k] = Sum(f, level + 1, 2 * x + k % 2, 2 * y + k / 2);
    }
  }

  glm::dvec3 GetValue() const
  {
    return (this->Quarters[0] + this->Quarters[1]) + (this->Quarters[2] + this->Quarters[3]);
  }

  int Level;
  int X;
  int Y;
  glm::dvec3 Quarters[4];
  glm::dvec3 Error = glm::dvec3(0.0);
};

Square MakeFirst(const Function& f, int x, int y)
{
  Square square(f, FirstLevel, x, y);
  const glm::dvec3 value = square.GetValue();
  square.Error = glm::abs(Sum(f, FirstLevel, x, y) - value);
  for (const glm::dvec3& quarter : square.Quarters)
  {
    square.Error = glm::max(square.Error, UnseenEdge * glm::abs(quarter - 0.25 * value));
  }
  return square;
}

Square MakeQuarter(const Function& f, const Square& whole, int k)
{
  Square quarter(f, whole.Level + 1, 2 * whole.X + k % 2, 2 * whole.Y + k / 2);
  quarter.Error =
    glm::max(InheritedError * whole.Error, glm::abs(quarter.GetValue() - whole.Quarters[k]));
  return quarter;
}

// A place of the unit square, and f there.
struct Peak
{
  glm::dvec2 At;
  double Brightness;
};

// Divides a square about the peaks in it until their quarters show what f is there.
void AddDivided(const Function& f, const Square& square, const std::vector<Peak>& peaks,
  std::vector<Square>& squares)
{
  const int side = 2 << square.Level;
  std::vector<Peak> inside[4];
  bool isHidden = false;
  for (const Peak& peak : peaks)
  {
    const glm::ivec2 at = glm::min(glm::ivec2(peak.At * double(side)), side - 1) % 2;
    const int k = 2 * at.y + at.x;
    const double mean = GetBrightness(square.Quarters[k]) * side * side / Pi;
    isHidden = isHidden || mean < 0.5 * peak.Brightness;
    inside[k].push_back(peak);
  }
  if (!isHidden || square.Level >= LastLevel || squares.size() >= MostSquaresOfPeaks)
  {
    squares.push_back(square);
    return;
  }
  for (int k = 0; k < 4; ++k)
  {
    AddDivided(f, MakeQuarter(f, square, k), inside[k], squares);
  }
}

// Divides the squares of the largest errors until these are within the tolerance together.
glm::dvec3 SumSquares(const Function& f, std::vector<Square> squares, double tolerance)
{
  glm::dvec3 total(0.0), errors(0.0), variance(0.0);
  const auto count = [&](const Square& square, double sign)
  {
    total += sign * square.GetValue();
    errors += sign * square.Error;
    variance += sign * square.Error * square.Error;
  };
  for (const Square& square : squares)
  {
    count(square, 1.0);
  }
  const glm::dvec3 scale = glm::max(total, 1e-300);
  std::priority_queue<std::pair<double, std::size_t>> queue;
  const auto enqueue = [&](std::size_t k)
  {
    const glm::dvec3 share = squares[k].Error / scale;
    queue.emplace(squares[k].Level < LastLevel ? std::max({ share.x, share.y, share.z }) : 0.0, k);
  };
  for (std::size_t k = 0; k < squares.size(); ++k)
  {
    enqueue(k);
  }
  // Errors of either sign cancel, but for the part that they have in common.
  const auto isEnough = [&]()
  {
    const glm::dvec3 error = 2.0 * glm::sqrt(glm::max(variance, 0.0)) + 0.1 * errors;
    return glm::all(glm::lessThanEqual(error, tolerance * total));
  };
  const double most = MostSquares * std::min(AlbedoTolerance / tolerance, 1.0);
  while (!isEnough() && queue.top().first > 0.0 && static_cast<double>(squares.size()) < most)
  {
    const Square whole = squares[queue.top().second];
    queue.pop();
    count(whole, -1.0);
    for (int k = 0; k < 4; ++k)
    {
      squares.push_back(MakeQuarter(f, whole, k));
      count(squares.back(), 1.0);
      enqueue(squares.size() - 1);
    }
  }
  return glm::max(total, 0.0);
}
}

glm::dvec3 IntegrateHemisphere(const Function& f, const glm::dvec3& given,
  const std::vector<glm::dvec3>& draws, double tolerance)
{
  constexpr int side = 1 << FirstLevel;
  std::vector<Peak> peaks[side][side];
  const auto lookAt = [&](const std::vector<glm::dvec3>& directions)
  {
    for (const glm::dvec3& d : directions)
    {
      if (d.z > 0.0)
      {
        const glm::dvec2 at = 0.5 * (DiscToSquare(glm::dvec2(d)) + 1.0);
        const glm::ivec2 first = glm::clamp(glm::ivec2(at * double(side)), 0, side - 1);
        peaks[first.y][first.x].push_back({ glm::max(at, 0.0), GetBrightness(f(d)) });
      }
    }
  };
  lookAt(RetroLobe(glm::dvec3(-given.x, -given.y, given.z)).GetProbes());
  lookAt(RetroLobe(given).GetProbes());
  lookAt(draws);
  std::vector<Square> squares;
  for (int k = 0; k < side * side; ++k)
  {
    const int x = k % side, y = k / side;
    AddDivided(f, MakeFirst(f, x, y), peaks[y][x], squares);
  }
  return SumSquares(f, std::move(squares), tolerance);
}
} // namespace measuredbrdf
