// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaterialMapFitter.h"

#include "NumberText.h"
#include "ParallelFor.h"
#include "PhotographFit.h"
#include "Printable.h"
#include "Setters.h"
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
#include <stdexcept>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkMaterialMapFitter);

namespace
{
constexpr double Alike = 1e-3;             // relative difference of materials that are the same
constexpr double UncertainWeight = 0.1;    // standard deviation that is reported
constexpr double PureWeight = 0.9;         // a found material should have it somewhere
constexpr double UsualBrightness = 0.05;   // deviation from 1 that needs no word
constexpr std::size_t MostLookalikes = 10; // that are listed
constexpr std::size_t MostComponents = 4;  // of a weight image

double GetDifference(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
  const double size = std::max(a.norm(), b.norm());
  return size > 0.0 ? (a - b).norm() / size : 0.0;
}

vtkSmartPointer<vtkImageData> NewImage(int width, int height, std::size_t components)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_FLOAT, static_cast<int>(components));
  return image;
}

// count of the texels, one at random in each of as many equal parts of the picture.
std::vector<std::size_t> DrawSample(std::size_t texels, int count, unsigned int seed)
{
  std::vector<std::size_t> sample(std::min(texels, static_cast<std::size_t>(count)));
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
}

//------------------------------------------------------------------------------
// A fit while it runs.
struct vtkMaterialMapFitter::Run : Figures
{
  vtkMaterialMapFitter* Fitter;
  PhotographPasses Passes;
  std::vector<NamedMaterial> Map; // the result's materials
  MaterialValues Values;          // of these
  MaterialValues LibraryValues;
  std::vector<int> Chosen;    // the materials in the library
  std::vector<float> Weights; // [texel][material]; 0 where a texel has no valid photograph
  std::vector<float> Errors;  // of each texel, relative; -1 there
  std::size_t Worst = 0;      // texel
  double Residual = 0.0;      // sum of squares over all texels
  double Samples = 0.0;       // valid values of all texels
  double Texels = 0.0;        // that have a valid photograph
  double Cross = 0.0;         // sum over all pixels of data times model
  double Model = 0.0;         // and of the model's squares

  // Throws MapFitStopped and std::runtime_error.
  explicit Run(vtkMaterialMapFitter* fitter)
    : Fitter(fitter)
    , Passes(fitter->Photographs,
        [fitter](double share)
        {
          fitter->InvokeEvent(vtkCommand::ProgressEvent, &share);
          return !fitter->Abort;
        })
  {
    const bool isLibrary = fitter->Method == LIBRARY;
    isLibrary ? this->ChooseMaterials() : this->FindTables();
    this->SolveAll(isLibrary ? 0.5 : 0.6);
    const auto count = [this](PixelState state)
    { return static_cast<vtkIdType>(this->Passes.PixelCounts[static_cast<std::size_t>(state)]); };
    this->SaturatedPixels = count(PixelState::Saturated);
    this->BlackPixels = count(PixelState::Black);
    this->InvalidPixels = count(PixelState::Invalid);
    this->Summarize();
    this->Passes.Proceed(1.0);
    this->FindLookalikes();
    this->FindUncertainties();
  }

  std::size_t GetNumberOfTexels() const
  {
    return static_cast<std::size_t>(this->Passes.Width) *
           static_cast<std::size_t>(this->Passes.Height);
  }

  std::vector<std::size_t> GetSample() const
  {
    return DrawSample(
      this->GetNumberOfTexels(), this->Fitter->NumberOfSampleTexels, this->Fitter->Seed);
  }

  // From a library to a few of its materials.
  void ChooseMaterials()
  {
    const auto& library = this->Fitter->Library;
    this->LibraryValues = EvaluateMaterials(this->Fitter->Photographs, library, {});
    TexelSums sums(this->LibraryValues, this->GetSample());
    this->Passes.Run(
      0.0, 0.35, [&](int k, const PhotographPixels& pixels) { sums.Add(k, pixels); });
    this->Chosen = SelectMaterials(sums, this->Fitter->MaximumNumberOfMaterials,
      this->Fitter->Tolerance, [&](double share) { this->Passes.Proceed(0.35 + 0.15 * share); });
    if (this->Chosen.empty())
    {
      throw std::runtime_error("no pixel is valid: all are saturated, black or not finite");
    }
    for (const int k : this->Chosen)
    {
      this->Map.push_back(library[static_cast<std::size_t>(k)]);
    }
    this->Values = { this->LibraryValues.Values(
                       Eigen::seqN(0, this->LibraryValues.Values.rows()), this->Chosen),
      this->LibraryValues.Scales };
    this->Converged = true;
  }

  // New materials from the photographs.
  void FindTables()
  {
    const int* size = this->Fitter->TableDimensions;
    const TableOptions options = { this->Fitter->MaximumNumberOfMaterials, this->Fitter->Seed,
      this->Fitter->Smoothness, { size[0], size[1], size[2] } };
    const TableMaterials tables =
      FindTableMaterials(this->Fitter->Photographs, options, this->Passes, this->GetSample());
    this->Map = tables.Materials;
    this->FactorizationError = tables.FactorError;
    this->Iterations = tables.Iterations;
    this->Converged = tables.Converged;
    this->SeenShare = tables.SeenShare;
    this->Values = EvaluateMaterials(this->Fitter->Photographs, tables.Materials, tables.Scales);
  }

  // Weights of all texels.
  void SolveAll(double start)
  {
    const std::size_t materials = this->Map.size();
    std::vector<std::size_t> numbers(this->GetNumberOfTexels());
    std::iota(numbers.begin(), numbers.end(), 0);
    this->Weights.assign(materials * numbers.size(), 0.0f);
    this->Errors.assign(numbers.size(), -1.0f);
    TexelSums sums(this->Values, std::move(numbers));
    this->Passes.Run(start, 0.9 + 0.1 * start,
      [&](int k, const PhotographPixels& pixels) { sums.Add(k, pixels); });
    std::vector<int> columns(materials);
    std::iota(columns.begin(), columns.end(), 0);
    std::vector<Eigen::Array3d> found(this->Errors.size(), Eigen::Array3d::Zero());
    ParallelForEach(
      this->Errors.size(),
      [&](std::size_t k)
      {
        const WeightSolution solution = SolveTexel(sums, k, columns);
        std::transform(solution.Weights.begin(), solution.Weights.end(),
          &this->Weights[materials * k], [](double w) { return static_cast<float>(w); });
        if (sums.GetNumberOfPhotographs(k) > 0)
        {
          const double squares = sums.GetSquares(k);
          const double cross = sums.GetRight(k, columns).dot(solution.Weights);
          this->Errors[k] =
            static_cast<float>(std::sqrt(solution.Residual / (squares > 0.0 ? squares : 1.0)));
          found[k] << solution.Residual, cross, solution.Residual - squares + 2.0 * cross;
        }
      },
      nullptr, 0);
    for (std::size_t k = 0; k < found.size(); ++k) // in one order on any number of threads
    {
      this->Residual += found[k][0];
      this->Cross += found[k][1];
      this->Model += found[k][2];
      this->Samples += 3.0 * static_cast<double>(sums.GetNumberOfPhotographs(k));
      this->Texels += sums.GetNumberOfPhotographs(k) > 0 ? 1.0 : 0.0;
    }
  }

  // Errors of the texels, and what is known of each material.
  void Summarize()
  {
    const std::size_t materials = this->Map.size();
    this->Materials.resize(materials);
    std::vector<float> errors;
    for (std::size_t texel = 0; texel < this->Errors.size(); ++texel)
    {
      const float error = this->Errors[texel];
      if (error < 0.0f)
      {
        continue;
      }
      errors.push_back(error);
      if (error > this->WorstError)
      {
        this->WorstError = error;
        this->Worst = texel;
      }
      for (std::size_t m = 0; m < materials; ++m)
      {
        const double weight = this->Weights[materials * texel + m];
        MaterialFigures& material = this->Materials[m];
        material.Coverage += weight / this->Texels;
        material.LargestWeight = std::max(material.LargestWeight, weight);
      }
    }
    this->TexelsWithoutData = static_cast<vtkIdType>(this->Errors.size() - errors.size());
    if (errors.empty())
    {
      return;
    }
    const auto count = static_cast<double>(errors.size());
    this->MeanError = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
    const auto rank = errors.begin() + static_cast<std::ptrdiff_t>(std::ceil(0.95 * count)) - 1;
    std::nth_element(errors.begin(), rank, errors.end());
    this->Error95 = *rank;

    // Standard deviation of each material's weight in a texel that all photographs see, where no
    // weight is 0: the residual's variance, propagated. Infinite where the photographs do not tell.
    const SmallVector variances =
      GetShareVariances(this->Values.Values.transpose() * this->Values.Values);
    const double unknowns = static_cast<double>(materials - 1) * this->Texels;
    const double freedom = std::max(this->Samples - unknowns, 1.0);
    for (std::size_t m = 0; m < materials; ++m)
    {
      const double variance = variances[static_cast<Eigen::Index>(m)];
      this->Materials[m].Uncertainty =
        std::isinf(variance) ? variance : std::sqrt(this->Residual / freedom * variance);
    }
  }

  void FindLookalikes()
  {
    std::vector<std::string> pairs;
    for (std::size_t a = 0; a < this->Map.size(); ++a)
    {
      const auto add = [&](const NamedMaterial& other, const Eigen::MatrixXd& values, std::size_t b,
                         const char* before, const char* after, const char* end)
      {
        const double difference =
          GetDifference(this->Values.Values.col(static_cast<Eigen::Index>(a)),
            values.col(static_cast<Eigen::Index>(b)));
        if (difference < Alike)
        {
          pairs.push_back("'" + this->Map[a].second + "' " + before + " '" + other.second + "'" +
                          after + NumberText(100.0 * difference, 2) + " %" + end);
        }
      };
      for (std::size_t b = a + 1; b < this->Map.size(); ++b)
      {
        add(this->Map[b], this->Values.Values, b, "and",
          " are the same in these photographs (difference ",
          "): only the sum of their weights is known");
      }
      for (std::size_t b = 0; !this->Chosen.empty() && b < this->Fitter->Library.size(); ++b)
      {
        if (std::find(this->Chosen.begin(), this->Chosen.end(), static_cast<int>(b)) ==
            this->Chosen.end())
        {
          add(this->Fitter->Library[b], this->LibraryValues.Values, b, "could as well be",
            ": in these photographs they differ by ", "");
        }
      }
    }
    const std::size_t listed = std::min(pairs.size(), MostLookalikes);
    this->Findings.assign(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(listed));
    if (listed < pairs.size())
    {
      this->Findings.push_back("and " + std::to_string(pairs.size() - listed) +
                               " more pairs of materials that look alike");
    }
  }

  void FindUncertainties()
  {
    for (std::size_t m = 0; m < this->Map.size(); ++m)
    {
      const MaterialFigures& material = this->Materials[m];
      const std::string name = "'" + this->Map[m].second + "'";
      if (std::isinf(material.Uncertainty))
      {
        this->Findings.push_back(
          "the weights of " + name + " are not determined by these photographs");
      }
      else if (material.Uncertainty > UncertainWeight)
      {
        this->Findings.push_back("the weights of " + name + " are uncertain by " +
                                 NumberText(material.Uncertainty, 2) + " (standard deviation)");
      }
      if (this->Chosen.empty() && material.LargestWeight < PureWeight)
      {
        this->Findings.push_back("no place is of " + name + " alone (at most " +
                                 NumberText(material.LargestWeight, 2) +
                                 "): what it looks like alone is extrapolated");
      }
    }
    const double brightness = this->Model > 0.0 ? this->Cross / this->Model : 1.0;
    if (std::abs(brightness - 1.0) > UsualBrightness)
    {
      this->Findings.push_back("with all materials times " + NumberText(brightness, 3) +
                               " the photographs would fit better: check irradiance and exposures, "
                               "or the library lacks a material");
    }
  }

  vtkSmartPointer<vtkMaterialMap> MakeMap() const
  {
    auto map = vtkSmartPointer<vtkMaterialMap>::New();
    map->SetModeToTextures();
    const std::size_t materials = this->Map.size();
    for (const auto& [brdf, name] : this->Map)
    {
      map->AddMaterial(brdf, name);
    }
    for (std::size_t first = 0; first < materials; first += MostComponents)
    {
      const std::size_t components = std::min(MostComponents, materials - first);
      const auto image = NewImage(this->Passes.Width, this->Passes.Height, components);
      auto* values = static_cast<float*>(image->GetScalarPointer());
      for (std::size_t at = first; at < this->Weights.size(); at += materials)
      {
        values = std::copy_n(&this->Weights[at], components, values);
      }
      map->AddWeightImage(image);
    }
    return map;
  }
};

//------------------------------------------------------------------------------
vtkMaterialMapFitter::vtkMaterialMapFitter() = default;

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
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, Smoothness, double, 1e-8, 1e4);
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, NumberOfSampleTexels, int, 64, 1 << 20);

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
  try
  {
    Run run(this);
    this->Output = run.MakeMap();
    this->ErrorImage = NewImage(run.Passes.Width, run.Passes.Height, 1);
    std::copy(run.Errors.begin(), run.Errors.end(),
      static_cast<float*>(this->ErrorImage->GetScalarPointer()));
    this->WorstTexel[0] = static_cast<int>(run.Worst) % run.Passes.Width;
    this->WorstTexel[1] = static_cast<int>(run.Worst) / run.Passes.Width;
    this->Found = run;
    return true;
  }
  catch (const MapFitStopped&)
  {
    return false;
  }
  catch (const std::exception& error) // for lack of memory, too
  {
    vtkErrorMacro("Fit: " << ToPrintable(error.what()) << ".");
    return false;
  }
}

//------------------------------------------------------------------------------
std::string vtkMaterialMapFitter::GetFinding(int index)
{
  return index >= 0 && index < this->GetNumberOfFindings()
           ? this->Found.Findings[static_cast<std::size_t>(index)]
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
  os << indent << "Smoothness: " << this->Smoothness << "\n";
  os << indent << "TableDimensions: " << this->TableDimensions[0] << " " << this->TableDimensions[1]
     << " " << this->TableDimensions[2] << "\n";
  os << indent << "NumberOfSampleTexels: " << this->NumberOfSampleTexels << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
  os << indent << "MeanError: " << this->GetMeanError() << "\n";
  os << indent << "WorstTexel: " << this->WorstTexel[0] << " " << this->WorstTexel[1] << "\n";
  os << indent << "NumberOfFindings: " << this->GetNumberOfFindings() << "\n";
}
