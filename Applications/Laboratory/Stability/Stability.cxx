// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Stability.h"

#include "Meshes.h"
#include "Methods.h"
#include "Progress.h"
#include "Scenes.h"
#include "Sheets.h"
#include "Surface.h"
#include "Tool.h"

#include "vtkActor.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBasisBRDF.h"
#include "vtkBasisProjector.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkNew.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadianceMethods.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderer.h"
#include "vtkSumBRDF.h"
#include "vtkTableRadianceIntegrator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace
{
constexpr tool::View SphereView = { 30.0, 20.0 };
constexpr double SphereFill = 0.9;
constexpr int Tile = 128;
constexpr int Lights = 64;      // of the thesis
constexpr int SoftLights = 256; // the planner's, for anisotropic materials
constexpr int Samples = 16;     // the planner's
constexpr int ThesisOrder = 6;

using tool::stability::Vector;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> Plan(vtkBRDF* brdf, vtkEnvironment* environment)
{
  vtkNew<vtkRadiancePlanner> planner;
  planner->SetBRDF(brdf);
  planner->SetEnvironment(environment);
  if (!planner->Update())
  {
    throw tool::Error("planning: " + tool::TakeErrorText());
  }
  return vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
}

//------------------------------------------------------------------------------
template <typename Integrator>
vtkSmartPointer<Integrator> MakeFor(vtkBRDF* brdf, vtkEnvironment* environment)
{
  auto integrator = vtkSmartPointer<Integrator>::New();
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  return integrator;
}

//------------------------------------------------------------------------------
tool::stability::MethodUnderTest MakeLightContender(const std::string& method)
{
  return { method, false,
    [method](vtkBRDF* brdf, vtkEnvironment* environment)
    {
      return tool::stability::MakeLightLoop(
        brdf, environment, tool::stability::MakeLights(environment, method, Lights));
    } };
}
}

namespace tool::stability
{
//------------------------------------------------------------------------------
void Finding::KnownUpTo(double bound, const std::string& why)
{
  this->Bound = bound;
  this->Why = why;
}

//------------------------------------------------------------------------------
std::string Finding::GetStatus() const
{
  if (!std::isfinite(this->Value) || this->Value > this->Bound)
  {
    return "fail";
  }
  return this->Value <= this->Threshold ? "pass" : "known limit";
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> Context::Choose(vtkBRDF* otherwise) const
{
  return this->BRDF ? this->BRDF.Get() : otherwise;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> Context::MakeEnvironment(
  const std::string& otherwise, int width) const
{
  return Shrink(this->Environment ? this->Environment : LoadEnvironment(otherwise), width);
}

//------------------------------------------------------------------------------
Finding& Context::Add(const std::string& method, const std::string& figure, double value,
  double threshold, const std::string& note)
{
  this->Findings.push_back({ method, figure, value, threshold, threshold, note, "" });
  return this->Findings.back();
}

//------------------------------------------------------------------------------
void Context::Add(
  const std::string& method, const std::string& figure, double value, const Limits& limits)
{
  Finding& finding = this->Add(method, figure, value, limits.Threshold);
  const auto known = limits.Known.find(method);
  if (known != limits.Known.end())
  {
    finding.KnownUpTo(known->second, limits.Why);
  }
}

//------------------------------------------------------------------------------
std::vector<Case> GetCases()
{
  std::vector<Case> cases;
  AddBasesCases(cases);
  AddRangeCases(cases);
  AddSamplingCases(cases);
  AddGeometryCases(cases);
  AddTemporalCases(cases);
  AddScaleCases(cases);
  AddDataCases(cases);
  AddConvergenceCases(cases);
  AddNumericCases(cases);
  return cases;
}

namespace
{
//------------------------------------------------------------------------------
// And the other methods of vtkRadianceMethods, at the sizes that they come with.
std::vector<MethodUnderTest> AddOthers(std::vector<MethodUnderTest> known)
{
  for (const auto& method : vtkRadianceMethods::GetMethods())
  {
    const std::string name = method->GetMethodName();
    if (!IsOnCpuOnly(name) && name != "light-set" && // which is three of them
        std::none_of(known.begin(), known.end(),
          [&name](const MethodUnderTest& other) { return other.Name == name; }))
    {
      known.push_back({ name, true,
        [method](vtkBRDF* brdf, vtkEnvironment* environment)
        {
          auto made = vtkSmartPointer<vtkRadianceIntegrator>::Take(method->NewCopy());
          made->SetBRDF(brdf);
          made->SetEnvironment(environment);
          return made;
        } });
    }
  }
  return known;
}
}

//------------------------------------------------------------------------------
const std::vector<MethodUnderTest>& GetMethodsUnderTest()
{
  static const std::vector<MethodUnderTest> contenders = AddOthers({
    MakeLightContender("median-cut"),
    MakeLightContender("importance"),
    MakeLightContender("variance"),
    { "thesis", false,
      [](vtkBRDF* brdf, vtkEnvironment* environment)
      {
        return MakeLightLoop(Project(brdf, vtkBasisBRDF::SPHERICAL_HARMONICS, ThesisOrder),
          environment, MakeLights(environment, "median-cut", Lights));
      } },
    { "soft-lights", true,
      [](vtkBRDF* brdf, vtkEnvironment* environment)
      {
        return MakeLightLoop(
          brdf, environment, MakeLights(environment, "variance", SoftLights), true);
      } },
    { "filtered", false,
      [](vtkBRDF* brdf, vtkEnvironment* environment)
      { return MakeFiltered(brdf, environment, Samples); } },
    { "table", true,
      [](vtkBRDF* brdf, vtkEnvironment* environment)
      { return MakeTable(brdf, environment, 65, 12, 16); } },
    { "hybrid", true, MakeFor<vtkHybridRadianceIntegrator> },
    { "auto", true, Plan },
  });
  return contenders;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkLightSet> MakeLights(
  vtkEnvironment* environment, const std::string& method, int count, unsigned int seed)
{
  LightSetOptions options{ count, method, seed };
  return MakeLightSet(environment, options);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> MakeLightLoop(int count)
{
  auto loop = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
  loop->SetGenerator(vtkNew<vtkMedianCutLightSetGenerator>());
  loop->SetNumberOfLights(count);
  return loop;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> MakeLightLoop(
  vtkBRDF* brdf, vtkEnvironment* environment, vtkLightSet* lights, bool soft)
{
  auto integrator = MakeFor<vtkLightSetRadianceIntegrator>(brdf, environment);
  integrator->SetLightSet(lights);
  integrator->SetSoftLights(soft);
  return integrator;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> MakeTable(
  vtkBRDF* brdf, vtkEnvironment* environment, int rows, int viewAngles, int azimuths)
{
  auto integrator = MakeFor<vtkTableRadianceIntegrator>(brdf, environment);
  integrator->SetNumberOfRows(rows);
  integrator->SetNumberOfViewAngles(viewAngles);
  integrator->SetNumberOfAzimuths(azimuths);
  return integrator;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> MakeFiltered(
  vtkBRDF* brdf, vtkEnvironment* environment, int samples)
{
  auto integrator = MakeFor<vtkFilteredRadianceIntegrator>(brdf, environment);
  integrator->SetNumberOfSamples(samples);
  return integrator;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> MakePlastic(double exponent)
{
  auto sum = vtkSmartPointer<vtkSumBRDF>::New();
  sum->AddTerm(MakeLambert(0.3));
  sum->AddTerm(MakeLobe(exponent));
  return sum;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> MakeLobe(double exponent)
{
  auto lobe = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
  lobe->SetExponent(exponent);
  return lobe;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> MakeLambert(double albedo)
{
  auto lambert = vtkSmartPointer<vtkLambertBRDF>::New();
  lambert->SetAlbedo(albedo, albedo, albedo);
  return lambert;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> Project(vtkBRDF* brdf, int basis, int order)
{
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(brdf);
  projector->SetBasis(basis);
  projector->SetOrder(order);
  if (!projector->Project())
  {
    throw Error("projection: " + TakeErrorText());
  }
  return projector->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> MakeEnvironment(
  int width, int height, const std::function<Vector(const Vector&)>& radiance)
{
  std::vector<float> pixels;
  pixels.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      Vector direction;
      vtkEnvironment::GetDirection((x + 0.5) / width, (y + 0.5) / height, direction.data());
      for (const double value : radiance(direction))
      {
        pixels.push_back(static_cast<float>(value));
      }
    }
  }
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  environment->SetPixels(width, height, std::move(pixels));
  return environment;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> Shrink(vtkEnvironment* environment, int width)
{
  const int height = std::max(width / 2, 1);
  if (environment->GetWidth() <= width || environment->GetHeight() <= height)
  {
    return environment;
  }
  std::vector<double> sums(3 * static_cast<std::size_t>(width * height), 0.0);
  std::vector<double> weights(static_cast<std::size_t>(width * height), 0.0);
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    const double solidAngle = environment->GetTexelSolidAngle(y);
    for (int x = 0; x < environment->GetWidth(); ++x)
    {
      const auto k = static_cast<std::size_t>(
        y * height / environment->GetHeight() * width +
        static_cast<int>(static_cast<long long>(x) * width / environment->GetWidth()));
      double rgb[3];
      environment->GetPixel(x, y, rgb);
      for (std::size_t c = 0; c < 3; ++c)
      {
        sums[3 * k + c] += solidAngle * rgb[c];
      }
      weights[k] += solidAngle;
    }
  }
  std::vector<float> pixels(sums.size());
  for (std::size_t k = 0; k < sums.size(); ++k)
  {
    pixels[k] = static_cast<float>(sums[k] / weights[k / 3]);
  }
  auto small = vtkSmartPointer<vtkEnvironment>::New();
  small->SetPixels(width, height, std::move(pixels));
  small->SetName(environment->GetName());
  return small;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> Roll(vtkEnvironment* environment, double columns)
{
  const int width = environment->GetWidth();
  const int whole = static_cast<int>(std::floor(columns));
  const double part = columns - whole;
  std::vector<float> pixels;
  pixels.reserve(environment->GetPixels().size());
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      double near[3];
      double far[3];
      environment->GetPixel(((x - whole) % width + width) % width, y, near);
      environment->GetPixel(((x - whole - 1) % width + width) % width, y, far);
      for (int c = 0; c < 3; ++c)
      {
        pixels.push_back(static_cast<float>((1.0 - part) * near[c] + part * far[c]));
      }
    }
  }
  auto rolled = vtkSmartPointer<vtkEnvironment>::New();
  rolled->SetPixels(width, environment->GetHeight(), std::move(pixels));
  return rolled;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> Scale(vtkEnvironment* environment, double factor)
{
  std::vector<float> pixels = environment->GetPixels();
  for (float& value : pixels)
  {
    value = static_cast<float>(value * factor);
  }
  auto scaled = vtkSmartPointer<vtkEnvironment>::New();
  scaled->SetPixels(environment->GetWidth(), environment->GetHeight(), std::move(pixels));
  return scaled;
}

//------------------------------------------------------------------------------
Vector GetSmoothRadiance(const Vector& d)
{
  return { 1.0 + 0.6 * d[1] + 0.3 * d[0] * d[2], 1.0 + 0.5 * d[0], 1.0 + 0.4 * d[1] * d[2] };
}

//------------------------------------------------------------------------------
void Pairs::Add(const Vector& normal, const Vector& view)
{
  this->Normals.insert(this->Normals.end(), normal.begin(), normal.end());
  this->Views.insert(this->Views.end(), view.begin(), view.end());
}

//------------------------------------------------------------------------------
Pairs MakeSpherePairs(int count)
{
  const double azimuth = vtkMath::RadiansFromDegrees(30.0);
  const double elevation = vtkMath::RadiansFromDegrees(20.0);
  const Vector view = { std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
    std::cos(elevation) * std::cos(azimuth) };
  Vector right;
  Vector up;
  vtkMath::Perpendiculars(view.data(), right.data(), up.data(), 0.0);
  Pairs pairs;
  for (int k = 0; k < count; ++k)
  {
    // Sunflower seeds: evenly over the disc, within the rim by a pixel of 500.
    const double r = 0.996 * std::sqrt((k + 0.5) / count);
    const double phi = vtkMath::Pi() * (3.0 - std::sqrt(5.0)) * k;
    Vector normal;
    for (std::size_t c = 0; c < 3; ++c)
    {
      normal[c] =
        r * std::cos(phi) * right[c] + r * std::sin(phi) * up[c] + std::sqrt(1.0 - r * r) * view[c];
    }
    pairs.Add(normal, view);
  }
  return pairs;
}

//------------------------------------------------------------------------------
Pairs AtAngle(const Pairs& pairs, double degrees)
{
  const double angle = vtkMath::RadiansFromDegrees(degrees);
  Pairs turned;
  for (std::size_t k = 0; k < pairs.Normals.size(); k += 3)
  {
    const double* n = &pairs.Normals[k];
    const double* v = &pairs.Views[k];
    const double cosine = vtkMath::Dot(n, v);
    double across[3] = { v[0] - cosine * n[0], v[1] - cosine * n[1], v[2] - cosine * n[2] };
    vtkMath::Normalize(across);
    Vector view;
    for (std::size_t c = 0; c < 3; ++c)
    {
      view[c] = std::cos(angle) * n[c] + std::sin(angle) * across[c];
    }
    turned.Add({ n[0], n[1], n[2] }, view);
  }
  return turned;
}

//------------------------------------------------------------------------------
Vector Turn(const Vector& v, double degrees)
{
  const double c = std::cos(vtkMath::RadiansFromDegrees(degrees));
  const double s = std::sin(vtkMath::RadiansFromDegrees(degrees));
  return { c * v[0] + s * v[2], v[1], c * v[2] - s * v[0] };
}

//------------------------------------------------------------------------------
std::vector<double> Integrate(vtkRadianceIntegrator* integrator, const Pairs& pairs)
{
  return IntegratePairs(integrator, pairs.Normals, pairs.Views);
}

//------------------------------------------------------------------------------
std::vector<double> IntegrateReference(
  vtkBRDF* brdf, vtkEnvironment* environment, const Pairs& pairs)
{
  const auto reference = MakeFor<vtkAdaptiveRadianceIntegrator>(brdf, environment);
  reference->SetTolerance(2e-4); // slopes of errors need it
  return Integrate(reference, pairs);
}

//------------------------------------------------------------------------------
std::string Say(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

//------------------------------------------------------------------------------
double GetRelativeL1(const std::vector<double>& x, const std::vector<double>& reference)
{
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    difference += std::abs(x[k] - reference[k]);
    sum += reference[k];
  }
  return difference == 0.0 ? 0.0 : difference / sum;
}

//------------------------------------------------------------------------------
double GetRelativeRMS(const std::vector<double>& x, const std::vector<double>& reference)
{
  double squares = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    squares += (x[k] - reference[k]) * (x[k] - reference[k]);
    sum += reference[k];
  }
  return std::sqrt(squares * static_cast<double>(x.size())) / sum;
}

//------------------------------------------------------------------------------
double GetMedianError(const std::vector<double>& x, const std::vector<double>& reference)
{
  std::vector<double> errors;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    if (!std::isfinite(x[k]))
    {
      return Unlimited;
    }
    if (reference[k] > 0.0)
    {
      errors.push_back(std::abs(x[k] - reference[k]) / reference[k]);
    }
  }
  if (errors.empty())
  {
    return 0.0;
  }
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  return errors[errors.size() / 2];
}

//------------------------------------------------------------------------------
double GetLargest(const std::vector<double>& x)
{
  double largest = 0.0;
  for (const double value : x)
  {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

//------------------------------------------------------------------------------
double CountBad(const std::vector<double>& x)
{
  return static_cast<double>(std::count_if(
    x.begin(), x.end(), [](double value) { return !(std::isfinite(value) && value >= 0.0); }));
}

//------------------------------------------------------------------------------
double FitSlope(const std::vector<double>& x, const std::vector<double>& y)
{
  double sums[4] = {};
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    const double u = std::log(x[k]);
    const double v = std::log(std::max(y[k], 1e-300));
    sums[0] += u;
    sums[1] += v;
    sums[2] += u * u;
    sums[3] += u * v;
  }
  const auto n = static_cast<double>(x.size());
  return (n * sums[3] - sums[0] * sums[1]) / (n * sums[2] - sums[0] * sums[0]);
}

//------------------------------------------------------------------------------
StabilityRenderer::StabilityRenderer(Context& context)
  : StabilityRenderer(context, vtkSmartPointer<vtkMeasuredBRDFMapper>::New())
{
}

//------------------------------------------------------------------------------
StabilityRenderer::StabilityRenderer(Context& context, vtkMeasuredBRDFMapper* mapper)
  : OffscreenScene(mapper)
  , Mapper(mapper)
{
  this->SetMesh(MakeSphere());
  this->SetView(SphereView.Azimuth, SphereView.Elevation, SphereFill);
  this->Open(Tile, Tile);
  context.Renderer = this->GetRendererName();
}

//------------------------------------------------------------------------------
void StabilityRenderer::SetIntegrator(vtkRadianceIntegrator* integrator)
{
  this->Mapper->SetBRDF(integrator->GetBRDF());
  this->Mapper->SetEnvironment(integrator->GetEnvironment());
  this->Mapper->SetIntegrator(integrator);
}

//------------------------------------------------------------------------------
Picture StabilityRenderer::Draw(int size)
{
  this->PlaceCamera(size, size);
  return this->DrawAsIs(size, size);
}

//------------------------------------------------------------------------------
Picture StabilityRenderer::DrawAsIs(int width, int height)
{
  Interruptible::Check();
  Picture picture = this->Capture(width, height);
  this->NumberOfBad = CountBad(std::vector<double>(picture.Pixels.begin(), picture.Pixels.end()));
  Decode(picture);
  return picture;
}

//------------------------------------------------------------------------------
Picture MakeSphereSheet(Context& context, const std::string& title, vtkBRDF* brdf,
  vtkEnvironment* environment, const std::vector<MethodUnderTest>& contenders)
{
  const Size size = { Tile, Tile };
  const Surface surface = FindSurface(MakeSphere(), SphereView, SphereFill, size, Tile * Tile);
  const std::vector<double> reference =
    IntegrateReference(brdf, environment, { surface.Normals, surface.Views });
  std::vector<double> sorted = reference;
  std::sort(sorted.begin(), sorted.end());
  const double exposure = 0.9 / std::max(sorted[sorted.size() * 99 / 100], 1e-30);
  Picture exact(Tile, Tile);
  for (std::size_t k = 0; k < surface.Pixels.size(); ++k)
  {
    float* pixel = &exact.Pixels[4 * static_cast<std::size_t>(surface.Pixels[k])];
    std::copy_n(&reference[3 * k], 3, pixel);
    pixel[3] = 1.0f;
  }

  const int columns = std::min<int>(static_cast<int>(contenders.size()) + 1, 5);
  const int rows = (static_cast<int>(contenders.size()) + columns) / columns;
  ContactSheet sheet(title, columns, rows, Tile, Tile);
  const auto add = [&](int k, Picture picture, const std::string& name, const std::string& note)
  {
    for (std::size_t p = 0; p < picture.Pixels.size(); ++p)
    {
      picture.Pixels[p] = p % 4 == 3 || !(picture.Pixels[p - p % 4 + 3] > 0.0f)
                            ? static_cast<float>(p % 4 == 3)
                            : static_cast<float>(RollOff(exposure * picture.Pixels[p]));
    }
    sheet.Add(k % columns, k / columns, picture, name, note);
  };
  add(0, exact, "reference", "");
  StabilityRenderer offscreen(context);
  for (std::size_t k = 0; k < contenders.size(); ++k)
  {
    const vtkSmartPointer<vtkRadianceIntegrator> integrator = contenders[k].Make(brdf, environment);
    offscreen.SetIntegrator(integrator);
    const Picture picture = offscreen.Draw(Tile);
    add(static_cast<int>(k) + 1, picture, contenders[k].Name,
      "error " + Say(100.0 * GetRelativeL1(Pick(picture, surface), reference)) + " %");
  }
  return sheet.GetPicture();
}

//------------------------------------------------------------------------------
std::vector<double> GetCovered(const Picture& picture)
{
  std::vector<double> values;
  for (std::size_t k = 0; k < picture.Pixels.size(); k += 4)
  {
    if (picture.Pixels[k + 3] > 0.0f)
    {
      values.insert(values.end(), &picture.Pixels[k], &picture.Pixels[k] + 3);
    }
  }
  return values;
}

//------------------------------------------------------------------------------
double GetPictureDifference(const Picture& a, const Picture& b)
{
  std::vector<double> values[2];
  for (std::size_t k = 0; k < std::min(a.Pixels.size(), b.Pixels.size()); k += 4)
  {
    if (a.Pixels[k + 3] > 0.0f && b.Pixels[k + 3] > 0.0f)
    {
      values[0].insert(values[0].end(), &a.Pixels[k], &a.Pixels[k] + 3);
      values[1].insert(values[1].end(), &b.Pixels[k], &b.Pixels[k] + 3);
    }
  }
  return values[1].empty() ? Unlimited : GetRelativeL1(values[0], values[1]);
}
} // namespace tool::stability
