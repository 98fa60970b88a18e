// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAdaptiveRadianceIntegrator.h"

#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "ReflectionGuide.h"
#include "TexelTree.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

vtkStandardNewMacro(vtkAdaptiveRadianceIntegrator);

namespace
{
using measuredbrdf::ReflectionGuide;
using measuredbrdf::TexelTree;

constexpr int WidestBase = 16; // squares across the map to begin with
// The radius that a square may keep: that of the solid angle in which a draw is alone, times this,
// and this share of the distance to it.
constexpr double AloneTimes = 2.0; // lobes are as much narrower as the view is lower
constexpr double DistanceShare = 1.0;
// What may be left where a square and its quarters agree by chance: this share of the change, of
// the error of the square that it is a quarter of, and of tolerance times value.
constexpr double LeastRest = 0.05;
constexpr double InheritedShare = 0.03;
constexpr double LeastShare = 3.0;
// Within texels radiance is smooth: what the quarters leave is not left once it is extrapolated.
constexpr double PartRest = 0.15;
constexpr double PeakTimes = 2.0;   // of a square's mean f: less is no hidden peak
constexpr double LargestRest = 1.0; // above, a square tells nothing
// Squares' errors of either sign cancel, but for the part that they have in common.
constexpr double OwnShare = 2.0; // standard deviations
constexpr double CommonShare = 0.1;

double Sum(const glm::dvec3& rgb) { return rgb.x + rgb.y + rgb.z; }

/// The integral of one pair.
class AdaptiveSum
{
public:
  AdaptiveSum(const TexelTree& texels, vtkBRDF* brdf, const measuredbrdf::Frame& frame,
    const glm::dvec3& view)
    : Texels(texels)
    , BRDF(brdf)
    , Local(glm::transpose(frame))
    , View(view)
  {
    this->Base = 0;
    while (texels.GetWidth(this->Base) > WidestBase)
    {
      ++this->Base;
    }
  }

  glm::dvec3 Run(const ReflectionGuide& guide, double tolerance);

private:
  struct Square
  {
    int Level;
    int X;
    int Y;
    double Error;
    glm::dvec3 Value;       // by the quarters
    glm::dvec3 Quarters[4]; // their own
  };
  struct Drawn
  {
    glm::dvec3 Direction; // in the environment's frame
    double Radius;        // of a square that may stay whole about it
  };

  glm::dvec3 Evaluate(int level, int x, int y) const;
  double EstimateRising(int level, int x, int y) const;
  double EstimateHidden(const Square& square) const;
  Square Make(int level, int x, int y, const glm::dvec3& value) const;
  void AddQuarters(const Square& square);
  void Add(int level, int x, int y, const glm::dvec3& value, double leastError);
  bool Divides(const Drawn& drawn, const glm::dvec3& middle, double radius) const;
  void Force(int level, int x, int y, const glm::dvec3& value, const std::vector<Drawn>& near);

  double EstimateError() const
  {
    return OwnShare * std::sqrt(std::max(this->Squares, 0.0)) +
           CommonShare * std::max(this->Error, 0.0);
  }

  static bool IsLess(const Square& a, const Square& b) { return a.Error < b.Error; }

  const TexelTree& Texels;
  vtkBRDF* BRDF;
  const glm::dmat3 Local;
  const glm::dvec3 View;
  int Base;
  double Tolerance = 0.0;
  glm::dvec3 Total = glm::dvec3(0.0);
  double Error = 0.0;       // sum of the squares' errors
  double Squares = 0.0;     // of their squares
  std::vector<Square> Heap; // the largest error first
  ReflectionGuide::Peaks Peaks;
};

//------------------------------------------------------------------------------
glm::dvec3 AdaptiveSum::Evaluate(int level, int x, int y) const
{
  const TexelTree::Light light = this->Texels.Get(level, x, y);
  const glm::dvec3 i = this->Local * light.Direction;
  if (!(i.z > 0.0) || !(Sum(light.Irradiance) > 0.0))
  {
    return glm::dvec3(0.0);
  }
  glm::dvec3 f;
  this->BRDF->Evaluate(&i.x, &this->View.x, &f.x);
  return i.z * f * light.Irradiance;
}

//------------------------------------------------------------------------------
// What may rise above the horizon where the middle of a square does not: a quarter of its light, as
// high as that quarter's middle can be.
double AdaptiveSum::EstimateRising(int level, int x, int y) const
{
  const TexelTree::Light light = this->Texels.Get(level, x, y);
  glm::dvec3 i = this->Local * light.Direction;
  const double radius = this->Texels.GetLargestRadius(level);
  if (i.z > 0.0 || i.z + radius <= 0.0)
  {
    return 0.0;
  }
  i.z = 0.5 * (i.z + radius);
  i = glm::normalize(i);
  glm::dvec3 f;
  this->BRDF->Evaluate(&i.x, &this->View.x, &f.x);
  return 0.25 * Sum(i.z * f * light.Irradiance);
}

//------------------------------------------------------------------------------
// What a peak of f adds that lies in the square, but not where its quarters look.
double AdaptiveSum::EstimateHidden(const Square& square) const
{
  const TexelTree::Light light = this->Texels.Get(square.Level, square.X, square.Y);
  const double irradiance = Sum(light.Irradiance) / 3.0;
  double radius = 0.0;
  const glm::dvec3 i =
    this->Local * this->Texels.GetMiddle(square.Level, square.X, square.Y, radius);
  if (!(i.z > 0.0) || !(irradiance > 0.0) || radius < ReflectionGuide::Peaks::GetResolution())
  {
    return 0.0;
  }
  double solidAngle = 0.0;
  const double peak = i.z * irradiance * this->Peaks.Get(i, radius, solidAngle);
  const double hidden = peak - PeakTimes * Sum(square.Value);
  return std::max(hidden, 0.0) * std::min(4.0 * solidAngle / (2.0 * radius * radius), 1.0);
}

//------------------------------------------------------------------------------
// value: of the square as a whole.
AdaptiveSum::Square AdaptiveSum::Make(int level, int x, int y, const glm::dvec3& value) const
{
  Square square{ level, x, y, 0.0, glm::dvec3(0.0), {} };
  for (int k = 0; k < 4; ++k)
  {
    square.Quarters[k] = this->Evaluate(level - 1, 2 * x + k % 2, 2 * y + k / 2);
    square.Value += square.Quarters[k];
  }
  if (level - 1 > this->Texels.GetLowestLevel()) // else it is as exact as can be
  {
    const double rest = this->Texels.Get(level, x, y).Rest;
    const glm::dvec3 change = square.Value - value;
    square.Value = glm::max(square.Value + rest * change, 0.0);
    square.Error = (level > 0 ? std::max(rest, LeastRest) : PartRest) * Sum(glm::abs(change)) +
                   this->EstimateRising(level, x, y);
    if (level > 0)
    {
      square.Error += this->EstimateHidden(square);
      square.Error = std::max(square.Error, LeastShare * this->Tolerance * Sum(square.Value));
    }
  }
  return square;
}

//------------------------------------------------------------------------------
// leastError: a square where the larger one was wrong may agree with its quarters by chance.
void AdaptiveSum::Add(int level, int x, int y, const glm::dvec3& value, double leastError)
{
  if (level == this->Texels.GetLowestLevel())
  {
    this->Total += value;
    return;
  }
  Square square = this->Make(level, x, y, value);
  // Where nearly all light is in one quarter, that agrees with the square whatever it hides.
  if (level > 0 && this->Texels.Get(level, x, y).Rest > LargestRest)
  {
    this->AddQuarters(square);
    return;
  }
  this->Total += square.Value;
  if (square.Error > 0.0 || Sum(square.Value) > 0.0)
  {
    square.Error = std::max(square.Error, leastError);
  }
  if (square.Error > 0.0)
  {
    this->Error += square.Error;
    this->Squares += square.Error * square.Error;
    this->Heap.push_back(square);
    std::push_heap(this->Heap.begin(), this->Heap.end(), IsLess);
  }
}

//------------------------------------------------------------------------------
void AdaptiveSum::AddQuarters(const Square& square)
{
  for (int k = 0; k < 4; ++k)
  {
    this->Add(square.Level - 1, 2 * square.X + k % 2, 2 * square.Y + k / 2, square.Quarters[k],
      InheritedShare * square.Error);
  }
}

//------------------------------------------------------------------------------
bool AdaptiveSum::Divides(const Drawn& drawn, const glm::dvec3& middle, double radius) const
{
  const double distance = std::max(glm::length(drawn.Direction - middle) - radius, 0.0);
  return radius > drawn.Radius + DistanceShare * distance;
}

//------------------------------------------------------------------------------
// Divides where a draw wants smaller squares about it.
void AdaptiveSum::Force(
  int level, int x, int y, const glm::dvec3& value, const std::vector<Drawn>& near)
{
  std::vector<Drawn> still;
  if (level > this->Texels.GetLowestLevel())
  {
    double radius = 0.0;
    const glm::dvec3 middle = this->Texels.GetMiddle(level, x, y, radius);
    std::copy_if(near.begin(), near.end(), std::back_inserter(still),
      [&](const Drawn& drawn) { return this->Divides(drawn, middle, radius); });
  }
  if (still.empty())
  {
    this->Add(level, x, y, value, 0.0);
    return;
  }
  for (int k = 0; k < 4; ++k)
  {
    const int quarterX = 2 * x + k % 2;
    const int quarterY = 2 * y + k / 2;
    this->Force(
      level - 1, quarterX, quarterY, this->Evaluate(level - 1, quarterX, quarterY), still);
  }
}

//------------------------------------------------------------------------------
glm::dvec3 AdaptiveSum::Run(const ReflectionGuide& guide, double tolerance)
{
  this->Tolerance = tolerance;
  this->Peaks = guide.GetPeaks(this->View);
  std::vector<ReflectionGuide::Draw> draws;
  guide.Draws(this->View, draws);
  std::vector<Drawn> near;
  for (const ReflectionGuide::Draw& draw : draws)
  {
    near.push_back({ draw.Direction * this->Local, // transposed: back to the environment's frame
      AloneTimes * std::sqrt(draw.SolidAngle * this->View.z / measuredbrdf::Pi) });
  }
  for (int y = 0; y < this->Texels.GetHeight(this->Base); ++y)
  {
    for (int x = 0; x < this->Texels.GetWidth(this->Base); ++x)
    {
      this->Force(this->Base, x, y, this->Evaluate(this->Base, x, y), near);
    }
  }
  while (!this->Heap.empty() && this->EstimateError() > tolerance * Sum(this->Total))
  {
    std::pop_heap(this->Heap.begin(), this->Heap.end(), IsLess);
    const Square square = this->Heap.back();
    this->Heap.pop_back();
    this->Total -= square.Value;
    this->Error -= square.Error;
    this->Squares -= square.Error * square.Error;
    this->AddQuarters(square);
  }
  return glm::max(this->Total, 0.0);
}
}

//------------------------------------------------------------------------------
struct vtkAdaptiveRadianceIntegrator::Internals
{
  Internals(vtkEnvironment* environment, vtkBRDF* brdf)
    : Texels(environment)
    , Guide(brdf)
  {
  }
  TexelTree Texels;
  ReflectionGuide Guide;
};

//------------------------------------------------------------------------------
vtkAdaptiveRadianceIntegrator::vtkAdaptiveRadianceIntegrator() = default;
vtkAdaptiveRadianceIntegrator::~vtkAdaptiveRadianceIntegrator() = default;

//------------------------------------------------------------------------------
bool vtkAdaptiveRadianceIntegrator::Begin()
{
  vtkEnvironment* environment = this->Environment;
  if (!environment || environment->GetPixels().empty())
  {
    vtkErrorMacro("Integrate: there is no environment, or it is empty.");
    return false;
  }
  this->Prepared = std::make_unique<Internals>(environment->GetSubdivided(), this->BRDF);
  return true;
}

//------------------------------------------------------------------------------
void vtkAdaptiveRadianceIntegrator::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const measuredbrdf::Frame frame = measuredbrdf::FrameAbout(glm::make_vec3(n), glm::make_vec3(t));
  const glm::dvec3 view = measuredbrdf::ToLocal(frame, glm::make_vec3(o));
  AdaptiveSum sum(this->Prepared->Texels, this->BRDF, frame, view);
  const glm::dvec3 result = sum.Run(this->Prepared->Guide, this->Tolerance);
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] += result[c];
  }
}

//------------------------------------------------------------------------------
void vtkAdaptiveRadianceIntegrator::CopyProperties(vtkRadianceIntegrator* source)
{
  this->Superclass::CopyProperties(source);
  if (auto* adaptive = vtkAdaptiveRadianceIntegrator::SafeDownCast(source))
  {
    this->SetTolerance(adaptive->Tolerance);
  }
}

//------------------------------------------------------------------------------
void vtkAdaptiveRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
}
