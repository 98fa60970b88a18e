// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Known parameters come back, figures are what they are said to be, and bad input is refused.
#include "ErrorCatcher.h"
#include "ExpectStops.h"
#include "HalfVector.h"
#include "TestIOHelpers.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkLambertBRDF.h"
#include "vtkLobeBRDFFitter.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace
{
using measuredbrdf::Pi;

using Color = std::array<double, 3>;

vtkSmartPointer<vtkLambertBRDF> MakeLambert(const Color& albedo)
{
  auto brdf = vtkSmartPointer<vtkLambertBRDF>::New();
  brdf->SetAlbedo(albedo[0], albedo[1], albedo[2]);
  return brdf;
}

vtkSmartPointer<vtkBlinnPhongBRDF> MakePhong(double exponent, const Color& specular)
{
  auto brdf = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
  brdf->SetExponent(exponent);
  brdf->SetSpecular(specular[0], specular[1], specular[2]);
  return brdf;
}

vtkSmartPointer<vtkAshikhminShirleyBRDF> MakeAshikhmin(
  double nu, double nv, const Color& scale, const Color& reflectance)
{
  auto brdf = vtkSmartPointer<vtkAshikhminShirleyBRDF>::New();
  brdf->SetExponents(nu, nv);
  brdf->SetSpecularScale(scale[0], scale[1], scale[2]);
  brdf->SetReflectance(reflectance[0], reflectance[1], reflectance[2]);
  return brdf;
}

vtkSmartPointer<vtkSumBRDF> Sum(const std::vector<vtkBRDF*>& terms)
{
  auto sum = vtkSmartPointer<vtkSumBRDF>::New();
  for (vtkBRDF* term : terms)
  {
    sum->AddTerm(term);
  }
  return sum;
}

template <typename T>
T* Term(vtkBRDFFitter* fitter, int index)
{
  auto* sum = vtkSumBRDF::SafeDownCast(fitter->GetOutput());
  T* term = sum ? T::SafeDownCast(sum->GetTerm(index)) : nullptr;
  EXPECT_TRUE(term) << index;
  return term;
}

// Within a share of the expected value (of 1e-4 where that is less).
void ExpectClose(double value, double expected, double share, const std::string& what)
{
  EXPECT_NEAR(value, expected, share * std::max(std::abs(expected), 1e-4)) << what;
}

void ExpectClose(
  const double value[3], const Color& expected, double share, const std::string& what)
{
  for (int c = 0; c < 3; ++c)
  {
    ExpectClose(value[c], expected[c], share, what);
  }
}

vtkSmartPointer<vtkBRDFFitter> NewPhongFitter(int lobes = 1)
{
  auto fitter = vtkSmartPointer<vtkLobeBRDFFitter>::New();
  fitter->SetShapeToBlinnPhong();
  fitter->SetNumberOfLobes(lobes);
  return fitter;
}

vtkSmartPointer<vtkBRDFFitter> NewAshikhminFitter(int lobes = 1)
{
  auto fitter = vtkSmartPointer<vtkLobeBRDFFitter>::New();
  fitter->SetNumberOfLobes(lobes);
  return fitter;
}

void ExpectFit(vtkBRDFFitter* fitter, vtkBRDF* input)
{
  fitter->SetInput(input);
  ASSERT_TRUE(fitter->Fit());
  ASSERT_TRUE(fitter->GetOutput());
  const std::vector<double>& history = fitter->GetResidualHistory();
  for (std::size_t k = 1; k < history.size(); ++k)
  {
    EXPECT_LE(history[k], history[k - 1]) << k;
  }
  EXPECT_EQ(fitter->GetNumberOfIterations(), static_cast<int>(history.size()) - 1);
}

// A material of the test's own: what `function` says.
class FunctionBRDF : public vtkBRDF
{
public:
  static FunctionBRDF* New();
  vtkTypeMacro(FunctionBRDF, vtkBRDF);
  void GetShaderInputs(vtkBRDFShaderInputs&) override {}
  std::function<void(const double i[3], const double o[3], double f[3])> Function;

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    this->Function(i, o, f);
  }
};
vtkStandardNewMacro(FunctionBRDF);

// The other with a factor uniform in [1 - noise, 1 + noise] that depends on the bits of i and o.
vtkSmartPointer<vtkBRDF> MakeNoisy(vtkBRDF* clean, double noise)
{
  auto noisy = vtkSmartPointer<FunctionBRDF>::New();
  const vtkSmartPointer<vtkBRDF> kept = clean;
  noisy->Function = [kept, noise](const double i[3], const double o[3], double f[3])
  {
    kept->Evaluate(i, o, f);
    std::uint64_t hash = 1469598103934665603u;
    for (const double value : { i[0], i[1], i[2], o[0], o[1], o[2] })
    {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof(bits));
      hash = (hash ^ bits) * 1099511628211u;
      hash ^= hash >> 29;
    }
    for (int c = 0; c < 3; ++c)
    {
      hash = hash * 6364136223846793005u + 1442695040888963407u;
      f[c] *= 1.0 + noise * (2.0 * static_cast<double>(hash >> 11) * 0x1p-53 - 1.0);
    }
  };
  return noisy;
}
}

namespace
{
// Two lobes of p, in color, and Schlick's F, in the tables that the fitter has.
vtkSmartPointer<vtkDistributionBRDF> MakeDistribution(int nTheta, int nPhi)
{
  constexpr int nFresnel = 32;
  auto brdf = vtkSmartPointer<vtkDistributionBRDF>::New();
  std::vector<float> p, fresnel;
  for (int k = 0; k < nTheta * nPhi; ++k)
  {
    const double u = (k % nTheta + 0.5) / nTheta;
    const double c = std::cos(0.5 * Pi * u * u);
    const double side = nPhi > 1 ? std::cos(2.0 * Pi * (k / nTheta + 0.5) / nPhi) : 0.0;
    for (const double n : { 30.0, 120.0, 120.0 })
    {
      const double lobe = std::pow(c, n * (1.0 + 0.8 * side * side));
      p.push_back(static_cast<float>(lobe + 0.05 * std::pow(c, 4.0)));
    }
  }
  for (int k = 0; k < nFresnel; ++k)
  {
    const double m = 1.0 - std::cos(0.5 * Pi * (k + 0.5) / nFresnel);
    for (const double f0 : { 0.05, 0.2, 0.6 })
    {
      fresnel.push_back(static_cast<float>(f0 + (1.0 - f0) * std::pow(m, 5.0)));
    }
  }
  EXPECT_TRUE(brdf->SetDistribution(nTheta, nPhi, p));
  EXPECT_TRUE(brdf->SetFresnel(nFresnel, fresnel));
  return brdf;
}

// What lies in the model comes back: the fit has its values, and its lobes' exponents.
struct Known
{
  const char* Name;
  vtkSmartPointer<vtkBRDFFitter> (*NewFitter)();
  vtkSmartPointer<vtkBRDF> (*NewInput)();
  double RelativeError;
  std::vector<double> Exponents; // of the lobes, u and v
};

template <int exponent>
vtkSmartPointer<vtkBRDF> NewPhongInput()
{
  return Sum({ MakeLambert({ 0.3, 0.1, 0.02 }), MakePhong(exponent, { 0.05, 0.1, 0.2 }) });
}

template <int loss>
vtkSmartPointer<vtkBRDFFitter> NewAshikhminOf()
{
  const auto fitter = NewAshikhminFitter();
  fitter->SetLoss(loss);
  return fitter;
}

template <int loss>
vtkSmartPointer<vtkBRDFFitter> NewTablesOf()
{
  const auto fitter = vtkSmartPointer<vtkDistributionBRDFFitter>::New();
  fitter->SetLoss(loss);
  return fitter;
}

vtkSmartPointer<vtkBRDF> NewAshikhminInput()
{
  return Sum({ MakeLambert({ 0.2, 0.3, 0.0 }),
    MakeAshikhmin(150.0, 150.0, { 0.9, 0.5, 0.7 }, { 0.04, 0.3, 0.9 }) });
}

vtkSmartPointer<vtkBRDF> NewTablesInput()
{
  return Sum({ MakeLambert({ 0.3, 0.2, 0.1 }), MakeDistribution(128, 1) });
}

const Known Cases[] = {
  { "Phong10", []() { return NewPhongFitter(); }, NewPhongInput<10>, 1e-3, { 10 } },
  { "Phong1000", []() { return NewPhongFitter(); }, NewPhongInput<1000>, 1e-3, { 1000 } },
  { "Phong30000", []() { return NewPhongFitter(); }, NewPhongInput<30000>, 1e-3, { 30000 } },
  { "ThreePhongs",
    []()
    {
      const auto fitter = NewPhongFitter(3);
      fitter->SetTolerance(1e-10);
      return fitter;
    },
    []() -> vtkSmartPointer<vtkBRDF>
    {
      return Sum({ MakeLambert({ 0.1, 0.2, 0.3 }), MakePhong(5.0, { 0.1, 0.05, 0.1 }),
        MakePhong(80.0, { 0.05, 0.1, 0.15 }), MakePhong(3000.0, { 0.05, 0.04, 0.03 }) });
    },
    1e-2, { 5, 80, 3000 } },
  { "AshikhminLogarithm", NewAshikhminOf<vtkBRDFFitter::LOG_COSINE>, NewAshikhminInput, 1e-3,
    { 150, 150 } },
  { "AshikhminCubeRoot", NewAshikhminOf<vtkBRDFFitter::CUBE_ROOT_COSINE>, NewAshikhminInput, 1e-3,
    { 150, 150 } },
  { "AshikhminSquared", NewAshikhminOf<vtkBRDFFitter::SQUARED>, NewAshikhminInput, 1e-3,
    { 150, 150 } },
  { "Brushed", []() { return NewAshikhminFitter(); },
    []() -> vtkSmartPointer<vtkBRDF>
    {
      return Sum({ MakeLambert({ 0.1, 0.1, 0.1 }),
        MakeAshikhmin(900.0, 20.0, { 0.5, 0.6, 0.7 }, { 0.2, 0.4, 0.6 }) });
    },
    1e-3, { 900, 20 } },
  { "BrushedThatIsNot",
    []() -> vtkSmartPointer<vtkBRDFFitter>
    {
      auto fitter = vtkSmartPointer<vtkLobeBRDFFitter>::New();
      fitter->SetAnisotropy(vtkLobeBRDFFitter::ANISOTROPIC);
      return fitter;
    },
    NewAshikhminInput, 1e-3, { 150, 150 } },
  { "Tables", NewTablesOf<vtkBRDFFitter::LOG_COSINE>, NewTablesInput, 1e-5, {} },
  { "TablesCubeRoot", NewTablesOf<vtkBRDFFitter::CUBE_ROOT_COSINE>, NewTablesInput, 1e-3, {} },
  { "TablesSquared", NewTablesOf<vtkBRDFFitter::SQUARED>, NewTablesInput, 1e-3, {} },
  { "BrushedTables",
    []() -> vtkSmartPointer<vtkBRDFFitter>
    {
      auto fitter = vtkSmartPointer<vtkDistributionBRDFFitter>::New();
      fitter->SetNumberOfPhiSamples(32);
      fitter->SetNumberOfSamples(1 << 17);
      fitter->SetNumberOfStarts(1);
      fitter->SetMaximumNumberOfIterations(15);
      return fitter;
    },
    []() -> vtkSmartPointer<vtkBRDF> { return MakeDistribution(48, 32); }, 0.01, {} },
  { "MatteTables", NewTablesOf<vtkBRDFFitter::LOG_COSINE>,
    []() -> vtkSmartPointer<vtkBRDF> {
      return Sum({ MakeLambert({ 0.6, 0.3, 0.0 }) });
    },
    0.01, {} },
  { "ManyCells", // whose equations are sparse
    []() -> vtkSmartPointer<vtkBRDFFitter>
    {
      auto fitter = vtkSmartPointer<vtkDistributionBRDFFitter>::New();
      fitter->SetNumberOfPhiSamples(256);
      fitter->SetNumberOfSamples(4096);
      fitter->SetNumberOfStarts(1);
      fitter->SetMaximumNumberOfIterations(1);
      return fitter;
    },
    NewTablesInput, 1.0, {} },
};
}

class KnownFit : public testing::TestWithParam<Known>
{
};

TEST_P(KnownFit, ComesBack)
{
  const auto fitter = GetParam().NewFitter();
  ExpectFit(fitter, GetParam().NewInput());
  EXPECT_LT(fitter->GetRelativeL2Error(), GetParam().RelativeError);
  EXPECT_LT(fitter->GetResidual(), 0.1 * GetParam().RelativeError);
  std::vector<double> exponents;
  auto* sum = vtkSumBRDF::SafeDownCast(fitter->GetOutput());
  ASSERT_TRUE(sum);
  for (int k = 1; k < sum->GetNumberOfTerms(); ++k) // by ascending exponent
  {
    if (auto* phong = vtkBlinnPhongBRDF::SafeDownCast(sum->GetTerm(k)))
    {
      exponents.push_back(phong->GetExponent());
    }
    if (auto* lobe = vtkAshikhminShirleyBRDF::SafeDownCast(sum->GetTerm(k)))
    {
      exponents.insert(exponents.end(), { lobe->GetExponentU(), lobe->GetExponentV() });
    }
    if (auto* tables = vtkDistributionBRDF::SafeDownCast(sum->GetTerm(k)))
    {
      const std::vector<float>& fresnel = tables->GetFresnel();
      for (std::size_t n = 3; n < fresnel.size(); ++n)
      {
        EXPECT_GE(fresnel[n], fresnel[n - 3]) << n;
      }
    }
  }
  ASSERT_EQ(exponents.size(), GetParam().Exponents.size());
  for (std::size_t k = 0; k < exponents.size(); ++k)
  {
    ExpectClose(exponents[k], GetParam().Exponents[k], 0.01, "exponent");
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, KnownFit, testing::ValuesIn(Cases),
  [](const testing::TestParamInfo<Known>& info) { return info.param.Name; });

//------------------------------------------------------------------------------
TEST(Fit, SameSeedSameResult)
{
  const auto input =
    MakeNoisy(Sum({ MakeLambert({ 0.3, 0.2, 0.1 }), MakePhong(40.0, { 0.1, 0.2, 0.3 }) }), 0.1);
  for (const auto& fitter : { NewAshikhminFitter(2), NewTablesOf<0>() })
  {
    SCOPED_TRACE(fitter->GetModelName());
    fitter->SetNumberOfSamples(1 << 13);
    ExpectFit(fitter, input);
    const vtkSmartPointer<vtkBRDF> first = fitter->GetOutput();
    const double residual = fitter->GetResidual();
    ExpectFit(fitter, input);
    EXPECT_NE(first, fitter->GetOutput());
    EXPECT_EQ(residual, fitter->GetResidual());
    testio::ExpectSameValues(first, fitter->GetOutput());
    fitter->SetSeed(2);
    ExpectFit(fitter, input);
    EXPECT_NE(residual, fitter->GetResidual());
    EXPECT_NEAR(residual, fitter->GetResidual(), 0.1 * residual);
  }
}

//------------------------------------------------------------------------------
namespace
{
// The losses as their papers write them.
double Transform(int loss, double f, double cosine)
{
  return loss == vtkBRDFFitter::LOG_COSINE         ? std::log(1.0 + f * cosine)
         : loss == vtkBRDFFitter::CUBE_ROOT_COSINE ? std::cbrt(f * cosine)
                                                   : f * std::sqrt(cosine);
}

// Residual of two isotropic materials by the midpoint rule: sin(theta_i) cos(theta_o)
// sin(theta_o), views to a cosine of 0.02.
double Quadrature(vtkBRDF* a, vtkBRDF* b, int loss)
{
  constexpr int n = 40;
  double sum = 0.0, weights = 0.0;
  for (int k = 0; k < n * n * n; ++k)
  {
    const double ti = 0.5 * Pi * (k % n + 0.5) / n;
    const double to = std::acos(0.02) * (k / n % n + 0.5) / n;
    const double phi = Pi * (k / (n * n) + 0.5) / n;
    const double i[3] = { std::sin(ti), 0.0, std::cos(ti) };
    const double o[3] = { std::sin(to) * std::cos(phi), std::sin(to) * std::sin(phi),
      std::cos(to) };
    const double weight = std::sin(ti) * std::sin(to) * std::cos(to);
    double fa[3], fb[3];
    a->Evaluate(i, o, fa);
    b->Evaluate(i, o, fb);
    for (int c = 0; c < 3; ++c)
    {
      const double t = Transform(loss, fa[c], i[2]) - Transform(loss, fb[c], i[2]);
      sum += weight * t * t;
      weights += weight;
    }
  }
  return std::sqrt(sum / weights);
}

// A parameter that is larger or smaller by this share makes the residual grow.
void ExpectLeast(vtkBRDF* input, vtkBRDF* fit, int loss, double share,
  const std::function<void(double factor)>& scale)
{
  const double least = Quadrature(input, fit, loss);
  for (const double factor : { 1.0 - share, 1.0 + share })
  {
    scale(factor);
    EXPECT_GT(Quadrature(input, fit, loss), least) << factor;
    scale(1.0 / factor);
  }
}
}

TEST(Fit, FiguresAreWhatTheyAreSaidToBe)
{
  // An input that the model can't reach, smooth enough for a plain quadrature.
  const auto input = Sum({ MakeLambert({ 0.2, 0.4, 0.1 }), MakePhong(2.0, { 0.1, 0.1, 0.2 }),
    MakePhong(20.0, { 0.1, 0.2, 0.3 }) });
  for (const int loss :
    { vtkBRDFFitter::LOG_COSINE, vtkBRDFFitter::CUBE_ROOT_COSINE, vtkBRDFFitter::SQUARED })
  {
    SCOPED_TRACE(loss);
    const auto fitter = NewPhongFitter();
    fitter->SetLoss(loss);
    ExpectFit(fitter, input);
    const double expected = Quadrature(input, fitter->GetOutput(), loss);
    ExpectClose(fitter->GetResidual(), expected, 0.02, "residual");
    ExpectClose(fitter->GetResidualHistory().back(), expected, 0.05, "residual of the fit's pairs");
    ExpectClose(fitter->GetRelativeL2Error(),
      vtkBRDFResampler::GetRelativeL2Error(input, fitter->GetOutput()), 0.03, "relative L2");
    // The least of its own loss: 2 % more or less of anything is worse.
    auto* lobe = Term<vtkBlinnPhongBRDF>(fitter, 1);
    ExpectLeast(input, fitter->GetOutput(), loss, 0.02,
      [lobe](double factor) { lobe->SetExponent(factor * lobe->GetExponent()); });
    ExpectLeast(input, fitter->GetOutput(), loss, 0.02,
      [lobe](double factor)
      {
        const double* ks = lobe->GetSpecular();
        lobe->SetSpecular(factor * ks[0], factor * ks[1], factor * ks[2]);
      });
  }
}

//------------------------------------------------------------------------------
// Far from the input: relative to what is a figure's own affair.
TEST(Fit, RelativeErrorIsRelativeToTheInput)
{
  const auto input = MakeAshikhmin(400.0, 2.0, { 0.5, 0.7, 0.9 }, { 0.3, 0.3, 0.3 });
  const auto fitter = NewPhongFitter();
  ExpectFit(fitter, input);
  const double expected = vtkBRDFResampler::GetRelativeL2Error(input, fitter->GetOutput());
  EXPECT_GT(expected, 0.3);
  ExpectClose(fitter->GetRelativeL2Error(), expected, 0.03, "relative L2");
}

//------------------------------------------------------------------------------
// Cells that follow the noise of the fit's own pairs do not help on others: figures are of pairs
// that the fit did not see.
TEST(Fit, FiguresAreOfPairsThatTheFitDidNotSee)
{
  const auto fitter = NewTablesOf<0>();
  fitter->SetNumberOfSamples(1024);
  fitter->SetNumberOfStarts(1);
  fitter->SetMaximumNumberOfIterations(5);
  ExpectFit(fitter, MakeNoisy(MakeDistribution(128, 1), 0.5));
  EXPECT_GT(fitter->GetResidual(), 1.02 * fitter->GetResidualHistory().back());
}

//------------------------------------------------------------------------------
TEST(Fit, AlbedoIsTheHemispheres)
{
  const auto input = Sum({ MakeLambert({ 0.2, 0.4, 0.1 }),
    MakeAshikhmin(100.0, 100.0, { 0.5, 0.7, 0.9 }, { 0.1, 0.3, 0.8 }) });
  const auto fitter = NewPhongFitter();
  ExpectFit(fitter, input);
  // 2 integral a(theta) cos sin dtheta, with cos^2 as the variable.
  const auto integrate = [](vtkBRDF* brdf)
  {
    Color albedo = { 0.0, 0.0, 0.0 };
    constexpr int n = 16;
    for (int k = 0; k < n; ++k)
    {
      const double z = std::sqrt((k + 0.5) / n);
      const double o[3] = { std::sqrt(1.0 - z * z), 0.0, z };
      double a[3];
      brdf->GetDirectionalAlbedo(o, a);
      for (int c = 0; c < 3; ++c)
      {
        albedo[c] += a[c] / n;
      }
    }
    return albedo;
  };
  ExpectClose(fitter->GetInputAlbedo(), integrate(input), 0.01, "albedo");
  ExpectClose(fitter->GetOutputAlbedo(), integrate(fitter->GetOutput()), 0.01, "output's albedo");
}

//------------------------------------------------------------------------------
TEST(Fit, HolesInATableDoNotCount)
{
  const auto source = Sum({ MakeLambert({ 0.3, 0.2, 0.1 }), MakePhong(30.0, { 0.1, 0.2, 0.3 }) });
  vtkNew<vtkBRDFResampler> resampler;
  resampler->SetInput(source);
  resampler->ReciprocalOn();
  ASSERT_TRUE(resampler->ResampleTo(16, 32, 64));
  std::vector<float> volume = resampler->GetOutput()->GetVolume();
  const int size[3] = { 16, 32, 64 };
  for (std::size_t cell = 0; cell < volume.size() / 3; ++cell)
  {
    const std::size_t thetaD = cell / 16 % 32, thetaH = cell / (16 * 32);
    if (thetaD > 20 || (thetaH > 20 && thetaH < 40))
    {
      volume[3 * cell + cell % 3] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  vtkNew<vtkTabulatedBRDF> table;
  ASSERT_TRUE(
    table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, size, volume));
  ASSERT_GT(table->GetNumberOfInvalidCells(), 16 * 32 * 64 / 2);
  const auto fitter = NewPhongFitter();
  const auto sum = Sum({ table });
  for (vtkBRDF* input : { static_cast<vtkBRDF*>(table), static_cast<vtkBRDF*>(sum) })
  {
    ExpectFit(fitter, input);
    ExpectClose(Term<vtkLambertBRDF>(fitter, 0)->GetAlbedo(), { 0.3, 0.2, 0.1 }, 0.01, "albedo");
    ExpectClose(Term<vtkBlinnPhongBRDF>(fitter, 1)->GetExponent(), 30.0, 0.02, "exponent");
    EXPECT_LT(fitter->GetRelativeL2Error(), 0.02);
  }

  // Nothing but holes: nothing to fit.
  std::fill(volume.begin(), volume.end(), std::numeric_limits<float>::quiet_NaN());
  vtkNew<vtkTabulatedBRDF> empty;
  ASSERT_TRUE(
    empty->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, size, volume));
  ErrorCatcher errors(fitter);
  fitter->SetInput(empty);
  EXPECT_FALSE(fitter->Fit());
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_NE(errors.GetText().find("valid"), std::string::npos) << errors.GetText();
}

//------------------------------------------------------------------------------
TEST(Fit, BadOptionsAreRefused)
{
  const auto good = MakePhong(20.0, { 0.1, 0.1, 0.1 });
  const auto fitter = NewAshikhminFitter();
  ErrorCatcher errors(fitter);
  const auto expectRefused = [&](const std::string& word)
  {
    vtkBRDF* before = fitter->GetOutput();
    const double residual = fitter->GetResidual();
    EXPECT_FALSE(fitter->Fit());
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_NE(errors.GetText().find(word), std::string::npos) << errors.GetText();
    EXPECT_EQ(fitter->GetOutput(), before);
    EXPECT_EQ(fitter->GetResidual(), residual);
  };
  expectRefused("no input");
  fitter->SetInput(good);
  fitter->SetNumberOfSamples(1024);
  fitter->SetNumberOfStarts(1);
  fitter->SetMaximumNumberOfIterations(10);
  ASSERT_TRUE(fitter->Fit());
  fitter->SetInput(MakeLambert({ 0.0, 0.0, 0.0 }));
  expectRefused("nothing to fit");
  fitter->SetInput(MakeLambert({ 1e200, 1.0, 0.0 }));
  expectRefused("too large");
}

//------------------------------------------------------------------------------
TEST(Fit, ProgressAndAbort)
{
  const auto input = Sum({ MakeLambert({ 0.3, 0.2, 0.1 }),
    MakeAshikhmin(30.0, 30.0, { 0.5, 0.7, 0.9 }, { 0.1, 0.3, 0.8 }) });
  for (const auto& fitter : { NewPhongFitter(2), NewTablesOf<0>() })
  {
    SCOPED_TRACE(fitter->GetModelName());
    fitter->SetInput(input);
    fitter->SetNumberOfSamples(1 << 13);
    ExpectStops(
      fitter.Get(), [&]() { return fitter->Fit(); }, [&]() { return fitter->GetOutput(); }, 1,
      { 0.0, 0.2, 0.29 });
  }
}

//------------------------------------------------------------------------------
TEST(Fit, OutputIsAMaterialLikeAnyOther)
{
  const auto input = Sum({ MakeLambert({ 0.3, 0.2, 0.1 }), MakePhong(30.0, { 0.1, 0.2, 0.3 }) });
  input->SetName("paint");
  input->SetSource("a test");
  vtkNew<vtkDistributionBRDFFitter> fitter;
  ExpectFit(fitter, input);
  EXPECT_EQ(fitter->GetOutput()->GetName(), "paint");
  EXPECT_EQ(fitter->GetOutput()->GetSource(), "D-BRDF fitted to a test");
  EXPECT_NE(fitter->GetReport().find("diffuse albedo: "), std::string::npos);
  EXPECT_EQ(fitter->GetOutput()->GetRenderable(), fitter->GetOutput());
  const testio::Folder folder;
  testio::Write(fitter->GetOutput(), folder("fit.exr"));
  testio::ExpectSameValues(fitter->GetOutput(), testio::Read(folder("fit.exr")));
  std::ostringstream text;
  fitter->Print(text);
  EXPECT_NE(text.str().find("Residual: "), std::string::npos);
}

//------------------------------------------------------------------------------
namespace
{
// A program's own model, with the public headers alone. The albedo whose f' = albedo / pi is best
// in the sense of SQUARED: a weighted mean of f.
class LambertFitter : public vtkBRDFFitter
{
public:
  static LambertFitter* New();
  vtkTypeMacro(LambertFitter, vtkBRDFFitter);

  std::string GetModelName() override { return "Lambert"; }

  double SumOfWeights = 0.0;
  double MeanSquare = 0.0; // with GetLossValue

protected:
  Result FitTo(const std::vector<Sample>& samples) override
  {
    double albedo[3] = { 0.0, 0.0, 0.0 };
    double total = 0.0;
    this->SumOfWeights = 0.0;
    for (const Sample& sample : samples)
    {
      this->SumOfWeights += sample.Weight;
      total += sample.Weight * sample.I[2];
      for (int c = 0; c < 3; ++c)
      {
        albedo[c] += Pi * sample.Weight * sample.I[2] * sample.F[c];
      }
    }
    this->MeanSquare = 0.0;
    for (double& value : albedo)
    {
      value /= total;
    }
    for (const Sample& sample : samples)
    {
      for (int c = 0; c < 3; ++c)
      {
        const double difference = this->GetLossValue(sample.F[c], sample.I[2]) -
                                  this->GetLossValue(albedo[c] / Pi, sample.I[2]);
        this->MeanSquare += sample.Weight * difference * difference / 3.0;
      }
    }
    vtkNew<vtkLambertBRDF> lambert;
    lambert->SetAlbedo(albedo);
    return { lambert.Get(), { this->MeanSquare }, this->UpdateProgress(0.5), "a report" };
  }
};
vtkStandardNewMacro(LambertFitter);
}

//------------------------------------------------------------------------------
// Over fresh pairs the residual is about the fit's own.
TEST(CustomFitter, IsMeasuredAsTheOthersAre)
{
  vtkNew<vtkLambertBRDF> diffuse;
  diffuse->SetAlbedo(0.3, 0.5, 0.2);
  vtkNew<vtkBlinnPhongBRDF> gloss;
  gloss->SetExponent(5.0);
  gloss->SetSpecular(0.1, 0.1, 0.1);
  vtkNew<vtkSumBRDF> input;
  input->AddTerm(diffuse);
  input->AddTerm(gloss);
  input->SetName("chalk");
  vtkNew<LambertFitter> fitter;
  fitter->SetLossToSquared();
  fitter->SetInput(input);
  ASSERT_TRUE(fitter->Fit());
  EXPECT_NEAR(fitter->SumOfWeights, 1.0, 1e-12);
  EXPECT_TRUE(fitter->GetConverged());
  EXPECT_EQ(fitter->GetReport(), "a report");
  EXPECT_EQ(fitter->GetOutput()->GetName(), "chalk");
  ASSERT_EQ(fitter->GetResidualHistory().size(), 1u);
  EXPECT_DOUBLE_EQ(fitter->GetResidualHistory()[0], std::sqrt(fitter->MeanSquare));
  EXPECT_GT(fitter->GetResidual(), 0.0);
  EXPECT_NEAR(fitter->GetResidual(), fitter->GetResidualHistory()[0], 1e-2 * fitter->GetResidual());
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(fitter->GetOutputAlbedo()[c], fitter->GetInputAlbedo()[c], 0.02);
  }
}
