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
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkTableRadianceIntegrator.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <set>
#include <utility>

namespace tool
{
namespace
{
using Block = std::array<int, 4>; // pixels of the surface

// That of a pixel; pixels that are not covered are replaced by one that is.
Block FindBlock(const tool::Surface& surface, int width, const std::vector<int>& places, int pixel)
{
  const int place = surface.Pixels[static_cast<std::size_t>(pixel)];
  const int left = place % width / 2 * 2;
  const int top = place / width / 2 * 2;
  Block block{ -1, -1, -1, -1 };
  int covered = -1;
  for (int k = 0; k < 4; ++k)
  {
    const int x = left + k % 2;
    const auto at = static_cast<std::size_t>((top + k / 2) * width + x);
    block[static_cast<std::size_t>(k)] = x < width && at < places.size() ? places[at] : -1;
    covered = covered < 0 ? block[static_cast<std::size_t>(k)] : covered;
  }
  for (int& other : block)
  {
    other = other < 0 ? covered : other;
  }
  return block;
}
}

//------------------------------------------------------------------------------
std::vector<double> IntegratePixels(vtkAdaptiveRadianceIntegrator* integrator,
  const Surface& surface, const std::vector<int>& pixels, const std::function<void(double)>& show)
{
  std::vector<double> normals;
  std::vector<double> views;
  for (const int k : pixels)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      normals.push_back(surface.Normals[3 * static_cast<std::size_t>(k) + c]);
      views.push_back(surface.Views[3 * static_cast<std::size_t>(k) + c]);
    }
  }
  return pixels.empty() ? normals : IntegrateSomePairs(integrator, normals, views, show);
}

//------------------------------------------------------------------------------
std::size_t CountInBlocks(const Surface& surface, int width, const std::vector<int>& pixels)
{
  std::set<std::pair<int, int>> blocks;
  for (const int pixel : pixels)
  {
    const int place = surface.Pixels[static_cast<std::size_t>(pixel)];
    blocks.insert({ place % width / 2, place / width / 2 });
  }
  return 4 * blocks.size();
}

//------------------------------------------------------------------------------
std::vector<double> IntegrateInBlocks(vtkAdaptiveRadianceIntegrator* integrator,
  const Surface& surface, int width, const std::vector<int>& places, const std::vector<int>& pixels,
  const std::function<void(double)>& show)
{
  std::vector<int> pairs(surface.Pixels.size(), -1); // of each pixel
  vtkNew<vtkDoubleArray> normals, views, radiance;
  normals->SetNumberOfComponents(3);
  views->SetNumberOfComponents(3);
  for (const int pixel : pixels)
  {
    if (pairs[static_cast<std::size_t>(pixel)] >= 0)
    {
      continue;
    }
    for (const int other : FindBlock(surface, width, places, pixel))
    {
      const auto at = static_cast<std::size_t>(other);
      pairs[at] = static_cast<int>(normals->GetNumberOfTuples());
      normals->InsertNextTuple(&surface.Normals[3 * at]);
      views->InsertNextTuple(&surface.Views[3 * at]);
    }
  }
  std::vector<double> result(3 * pixels.size());
  if (pixels.empty())
  {
    return result;
  }
  const bool done = RunWithProgress(
    integrator,
    [&](vtkAdaptiveRadianceIntegrator* made)
    { return made->IntegrateNeighbors(normals, views, radiance); },
    show);
  if (!done)
  {
    throw Error("integrating: " + TakeErrorText());
  }
  for (std::size_t k = 0; k < pixels.size(); ++k)
  {
    radiance->GetTuple(pairs[static_cast<std::size_t>(pixels[k])], &result[3 * k]);
  }
  return result;
}

namespace
{
constexpr int CoarsestStride = 8;          // pixels
constexpr std::size_t FewestPixels = 4096; // worth a table
constexpr double FlatTolerance = 0.0015;   // in the middle of a cell, where interpolation errs most
constexpr double LeastShare = 0.02;      // of the mean radiance: darker pixels count as that bright
constexpr double LeastCosine = 0.9;      // between the normals of a cell: no edge of the mesh
constexpr double FirstTolerance = 0.002; // of integrated pixels
constexpr double GridTolerance = 0.001;  // of those between which others are interpolated
// Of cells of eight and of four pixels, to divide the others further: else all is integrated.
constexpr double LeastFlatOfEight = 0.05;
constexpr double LeastFlatOfFour = 0.1;
constexpr double LeastTolerance = 0.0005;
constexpr double CheckTolerance = 0.0002; // of the sample
constexpr std::size_t SampleSize = 400;
constexpr double EnoughWithin = 0.99;       // of the sample
constexpr double EnoughBetween = 0.97;      // of its interpolated pixels
constexpr std::size_t FewestBetween = 30;   // to tell
constexpr std::size_t FewestChecked = 2000; // pixels: a sample would take as long as the picture
constexpr double SampleShare = 0.1;         // of the time, about

//------------------------------------------------------------------------------
struct Cell
{
  int X;
  int Y;
};

//------------------------------------------------------------------------------
class Refinement
{
public:
  Refinement(vtkBRDF* brdf, vtkEnvironment* environment, const tool::Surface& surface,
    const tool::Size& size, const tool::ShowReference& show)
    : Surface(surface)
    , Size(size)
    , Show(show)
    , Index(static_cast<std::size_t>(size.Width * size.Height), -1)
    , Radiance(surface.Normals.size())
    , IsKnown(surface.Pixels.size(), 0)
    , IsGuessed(surface.Pixels.size(), 0)
  {
    for (std::size_t k = 0; k < surface.Pixels.size(); ++k)
    {
      this->Index[static_cast<std::size_t>(surface.Pixels[k])] = static_cast<int>(k);
    }
    for (vtkAdaptiveRadianceIntegrator* integrator :
      { this->Reference.Get(), this->Grid.Get(), this->Strict.Get() })
    {
      integrator->SetBRDF(brdf);
      integrator->SetEnvironment(environment);
    }
    this->Reference->SetTolerance(FirstTolerance);
    this->Strict->SetTolerance(CheckTolerance);
    this->Guess.assign(surface.Normals.size(), 0.0);
    this->EvaluatesMany = this->Reference->EvaluatesManyLights();
  }

  // What a table gives, so that what it lacks is interpolated.
  void MakeGuess()
  {
    vtkBRDF* brdf = this->Reference->GetBRDF();
    if (brdf->IsIsotropic() && this->Surface.Pixels.size() >= FewestPixels)
    {
      vtkNew<vtkTableRadianceIntegrator> table;
      table->SetBRDF(brdf);
      table->SetEnvironment(this->Reference->GetEnvironment());
      table->SetSizes({ 65, 16, 16 });
      this->Guess = tool::IntegrateSomePairs(table, this->Surface.Normals, this->Surface.Views,
        [this](double) { this->Bar.Update(this->Done); });
      this->HasGuess = true;
      this->ShowPicture(CoarsestStride);
    }
  }

  // Every pixel, blocks of a coarse grid first, for those who look on.
  void RunAll()
  {
    for (int stride = CoarsestStride; stride > 1; stride /= 2)
    {
      std::vector<int> wanted;
      for (int y = 0; y < this->Size.Height; y += stride)
      {
        for (int x = 0; x < this->Size.Width; x += stride)
        {
          for (int k = 0; k < 4; ++k)
          {
            wanted.push_back(this->Find(x + k % 2, y + k / 2));
          }
        }
      }
      this->Integrate(wanted, this->Reference);
      this->ShowPicture(stride);
    }
  }

  void Run(int stride)
  {
    std::fill(this->IsGuessed.begin(), this->IsGuessed.end(), 0);
    std::vector<int> wanted;
    std::vector<Cell> cells;
    for (int y = 0; y < this->Size.Height; y += stride)
    {
      for (int x = 0; x < this->Size.Width; x += stride)
      {
        wanted.push_back(this->Find(x, y));
        cells.push_back({ x, y });
      }
    }
    this->Grid->SetTolerance(std::min(GridTolerance, this->Reference->GetTolerance()));
    this->Integrate(wanted, this->Grid);
    this->ShowPicture(stride);
    double flat = 1.0;
    for (int s = stride; s > 1; s /= 2)
    {
      if ((s == 4 && stride > 4 && flat < LeastFlatOfEight) || (s == 2 && flat < LeastFlatOfFour))
      {
        break;
      }
      cells = this->Refine(cells, s, flat);
      this->ShowPicture(s / 2);
    }
    wanted.clear();
    for (std::size_t k = 0; k < this->IsKnown.size(); ++k)
    {
      if (!this->IsGuessed[k])
      {
        wanted.push_back(static_cast<int>(k));
      }
    }
    this->Integrate(wanted, this->Reference);
  }

  // Takes some of all pixels, scattered among them, for Check: they are not kept in the picture.
  // Lowers the tolerance until enough of them are within 0.3 % of what a smaller one gives. Returns
  // whether all pixels are to be integrated, in blocks. Of few pixels there is no sample.
  bool ChooseTolerance()
  {
    if (this->IsKnown.size() < FewestChecked)
    {
      this->Reference->SetTolerance(GridTolerance);
      return false;
    }
    this->Sample.Scatter(SampleSize, this->IsKnown.size());
    this->Sample.SetExact(
      this->IntegrateAll(this->Sample.GetPixels(), this->Strict, 0.0, SampleShare), LeastShare);
    this->InBlocks = this->EvaluatesMany;
    double tolerance = this->InBlocks ? tool::BlockTolerance::Coarsest : FirstTolerance;
    Trial trial = this->Try(tolerance);
    if (this->InBlocks)
    {
      const double chosen =
        tool::BlockTolerance::Choose(trial.Evaluations, static_cast<double>(this->IsKnown.size()));
      this->InBlocks = chosen > 0.0;
      const double next = this->InBlocks ? chosen : FirstTolerance;
      if (next < tolerance)
      {
        tolerance = next;
        trial = this->Try(tolerance);
      }
    }
    const double least = this->InBlocks ? tool::BlockTolerance::Finest : LeastTolerance;
    while ((this->InBlocks ? 1.0 : EnoughWithin) > trial.Within && tolerance > least)
    {
      tolerance =
        std::max((this->InBlocks ? tool::BlockTolerance::Factor : 0.5) * tolerance, least);
      trial = this->Try(tolerance);
    }
    return this->InBlocks;
  }

  // Compares the sample with the picture.
  void Check(tool::ReferencePicture& picture) const
  {
    const std::size_t count = this->IsKnown.size();
    picture.Integrated =
      static_cast<double>(std::count(this->IsKnown.begin(), this->IsKnown.end(), char(1))) /
      static_cast<double>(count);
    std::vector<double> drawn;
    std::size_t between = 0;
    std::size_t good = 0;
    for (std::size_t k = 0; k < this->Sample.GetPixels().size(); ++k)
    {
      const auto pixel = static_cast<std::size_t>(this->Sample.GetPixels()[k]);
      const double* rgb = &this->Radiance[3 * pixel];
      drawn.insert(drawn.end(), rgb, rgb + 3);
      if (!this->IsKnown[pixel])
      {
        const double error = this->Sample.GetError(rgb, this->Sample.GetExact(k));
        ++between;
        good += error <= tool::ReferencePicture::Tolerance ? 1 : 0;
      }
    }
    picture.Within =
      this->Sample.GetWithin(drawn, tool::ReferencePicture::Tolerance, picture.Worst);
    picture.WithinBetween =
      between < FewestBetween ? 1.0 : static_cast<double>(good) / static_cast<double>(between);
    picture.Radiance = this->Radiance;
  }

private:
  // Of the sample, to the present tolerance.
  struct Trial
  {
    double Within = 1.0;
    double Evaluations = 0.0; // of f a pixel
  };
  Trial Try(double tolerance)
  {
    this->Reference->SetTolerance(tolerance);
    Trial trial;
    if (tolerance <= (this->InBlocks ? tool::BlockTolerance::Finest : LeastTolerance))
    {
      return trial; // there is no finer one
    }
    const std::vector<int>& pixels = this->Sample.GetPixels();
    const auto before = static_cast<double>(this->Reference->GetNumberOfEvaluations());
    const std::vector<double> rgb =
      this->IntegrateAll(pixels, this->Reference, SampleShare, SampleShare);
    double worst = 0.0;
    trial.Within = this->Sample.GetWithin(rgb, tool::ReferencePicture::Tolerance, worst);
    const std::size_t count =
      this->InBlocks ? tool::CountInBlocks(this->Surface, this->Size.Width, pixels) : pixels.size();
    trial.Evaluations = (static_cast<double>(this->Reference->GetNumberOfEvaluations()) - before) /
                        static_cast<double>(count);
    return trial;
  }

  /// The surface's pixel at a place, or -1.
  int Find(int x, int y) const
  {
    return x < this->Size.Width && y < this->Size.Height
             ? this->Index[static_cast<std::size_t>(y * this->Size.Width + x)]
             : -1;
  }

  void Integrate(const std::vector<int>& wanted, vtkAdaptiveRadianceIntegrator* integrator)
  {
    std::vector<int> pixels;
    for (const int k : wanted)
    {
      if (k >= 0 && !this->IsKnown[static_cast<std::size_t>(k)])
      {
        this->IsKnown[static_cast<std::size_t>(k)] = 1;
        pixels.push_back(k);
      }
    }
    const auto settled = [this](std::size_t more)
    {
      return static_cast<double>(this->CountSettled() - more) /
             static_cast<double>(this->IsKnown.size());
    };
    const std::vector<double> radiance = this->IntegrateAll(pixels, integrator,
      SampleShare + (1.0 - SampleShare) * settled(pixels.size()),
      SampleShare + (1.0 - SampleShare) * settled(0));
    for (std::size_t k = 0; k < pixels.size(); ++k)
    {
      std::copy_n(&radiance[3 * k], 3, &this->Radiance[3 * static_cast<std::size_t>(pixels[k])]);
    }
  }

  std::size_t CountSettled() const
  {
    std::size_t count = 0;
    for (std::size_t k = 0; k < this->IsKnown.size(); ++k)
    {
      count += this->IsKnown[k] || this->IsGuessed[k] ? 1 : 0;
    }
    return count;
  }

  // begin, end: the share of all work that is done before and after this.
  std::vector<double> IntegrateAll(const std::vector<int>& pixels,
    vtkAdaptiveRadianceIntegrator* integrator, double begin, double end)
  {
    const auto update = [&](double share)
    {
      // A picture that is interpolated again does not begin again.
      this->Done = std::max(this->Done, begin + share * (end - begin));
      this->Bar.Update(this->Done);
    };
    return this->InBlocks && integrator == this->Reference
             ? tool::IntegrateInBlocks(
                 integrator, this->Surface, this->Size.Width, this->Index, pixels, update)
             : tool::IntegratePixels(integrator, this->Surface, pixels, update);
  }

  // What is known so far; elsewhere the guess or, without one, the nearest point of the grid.
  void ShowPicture(int stride) const
  {
    if (!this->Show)
    {
      return;
    }
    std::vector<double> radiance = this->Radiance;
    for (std::size_t k = 0; k < this->IsKnown.size(); ++k)
    {
      if (this->IsKnown[k] || this->IsGuessed[k])
      {
        continue;
      }
      const int x = this->Surface.Pixels[k] % this->Size.Width;
      const int y = this->Surface.Pixels[k] / this->Size.Width;
      const int near = this->Find(x / stride * stride, y / stride * stride);
      const std::vector<double>& source = this->HasGuess || near < 0 ? this->Guess : this->Radiance;
      const std::size_t at = this->HasGuess || near < 0 ? k : static_cast<std::size_t>(near);
      std::copy_n(&source[3 * at], 3, &radiance[3 * k]);
    }
    this->Show(radiance);
  }

  // What the guess lacks, bilinear between the corners; u, v in [0, 1].
  void Interpolate(const int corners[4], double u, double v, int k, double rgb[3]) const
  {
    const double weights[4] = { (1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v };
    for (std::size_t c = 0; c < 3; ++c)
    {
      double value = this->Guess[3 * static_cast<std::size_t>(k) + c];
      for (int corner = 0; corner < 4; ++corner)
      {
        const std::size_t at = 3 * static_cast<std::size_t>(corners[corner]) + c;
        value += weights[corner] * (this->Radiance[at] - this->Guess[at]);
      }
      rgb[c] = std::max(value, 0.0);
    }
  }

  // False where one is not covered, or the mesh has an edge between them.
  bool FindCorners(const Cell& cell, int s, int corners[4]) const
  {
    for (int corner = 0; corner < 4; ++corner)
    {
      corners[corner] = this->Find(cell.X + corner % 2 * s, cell.Y + corner / 2 * s);
    }
    const int middle = this->Find(cell.X + s / 2, cell.Y + s / 2);
    return middle >= 0 && std::all_of(corners, corners + 4,
                            [this, middle](int k) {
                              return k >= 0 && vtkMath::Dot(this->GetNormal(k),
                                                 this->GetNormal(middle)) >= LeastCosine;
                            });
  }

  const double* GetNormal(int k) const { return &this->Surface.Normals[3 * std::size_t(k)]; }

  // Fills the cells whose middle is foretold by their corners; returns the quarters of the others.
  // flat: the share of the filled ones.
  std::vector<Cell> Refine(const std::vector<Cell>& cells, int s, double& flat)
  {
    const int half = s / 2;
    int corners[4];
    std::vector<int> wanted;
    for (const Cell& cell : cells)
    {
      if (this->FindCorners(cell, s, corners))
      {
        wanted.push_back(this->Find(cell.X + half, cell.Y + half));
      }
    }
    this->Integrate(wanted, this->Grid);
    const double tested = static_cast<double>(wanted.size());
    std::size_t filled = 0;
    wanted.clear();
    std::vector<Cell> finer;
    for (const Cell& cell : cells)
    {
      const int middle = this->Find(cell.X + half, cell.Y + half);
      double rgb[3];
      bool isFlat = this->FindCorners(cell, s, corners);
      if (isFlat)
      {
        this->Interpolate(corners, 0.5, 0.5, middle, rgb);
        isFlat = this->Sample.GetError(
                   rgb, &this->Radiance[3 * static_cast<std::size_t>(middle)]) <= FlatTolerance;
      }
      if (isFlat)
      {
        this->Fill(cell, s, corners);
        ++filled;
        continue;
      }
      for (const int y : { 0, half })
      {
        for (const int x : { 0, half })
        {
          finer.push_back({ cell.X + x, cell.Y + y });
        }
      }
      for (int y = 0; y <= s; y += half)
      {
        for (int x = 0; x <= s; x += half)
        {
          wanted.push_back(this->Find(cell.X + x, cell.Y + y));
        }
      }
    }
    this->Integrate(wanted, this->Grid);
    flat = static_cast<double>(filled) / std::max(tested, 1.0);
    return finer;
  }

  void Fill(const Cell& cell, int s, const int corners[4])
  {
    const double* middle = this->GetNormal(this->Find(cell.X + s / 2, cell.Y + s / 2));
    for (int y = 0; y <= s; ++y)
    {
      for (int x = 0; x <= s; ++x)
      {
        const int k = this->Find(cell.X + x, cell.Y + y);
        if (k >= 0 && vtkMath::Dot(this->GetNormal(k), middle) >= LeastCosine)
        {
          this->IsGuessed[static_cast<std::size_t>(k)] = 1;
          if (!this->IsKnown[static_cast<std::size_t>(k)])
          {
            this->Interpolate(corners, static_cast<double>(x) / s, static_cast<double>(y) / s, k,
              &this->Radiance[3 * static_cast<std::size_t>(k)]);
          }
        }
      }
    }
  }

  const tool::Surface& Surface;
  tool::Size Size;
  const tool::ShowReference& Show;
  vtkNew<vtkAdaptiveRadianceIntegrator> Reference;
  vtkNew<vtkAdaptiveRadianceIntegrator> Grid;
  vtkNew<vtkAdaptiveRadianceIntegrator> Strict;
  std::vector<int> Index; // of the surface's pixels, by place
  std::vector<double> Guess;
  bool HasGuess = false;
  std::vector<double> Radiance;
  std::vector<char> IsKnown;   // integrated
  std::vector<char> IsGuessed; // in a cell that is interpolated
  tool::ProgressBar Bar{ "integrating" };
  double Done = 0.0; // share of all work
  tool::ReferenceSample Sample;
  bool EvaluatesMany = false; // lights at once
  bool InBlocks = false;      // all pixels are integrated, each with its neighbors
};
}

//------------------------------------------------------------------------------
ReferencePicture DrawReference(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface,
  const Size& size, const ShowReference& show)
{
  if (surface.Stride > 1)
  {
    ReferencePicture some;
    some.Radiance = IntegrateReference(brdf, environment, surface);
    return some;
  }
  Refinement refinement(brdf, environment, surface, size, show);
  ReferencePicture picture;
  if (refinement.ChooseTolerance())
  {
    refinement.RunAll();
    refinement.Check(picture);
    return picture;
  }
  refinement.MakeGuess();
  for (int stride = surface.Pixels.size() < FewestPixels ? 1 : CoarsestStride; stride > 0;
       stride /= 2)
  {
    refinement.Run(stride);
    refinement.Check(picture);
    if (picture.Within >= EnoughWithin && picture.WithinBetween >= EnoughBetween)
    {
      break;
    }
  }
  return picture;
}

namespace
{
constexpr std::size_t TimedPixels = 64;
}

//------------------------------------------------------------------------------
double EstimateReferenceSeconds(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface)
{
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(brdf);
  reference->SetEnvironment(environment);
  reference->Prepare();
  const std::size_t count = surface.Pixels.size();
  std::vector<int> pixels;
  for (std::size_t k = 0; k < TimedPixels; ++k)
  {
    pixels.push_back(static_cast<int>((2 * k + 1) * count / (2 * TimedPixels)));
  }
  const auto begin = std::chrono::steady_clock::now();
  IntegratePixels(reference, surface, pixels, [](double) {});
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  return seconds.count() * static_cast<double>(count) / TimedPixels;
}

//------------------------------------------------------------------------------
int LimitReference(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface,
  double seconds, const std::string& option)
{
  const auto count = static_cast<double>(surface.Pixels.size());
  const double needed = seconds > 0.0 ? EstimateReferenceSeconds(brdf, environment, surface) : 0.0;
  if (needed <= seconds)
  {
    return static_cast<int>(count);
  }
  const int affordable = std::max(1, static_cast<int>(count * seconds / needed));
  char text[200];
  std::snprintf(text, sizeof(text),
    "The reference of %.0f pixels may take %.2g s, more than %s %g: at most %d pixels on a grid "
    "are "
    "compared.\n",
    count, needed, option.c_str(), seconds, affordable);
  PrintOut(text);
  return affordable;
}
} // namespace tool
