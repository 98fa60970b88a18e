// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFit.h"

#include "LitSphere.h"

#include "vtkMeasuredBRDFConfigure.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

#if MEASUREDBRDF_WITH_CERES
#include <ceres/ceres.h>
#endif

namespace tool
{
//------------------------------------------------------------------------------
double GetMeanError(
  const std::vector<double>& radiance, const std::vector<double>& reference, int numberOfLights)
{
  const std::size_t count = reference.size() / static_cast<std::size_t>(numberOfLights);
  double mean = 0.0;
  for (std::size_t begin = 0; begin < reference.size(); begin += count)
  {
    double distance = 0.0;
    double sum = 0.0;
    for (std::size_t k = begin; k < begin + count; ++k)
    {
      distance += std::abs(radiance[k] - reference[k]);
      sum += reference[k];
    }
    mean += distance / std::max(sum, 1e-300) / numberOfLights;
  }
  return mean;
}

#if MEASUREDBRDF_WITH_CERES
namespace
{
//------------------------------------------------------------------------------
/// Asks after each iteration whether to go on; an exception waits until the solver has returned.
struct Watcher : ceres::IterationCallback
{
  explicit Watcher(const std::function<void()>& proceed)
    : Proceed(proceed)
  {
  }

  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override
  {
    try
    {
      this->Proceed();
      return ceres::SOLVER_CONTINUE;
    }
    catch (...)
    {
      this->Thrown = std::current_exception();
      return ceres::SOLVER_ABORT;
    }
  }

  const std::function<void()>& Proceed;
  std::exception_ptr Thrown;
};

//------------------------------------------------------------------------------
/// A value that is searched: its place among the model's values, and its range.
struct FreeValue
{
  std::size_t Index;
  double Least, Most;
};

//------------------------------------------------------------------------------
/// The distance of two lit spheres as a sum of squares.
class SphereResiduals : public ceres::CostFunction
{
public:
  /// Of the model's values the free ones are searched, the others stay as they are in it.
  SphereResiduals(SurfaceModel* model, const LitSphere& sphere,
    const std::vector<double>& reference, const std::vector<FreeValue>& free)
    : Model(model)
    , Sphere(sphere)
    , Reference(reference)
    , Free(free)
    , Start(model->GetValues())
  {
    this->set_num_residuals(static_cast<int>(reference.size()));
    this->mutable_parameter_block_sizes()->push_back(static_cast<int>(free.size()));
    // Every light counts the same, however bright.
    const std::size_t count =
      reference.size() / static_cast<std::size_t>(sphere.GetNumberOfLights());
    for (std::size_t begin = 0; begin < reference.size(); begin += count)
    {
      double mean = 0.0;
      for (std::size_t k = begin; k < begin + count; ++k)
      {
        mean += reference[k] / static_cast<double>(count);
      }
      this->Scales.push_back(1.0 / std::max(mean, 1e-300));
    }
  }

  bool Evaluate(
    double const* const* parameters, double* residuals, double** jacobians) const override
  {
    const std::size_t count = this->Reference.size();
    std::vector<double> at(parameters[0], parameters[0] + this->Free.size());
    const std::vector<double> here = this->GetResiduals(at);
    std::copy(here.begin(), here.end(), residuals);
    if (!jacobians || !jacobians[0])
    {
      return true;
    }
    for (std::size_t k = 0; k < at.size(); ++k)
    {
      const double before = at[k];
      // A step to the inside of the range.
      const double middle = 0.5 * (this->Free[k].Least + this->Free[k].Most);
      const double step = before > middle ? -1e-4 : 1e-4;
      at[k] = before + step;
      const std::vector<double> there = this->GetResiduals(at);
      at[k] = before;
      for (std::size_t r = 0; r < count; ++r)
      {
        jacobians[0][r * at.size() + k] = (there[r] - here[r]) / step;
      }
    }
    return true;
  }

  /// The model with these values for the free ones.
  void Apply(const std::vector<double>& free) const
  {
    std::vector<double> values = this->Start;
    for (std::size_t k = 0; k < free.size(); ++k)
    {
      values[this->Free[k].Index] = free[k];
    }
    this->Model->SetValues(values);
  }

private:
  // Squares are as the distance for small differences d^2, as |d| for large ones (the pseudo-Huber
  // loss): sums of squares then behave as relative L1, which the errors are given in.
  std::vector<double> GetResiduals(const std::vector<double>& free) const
  {
    constexpr double width = 0.05; // of the mean radiance
    this->Apply(free);
    std::vector<double> radiance = this->Sphere.Sum(this->Model);
    const std::size_t count = radiance.size() / this->Scales.size();
    for (std::size_t k = 0; k < radiance.size(); ++k)
    {
      const double d = (radiance[k] - this->Reference[k]) * this->Scales[k / count];
      const double root = std::sqrt(1.0 + d * d / (width * width));
      radiance[k] = d * std::sqrt(2.0 / (1.0 + root));
    }
    return radiance;
  }

  SurfaceModel* Model;
  const LitSphere& Sphere;
  const std::vector<double>& Reference;
  std::vector<FreeValue> Free;
  std::vector<double> Start;
  std::vector<double> Scales;
};

//------------------------------------------------------------------------------
/// One material, one model: values, and how far off they are.
struct Candidate
{
  std::vector<double> Values;
  double Error = std::numeric_limits<double>::infinity();
};

/// What a search takes of the models' ranges.
struct Limits
{
  double LeastMetallic;
  double MostMetallic;
  double MostRoughness;
  bool AreUsual;
};
constexpr Limits Free = { 0.0, 1.0, 1.0, false };
constexpr Limits Dielectric = { 0.0, 0.0, 1.0, true };
constexpr Limits Metal = { 0.3, 1.0, 0.6, true };

constexpr int FewIterations = 10; // to choose between starts
constexpr int MostIterations = 40;

class Search
{
public:
  Search(SurfaceModel* model, vtkBRDF* brdf, const LitSphere& sphere, const Limits& limits,
    const std::function<void()>& proceed)
    : Model(model)
    , Sphere(sphere)
    , Allowed(limits)
    , Proceed(proceed)
    , Reference(sphere.Sum(brdf))
  {
    if (std::none_of(
          this->Reference.begin(), this->Reference.end(), [](double value) { return value > 0.0; }))
    {
      throw std::runtime_error("the material reflects no light: there is nothing to fit");
    }
    // Towards the light from above, seen halfway to the rim.
    const double view[3] = { 0.6, 0.0, 0.8 };
    brdf->GetDirectionalAlbedo(view, this->Albedo.data());
  }

  /// The best of the starts of the last part, over what was found for the others, after few
  /// iterations.
  Candidate Try(const Candidate& before, const std::vector<Feature>& features) const
  {
    const Feature part = features.back();
    std::vector<std::vector<double>> bases = { before.Values };
    if ((part == Feature::Specular || part == Feature::Sheen) && this->Allowed.LeastMetallic == 0.0)
    {
      // A metal hides what these parts change: without them it was the best, with them it may not.
      // The same without a metallic part, of the material's color:
      bases.push_back(before.Values);
      std::transform(this->Albedo.begin(), this->Albedo.end(), bases.back().begin(),
        [](double albedo) { return std::clamp(albedo, 0.0, 1.0); });
      bases.back()[MetallicPlace] = 0.0;
    }
    Candidate best;
    for (const std::vector<double>& base : bases)
    {
      for (const Candidate& start : this->FindStarts(base, part, part == Feature::Core ? 3 : 2))
      {
        const Candidate found = this->Refine(start, features, FewIterations);
        best = found.Error < best.Error ? found : best;
      }
    }
    return best;
  }

private:
  double GetError(const std::vector<double>& values) const
  {
    this->Model->SetValues(values);
    return GetMeanError(
      this->Sphere.Sum(this->Model), this->Reference, this->Sphere.GetNumberOfLights());
  }

  // The best starts of a part before they are refined: the k-th takes the k-th start of each of its
  // parameters, or the last one.
  std::vector<Candidate> FindStarts(
    const std::vector<double>& base, Feature part, std::size_t most) const
  {
    const std::vector<ModelNumber>& numbers = this->Model->GetNumbers();
    std::vector<Candidate> starts;
    std::size_t count = 1;
    for (std::size_t k = 0; k < count; ++k)
    {
      Candidate start{ base };
      for (std::size_t at = 0; at < numbers.size(); ++at)
      {
        const std::vector<double>& list = numbers[at].Parameter->Starts;
        if (numbers[at].Parameter->Part == part)
        {
          count = std::max(count, list.size());
          const double value =
            list.empty() ? this->Albedo[numbers[at].Channel] : list[std::min(k, list.size() - 1)];
          const FreeValue range = this->GetRange(at);
          start.Values[at] = std::clamp(value, range.Least, range.Most);
        }
      }
      start.Error = this->GetError(start.Values);
      starts.push_back(start);
    }
    std::stable_sort(starts.begin(), starts.end(),
      [](const Candidate& a, const Candidate& b) { return a.Error < b.Error; });
    starts.resize(std::min(starts.size(), most));
    return starts;
  }

  FreeValue GetRange(std::size_t at) const
  {
    const ModelParameter& parameter = *this->Model->GetNumbers()[at].Parameter;
    double least = parameter.Least;
    double most =
      this->Allowed.AreUsual ? std::min(parameter.Most, parameter.MostUsual) : parameter.Most;
    if (at == MetallicPlace)
    {
      least = this->Allowed.LeastMetallic;
      most = this->Allowed.MostMetallic;
    }
    else if (at == RoughnessPlace)
    {
      most = std::min(most, this->Allowed.MostRoughness);
    }
    return { at, least, most };
  }

  std::vector<FreeValue> GetFree(const std::vector<Feature>& features) const
  {
    std::vector<FreeValue> free;
    for (std::size_t at = 0; at < this->Model->GetNumbers().size(); ++at)
    {
      const Feature part = this->Model->GetNumbers()[at].Parameter->Part;
      const FreeValue range = this->GetRange(at);
      if (std::find(features.begin(), features.end(), part) != features.end() &&
          range.Least < range.Most)
      {
        free.push_back(range);
      }
    }
    return free;
  }

public:
  /// A fit of the parts' values from a start; the start itself where none is better.
  Candidate Refine(
    const Candidate& start, const std::vector<Feature>& features, int iterations) const
  {
    this->Model->SetValues(start.Values);
    const std::vector<FreeValue> free = this->GetFree(features);
    std::vector<double> values;
    for (const FreeValue& value : free)
    {
      values.push_back(std::clamp(start.Values[value.Index], value.Least, value.Most));
    }
    auto* residuals = new SphereResiduals(this->Model, this->Sphere, this->Reference, free);
    ceres::Problem problem; // which owns them
    problem.AddResidualBlock(residuals, nullptr, values.data());
    for (std::size_t k = 0; k < free.size(); ++k)
    {
      problem.SetParameterLowerBound(values.data(), static_cast<int>(k), free[k].Least);
      problem.SetParameterUpperBound(values.data(), static_cast<int>(k), free[k].Most);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.num_threads = 1; // the same sums in the same order: the same result
    options.max_num_iterations = iterations;
    options.function_tolerance = 1e-4;
    options.logging_type = ceres::SILENT;
    Watcher watcher(this->Proceed);
    options.callbacks.push_back(&watcher);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (watcher.Thrown)
    {
      std::rethrow_exception(watcher.Thrown);
    }
    if (!summary.IsSolutionUsable())
    {
      return start;
    }
    residuals->Apply(values);
    Candidate found{ this->Model->GetValues() };
    found.Error = this->GetError(found.Values);
    return found.Error < start.Error ? found : start;
  }

private:
  // All models begin with a color.
  static constexpr std::size_t MetallicPlace = 3;
  static constexpr std::size_t RoughnessPlace = 4;

  SurfaceModel* Model;
  const LitSphere& Sphere;
  Limits Allowed;
  const std::function<void()>& Proceed;
  std::vector<double> Reference;
  std::array<double, 3> Albedo{};
};

//------------------------------------------------------------------------------
// The parts that the model has and the material may need.
std::vector<Feature> GetChoices(SurfaceModel* model, vtkBRDF* brdf)
{
  std::vector<Feature> choices;
  for (const Feature part :
    { Feature::Anisotropy, Feature::Specular, Feature::Coat, Feature::Sheen })
  {
    const auto& parameters = model->GetParameters();
    const bool known = std::any_of(parameters.begin(), parameters.end(),
      [part](const ModelParameter& parameter) { return parameter.Part == part; });
    if (known && (part != Feature::Anisotropy || !brdf->IsIsotropic()))
    {
      choices.push_back(part);
    }
  }
  return choices;
}

//------------------------------------------------------------------------------
ModelFit FitWithin(const std::string& model, vtkBRDF* brdf, const LitSphere& sphere,
  const Limits& limits, const std::function<void(double)>& proceed)
{
  ModelFit fit{ SurfaceModel::Make(model), {}, 0.0 };
  double share = 0.0;
  const std::function<void()> goOn = [&]() { proceed(share); };
  const Search search(fit.Model, brdf, sphere, limits, goOn);
  std::vector<Feature> features = { Feature::Core };
  Candidate best =
    search.Refine(search.Try({ fit.Model->GetValues() }, features), features, MostIterations);
  std::vector<Feature> choices = GetChoices(fit.Model, brdf);
  const double rounds = static_cast<double>(choices.size()) + 1.0;
  for (bool worthIt = true; worthIt && !choices.empty();)
  {
    std::vector<std::pair<Candidate, Feature>> tries;
    for (std::size_t k = 0; k < choices.size(); ++k)
    {
      const double left = static_cast<double>(choices.size());
      share = (rounds - left + static_cast<double>(k) / left) / rounds;
      features.push_back(choices[k]);
      tries.emplace_back(search.Try(best, features), choices[k]);
      features.pop_back();
    }
    std::stable_sort(tries.begin(), tries.end(),
      [](const auto& one, const auto& other) { return one.first.Error < other.first.Error; });
    worthIt = false;
    for (std::size_t k = 0; k < tries.size() && !worthIt; ++k)
    {
      features.push_back(tries[k].second);
      const Candidate next = search.Refine(tries[k].first, features, MostIterations);
      worthIt = best.Error - next.Error >= std::max(WorthIt * best.Error, WorthAtLeast);
      if (!worthIt)
      {
        features.pop_back();
        continue;
      }
      best = next;
      choices.erase(std::find(choices.begin(), choices.end(), tries[k].second));
    }
  }
  proceed(1.0);
  if (!std::isfinite(best.Error))
  {
    throw std::runtime_error("the fit of " + fit.Model->GetTitle() + " failed");
  }
  fit.Model->SetValues(best.Values);
  fit.Features.assign(features.begin() + 1, features.end());
  fit.Error = best.Error;
  fit.ClosestError = best.Error;
  return fit;
}
}

//------------------------------------------------------------------------------
std::string GetModelFitAbsence() { return ""; }

//------------------------------------------------------------------------------
ModelFit FitModel(const std::string& model, vtkBRDF* brdf, const LitSphere& sphere, bool usual,
  const std::function<void(double)>& proceed)
{
  if (!usual)
  {
    return FitWithin(model, brdf, sphere, Free, proceed);
  }
  const auto fitPart = [&](const Limits& limits, int part)
  {
    return FitWithin(
      model, brdf, sphere, limits, [&](double share) { proceed((part + share) / 3.0); });
  };
  const ModelFit closest = fitPart(Free, 0);
  ModelFit fit = fitPart(Dielectric, 1);
  if (fit.Error > (1.0 + WorthIt) * closest.Error)
  {
    try
    {
      ModelFit metal = fitPart(Metal, 2);
      // One at the least metallic part wants to be none.
      const bool isMetal = metal.Model->GetValues()[3] > Metal.LeastMetallic + 1e-3 &&
                           metal.Error < (1.0 - WorthIt) * fit.Error;
      fit = isMetal ? metal : fit;
    }
    catch (const std::runtime_error&) // no start is finite: the dielectric stays
    {
    }
  }
  proceed(1.0);
  fit.ClosestError = std::min(closest.Error, fit.Error);
  return fit;
}
#else
//------------------------------------------------------------------------------
std::string GetModelFitAbsence()
{
  return "this build has no Ceres (MEASUREDBRDF_WITH_CERES), which the fit needs";
}

//------------------------------------------------------------------------------
ModelFit FitModel(
  const std::string&, vtkBRDF*, const LitSphere&, bool, const std::function<void(double)>&)
{
  throw std::runtime_error(GetModelFitAbsence());
}
#endif
} // namespace tool
