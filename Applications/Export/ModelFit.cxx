// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFit.h"

#include "LeastSquares.h"
#include "LitSphere.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tool
{
//------------------------------------------------------------------------------
double GetMeanError(const Eigen::ArrayXXd& radiance, const Eigen::ArrayXXd& reference)
{
  const Eigen::ArrayXXd distances = (radiance - reference).abs();
  return (distances.colwise().sum() / reference.colwise().sum().max(1e-300)).mean();
}

namespace
{
// All models begin with a color.
constexpr std::size_t MetallicPlace = 3;
constexpr std::size_t RoughnessPlace = 4;

constexpr int FewIterations = 10; // to choose between starts
constexpr int MostIterations = 40;

/// What is fitted.
struct Target
{
  const LitSphere& Sphere;
  bool IsIsotropic;
  Eigen::ArrayXXd Radiance;       // of its sphere
  std::array<double, 3> Albedo{}; // towards the light from above, seen halfway to the rim

  Target(vtkBRDF* brdf, const LitSphere& sphere)
    : Sphere(sphere)
    , IsIsotropic(brdf->IsIsotropic())
    , Radiance(sphere.Sum(brdf))
  {
    if (!(this->Radiance > 0.0).any())
    {
      throw std::runtime_error("the material reflects no light: there is nothing to fit");
    }
    const double view[3] = { 0.6, 0.0, 0.8 };
    brdf->GetDirectionalAlbedo(view, this->Albedo.data());
  }
};

/// Values of all of a model's numbers, and how far off its sphere is.
struct Candidate
{
  std::vector<double> Values;
  double Error = std::numeric_limits<double>::infinity();
};

bool IsBetter(const Candidate& a, const Candidate& b) { return a.Error < b.Error; }

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

//------------------------------------------------------------------------------
/// Searches the values of one model within limits.
class Search
{
public:
  Search(SurfaceModel* model, const Target& target, const Limits& limits,
    const std::function<void()>& proceed)
    : Model(model)
    , Wanted(target)
    , Proceed(proceed)
  {
    for (const ModelNumber& number : model->GetNumbers())
    {
      const ModelParameter& parameter = *number.Parameter;
      this->Least.push_back(parameter.Least);
      this->Most.push_back(
        limits.AreUsual ? std::min(parameter.Most, parameter.MostUsual) : parameter.Most);
    }
    this->Least[MetallicPlace] = limits.LeastMetallic;
    this->Most[MetallicPlace] = limits.MostMetallic;
    this->Most[RoughnessPlace] = std::min(this->Most[RoughnessPlace], limits.MostRoughness);
  }

  /// The best of the starts of the last part, over what was found for the others, after few
  /// iterations.
  Candidate Try(const Candidate& before, const std::vector<Feature>& features) const
  {
    const Feature part = features.back();
    std::vector<std::vector<double>> bases = { before.Values };
    if ((part == Feature::Specular || part == Feature::Sheen) && this->Least[MetallicPlace] == 0.0)
    {
      // A metal hides what these parts change: without them it was the best, with them it may not.
      // The same without a metallic part, of the material's color:
      bases.push_back(before.Values);
      std::transform(this->Wanted.Albedo.begin(), this->Wanted.Albedo.end(), bases.back().begin(),
        [](double albedo) { return std::clamp(albedo, 0.0, 1.0); });
      bases.back()[MetallicPlace] = 0.0;
    }
    Candidate best;
    for (const std::vector<double>& base : bases)
    {
      for (const Candidate& start : this->FindStarts(base, part, part == Feature::Core ? 3 : 2))
      {
        best = std::min(best, this->Refine(start, features, FewIterations), IsBetter);
      }
    }
    return best;
  }

  /// A fit of the parts' values from a start; the start itself where none is better. Squares are as
  /// the distance for small differences d^2, as |d| for large ones (the pseudo-Huber loss): sums of
  /// squares then behave as relative L1, which the errors are given in.
  Candidate Refine(
    const Candidate& start, const std::vector<Feature>& features, int iterations) const
  {
    std::vector<std::size_t> free; // places of the numbers that are searched
    for (std::size_t at = 0; at < this->Least.size(); ++at)
    {
      const Feature part = this->Model->GetNumbers()[at].Parameter->Part;
      if (std::find(features.begin(), features.end(), part) != features.end() &&
          this->Least[at] < this->Most[at])
      {
        free.push_back(at);
      }
    }
    measuredbrdf::LeastSquares method;
    method.Least.resize(static_cast<Eigen::Index>(free.size()));
    method.Most = method.Least;
    Eigen::VectorXd x = method.Least;
    for (Eigen::Index k = 0; k < x.size(); ++k)
    {
      method.Least[k] = this->Least[free[k]];
      method.Most[k] = this->Most[free[k]];
      x[k] = std::clamp(start.Values[free[k]], method.Least[k], method.Most[k]);
    }
    const auto getValues = [&](const Eigen::VectorXd& at)
    {
      std::vector<double> values = start.Values;
      for (Eigen::Index k = 0; k < at.size(); ++k)
      {
        values[free[k]] = at[k];
      }
      return values;
    };
    const auto getResiduals = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd
    {
      constexpr double width = 0.05; // of the mean radiance
      const Eigen::ArrayXXd& wanted = this->Wanted.Radiance;
      // Every light counts the same, however bright.
      const Eigen::ArrayXXd d =
        (this->GetRadiance(getValues(at)) - wanted).rowwise() / wanted.colwise().mean().max(1e-300);
      const Eigen::ArrayXXd loss = d * (2.0 / (1.0 + (1.0 + (d / width).square()).sqrt())).sqrt();
      return loss.reshaped();
    };
    const auto getJacobian = [&](const Eigen::VectorXd& at, const Eigen::VectorXd& here)
    {
      Eigen::MatrixXd jacobian(here.size(), at.size());
      for (Eigen::Index k = 0; k < at.size(); ++k)
      {
        // A step to the inside of the range.
        const double step = at[k] > 0.5 * (method.Least[k] + method.Most[k]) ? -1e-4 : 1e-4;
        Eigen::VectorXd beside = at;
        beside[k] += step;
        jacobian.col(k) = (getResiduals(beside) - here) / step;
      }
      return jacobian;
    };
    method.MostIterations = iterations;
    method.Tolerance = 1e-4;
    method.Proceed = [this](int, double)
    {
      this->Proceed();
      return true;
    };
    method.Minimize(getResiduals, getJacobian, x);
    const Candidate found{ getValues(x), this->GetError(getValues(x)) };
    return std::min(start, found, IsBetter);
  }

private:
  Eigen::ArrayXXd GetRadiance(const std::vector<double>& values) const
  {
    this->Model->SetValues(values);
    return this->Wanted.Sphere.Sum(this->Model);
  }

  double GetError(const std::vector<double>& values) const
  {
    return GetMeanError(this->GetRadiance(values), this->Wanted.Radiance);
  }

  // The best starts of a part before they are refined: the k-th takes the k-th start of each of its
  // parameters, or the last one.
  std::vector<Candidate> FindStarts(
    const std::vector<double>& base, Feature part, std::size_t most) const
  {
    std::vector<Candidate> starts;
    std::size_t count = 1;
    for (std::size_t k = 0; k < count; ++k)
    {
      std::vector<double> values = base;
      for (std::size_t at = 0; at < values.size(); ++at)
      {
        const auto& [parameter, channel] = this->Model->GetNumbers()[at];
        if (parameter->Part == part)
        {
          const std::vector<double>& list = parameter->Starts;
          count = std::max(count, list.size());
          const double value =
            list.empty() ? this->Wanted.Albedo[channel] : list[std::min(k, list.size() - 1)];
          values[at] = std::clamp(value, this->Least[at], this->Most[at]);
        }
      }
      starts.push_back({ values, this->GetError(values) });
    }
    std::stable_sort(starts.begin(), starts.end(), IsBetter);
    starts.resize(std::min(starts.size(), most));
    return starts;
  }

  SurfaceModel* Model;
  const Target& Wanted;
  const std::function<void()>& Proceed;
  std::vector<double> Least, Most; // of all numbers
};

//------------------------------------------------------------------------------
// The parts that the model has and the material may need.
std::vector<Feature> GetChoices(SurfaceModel* model, bool isIsotropic)
{
  std::vector<Feature> choices;
  for (const Feature part :
    { Feature::Anisotropy, Feature::Specular, Feature::Coat, Feature::Sheen })
  {
    const auto& parameters = model->GetParameters();
    const bool known = std::any_of(parameters.begin(), parameters.end(),
      [part](const ModelParameter& parameter) { return parameter.Part == part; });
    if (known && (part != Feature::Anisotropy || !isIsotropic))
    {
      choices.push_back(part);
    }
  }
  return choices;
}

//------------------------------------------------------------------------------
// Parts are taken as long as one is worth it: in each round all are tried, the best is refined
// first.
ModelFit FitWithin(const std::string& model, const Target& target, const Limits& limits,
  const std::function<void(double)>& proceed)
{
  ModelFit fit{ SurfaceModel::Make(model), {}, 0.0 };
  double share = 0.0;
  const std::function<void()> goOn = [&]() { proceed(share); };
  const Search search(fit.Model, target, limits, goOn);
  std::vector<Feature> features = { Feature::Core };
  Candidate best =
    search.Refine(search.Try({ fit.Model->GetValues() }, features), features, MostIterations);
  std::vector<Feature> choices = GetChoices(fit.Model, target.IsIsotropic);
  const double rounds = static_cast<double>(choices.size()) + 1.0;
  // Below that error no part can be worth it.
  for (bool worthIt = true; worthIt && !choices.empty() && best.Error > WorthAtLeast;)
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
      [](const auto& one, const auto& other) { return IsBetter(one.first, other.first); });
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
ModelFit FitModel(const std::string& model, vtkBRDF* brdf, const LitSphere& sphere, bool usual,
  const std::function<void(double)>& proceed)
{
  const Target target(brdf, sphere);
  const double limits = usual ? 3.0 : 1.0; // that are searched
  const auto fitPart = [&](const Limits& part, int place)
  {
    return FitWithin(model, target, part, [&](double share) { proceed((place + share) / limits); });
  };
  const ModelFit closest = fitPart(Free, 0);
  if (!usual)
  {
    return closest;
  }
  ModelFit fit = fitPart(Dielectric, 1);
  if (fit.Error > (1.0 + WorthIt) * closest.Error)
  {
    const ModelFit metal = fitPart(Metal, 2);
    // One at the least metallic part wants to be none.
    const bool isMetal = metal.Model->GetValues()[MetallicPlace] > Metal.LeastMetallic + 1e-3 &&
                         metal.Error < (1.0 - WorthIt) * fit.Error;
    fit = isMetal ? metal : fit;
  }
  proceed(1.0);
  fit.ClosestError = std::min(closest.Error, fit.Error);
  return fit;
}
} // namespace tool
