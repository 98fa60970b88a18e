// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialMapFit.h"

#include "NumberText.h"
#include "ParallelFor.h"
#include "TableMaterials.h"
#include "TexelWeights.h"
#include "vtkPhotographSet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace measuredbrdf
{
namespace
{
constexpr double Alike = 1e-3;             // relative difference of materials that are the same
constexpr double UncertainWeight = 0.1;    // standard deviation that is reported
constexpr double PureWeight = 0.9;         // a found material should have it somewhere
constexpr double UsualBrightness = 0.05;   // deviation from 1 that needs no word
constexpr std::size_t MostLookalikes = 10; // that are listed

std::string FormatPercent(double share) { return NumberText(100.0 * share, 2) + " %"; }

double GetDifference(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
  const double size = std::max(a.norm(), b.norm());
  return size > 0.0 ? (a - b).norm() / size : 0.0;
}

struct IdentityFacts
{
  Eigen::MatrixXd Values; // of the result's materials: MaterialValues::Values
  double Residual = 0.0;  // sum of squares over all texels
  double Samples = 0.0;   // valid values of all texels
  double Texels = 0.0;    // that have a valid photograph
  // Of a library only:
  const std::vector<NamedMaterial>* Library = nullptr;
  Eigen::MatrixXd LibraryValues;
  std::vector<int> Chosen; // the result's materials in it
};

void FindLookalikes(
  const IdentityFacts& facts, const MapFitResult& result, std::vector<std::string>& findings)
{
  std::vector<std::string> pairs;
  for (Eigen::Index a = 0; a < facts.Values.cols(); ++a)
  {
    const std::string& name = result.Materials[static_cast<std::size_t>(a)].Material.Name;
    for (Eigen::Index b = a + 1; b < facts.Values.cols(); ++b)
    {
      const double difference = GetDifference(facts.Values.col(a), facts.Values.col(b));
      if (difference < Alike)
      {
        pairs.push_back("'" + name + "' and '" +
                        result.Materials[static_cast<std::size_t>(b)].Material.Name +
                        "' are the same in these photographs (difference " +
                        FormatPercent(difference) + "): only the sum of their weights is known");
      }
    }
    for (Eigen::Index b = 0; facts.Library && b < facts.LibraryValues.cols(); ++b)
    {
      const double difference = GetDifference(facts.Values.col(a), facts.LibraryValues.col(b));
      if (difference < Alike &&
          std::find(facts.Chosen.begin(), facts.Chosen.end(), b) == facts.Chosen.end())
      {
        pairs.push_back("'" + name + "' could as well be '" +
                        (*facts.Library)[static_cast<std::size_t>(b)].Name +
                        "': in these photographs they differ by " + FormatPercent(difference));
      }
    }
  }
  const std::size_t listed = std::min(pairs.size(), MostLookalikes);
  findings.insert(
    findings.end(), pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(listed));
  if (listed < pairs.size())
  {
    findings.push_back(
      "and " + std::to_string(pairs.size() - listed) + " more pairs of materials that look alike");
  }
}

// Standard deviation of each material's weight in a texel that all photographs see, where no weight
// is 0: the residual's variance, propagated. Infinite where the photographs do not tell.
std::vector<double> GetWeightUncertainties(const IdentityFacts& facts)
{
  const SmallMatrix matrix = facts.Values.transpose() * facts.Values;
  const SmallVector variances = GetShareVariances(matrix);
  const double unknowns = static_cast<double>(facts.Values.cols() - 1) * facts.Texels;
  const double freedom = std::max(facts.Samples - unknowns, 1.0);
  std::vector<double> uncertainties;
  for (Eigen::Index k = 0; k < variances.size(); ++k)
  {
    uncertainties.push_back(std::isinf(variances[k])
                              ? std::numeric_limits<double>::infinity()
                              : std::sqrt(facts.Residual / freedom * variances[k]));
  }
  return uncertainties;
}

// What the photographs leave open, for people, a sentence each.
std::vector<std::string> FindIdentityProblems(
  const IdentityFacts& facts, const MapFitResult& result)
{
  std::vector<std::string> findings;
  FindLookalikes(facts, result, findings);
  for (const MapMaterial& material : result.Materials)
  {
    TextStream text;
    text.precision(2);
    if (std::isinf(material.Uncertainty))
    {
      text << "the weights of '" << material.Material.Name
           << "' are not determined by these photographs";
    }
    else if (material.Uncertainty > UncertainWeight)
    {
      text << "the weights of '" << material.Material.Name << "' are uncertain by "
           << material.Uncertainty << " (standard deviation)";
    }
    if (!text.str().empty())
    {
      findings.push_back(text.str());
    }
    if (!facts.Library && material.LargestWeight < PureWeight)
    {
      TextStream pure;
      pure.precision(2);
      pure << "no place is of '" << material.Material.Name << "' alone (at most "
           << material.LargestWeight << "): what it looks like alone is extrapolated";
      findings.push_back(pure.str());
    }
  }
  if (std::abs(result.Brightness - 1.0) > UsualBrightness)
  {
    TextStream text;
    text.precision(3);
    text << "with all materials times " << result.Brightness
         << " the photographs would fit better: check irradiance and exposures, or the library "
            "lacks a material";
    findings.push_back(text.str());
  }
  return findings;
}

// count of the texels, one at random in each of as many equal parts of the picture.
std::vector<std::size_t> DrawSample(std::size_t texels, std::size_t count, unsigned int seed)
{
  std::vector<std::size_t> sample(std::min(texels, count));
  std::mt19937 random(seed);
  for (std::size_t k = 0; k < sample.size(); ++k)
  {
    const double place = static_cast<double>(k) + static_cast<double>(random()) * 0x1p-32;
    const double share = place / static_cast<double>(sample.size());
    sample[k] =
      sample.size() == texels
        ? k
        : std::min(static_cast<std::size_t>(share * static_cast<double>(texels)), texels - 1);
  }
  return sample;
}

class MapFit
{
public:
  MapFit(vtkPhotographSet* photographs, const MapFitOptions& options)
    : Photographs(photographs)
    , Options(options)
    , Passes(photographs, options.Proceed)
  {
  }

  MapFitResult Run()
  {
    try
    {
      this->Passes.Open();
      this->Result.Width = this->Passes.GetWidth();
      this->Result.Height = this->Passes.GetHeight();
      const bool found = this->Options.FindsTables ? this->FindTables() : this->ChooseMaterials();
      if (found && this->SolveAll())
      {
        this->Passes.Proceed(1.0);
        this->Result.Findings = FindIdentityProblems(this->Facts, this->Result);
      }
    }
    catch (const PhotographError& error)
    {
      this->Result.Problem = error.what();
    }
    this->Result.Stopped = this->Passes.IsStopped();
    this->Result.PixelCounts = this->Passes.GetPixelCounts();
    this->Result.Passes = this->Passes.GetNumberOfPasses();
    return this->Result;
  }

private:
  std::size_t GetNumberOfTexels() const
  {
    return static_cast<std::size_t>(this->Result.Width) *
           static_cast<std::size_t>(this->Result.Height);
  }

  // As many texels as the memory holds, at most SampleTexels.
  std::vector<std::size_t> GetSample(std::size_t bytesPerTexel) const
  {
    const std::size_t fit = std::max<std::size_t>(this->Options.MemoryBytes / bytesPerTexel, 1);
    return DrawSample(this->GetNumberOfTexels(),
      std::min(fit, static_cast<std::size_t>(this->Options.SampleTexels)), this->Options.Seed);
  }

  // From a library to a few of its materials.
  bool ChooseMaterials()
  {
    const MaterialValues all = EvaluateMaterials(this->Photographs, this->Options.Library, {});
    const int photographs = all.GetNumberOfPhotographs();
    TexelSums sums(
      all, this->GetSample(TexelSums::GetBytesPerTexel(all.GetNumberOfMaterials(), photographs)));
    if (!this->Passes.Run(
          0.0, 0.35, [&](int k, const PhotographPixels& pixels) { sums.Add(k, pixels); }))
    {
      return false;
    }
    SelectionOptions selection;
    selection.Most = this->Options.Most;
    selection.Tolerance = this->Options.Tolerance;
    selection.Proceed = [&](double share) { return this->Passes.Proceed(0.35 + 0.15 * share); };
    const std::vector<int> chosen = SelectMaterials(sums, selection);
    if (chosen.empty())
    {
      this->Result.Problem =
        this->Passes.IsStopped() ? "" : "no pixel is valid: all are saturated, black or not finite";
      return false;
    }
    for (const int k : chosen)
    {
      MapMaterial material;
      material.Material = this->Options.Library[static_cast<std::size_t>(k)];
      this->Result.Materials.push_back(material);
    }
    this->Values = all.Select(chosen);
    this->Facts.Library = &this->Options.Library;
    this->Facts.LibraryValues = all.Values;
    this->Facts.Chosen = chosen;
    return true;
  }

  // New materials from the photographs.
  bool FindTables()
  {
    const auto photographs = static_cast<std::size_t>(this->Photographs->GetNumberOfPhotographs());
    // The factorization keeps the sample twice, as floats.
    const std::vector<std::size_t> sample = this->GetSample(photographs * 25);
    TableMaterials tables(this->Photographs, this->Options, sample.size());
    if (!this->Passes.Run(
          0.0, 0.3, [&](int k, const PhotographPixels& pixels) { tables.Add(k, pixels, sample); }))
    {
      return false;
    }
    const auto proceed = [this](double share) { return this->Passes.Proceed(0.3 + 0.3 * share); };
    this->Result.Problem = tables.Find(proceed);
    if (!this->Result.Problem.empty() || this->Passes.IsStopped())
    {
      return false;
    }
    for (const NamedMaterial& found : tables.GetMaterials())
    {
      MapMaterial material;
      material.Material = found;
      this->Result.Materials.push_back(material);
    }
    this->Result.FactorError = tables.GetFactorization().RelativeError;
    this->Result.Iterations = tables.GetFactorization().Iterations;
    this->Result.Converged = tables.GetFactorization().Converged;
    this->Result.SeenShare = tables.GetSeenShare();
    this->Values = EvaluateMaterials(this->Photographs, tables.GetMaterials(), tables.GetScales());
    return true;
  }

  // Weights of all texels, band by band: as many texels at once as the memory holds.
  bool SolveAll()
  {
    const std::size_t texels = this->GetNumberOfTexels();
    const auto materials = static_cast<std::size_t>(this->Values.GetNumberOfMaterials());
    this->Result.Weights.assign(materials * texels, 0.0f);
    this->Result.Errors.assign(texels, -1.0f);
    const std::size_t bytes = TexelSums::GetBytesPerTexel(this->Values.GetNumberOfMaterials(),
                                this->Values.GetNumberOfPhotographs()) +
                              sizeof(double) * 4;
    const std::size_t band = std::clamp<std::size_t>(this->Options.MemoryBytes / bytes, 1, texels);
    const std::size_t bands = (texels + band - 1) / band;
    const double start = this->Options.FindsTables ? 0.6 : 0.5;
    for (std::size_t b = 0; b < bands; ++b)
    {
      std::vector<std::size_t> numbers(std::min(band, texels - b * band));
      std::iota(numbers.begin(), numbers.end(), b * band);
      TexelSums sums(this->Values, std::move(numbers));
      const double from =
        start + (1.0 - start) * static_cast<double>(b) / static_cast<double>(bands);
      const double to =
        start + (1.0 - start) * (static_cast<double>(b) + 0.9) / static_cast<double>(bands);
      if (!this->Passes.Run(
            from, to, [&](int k, const PhotographPixels& pixels) { sums.Add(k, pixels); }))
      {
        return false;
      }
      this->SolveBand(sums);
    }
    this->Summarize();
    return true;
  }

  void SolveBand(const TexelSums& sums)
  {
    const auto materials = static_cast<std::size_t>(this->Values.GetNumberOfMaterials());
    std::vector<int> columns(materials);
    std::iota(columns.begin(), columns.end(), 0);
    struct Sums
    {
      double Residual, Cross, Model;
    };
    std::vector<Sums> found(sums.GetNumberOfTexels(), Sums{ 0.0, 0.0, 0.0 });
    measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(found.size()),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
        {
          const WeightSolution solution = SolveTexel(sums, k, columns);
          const std::size_t texel = sums.GetTexel(k);
          for (std::size_t m = 0; m < materials; ++m)
          {
            this->Result.Weights[materials * texel + m] =
              static_cast<float>(solution.Weights[static_cast<Eigen::Index>(m)]);
          }
          if (sums.GetNumberOfPhotographs(k) > 0)
          {
            const double squares = sums.GetSquares(k);
            this->Result.Errors[texel] =
              static_cast<float>(squares > 0.0 ? std::sqrt(solution.Residual / squares)
                                               : std::sqrt(solution.Residual));
            const double cross = sums.GetRight(k, columns).dot(solution.Weights);
            found[k] = { solution.Residual, cross, solution.Residual - squares + 2.0 * cross };
          }
        }
      });
    for (std::size_t k = 0; k < found.size(); ++k) // in one order on any number of threads
    {
      this->Facts.Residual += found[k].Residual;
      this->Cross += found[k].Cross;
      this->Model += found[k].Model;
      this->Facts.Samples += 3.0 * sums.GetNumberOfPhotographs(k);
      this->Facts.Texels += sums.GetNumberOfPhotographs(k) > 0 ? 1.0 : 0.0;
    }
  }

  void Summarize()
  {
    const std::size_t materials = this->Result.Materials.size();
    std::vector<float> errors;
    double sum = 0.0;
    for (std::size_t texel = 0; texel < this->Result.Errors.size(); ++texel)
    {
      const float error = this->Result.Errors[texel];
      if (error < 0.0f)
      {
        continue;
      }
      errors.push_back(error);
      sum += error;
      if (error > this->Result.WorstError)
      {
        this->Result.WorstError = error;
        this->Result.WorstTexel = texel;
      }
      for (std::size_t m = 0; m < materials; ++m)
      {
        const double weight = this->Result.Weights[materials * texel + m];
        MapMaterial& material = this->Result.Materials[m];
        material.Coverage += weight;
        material.LargestWeight = std::max(material.LargestWeight, weight);
      }
    }
    this->Result.TexelsWithoutData = this->Result.Errors.size() - errors.size();
    if (errors.empty())
    {
      return;
    }
    for (MapMaterial& material : this->Result.Materials)
    {
      material.Coverage /= static_cast<double>(errors.size());
    }
    this->Result.MeanError = sum / static_cast<double>(errors.size());
    const auto rank =
      static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(errors.size())) - 1.0);
    std::nth_element(
      errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(rank), errors.end());
    this->Result.Error95 = errors[rank];
    this->Result.Brightness = this->Model > 0.0 ? this->Cross / this->Model : 1.0;
    this->Facts.Values = this->Values.Values;
    const std::vector<double> uncertainties = GetWeightUncertainties(this->Facts);
    for (std::size_t m = 0; m < materials; ++m)
    {
      this->Result.Materials[m].Uncertainty = uncertainties[m];
    }
  }

  vtkPhotographSet* Photographs;
  const MapFitOptions& Options;
  PhotographPasses Passes;
  MaterialValues Values;
  IdentityFacts Facts;
  double Cross = 0.0; // sum over all pixels of data times model
  double Model = 0.0; // and of the model's squares
  MapFitResult Result;
};
}

MapFitResult FitMaterialMap(vtkPhotographSet* photographs, const MapFitOptions& options)
{
  return MapFit(photographs, options).Run();
}
} // namespace measuredbrdf
