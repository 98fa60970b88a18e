// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeFit.h"

#include "vtkMeasuredBRDFConfigure.h"

#if MEASUREDBRDF_WITH_CERES

#include "HalfVector.h"
#include "LinearLeastSquares.h"
#include "NumberText.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFFitter.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSumBRDF.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>

namespace measuredbrdf
{
namespace
{
constexpr double MaximumExponent = 1e6; // what the representations take
constexpr std::size_t ScreeningSamples = 2048;
constexpr std::size_t RefiningSamples = 4096;
constexpr int RefiningIterations = 30;

// The parameters as one vector: ln(n+1) per exponent, then per channel the Lambert albedo / pi
// and base[, rise] per lobe.
struct Layout
{
  explicit Layout(const LobeModel& model)
    : Model(model)
    , ExponentsPerLobe(model.Anisotropic ? 2 : 1)
    , CoefficientsPerLobe(model.Shape == LobeShape::BlinnPhong ? 1 : 2)
  {
  }
  int GetNumberOfExponents() const { return this->Model.NumberOfLobes * this->ExponentsPerLobe; }
  int GetNumberOfCoefficients() const // of one channel
  {
    return 1 + this->Model.NumberOfLobes * this->CoefficientsPerLobe;
  }
  int GetCoefficient(int channel, int k) const
  {
    return this->GetNumberOfExponents() + channel * this->GetNumberOfCoefficients() + k;
  }
  int GetSize() const { return this->GetCoefficient(3, 0); }

  LobeModel Model;
  int ExponentsPerLobe;
  int CoefficientsPerLobe;
};

// What the coefficients of one channel multiply, and its derivatives by the log-exponents.
struct Basis
{
  double Values[7];       // 1, then per lobe shape[, shape * rise]
  double LogSlopes[3][2]; // d ln(shape) / d ln(n+1)
};

Basis Evaluate(const Layout& layout, const double* parameters, const FitSample& sample)
{
  Basis basis;
  basis.Values[0] = 1.0;
  const glm::dvec3& h = sample.H;
  const double s = h.x * h.x + h.y * h.y;
  const double ratio = LogCosineRatio(s);
  const double hd = glm::dot(h, sample.O);
  for (int lobe = 0; lobe < layout.Model.NumberOfLobes; ++lobe)
  {
    const double* logs = parameters + lobe * layout.ExponentsPerLobe;
    const double u = std::exp(logs[0]); // n + 1
    const double v = layout.Model.Anisotropic ? std::exp(logs[1]) : u;
    double* values = basis.Values + 1 + lobe * layout.CoefficientsPerLobe;
    double* slopes = basis.LogSlopes[lobe];
    if (layout.Model.Shape == LobeShape::BlinnPhong)
    {
      values[0] = (u + 1.0) / (2.0 * Pi) * PowerCosine(u - 1.0, s);
      slopes[0] = u * (1.0 / (u + 1.0) + 0.5 * s * ratio);
      continue;
    }
    const double power = 0.5 * ((u - 1.0) * h.x * h.x + (v - 1.0) * h.y * h.y) * ratio;
    values[0] =
      std::sqrt(u * v) / (8.0 * Pi) * std::exp(power) / (hd * std::max(sample.I.z, sample.O.z));
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
double SolveCoefficients(const FitSamples& samples, const Layout& layout, double* parameters)
{
  const int count = layout.GetNumberOfCoefficients();
  std::vector<Basis> bases;
  bases.reserve(samples.size());
  for (const FitSample& sample : samples)
  {
    bases.push_back(Evaluate(layout, parameters, sample));
  }
  const FitLoss& loss = samples.GetLoss();
  double mean = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    double* coefficients = parameters + layout.GetCoefficient(c, 0);
    std::fill_n(coefficients, count, 0.0);
    constexpr int passes = 4;
    for (int pass = 0; pass <= passes; ++pass)
    {
      Eigen::MatrixXd H = Eigen::MatrixXd::Zero(count, count);
      Eigen::VectorXd g = Eigen::VectorXd::Zero(count);
      double sum = 0.0;
      for (std::size_t k = 0; k < samples.size(); ++k)
      {
        const FitSample& sample = samples[k];
        const double f = pass == 0 ? sample.F[c] : Dot(coefficients, bases[k], count);
        const double t = loss.Value(f, sample.I.z) - loss.Value(sample.F[c], sample.I.z);
        const double difference = f - sample.F[c];
        const double slope = std::abs(difference) > 1e-9 * (1.0 + f)
                               ? t / difference
                               : loss.Slope(sample.F[c], sample.I.z);
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

// Calls use(exponents) for all ascending choices of `lobes` exponents from 1 to 1e5.
void ForExponents(int lobes, const std::function<void(const std::vector<double>&)>& use)
{
  constexpr int steps = 11; // a factor of 2.8 each
  std::vector<int> choice(static_cast<std::size_t>(lobes));
  std::iota(choice.begin(), choice.end(), 0);
  for (;;)
  {
    std::vector<double> exponents;
    for (const int k : choice)
    {
      exponents.push_back(std::pow(10.0, 5.0 * k / steps));
    }
    use(exponents);
    int last = lobes - 1;
    while (last >= 0 && choice[last] == steps - (lobes - 1 - last))
    {
      --last;
    }
    if (last < 0)
    {
      return;
    }
    ++choice[last];
    std::iota(choice.begin() + last + 1, choice.end(), choice[last] + 1);
  }
}

// Parameters of lobes with these exponents, the best coefficients for them, and what they leave.
Start MakeStart(const FitSamples& samples, const Layout& layout,
  const std::vector<double>& exponents, double stretch)
{
  std::vector<double> parameters(static_cast<std::size_t>(layout.GetSize()));
  for (std::size_t lobe = 0; lobe < exponents.size(); ++lobe)
  {
    double* logs = &parameters[lobe * static_cast<std::size_t>(layout.ExponentsPerLobe)];
    logs[0] = std::log1p(exponents[lobe] * stretch);
    logs[layout.ExponentsPerLobe - 1] =
      std::log1p(layout.Model.Anisotropic ? exponents[lobe] / stretch : exponents[lobe]);
  }
  const double mean = SolveCoefficients(samples, layout, parameters.data());
  return { std::move(parameters), mean };
}

std::vector<Start> DrawStarts(
  const FitSamples& samples, const Layout& layout, unsigned int seed, int count)
{
  std::mt19937 generator(seed);
  const auto draw = [&generator]() { return generator() / 4294967296.0; };
  std::vector<Start> starts;
  for (int k = 0; k < count; ++k)
  {
    std::vector<double> exponents;
    for (int lobe = 0; lobe < layout.Model.NumberOfLobes; ++lobe)
    {
      exponents.push_back(std::pow(10.0, 5.0 * draw()));
    }
    starts.push_back(MakeStart(samples, layout, exponents, std::pow(4.0, 2.0 * draw() - 1.0)));
  }
  return starts;
}

// All starts with what they leave on a few samples, best first; none where it was stopped.
std::vector<Start> Screen(
  const FitSamples& samples, const Layout& layout, const std::function<bool()>& proceed)
{
  const std::vector<double> stretches =
    layout.Model.Anisotropic ? std::vector<double>{ 1.0, 4.0, 0.25 } : std::vector<double>{ 1.0 };
  std::vector<Start> starts;
  bool stopped = false;
  ForExponents(layout.Model.NumberOfLobes,
    [&](const std::vector<double>& exponents)
    {
      stopped = stopped || !proceed();
      for (std::size_t k = 0; k < stretches.size() && !stopped; ++k)
      {
        starts.push_back(MakeStart(samples, layout, exponents, stretches[k]));
      }
    });
  std::stable_sort(starts.begin(), starts.end(),
    [](const Start& a, const Start& b) { return a.MeanSquare < b.MeanSquare; });
  starts.resize(stopped ? 0 : starts.size());
  return starts;
}

// All residuals sqrt(w/3) (T(f') - T(f)): their sum of squares is the weighted mean square.
class LobeCost : public ceres::CostFunction
{
public:
  LobeCost(const FitSamples& samples, const Layout& layout)
    : Samples(samples)
    , Shape(layout)
  {
    this->set_num_residuals(static_cast<int>(3 * samples.size()));
    this->mutable_parameter_block_sizes()->push_back(layout.GetSize());
  }

  bool Evaluate(
    double const* const* parameters, double* residuals, double** jacobians) const override
  {
    const FitLoss& loss = this->Samples.GetLoss();
    const int size = this->Shape.GetSize();
    const int count = this->Shape.GetNumberOfCoefficients();
    for (std::size_t k = 0; k < 3 * this->Samples.size(); ++k)
    {
      const FitSample& sample = this->Samples[k / 3];
      const int c = static_cast<int>(k % 3);
      const Basis basis = measuredbrdf::Evaluate(this->Shape, parameters[0], sample);
      const double* coefficients = parameters[0] + this->Shape.GetCoefficient(c, 0);
      const double f = Dot(coefficients, basis, count);
      const double weight = std::sqrt(sample.Weight / 3.0);
      residuals[k] = weight * (loss.Value(f, sample.I.z) - loss.Value(sample.F[c], sample.I.z));
      if (jacobians)
      {
        double* row = jacobians[0] + k * size;
        std::fill_n(row, size, 0.0);
        const double slope = weight * loss.Slope(f, sample.I.z);
        std::transform(basis.Values, basis.Values + count, row + this->Shape.GetCoefficient(c, 0),
          [slope](double value) { return slope * value; });
        this->AddExponentSlopes(slope, coefficients, basis, row);
      }
    }
    return true;
  }

private:
  void AddExponentSlopes(
    double slope, const double* coefficients, const Basis& basis, double* row) const
  {
    for (int lobe = 0; lobe < this->Shape.Model.NumberOfLobes; ++lobe)
    {
      const int first = 1 + lobe * this->Shape.CoefficientsPerLobe;
      const double f = std::inner_product(coefficients + first,
        coefficients + first + this->Shape.CoefficientsPerLobe, basis.Values + first, 0.0);
      for (int e = 0; e < this->Shape.ExponentsPerLobe; ++e)
      {
        row[lobe * this->Shape.ExponentsPerLobe + e] = slope * f * basis.LogSlopes[lobe][e];
      }
    }
  }

  const FitSamples& Samples;
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
ceres::Solver::Summary Refine(const FitSamples& samples, const Layout& layout, Start& start,
  Watcher& watcher, int iterations, double tolerance)
{
  double* parameters = start.Parameters.data();
  ceres::Problem problem;
  problem.AddResidualBlock(new LobeCost(samples, layout), nullptr, parameters);
  for (int k = 0; k < layout.GetSize(); ++k)
  {
    problem.SetParameterLowerBound(parameters, k, 0.0);
    if (k < layout.GetNumberOfExponents())
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

struct FittedLobe
{
  double ExponentU, ExponentV;
  double Base[3], Rise[3];
};

vtkSmartPointer<vtkBRDF> MakeLobe(const FittedLobe& fitted, LobeShape shape, TextStream& report)
{
  const auto text = [](const double* rgb)
  {
    TextStream stream;
    stream << rgb[0] << " " << rgb[1] << " " << rgb[2];
    return stream.str();
  };
  if (shape == LobeShape::BlinnPhong)
  {
    vtkNew<vtkBlinnPhongBRDF> lobe;
    lobe->SetExponent(fitted.ExponentU);
    lobe->SetSpecular(fitted.Base);
    report << "lobe: exponent " << fitted.ExponentU << ", specular " << text(fitted.Base) << "\n";
    return lobe.Get();
  }
  double scale[3], reflectance[3];
  for (int c = 0; c < 3; ++c)
  {
    scale[c] = fitted.Base[c] + fitted.Rise[c];
    reflectance[c] = scale[c] > 0.0 ? fitted.Base[c] / scale[c] : 0.0;
  }
  vtkNew<vtkAshikhminShirleyBRDF> lobe;
  lobe->SetExponents(fitted.ExponentU, fitted.ExponentV);
  lobe->SetSpecularScale(scale);
  lobe->SetReflectance(reflectance);
  report << "lobe: exponents " << fitted.ExponentU << " " << fitted.ExponentV << ", scale "
         << text(scale) << ", reflectance " << text(reflectance) << "\n";
  return lobe.Get();
}

// The material of the parameters, and its report.
void Unpack(const Layout& layout, const std::vector<double>& parameters, LobeFitResult& result)
{
  double albedo[3];
  std::vector<FittedLobe> lobes(layout.Model.NumberOfLobes);
  for (int lobe = 0; lobe < layout.Model.NumberOfLobes; ++lobe)
  {
    const double* logs = &parameters[lobe * layout.ExponentsPerLobe];
    // Rounding must not carry them beyond the bound that they may have reached.
    lobes[lobe].ExponentU = std::min(std::expm1(logs[0]), MaximumExponent);
    lobes[lobe].ExponentV =
      std::min(std::expm1(logs[layout.ExponentsPerLobe - 1]), MaximumExponent);
    for (int c = 0; c < 3; ++c)
    {
      const double* coefficients = &parameters[layout.GetCoefficient(c, 0)];
      const double* own = coefficients + 1 + lobe * layout.CoefficientsPerLobe;
      albedo[c] = Pi * coefficients[0];
      lobes[lobe].Base[c] = own[0];
      lobes[lobe].Rise[c] = layout.CoefficientsPerLobe == 2 ? own[1] : 0.0;
    }
  }
  std::stable_sort(lobes.begin(), lobes.end(),
    [](const FittedLobe& a, const FittedLobe& b)
    { return a.ExponentU * a.ExponentV < b.ExponentU * b.ExponentV; });
  TextStream report;
  report << "diffuse albedo: " << albedo[0] << " " << albedo[1] << " " << albedo[2] << "\n";
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(albedo);
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  for (const FittedLobe& lobe : lobes)
  {
    sum->AddTerm(MakeLobe(lobe, layout.Model.Shape, report));
  }
  result.BRDF = sum;
  result.Report = report.str();
}
}

//------------------------------------------------------------------------------
LobeFitResult FitLobes(const FitSamples& samples, const LobeModel& model, vtkBRDFFitter* settings,
  const std::function<bool(double)>& progress)
{
  constexpr double screened = 0.2, refined = 0.6; // of the progress
  const Layout layout(model);
  const FitSamples few = samples.GetFirst(ScreeningSamples);
  std::vector<Start> starts =
    settings->GetStartSeed() > 0
      ? DrawStarts(few, layout, settings->GetStartSeed(), settings->GetNumberOfStarts())
      : Screen(few, layout, [&progress]() { return progress(0.0); });
  if (starts.empty())
  {
    return LobeFitResult();
  }
  starts.resize(std::min<std::size_t>(starts.size(), settings->GetNumberOfStarts()));
  const FitSamples some = samples.GetFirst(RefiningSamples);
  const double step = (refined - screened) / static_cast<double>(starts.size());
  double from = screened;
  for (Start& start : starts)
  {
    Watcher watcher(progress, from, from + step, RefiningIterations);
    Refine(some, layout, start, watcher, RefiningIterations, settings->GetTolerance());
    if (watcher.Stopped)
    {
      return LobeFitResult();
    }
    from += step;
  }
  Start best = *std::min_element(starts.begin(), starts.end(),
    [](const Start& a, const Start& b) { return a.MeanSquare < b.MeanSquare; });
  const int most = settings->GetMaximumNumberOfIterations();
  Watcher watcher(progress, refined, 1.0, most);
  const ceres::Solver::Summary solved =
    Refine(samples, layout, best, watcher, most, settings->GetTolerance());
  LobeFitResult result;
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
} // namespace measuredbrdf

#else
namespace measuredbrdf
{
LobeFitResult FitLobes(
  const FitSamples&, const LobeModel&, vtkBRDFFitter*, const std::function<bool(double)>&)
{
  LobeFitResult result;
  result.Report = "this build has no Ceres (MEASUREDBRDF_WITH_CERES): Blinn-Phong and "
                  "Ashikhmin-Shirley lobes cannot be fitted";
  return result;
}
} // namespace measuredbrdf
#endif
