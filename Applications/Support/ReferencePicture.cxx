// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferencePicture.h"

#include "Measuring.h"
#include "Methods.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

namespace tool
{
namespace
{
constexpr std::size_t FewestPixels = 2000; // of fewer a sample would take as long as the picture
constexpr int SampleSize = 400;
constexpr double SampleTolerance = 0.0002; // to which the sample is exact
constexpr double SampleShare = 0.1;        // of the time, about
constexpr double LeastShare = 0.02; // of the mean radiance: darker pixels count as that bright

// Of the picture. Evaluations of f are counted, not timed: pictures do not depend on the machine.
constexpr double CoarsestTolerance = 0.0028;
constexpr double FinestTolerance = 0.0014;
constexpr double AffordableEvaluations = 10500.0; // of f a pixel
constexpr double UsualPixels = 160000.0;          // of a sphere in 500 x 500
constexpr double EvaluationPower = 0.85;          // of the inverse tolerance, about
constexpr double NextTolerance = 0.8;             // times the last one, where the sample is off

//------------------------------------------------------------------------------
/// Four neighbors. One that is covered takes the place of those that are not.
struct Block
{
  int X;                             // of the left one
  int Y;                             // of the upper one
  std::array<std::size_t, 4> Pixels; // of the surface
};

constexpr int BlockSide = 2;
constexpr int CoarsestStride = 8; // of the blocks that are shown first

//------------------------------------------------------------------------------
// Normals and views of some pixels, 3 doubles each.
std::pair<std::vector<double>, std::vector<double>> Gather(
  const Surface& surface, const std::vector<std::size_t>& pixels)
{
  std::pair<std::vector<double>, std::vector<double>> gathered;
  for (const std::size_t k : pixels)
  {
    const double* normal = &surface.Normals[3 * k];
    const double* view = &surface.Views[3 * k];
    gathered.first.insert(gathered.first.end(), normal, normal + 3);
    gathered.second.insert(gathered.second.end(), view, view + 3);
  }
  return gathered;
}

//------------------------------------------------------------------------------
/// A picture's pixels in blocks. A block is always the same four: its radiance does not depend on
/// which others are asked for.
class BlockPicture
{
public:
  BlockPicture(vtkBRDF* brdf, vtkEnvironment* environment, const tool::Surface& surface,
    const tool::Size& size)
    : Surface(surface)
    , Size(size)
    , Index(static_cast<std::size_t>(size.Width * size.Height), -1)
    , IsKnown(surface.Pixels.size(), 0)
    , Radiance(3 * surface.Pixels.size(), 0.0)
  {
    this->Integrator->SetBRDF(brdf);
    this->Integrator->SetEnvironment(environment);
    for (std::size_t k = 0; k < surface.Pixels.size(); ++k)
    {
      this->Index[static_cast<std::size_t>(surface.Pixels[k])] = static_cast<int>(k);
    }
    for (int y = 0; y < size.Height; y += BlockSide)
    {
      for (int x = 0; x < size.Width; x += BlockSide)
      {
        const std::array<int, 4> found = { this->Find(x, y), this->Find(x + 1, y),
          this->Find(x, y + 1), this->Find(x + 1, y + 1) };
        const int covered = *std::max_element(found.begin(), found.end());
        Block block{ x, y, {} };
        std::transform(found.begin(), found.end(), block.Pixels.begin(),
          [covered](int k) { return static_cast<std::size_t>(k < 0 ? covered : k); });
        if (covered >= 0)
        {
          this->Blocks.push_back(block);
        }
      }
    }
  }

  /// Lowers the tolerance from one that is affordable until the sample is within 0.3 %.
  void ChooseTolerance()
  {
    std::vector<Block> blocks;
    for (int k = 0; k < SampleSize; ++k)
    {
      // Scattered by the golden ratio: no column.
      const double place = std::fmod(0.5 + 0.61803398874989485 * (k + 1), 1.0);
      blocks.push_back(this->Blocks[static_cast<std::size_t>(place * this->Blocks.size())]);
      this->Sample.push_back(blocks.back().Pixels[k % 4]);
    }
    const auto [normals, views] = Gather(this->Surface, this->Sample);
    this->Integrator->SetTolerance(SampleTolerance);
    this->Exact = IntegratePairs(this->Integrator, normals, views,
      [this](double share) { this->Bar.Update(SampleShare * share); });

    const auto attempt = [&](double tolerance)
    {
      this->Integrator->SetTolerance(tolerance);
      this->Integrate(blocks, SampleShare, SampleShare);
      return this->GetWithin();
    };
    const auto before = static_cast<double>(this->Integrator->GetNumberOfEvaluations());
    double within = attempt(CoarsestTolerance);
    const double evaluations =
      (static_cast<double>(this->Integrator->GetNumberOfEvaluations()) - before) /
      (4.0 * SampleSize) * std::max(this->Surface.Pixels.size() / UsualPixels, 1.0);
    double tolerance = std::clamp(
      CoarsestTolerance * std::pow(evaluations / AffordableEvaluations, 1.0 / EvaluationPower),
      FinestTolerance, CoarsestTolerance);
    if (tolerance < CoarsestTolerance && tolerance > FinestTolerance)
    {
      within = attempt(tolerance);
    }
    while (within < 1.0 && tolerance > FinestTolerance)
    {
      tolerance = std::max(NextTolerance * tolerance, FinestTolerance);
      within = tolerance > FinestTolerance ? attempt(tolerance) : 1.0; // there is no finer one
    }
    this->Integrator->SetTolerance(tolerance);
    std::fill(this->IsKnown.begin(), this->IsKnown.end(), char(0));
  }

  /// Blocks of a coarse grid first, for those who look on.
  void Draw(const ShowReference& show)
  {
    std::size_t done = 0;
    for (int stride = CoarsestStride; stride >= BlockSide; stride /= 2)
    {
      std::vector<Block> wanted;
      std::copy_if(this->Blocks.begin(), this->Blocks.end(), std::back_inserter(wanted),
        [&](const Block& block) {
          return block.X % stride == 0 && block.Y % stride == 0 && !this->IsKnown[block.Pixels[0]];
        });
      const auto share = [this](std::size_t blocks)
      { return SampleShare + (1.0 - SampleShare) * blocks / this->Blocks.size(); };
      this->Integrate(wanted, share(done), share(done + wanted.size()));
      done += wanted.size();
      if (show)
      {
        show(this->FillGaps(stride));
      }
    }
  }

  const std::vector<double>& GetRadiance() const { return this->Radiance; }

  /// The share of the sample that is within the tolerance.
  double GetWithin() const
  {
    const double least =
      LeastShare * std::accumulate(this->Exact.begin(), this->Exact.end(), 0.0) / SampleSize;
    int within = 0;
    for (std::size_t k = 0; k < this->Sample.size(); ++k)
    {
      double difference = 0.0;
      double scale = 0.0;
      for (std::size_t c = 0; c < 3; ++c)
      {
        const double exact = this->Exact[3 * k + c];
        difference += std::abs(this->Radiance[3 * this->Sample[k] + c] - exact);
        scale += exact;
      }
      within += difference <= ReferencePicture::Tolerance * std::max(scale, least) ? 1 : 0;
    }
    return static_cast<double>(within) / SampleSize;
  }

private:
  /// The surface's pixel at a place, or -1.
  int Find(int x, int y) const
  {
    return x < this->Size.Width && y < this->Size.Height
             ? this->Index[static_cast<std::size_t>(y * this->Size.Width + x)]
             : -1;
  }

  // begin, end: the share of all work that is done before and after this.
  void Integrate(const std::vector<Block>& blocks, double begin, double end)
  {
    std::vector<std::size_t> pixels;
    for (const Block& block : blocks)
    {
      pixels.insert(pixels.end(), block.Pixels.begin(), block.Pixels.end());
    }
    const auto pairs = Gather(this->Surface, pixels);
    vtkNew<vtkDoubleArray> radiance;
    const auto integrate = [&](vtkAdaptiveRadianceIntegrator* made)
    {
      const auto n = MakeArray(pairs.first, 3);
      const auto v = MakeArray(pairs.second, 3);
      return made->GetBRDF()->IsIsotropic()
               ? made->IntegrateNeighbors(n, v, radiance)
               : made->Integrate(n, v, radiance, MakeTangents(pairs.first));
    };
    const std::function<void(double)> update = [&](double share)
    { this->Bar.Update(begin + share * (end - begin)); };
    if (!blocks.empty() && !RunWithProgress(this->Integrator.Get(), integrate, update))
    {
      throw Error("integrating: " + TakeErrorText());
    }
    for (std::size_t k = 0; k < pixels.size(); ++k)
    {
      radiance->GetTuple(static_cast<vtkIdType>(k), &this->Radiance[3 * pixels[k]]);
      this->IsKnown[pixels[k]] = 1;
    }
  }

  // What is known, and elsewhere the nearest point of the grid.
  std::vector<double> FillGaps(int stride) const
  {
    std::vector<double> radiance = this->Radiance;
    for (std::size_t k = 0; k < this->IsKnown.size(); ++k)
    {
      const int x = this->Surface.Pixels[k] % this->Size.Width;
      const int y = this->Surface.Pixels[k] / this->Size.Width;
      const int near = this->Find(x / stride * stride, y / stride * stride);
      if (!this->IsKnown[k] && near >= 0)
      {
        std::copy_n(&this->Radiance[3 * static_cast<std::size_t>(near)], 3, &radiance[3 * k]);
      }
    }
    return radiance;
  }

  const tool::Surface& Surface;
  tool::Size Size;
  std::vector<int> Index; // of the surface's pixels, by place
  std::vector<Block> Blocks;
  std::vector<char> IsKnown;
  std::vector<double> Radiance;    // 3 a pixel
  std::vector<std::size_t> Sample; // pixels
  std::vector<double> Exact;       // their radiance
  vtkNew<vtkAdaptiveRadianceIntegrator> Integrator;
  ProgressBar Bar{ "integrating" };
};
}

//------------------------------------------------------------------------------
ReferencePicture DrawReference(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface,
  const Size& size, const ShowReference& show)
{
  if (surface.Stride > 1 || surface.Pixels.size() < FewestPixels)
  {
    return { IntegrateReference(brdf, environment, surface) };
  }
  BlockPicture picture(brdf, environment, surface, size);
  picture.ChooseTolerance();
  picture.Draw(show);
  return { picture.GetRadiance(), picture.GetWithin() };
}
} // namespace tool
