// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaterialMapFitter.h"

#include "NumberText.h"
#include "ParallelFor.h"
#include "PhotographPasses.h"
#include "Printable.h"
#include "Setters.h"
#include "TableMaterials.h"
#include "TexelWeights.h"
#include "vtkBRDF.h"
#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkObjectFactory.h"
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
} // namespace measuredbrdf

using namespace measuredbrdf;

vtkStandardNewMacro(vtkMaterialMapFitter);

namespace
{
constexpr int MostComponents = 4; // of a weight image

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> NewImage(int width, int height, int components)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_FLOAT, components);
  return image;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkMaterialMap> MakeMap(const MapFitResult& result)
{
  auto map = vtkSmartPointer<vtkMaterialMap>::New();
  map->SetModeToTextures();
  const int materials = static_cast<int>(result.Materials.size());
  for (const MapMaterial& material : result.Materials)
  {
    map->AddMaterial(material.Material.BRDF, material.Material.Name);
  }
  for (int first = 0; first < materials; first += MostComponents)
  {
    const int components = std::min(MostComponents, materials - first);
    const auto image = NewImage(result.Width, result.Height, components);
    auto* values = static_cast<float*>(image->GetScalarPointer());
    for (std::size_t texel = 0; texel < result.Errors.size(); ++texel)
    {
      const float* weights = &result.Weights[texel * static_cast<std::size_t>(materials)];
      values = std::copy_n(weights + first, components, values);
    }
    map->AddWeightImage(image);
  }
  return map;
}
}

//------------------------------------------------------------------------------
struct vtkMaterialMapFitter::Results : MapFitResult
{
  Results() { this->Converged = false; } // before the first Fit

  vtkIdType Count(PixelState state) const
  {
    return static_cast<vtkIdType>(this->PixelCounts[static_cast<std::size_t>(state)]);
  }

  // Of a material; zeros where there is none of that number.
  MapMaterial Get(int material) const
  {
    const bool exists =
      material >= 0 && static_cast<std::size_t>(material) < this->Materials.size();
    return exists ? this->Materials[static_cast<std::size_t>(material)] : MapMaterial();
  }
};

//------------------------------------------------------------------------------
vtkMaterialMapFitter::vtkMaterialMapFitter()
  : Found(new Results)
{
}

//------------------------------------------------------------------------------
vtkMaterialMapFitter::~vtkMaterialMapFitter() = default;

//------------------------------------------------------------------------------
void vtkMaterialMapFitter::SetPhotographs(vtkPhotographSet* photographs)
{
  measuredbrdfAssignMacro(Photographs, photographs);
}

//------------------------------------------------------------------------------
vtkPhotographSet* vtkMaterialMapFitter::GetPhotographs() { return this->Photographs; }
vtkMaterialMap* vtkMaterialMapFitter::GetOutput() { return this->Output; }
vtkImageData* vtkMaterialMapFitter::GetErrorImage() { return this->ErrorImage; }

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkMaterialMapFitter, Method, int, LIBRARY, TABLES);
measuredbrdfSetInRangeMacro(vtkMaterialMapFitter, MaximumNumberOfMaterials, int, 1, 32);
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, Tolerance, double, 0.0, 1.0);
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, Compactness, double, 0.0, 1.0);
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, Smoothness, double, 1e-8, 1e4);
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, NumberOfSampleTexels, int, 64, 1 << 20);
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, MemoryLimit, int, 1, 1 << 20);

//------------------------------------------------------------------------------
void vtkMaterialMapFitter::SetTableDimensions(int phiD, int thetaD, int thetaH)
{
  constexpr int least = 4, most = 90;
  const int given[3] = { phiD, thetaD, thetaH };
  int taken[3];
  std::transform(
    given, given + 3, taken, [&](int value) { return std::clamp(value, least, most); });
  if (!std::equal(given, given + 3, taken))
  {
    vtkWarningMacro("SetTableDimensions: " << phiD << ", " << thetaD << ", " << thetaH
                                           << " are not all from " << least << " to " << most
                                           << "; " << taken[0] << ", " << taken[1] << ", "
                                           << taken[2] << " are taken.");
  }
  if (!std::equal(taken, taken + 3, this->TableDimensions))
  {
    std::copy_n(taken, 3, this->TableDimensions);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkMaterialMapFitter::AddMaterial(vtkBRDF* brdf, const std::string& name)
{
  if (!brdf || this->GetNumberOfLibraryMaterials() >= MaximumLibrarySize)
  {
    vtkErrorMacro("AddMaterial: " << (brdf ? "there are " + std::to_string(MaximumLibrarySize) +
                                               " materials, the most"
                                           : std::string("found null, expected a material"))
                                  << ".");
    return;
  }
  this->Library.push_back({ brdf, name });
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkMaterialMapFitter::RemoveAllMaterials()
{
  this->Library.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkMaterialMapFitter::Fit()
{
  if (!this->Photographs || this->Photographs->GetNumberOfPhotographs() == 0)
  {
    vtkErrorMacro("Fit: no photographs.");
    return false;
  }
  if (this->Method == LIBRARY && this->Library.empty())
  {
    vtkErrorMacro("Fit: no material in the library.");
    return false;
  }
  this->Abort = false;
  MapFitOptions options;
  options.FindsTables = this->Method == TABLES;
  for (const auto& [brdf, name] : this->Library)
  {
    options.Library.push_back({ brdf, name });
  }
  options.Most = this->MaximumNumberOfMaterials;
  options.Tolerance = this->Tolerance;
  options.Compactness = this->Compactness;
  options.Smoothness = this->Smoothness;
  std::copy_n(this->TableDimensions, 3, options.TableDimensions.begin());
  options.SampleTexels = this->NumberOfSampleTexels;
  options.MemoryBytes = static_cast<std::size_t>(this->MemoryLimit) << 20;
  options.Seed = this->Seed;
  options.Proceed = [this](double share)
  {
    this->InvokeEvent(vtkCommand::ProgressEvent, &share);
    return !this->Abort;
  };
  MapFitResult result = MapFit(this->Photographs, options).Run();
  if (result.Stopped)
  {
    return false;
  }
  if (!result.Problem.empty())
  {
    vtkErrorMacro("Fit: " << ToPrintable(result.Problem) << ".");
    return false;
  }
  this->Output = MakeMap(result);
  this->ErrorImage = NewImage(result.Width, result.Height, 1);
  std::copy(result.Errors.begin(), result.Errors.end(),
    static_cast<float*>(this->ErrorImage->GetScalarPointer()));
  this->WorstTexel[0] = static_cast<int>(result.WorstTexel) % result.Width;
  this->WorstTexel[1] = static_cast<int>(result.WorstTexel) / result.Width;
  result.Weights.clear(); // they are in the images
  result.Errors.clear();
  static_cast<MapFitResult&>(*this->Found) = std::move(result);
  return true;
}

//------------------------------------------------------------------------------
double vtkMaterialMapFitter::GetMeanError() { return this->Found->MeanError; }
double vtkMaterialMapFitter::GetError95() { return this->Found->Error95; }
double vtkMaterialMapFitter::GetWorstError() { return this->Found->WorstError; }
double vtkMaterialMapFitter::GetFactorizationError() { return this->Found->FactorError; }
double vtkMaterialMapFitter::GetSeenShare() { return this->Found->SeenShare; }
int vtkMaterialMapFitter::GetNumberOfIterations() { return this->Found->Iterations; }
bool vtkMaterialMapFitter::GetConverged() { return this->Found->Converged; }
int vtkMaterialMapFitter::GetNumberOfPasses() { return this->Found->Passes; }

//------------------------------------------------------------------------------
vtkIdType vtkMaterialMapFitter::GetNumberOfSaturatedPixels()
{
  return this->Found->Count(PixelState::Saturated);
}

//------------------------------------------------------------------------------
vtkIdType vtkMaterialMapFitter::GetNumberOfBlackPixels()
{
  return this->Found->Count(PixelState::Black);
}

//------------------------------------------------------------------------------
vtkIdType vtkMaterialMapFitter::GetNumberOfInvalidPixels()
{
  return this->Found->Count(PixelState::Invalid);
}

//------------------------------------------------------------------------------
vtkIdType vtkMaterialMapFitter::GetNumberOfTexelsWithoutData()
{
  return static_cast<vtkIdType>(this->Found->TexelsWithoutData);
}

//------------------------------------------------------------------------------
double vtkMaterialMapFitter::GetCoverage(int material)
{
  return this->Found->Get(material).Coverage;
}

//------------------------------------------------------------------------------
double vtkMaterialMapFitter::GetLargestWeight(int material)
{
  return this->Found->Get(material).LargestWeight;
}

//------------------------------------------------------------------------------
double vtkMaterialMapFitter::GetUncertainty(int material)
{
  return this->Found->Get(material).Uncertainty;
}

//------------------------------------------------------------------------------
int vtkMaterialMapFitter::GetNumberOfFindings()
{
  return static_cast<int>(this->Found->Findings.size());
}

//------------------------------------------------------------------------------
std::string vtkMaterialMapFitter::GetFinding(int index)
{
  return index >= 0 && index < this->GetNumberOfFindings()
           ? this->Found->Findings[static_cast<std::size_t>(index)]
           : std::string();
}

//------------------------------------------------------------------------------
void vtkMaterialMapFitter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Photographs: " << this->Photographs.Get() << "\n";
  os << indent << "Output: " << this->Output.Get() << "\n";
  os << indent << "ErrorImage: " << this->ErrorImage.Get() << "\n";
  os << indent << "Method: " << (this->Method == LIBRARY ? "LIBRARY" : "TABLES") << "\n";
  os << indent << "NumberOfLibraryMaterials: " << this->Library.size() << "\n";
  os << indent << "MaximumNumberOfMaterials: " << this->MaximumNumberOfMaterials << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Compactness: " << this->Compactness << "\n";
  os << indent << "Smoothness: " << this->Smoothness << "\n";
  os << indent << "TableDimensions: " << this->TableDimensions[0] << " " << this->TableDimensions[1]
     << " " << this->TableDimensions[2] << "\n";
  os << indent << "NumberOfSampleTexels: " << this->NumberOfSampleTexels << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
  os << indent << "MeanError: " << this->GetMeanError() << "\n";
  os << indent << "Error95: " << this->GetError95() << "\n";
  os << indent << "WorstError: " << this->GetWorstError() << "\n";
  os << indent << "WorstTexel: " << this->WorstTexel[0] << " " << this->WorstTexel[1] << "\n";
  os << indent << "NumberOfSaturatedPixels: " << this->GetNumberOfSaturatedPixels() << "\n";
  os << indent << "NumberOfBlackPixels: " << this->GetNumberOfBlackPixels() << "\n";
  os << indent << "NumberOfInvalidPixels: " << this->GetNumberOfInvalidPixels() << "\n";
  os << indent << "NumberOfTexelsWithoutData: " << this->GetNumberOfTexelsWithoutData() << "\n";
  os << indent << "FactorizationError: " << this->GetFactorizationError() << "\n";
  os << indent << "SeenShare: " << this->GetSeenShare() << "\n";
  os << indent << "NumberOfIterations: " << this->GetNumberOfIterations() << "\n";
  os << indent << "Converged: " << (this->GetConverged() ? "On" : "Off") << "\n";
  os << indent << "NumberOfPasses: " << this->GetNumberOfPasses() << "\n";
  os << indent << "NumberOfFindings: " << this->GetNumberOfFindings() << "\n";
}
