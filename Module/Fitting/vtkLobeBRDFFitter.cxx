// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLobeBRDFFitter.h"

#include "HalfVector.h"
#include "LeastSquares.h"
#include "LinearLeastSquares.h"
#include "NumberText.h"
#include "Setters.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSumBRDF.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

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

namespace measuredbrdf
{
namespace
{
constexpr double MaximumExponent = 1e6; // what the representations take
constexpr std::size_t ScreeningSamples = 2048;
constexpr std::size_t RefiningSamples = 4096;
constexpr int RefiningIterations = 30;

// The parameters as one vector: ln(n+1) per exponent, then per channel the Lambert albedo / pi
// and base[, rise] per lobe. f = albedo/pi + sum over lobes of (base + rise (1 - h.o)^5)
// shape(exponents): linear in all parameters except the exponents. The scale S and reflectance R of
// Ashikhmin-Shirley are replaced by base = S R and rise = S (1 - R). Changes of S and R can cancel
// each other; changes of base and rise cannot, and the bounds S >= 0, 0 <= R <= 1 become base >= 0,
// rise >= 0. Shapes: Blinn-Phong's (n+2)/(2 pi) cos^n theta_h; Ashikhmin-Shirley's
// sqrt((nu+1)(nv+1))/(8 pi) (n.h)^e / ((h.o) max(cos_i, cos_o)).
struct Layout
{
  Layout(bool isPhong, int lobes, bool isAnisotropic)
    : IsPhong(isPhong)
    , NumberOfLobes(lobes)
    , ExponentsPerLobe(isAnisotropic ? 2 : 1)
    , CoefficientsPerLobe(isPhong ? 1 : 2)
    , Exponents(lobes * this->ExponentsPerLobe)
    , Coefficients(1 + lobes * this->CoefficientsPerLobe)
    , Size(this->Exponents + 3 * this->Coefficients)
  {
  }

  bool IsPhong;
  int NumberOfLobes;
  int ExponentsPerLobe; // 2: anisotropic, only Ashikhmin-Shirley's
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
  for (int lobe = 0; lobe < layout.NumberOfLobes; ++lobe)
  {
    const double* logs = parameters + lobe * layout.ExponentsPerLobe;
    const double u = std::exp(logs[0]); // n + 1
    const double v = layout.ExponentsPerLobe > 1 ? std::exp(logs[1]) : u;
    double* values = basis.Values + 1 + lobe * layout.CoefficientsPerLobe;
    double* slopes = basis.LogSlopes[lobe];
    if (layout.IsPhong)
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
    if (layout.ExponentsPerLobe == 1)
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
  const std::vector<double> stretches = layout.ExponentsPerLobe > 1
                                          ? std::vector<double>{ 1.0, 4.0, 0.25 }
                                          : std::vector<double>{ 1.0 };
  const int lobes = layout.NumberOfLobes;
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
        if (layout.ExponentsPerLobe > 1)
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

// Improves all parameters. The residuals are sqrt(w/3) (T(f') - T(f)): their sum of squares is the
// weighted mean square.
void Refine(const vtkBRDFFitter::Samples& samples, const vtkBRDFFitter& loss, const Layout& layout,
  Start& start, LeastSquares& method)
{
  Eigen::VectorXd parameters =
    Eigen::Map<const Eigen::VectorXd>(start.Parameters.data(), layout.Size);
  method.Least.setZero(layout.Size);
  method.Most.setConstant(layout.Size, std::numeric_limits<double>::max());
  method.Most.head(layout.Exponents).setConstant(std::log1p(MaximumExponent));
  // Calls use(row, sample, channel, first coefficient, basis, f, weight) for each residual. The
  // bases are kept: they take the most time, and values and derivatives are asked for in turns.
  std::vector<Basis> bases(samples.size());
  Eigen::VectorXd known =
    Eigen::VectorXd::Constant(layout.Size, std::numeric_limits<double>::quiet_NaN());
  const auto forResiduals = [&](const Eigen::VectorXd& at, const auto& use)
  {
    if (known != at)
    {
      std::transform(samples.begin(), samples.end(), bases.begin(),
        [&](const vtkBRDFFitter::Sample& sample) { return Evaluate(layout, at.data(), sample); });
      known = at;
    }
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      const vtkBRDFFitter::Sample& sample = samples[k];
      const Basis& basis = bases[k];
      const double weight = std::sqrt(sample.Weight / 3.0);
      for (int c = 0; c < 3; ++c)
      {
        const int first = layout.Exponents + c * layout.Coefficients;
        const double f = Dot(at.data() + first, basis, layout.Coefficients);
        use(row++, sample, c, first, basis, f, weight);
      }
    }
  };
  const auto size = 3 * static_cast<Eigen::Index>(samples.size());
  const auto getResiduals = [&](const Eigen::VectorXd& at)
  {
    Eigen::VectorXd residuals(size);
    forResiduals(at,
      [&](Eigen::Index row, const vtkBRDFFitter::Sample& sample, int c, int, const Basis&, double f,
        double weight)
      {
        residuals[row] = weight * (loss.GetLossValue(f, sample.I[2]) -
                                    loss.GetLossValue(sample.F[c], sample.I[2]));
      });
    return residuals;
  };
  const auto getJacobian = [&](const Eigen::VectorXd& at, const Eigen::VectorXd&)
  {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Rows jacobian = Rows::Zero(size, layout.Size);
    forResiduals(at,
      [&](Eigen::Index row, const vtkBRDFFitter::Sample& sample, int, int first, const Basis& basis,
        double f, double weight)
      {
        const double slope = weight * loss.GetLossSlope(f, sample.I[2]);
        for (int k = 0; k < layout.Coefficients; ++k)
        {
          jacobian(row, first + k) = slope * basis.Values[k];
        }
        for (int e = 0; e < layout.Exponents; ++e)
        {
          const int lobe = e / layout.ExponentsPerLobe;
          const int own = 1 + lobe * layout.CoefficientsPerLobe;
          const double* coefficients = at.data() + first + own;
          const double part = std::inner_product(
            coefficients, coefficients + layout.CoefficientsPerLobe, basis.Values + own, 0.0);
          jacobian(row, e) = slope * part * basis.LogSlopes[lobe][e % layout.ExponentsPerLobe];
        }
      });
    return jacobian;
  };
  start.MeanSquare = method.Minimize(getResiduals, getJacobian, parameters);
  std::copy_n(parameters.data(), layout.Size, start.Parameters.begin());
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
  std::vector<int> lobes(static_cast<std::size_t>(layout.NumberOfLobes));
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
    if (layout.IsPhong)
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
  const Layout layout(isPhong, this->NumberOfLobes, !isPhong && isBrushed);
  const vtkBRDFFitter& loss = *this;
  bool stopped = false;
  Result result;
  const auto refine = [&](
                        const Samples& pairs, Start& start, int iterations, double from, double to)
  {
    LeastSquares method;
    method.MostIterations = iterations;
    method.Tolerance = this->Tolerance;
    result.History.clear();
    method.Proceed = [&](int iteration, double squares)
    {
      result.History.push_back(squares);
      stopped = stopped || !this->UpdateProgress(from + (to - from) * iteration / iterations);
      return !stopped;
    };
    Refine(pairs, loss, layout, start, method);
    result.Converged = method.Converged;
  };
  std::vector<Start> starts = Screen(TakeFirst(samples, ScreeningSamples), loss, layout,
    [this](double share) { return this->UpdateProgress(share); });
  starts.resize(std::min<std::size_t>(starts.size(), this->NumberOfStarts));
  const Samples some = TakeFirst(samples, RefiningSamples);
  const double step = (refined - screened) / this->NumberOfStarts;
  Start best{ {}, std::numeric_limits<double>::infinity() };
  for (std::size_t k = 0; k < starts.size() && !stopped; ++k)
  {
    const double from = screened + step * static_cast<double>(k);
    refine(some, starts[k], RefiningIterations, from, from + step);
    best = starts[k].MeanSquare < best.MeanSquare ? starts[k] : best;
  }
  if (!best.Parameters.empty() && !stopped)
  {
    refine(samples, best, this->MaximumNumberOfIterations, refined, 1.0);
    if (std::isfinite(best.MeanSquare))
    {
      Unpack(layout, best.Parameters, result);
    }
  }
  return result;
}
