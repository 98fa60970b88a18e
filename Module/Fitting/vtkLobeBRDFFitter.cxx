// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLobeBRDFFitter.h"

#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkLobeBRDFFitter);

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkLobeBRDFFitter, Shape, int, BLINN_PHONG, ASHIKHMIN_SHIRLEY);
measuredbrdfSetInRangeMacro(vtkLobeBRDFFitter, Anisotropy, int, AS_INPUT, ANISOTROPIC);
measuredbrdfSetInRangeMacro(vtkLobeBRDFFitter, NumberOfLobes, int, 1, 3);

//------------------------------------------------------------------------------
void vtkLobeBRDFFitter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Shape: " << this->GetModelName() << "\n";
  os << indent << "NumberOfLobes: " << this->NumberOfLobes << "\n";
  os << indent << "Anisotropy: " << this->Anisotropy << "\n";
}

#if MEASUREDBRDF_WITH_CERES

#include "HalfVector.h"
#include "LinearLeastSquares.h"
#include "NumberText.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSumBRDF.h"

#include <ceres/ceres.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace measuredbrdf
{
namespace
{
constexpr double MaximumExponent = 1e6; // what the representations take
constexpr std::size_t ScreeningSamples = 2048;
constexpr std::size_t RefiningSamples = 4096;
constexpr int RefiningIterations = 30;

struct LobeModel
{
  bool IsPhong;
  int NumberOfLobes;
  bool Anisotropic; // only Ashikhmin-Shirley's
};

// The parameters as one vector: ln(n+1) per exponent, then per channel the Lambert albedo / pi
// and base[, rise] per lobe. f = albedo/pi + sum over lobes of (base + rise (1 - h.o)^5)
// shape(exponents): linear in all parameters except the exponents. The scale S and reflectance R of
// Ashikhmin-Shirley are replaced by base = S R and rise = S (1 - R). Changes of S and R can cancel
// each other; changes of base and rise cannot, and the bounds S >= 0, 0 <= R <= 1 become base >= 0,
// rise >= 0. Shapes: Blinn-Phong's (n+2)/(2 pi) cos^n theta_h; Ashikhmin-Shirley's
// sqrt((nu+1)(nv+1))/(8 pi) (n.h)^e / ((h.o) max(cos_i, cos_o)).
struct Layout
{
  explicit Layout(const LobeModel& model)
    : Model(model)
    , ExponentsPerLobe(model.Anisotropic ? 2 : 1)
    , CoefficientsPerLobe(model.IsPhong ? 1 : 2)
    , Exponents(model.NumberOfLobes * this->ExponentsPerLobe)
    , Coefficients(1 + model.NumberOfLobes * this->CoefficientsPerLobe)
    , Size(this->Exponents + 3 * this->Coefficients)
  {
  }

  LobeModel Model;
  int ExponentsPerLobe;
  int CoefficientsPerLobe;
  int Exponents;
  int Coefficients; // of one channel
  int Size;
};

// What the coefficients of one channel multiply, and its derivatives by the log-exponents.
struct Basis
{
  double Values[7];       // 1, then per lobe shape[, shape * rise]
  double LogSlopes[3][2]; // d ln(shape) / d ln(n+1)
};

Basis Evaluate(const Layout& layout, const double* parameters, const vtkBRDFFitter::Sample& sample)
{
  Basis basis;
  basis.Values[0] = 1.0;
  const glm::dvec3 o = glm::make_vec3(sample.O);
  const glm::dvec3 h = HalfVector(glm::make_vec3(sample.I), o);
  const double s = h.x * h.x + h.y * h.y;
  const double ratio = LogCosineRatio(s);
  const double hd = glm::dot(h, o);
  for (int lobe = 0; lobe < layout.Model.NumberOfLobes; ++lobe)
  {
    const double* logs = parameters + lobe * layout.ExponentsPerLobe;
    const double u = std::exp(logs[0]); // n + 1
    const double v = layout.Model.Anisotropic ? std::exp(logs[1]) : u;
    double* values = basis.Values + 1 + lobe * layout.CoefficientsPerLobe;
    double* slopes = basis.LogSlopes[lobe];
    if (layout.Model.IsPhong)
    {
      values[0] = (u + 1.0) / (2.0 * Pi) * PowerCosine(u - 1.0, s);
      slopes[0] = u * (1.0 / (u + 1.0) + 0.5 * s * ratio);
      continue;
    }
    const double power = 0.5 * ((u - 1.0) * h.x * h.x + (v - 1.0) * h.y * h.y) * ratio;
    values[0] =
      std::sqrt(u * v) / (8.0 * Pi) * std::exp(power) / (hd * std::max(sample.I[2], sample.O[2]));
    values[1] = values[0] * SchlickFresnel(0.0, hd);
    slopes[0] = 0.5 + 0.5 * u * h.x * h.x * ratio;
    slopes[1] = 0.5 + 0.5 * v * h.y * h.y * ratio;
    if (!layout.Model.Anisotropic)
    {
      slopes[0] += slopes[1];
    }
  }
  return basis;
}

double Dot(const double* coefficients, const Basis& basis, int count)
{
  return std::inner_product(coefficients, coefficients + count, basis.Values, 0.0);
}

/**
 * The non-negative coefficients that are best for the exponents in parameters (written there), and
 * the weighted mean square they leave. A few steps of reweighted linear least squares: the weights
 * are the squared secants of T between data and model, first the data's own slope.
 */
double SolveCoefficients(const vtkBRDFFitter::Samples& samples, const vtkBRDFFitter& loss,
  const Layout& layout, double* parameters)
{
  const int count = layout.Coefficients;
  std::vector<Basis> bases;
  bases.reserve(samples.size());
  for (const vtkBRDFFitter::Sample& sample : samples)
  {
    bases.push_back(Evaluate(layout, parameters, sample));
  }
  double mean = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    double* coefficients = parameters + layout.Exponents + c * count;
    constexpr int passes = 4;
    for (int pass = 0; pass <= passes; ++pass)
    {
      Eigen::MatrixXd H = Eigen::MatrixXd::Zero(count, count);
      Eigen::VectorXd g = Eigen::VectorXd::Zero(count);
      double sum = 0.0;
      for (std::size_t k = 0; k < samples.size(); ++k)
      {
        const vtkBRDFFitter::Sample& sample = samples[k];
        const double cosine = sample.I[2];
        const double f = pass == 0 ? sample.F[c] : Dot(coefficients, bases[k], count);
        const double t = loss.GetLossValue(f, cosine) - loss.GetLossValue(sample.F[c], cosine);
        const double difference = f - sample.F[c];
        const double slope = std::abs(difference) > 1e-9 * (1.0 + f)
                               ? t / difference
                               : loss.GetLossSlope(sample.F[c], cosine);
        const double weight = sample.Weight * slope * slope;
        sum += sample.Weight * t * t / 3.0;
        const Eigen::Map<const Eigen::VectorXd> row(bases[k].Values, count);
        H.noalias() += weight * row * row.transpose();
        g.noalias() += weight * sample.F[c] * row;
      }
      if (pass == passes)
      {
        mean += sum;
        break;
      }
      Eigen::VectorXd x = Eigen::VectorXd::Ones(count);
      SolveNonNegative(H.sparseView(), g, x);
      std::copy_n(x.data(), count, coefficients);
    }
  }
  return mean;
}

struct Start
{
  std::vector<double> Parameters;
  double MeanSquare;
};

// All ascending choices of exponents from 1 to 1e5, with the best coefficients for them, the best
// first; none where it was stopped.
std::vector<Start> Screen(const vtkBRDFFitter::Samples& samples, const vtkBRDFFitter& loss,
  const Layout& layout, const std::function<bool(double)>& progress)
{
  constexpr int steps = 12; // a factor of 2.8 each
  const std::vector<double> stretches =
    layout.Model.Anisotropic ? std::vector<double>{ 1.0, 4.0, 0.25 } : std::vector<double>{ 1.0 };
  const int lobes = layout.Model.NumberOfLobes;
  std::vector<Start> starts;
  for (int choice = 0; choice < static_cast<int>(std::pow(steps, lobes)); ++choice)
  {
    std::vector<int> digits;
    for (int rest = choice; static_cast<int>(digits.size()) < lobes; rest /= steps)
    {
      digits.insert(digits.begin(), rest % steps);
    }
    if (std::adjacent_find(digits.begin(), digits.end(), std::greater_equal<int>()) != digits.end())
    {
      continue;
    }
    if (!progress(0.0))
    {
      return {};
    }
    for (const double stretch : stretches)
    {
      std::vector<double> parameters;
      for (const int digit : digits)
      {
        const double exponent = std::pow(10.0, 5.0 * digit / (steps - 1));
        parameters.push_back(std::log1p(exponent * stretch));
        if (layout.Model.Anisotropic)
        {
          parameters.push_back(std::log1p(exponent / stretch));
        }
      }
      parameters.resize(static_cast<std::size_t>(layout.Size));
      const double mean = SolveCoefficients(samples, loss, layout, parameters.data());
      starts.push_back({ parameters, mean });
    }
  }
  std::stable_sort(starts.begin(), starts.end(),
    [](const Start& a, const Start& b) { return a.MeanSquare < b.MeanSquare; });
  return starts;
}

// All residuals sqrt(w/3) (T(f') - T(f)): their sum of squares is the weighted mean square.
class LobeCost : public ceres::CostFunction
{
public:
  LobeCost(const vtkBRDFFitter::Samples& samples, const vtkBRDFFitter& loss, const Layout& layout)
    : Samples(samples)
    , Loss(loss)
    , Shape(layout)
  {
    this->set_num_residuals(static_cast<int>(3 * samples.size()));
    this->mutable_parameter_block_sizes()->push_back(layout.Size);
  }

  bool Evaluate(
    double const* const* parameters, double* residuals, double** jacobians) const override
  {
    const Layout& layout = this->Shape;
    double* row = jacobians ? jacobians[0] : nullptr;
    for (const vtkBRDFFitter::Sample& sample : this->Samples)
    {
      const Basis basis = measuredbrdf::Evaluate(layout, parameters[0], sample);
      const double weight = std::sqrt(sample.Weight / 3.0);
      for (int c = 0; c < 3; ++c)
      {
        const int first = layout.Exponents + c * layout.Coefficients;
        const double* coefficients = parameters[0] + first;
        const double f = Dot(coefficients, basis, layout.Coefficients);
        *residuals++ = weight * (this->Loss.GetLossValue(f, sample.I[2]) -
                                  this->Loss.GetLossValue(sample.F[c], sample.I[2]));
        if (!row)
        {
          continue;
        }
        std::fill_n(row, layout.Size, 0.0);
        const double slope = weight * this->Loss.GetLossSlope(f, sample.I[2]);
        std::transform(basis.Values, basis.Values + layout.Coefficients, row + first,
          [slope](double value) { return slope * value; });
        for (int e = 0; e < layout.Exponents; ++e)
        {
          const int lobe = e / layout.ExponentsPerLobe;
          const int own = 1 + lobe * layout.CoefficientsPerLobe;
          const double part = std::inner_product(coefficients + own,
            coefficients + own + layout.CoefficientsPerLobe, basis.Values + own, 0.0);
          row[e] = slope * part * basis.LogSlopes[lobe][e % layout.ExponentsPerLobe];
        }
        row += layout.Size;
      }
    }
    return true;
  }

private:
  const vtkBRDFFitter::Samples& Samples;
  const vtkBRDFFitter& Loss;
  const Layout& Shape;
};

// Keeps the history and reports progress, from one share to another.
class Watcher : public ceres::IterationCallback
{
public:
  Watcher(const std::function<bool(double)>& progress, double from, double to, int iterations)
    : Progress(progress)
    , From(from)
    , To(to)
    , Iterations(iterations)
  {
  }

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override
  {
    if (summary.step_is_successful || summary.iteration == 0)
    {
      this->History.push_back(2.0 * summary.cost); // Ceres' cost is half the sum of squares
    }
    const double share = std::min(double(summary.iteration) / this->Iterations, 1.0);
    this->Stopped = !this->Progress(this->From + (this->To - this->From) * share);
    return this->Stopped ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

  std::vector<double> History;
  bool Stopped = false;

private:
  const std::function<bool(double)>& Progress;
  double From, To;
  int Iterations;
};

// By Ceres' Levenberg-Marquardt within bounds.
ceres::Solver::Summary Refine(const vtkBRDFFitter::Samples& samples, const vtkBRDFFitter& loss,
  const Layout& layout, Start& start, Watcher& watcher, int iterations, double tolerance)
{
  double* parameters = start.Parameters.data();
  ceres::Problem problem;
  problem.AddResidualBlock(new LobeCost(samples, loss, layout), nullptr, parameters);
  for (int k = 0; k < layout.Size; ++k)
  {
    problem.SetParameterLowerBound(parameters, k, 0.0);
    if (k < layout.Exponents)
    {
      problem.SetParameterUpperBound(parameters, k, std::log1p(MaximumExponent));
    }
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.num_threads = 1; // the same sums in the same order: the same result
  options.max_num_iterations = iterations;
  options.function_tolerance = tolerance;
  options.parameter_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  options.callbacks.push_back(&watcher);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  start.MeanSquare = 2.0 * summary.final_cost;
  return summary;
}

// The material of the parameters, and its report.
void Unpack(
  const Layout& layout, const std::vector<double>& parameters, vtkBRDFFitter::Result& result)
{
  using Color = Eigen::Array3d;
  const auto text = [](const Color& rgb)
  {
    TextStream stream;
    stream << rgb[0] << " " << rgb[1] << " " << rgb[2];
    return stream.str();
  };
  const auto getCoefficient = [&](int k)
  {
    const double* all = &parameters[static_cast<std::size_t>(layout.Exponents + k)];
    return Color(all[0], all[layout.Coefficients], all[2 * layout.Coefficients]);
  };
  const auto getExponent = [&](int k)
  {
    // Rounding must not carry it beyond the bound that it may have reached.
    return std::min(std::expm1(parameters[static_cast<std::size_t>(k)]), MaximumExponent);
  };
  const auto getFirst = [&](int lobe) { return getExponent(lobe * layout.ExponentsPerLobe); };
  const auto getLast = [&](int lobe)
  { return getExponent((lobe + 1) * layout.ExponentsPerLobe - 1); };
  std::vector<int> lobes(static_cast<std::size_t>(layout.Model.NumberOfLobes));
  std::iota(lobes.begin(), lobes.end(), 0);
  std::stable_sort(lobes.begin(), lobes.end(),
    [&](int a, int b) { return getFirst(a) * getLast(a) < getFirst(b) * getLast(b); });
  TextStream report;
  Color albedo = Pi * getCoefficient(0);
  report << "diffuse albedo: " << text(albedo) << "\n";
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(albedo.data());
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  for (const int k : lobes)
  {
    const int coefficient = 1 + k * layout.CoefficientsPerLobe;
    Color base = getCoefficient(coefficient);
    if (layout.Model.IsPhong)
    {
      vtkNew<vtkBlinnPhongBRDF> lobe;
      lobe->SetExponent(getFirst(k));
      lobe->SetSpecular(base.data());
      report << "lobe: exponent " << getFirst(k) << ", specular " << text(base) << "\n";
      sum->AddTerm(lobe);
      continue;
    }
    Color scale = base + getCoefficient(coefficient + 1);
    Color reflectance = (scale > 0.0).select(base / scale, 0.0);
    vtkNew<vtkAshikhminShirleyBRDF> lobe;
    lobe->SetExponents(getFirst(k), getLast(k));
    lobe->SetSpecularScale(scale.data());
    lobe->SetReflectance(reflectance.data());
    report << "lobe: exponents " << getFirst(k) << " " << getLast(k) << ", scale " << text(scale)
           << ", reflectance " << text(reflectance) << "\n";
    sum->AddTerm(lobe);
  }
  result.BRDF = sum;
  result.Report = report.str();
}

vtkBRDFFitter::Samples TakeFirst(const vtkBRDFFitter::Samples& samples, std::size_t count)
{
  const auto end = samples.begin() + static_cast<std::ptrdiff_t>(std::min(count, samples.size()));
  vtkBRDFFitter::Samples first(samples.begin(), end); // a low-discrepancy set, too
  vtkBRDFFitter::NormalizeWeights(first);
  return first;
}
}
} // namespace measuredbrdf

using namespace measuredbrdf;

//------------------------------------------------------------------------------
// All combinations of log-spaced exponents are tried on a few samples with the best non-negative
// coefficients; the best ones are refined on more, the best of those on all.
vtkBRDFFitter::Result vtkLobeBRDFFitter::FitTo(const std::vector<Sample>& samples)
{
  constexpr double screened = 0.2, refined = 0.6; // of the progress
  const bool isPhong = this->Shape == BLINN_PHONG;
  const bool isBrushed = this->Anisotropy == ANISOTROPIC ||
                         (this->Anisotropy == AS_INPUT && !this->Input->IsIsotropic());
  const Layout layout({ isPhong, this->NumberOfLobes, !isPhong && isBrushed });
  const vtkBRDFFitter& loss = *this;
  const std::function<bool(double)> progress = [this](double share)
  { return this->UpdateProgress(share); };
  std::vector<Start> starts = Screen(TakeFirst(samples, ScreeningSamples), loss, layout, progress);
  starts.resize(std::min<std::size_t>(starts.size(), this->NumberOfStarts));
  const vtkBRDFFitter::Samples some = TakeFirst(samples, RefiningSamples);
  const double step = (refined - screened) / this->NumberOfStarts;
  Result result;
  Start best{ {}, std::numeric_limits<double>::infinity() };
  for (std::size_t k = 0; k < starts.size(); ++k)
  {
    const double from = screened + step * static_cast<double>(k);
    Watcher watcher(progress, from, from + step, RefiningIterations);
    Refine(some, loss, layout, starts[k], watcher, RefiningIterations, this->Tolerance);
    if (watcher.Stopped)
    {
      return result;
    }
    best = starts[k].MeanSquare < best.MeanSquare ? starts[k] : best;
  }
  if (best.Parameters.empty())
  {
    return result;
  }
  const int most = this->MaximumNumberOfIterations;
  Watcher watcher(progress, refined, 1.0, most);
  const ceres::Solver::Summary solved =
    Refine(samples, loss, layout, best, watcher, most, this->Tolerance);
  if (!solved.IsSolutionUsable() && !watcher.Stopped)
  {
    result.Report = solved.message;
    return result;
  }
  Unpack(layout, best.Parameters, result);
  result.History = watcher.History;
  result.Converged = solved.termination_type == ceres::CONVERGENCE;
  return result;
}

#else

//------------------------------------------------------------------------------
vtkBRDFFitter::Result vtkLobeBRDFFitter::FitTo(const std::vector<Sample>&)
{
  Result result;
  result.Report = "this build has no Ceres (MEASUREDBRDF_WITH_CERES): Blinn-Phong and "
                  "Ashikhmin-Shirley lobes cannot be fitted";
  return result;
}
#endif
