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
constexpr int FirstLevel = 5; // 32 x 32 squares of 16 points
constexpr int LastLevel = 18; // 0.0004 degrees a side
constexpr int MostSquares = 1 << 16;
constexpr int MostSquaresOfPeaks = 1 << 13;
// Of a square's error, where its quarters agree by chance.
constexpr double InheritedError = 0.125;
// Of the spread of a first square's quarters: a straight edge, as of a tree's cell, near a square's
// middle lies between the same points of the square and of its quarters, which agree then.
constexpr double UnseenEdge = 0.2;

class Cubature
{
public:
  explicit Cubature(const std::function<glm::dvec3(const glm::dvec3&)>& evaluate)
    : Evaluate(evaluate)
  {
    constexpr int side = 1 << FirstLevel;
    this->Squares.reserve(std::size_t(2) * side * side);
    for (int y = 0; y < side; ++y)
    {
      for (int x = 0; x < side; ++x)
      {
        this->Add({ FirstLevel, x, y, glm::dvec3(0.0), glm::dvec3(0.0) });
        Square& square = this->Squares.back();
        square.Error = glm::max(glm::abs(this->Sum(FirstLevel, x, y) - square.GetValue()),
          UnseenEdge * square.GetSpread());
      }
    }
  }

  // Divides the squares about a direction until they show what f is there.
  void LookAt(const glm::dvec3& d)
  {
    if (!(d.z > 0.0))
    {
      return;
    }
    const double peak = Brightness(this->Evaluate(d));
    const glm::dvec2 p = 0.5 * (DiscToSquare(glm::dvec2(d)) + 1.0);
    const auto find = [&p](int level)
    {
      const int side = 1 << level;
      return glm::ivec2(std::clamp(static_cast<int>(p.x * side), 0, side - 1),
        std::clamp(static_cast<int>(p.y * side), 0, side - 1));
    };
    glm::ivec2 at = find(FirstLevel);
    int index = at.y * (1 << FirstLevel) + at.x;
    for (int level = FirstLevel + 1; level <= LastLevel; ++level)
    {
      at = find(level);
      const int quarter = 2 * (at.y % 2) + at.x % 2;
      const Square& square = this->Squares[static_cast<std::size_t>(index)];
      if (square.Child < 0)
      {
        const double mean = Brightness(square.Quarters[quarter]) * std::ldexp(1.0, 2 * level) / Pi;
        if (mean >= 0.5 * peak || this->Squares.size() >= MostSquaresOfPeaks)
        {
          return;
        }
        this->Divide(index);
      }
      index = this->Squares[static_cast<std::size_t>(index)].Child + quarter;
    }
  }

  glm::dvec3 Run(double tolerance)
  {
    glm::dvec3 total(0.0), errors(0.0), squares(0.0);
    const auto count = [&](const Square& square, double sign)
    {
      total += sign * square.GetValue();
      errors += sign * square.Error;
      squares += sign * square.Error * square.Error;
    };
    for (const Square& square : this->Squares)
    {
      if (square.Child < 0)
      {
        count(square, 1.0);
      }
    }
    const glm::dvec3 scale = total;
    const auto getPriority = [&scale](const Square& square)
    {
      double largest = 0.0;
      for (int c = 0; c < 3 && square.Level < LastLevel; ++c)
      {
        largest = std::max(largest, square.Error[c] / std::max(scale[c], 1e-300));
      }
      return largest;
    };
    std::priority_queue<std::pair<double, int>> queue;
    for (std::size_t k = 0; k < this->Squares.size(); ++k)
    {
      if (this->Squares[k].Child < 0)
      {
        queue.emplace(getPriority(this->Squares[k]), static_cast<int>(k));
      }
    }
    // Errors of either sign cancel, but for the part that they have in common.
    const auto isEnough = [&]()
    {
      const glm::dvec3 error = 2.0 * glm::sqrt(glm::max(squares, 0.0)) + 0.1 * errors;
      return glm::all(glm::lessThanEqual(error, tolerance * total));
    };
    const double most = MostSquares * std::min(AlbedoTolerance / tolerance, 1.0);
    while (
      !isEnough() && queue.top().first > 0.0 && static_cast<double>(this->Squares.size()) < most)
    {
      const int index = queue.top().second;
      queue.pop();
      count(this->Squares[static_cast<std::size_t>(index)], -1.0);
      this->Divide(index);
      const int child = this->Squares[static_cast<std::size_t>(index)].Child;
      for (int k = child; k < child + 4; ++k)
      {
        const Square& quarter = this->Squares[static_cast<std::size_t>(k)];
        count(quarter, 1.0);
        queue.emplace(getPriority(quarter), k);
      }
    }
    return glm::max(total, 0.0);
  }

private:
  struct Square
  {
    int Level; // 2^Level along a side of all
    int X;
    int Y;
    glm::dvec3 Error;
    glm::dvec3 Quarters[4];
    int Child = -1; // the first of four

    Square(int level, int x, int y, const glm::dvec3& whole, const glm::dvec3& error)
      : Level(level)
      , X(x)
      , Y(y)
      , Error(error)
      , Quarters{ whole, whole, whole, whole }
    {
    }
    glm::dvec3 GetValue() const
    {
      return (this->Quarters[0] + this->Quarters[1]) + (this->Quarters[2] + this->Quarters[3]);
    }
    glm::dvec3 GetSpread() const
    {
      const glm::dvec3 mean = 0.25 * this->GetValue();
      glm::dvec3 spread(0.0);
      for (const glm::dvec3& quarter : this->Quarters)
      {
        spread = glm::max(spread, glm::abs(quarter - mean));
      }
      return spread;
    }
  };

  static double Brightness(const glm::dvec3& f) { return f.x + f.y + f.z; }

  // Gauss's rule of 2 x 2 points.
  glm::dvec3 Sum(int level, int x, int y) const
  {
    constexpr double offset = 0.28867513459481287; // 1 / sqrt(12)
    const double side = std::ldexp(2.0, -level);
    glm::dvec3 sum(0.0);
    for (int k = 0; k < 4; ++k)
    {
      const double a = (x + 0.5 + (k % 2 == 0 ? -offset : offset)) * side - 1.0;
      const double b = (y + 0.5 + (k / 2 == 0 ? -offset : offset)) * side - 1.0;
      const glm::dvec2 p = SquareToDisc({ a, b });
      const double z = std::sqrt(std::max(1.0 - glm::dot(p, p), 0.0));
      sum += this->Evaluate(glm::dvec3(p, z));
    }
    return sum * (Pi / 16.0 * side * side); // a quarter of its part of the disc
  }

  void Add(Square square)
  {
    for (int k = 0; k < 4; ++k)
    {
      square.Quarters[k] = this->Sum(square.Level + 1, 2 * square.X + k % 2, 2 * square.Y + k / 2);
    }
    this->Squares.push_back(square);
  }

  void Divide(int index)
  {
    const Square square = this->Squares[static_cast<std::size_t>(index)];
    this->Squares[static_cast<std::size_t>(index)].Child = static_cast<int>(this->Squares.size());
    for (int k = 0; k < 4; ++k)
    {
      this->Add({ square.Level + 1, 2 * square.X + k % 2, 2 * square.Y + k / 2, square.Quarters[k],
        InheritedError * square.Error });
      Square& quarter = this->Squares.back();
      quarter.Error = glm::max(quarter.Error, glm::abs(quarter.GetValue() - square.Quarters[k]));
    }
  }

  const std::function<glm::dvec3(const glm::dvec3&)>& Evaluate;
  std::vector<Square> Squares;
};
}

glm::dvec3 IntegrateHemisphere(const std::function<glm::dvec3(const glm::dvec3&)>& f,
  const glm::dvec3& given, const std::vector<glm::dvec3>& draws, double tolerance)
{
  Cubature cubature(f);
  for (const glm::dvec3& about : { glm::dvec3(-given.x, -given.y, given.z), given })
  {
    for (const glm::dvec3& probe : RetroLobe(about).GetProbes())
    {
      cubature.LookAt(probe);
    }
  }
  for (const glm::dvec3& draw : draws)
  {
    cubature.LookAt(draw);
  }
  return cubature.Run(tolerance);
}
} // namespace measuredbrdf
