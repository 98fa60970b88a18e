// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Stability: what a global basis does to sharp lobes, and beyond the zone that was measured.
#include "Acquisition.h"
#include "Meshes.h"
#include "Methods.h"
#include "Sheets.h"
#include "Stability.h"
#include "Tool.h"

#include "vtkBRDFResampler.h"
#include "vtkBasisBRDF.h"
#include "vtkBasisProjector.h"
#include "vtkLightSet.h"
#include "vtkMath.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>

using namespace tool::stability;

namespace
{
constexpr double Hemisphere[2] = { 0.0, 90.0 };
constexpr double Zone[2] = { 9.0, 57.0 }; // of the device, Ghosh et al. 2007
constexpr int BasisTile = 96;
constexpr int Pairs14 = 1 << 14;

// The negative mass that an extrapolation may have.
constexpr double NegativeMass = 0.05;

//------------------------------------------------------------------------------
std::string Name(int basis, int order)
{
  static const char* const names[] = { "harmonics", "hemispherical", "zonal", "Leg.xFourier" };
  return std::string(names[basis]) + " " + std::to_string(order);
}

//------------------------------------------------------------------------------
// One light above, as in the thesis's 2.3.4: the lobe itself is what shows.
void DrawRinging(Context& context, const std::vector<double>& exponents)
{
  const std::vector<int> orders = { 2, 6, 12 };
  vtkNew<vtkLightSet> light;
  const double direction[3] = { 0.61, 0.61, 0.5 };
  const double irradiance[3] = { 1.0, 1.0, 1.0 };
  light->AddLight(direction, irradiance);
  const vtkSmartPointer<vtkEnvironment> environment = MakeEnvironment(8, 4,
    [](const Vector&) {
      return Vector{ 1.0, 1.0, 1.0 };
    });
  const int columns = static_cast<int>(orders.size()) + 1;
  tool::ContactSheet sheet("Harmonics ring: one light, order x sharpness", columns,
    static_cast<int>(exponents.size()), BasisTile, BasisTile);
  StabilityRenderer offscreen(context);
  for (std::size_t row = 0; row < exponents.size(); ++row)
  {
    const vtkSmartPointer<vtkBRDF> lobe = MakeLobe(exponents[row]);
    double exposure = 1.0;
    for (int column = 0; column < columns; ++column)
    {
      const int order = column > 0 ? orders[static_cast<std::size_t>(column) - 1] : 0;
      const vtkSmartPointer<vtkBRDF> brdf =
        column > 0 ? Project(lobe, vtkBasisBRDF::SPHERICAL_HARMONICS, order) : lobe;
      offscreen.SetIntegrator(MakeLightLoop(brdf, environment, light));
      tool::Picture picture = offscreen.Draw(BasisTile);
      exposure = column == 0 ? 0.9 / GetLargest(GetCovered(picture)) : exposure;
      for (std::size_t k = 0; k < picture.Pixels.size(); ++k)
      {
        picture.Pixels[k] = k % 4 == 3 ? 1.0f
                                       : static_cast<float>(tool::RollOff(
                                           std::sqrt(std::max(0.0, exposure * picture.Pixels[k]))));
      }
      sheet.Add(column, static_cast<int>(row), picture,
        column > 0 ? "order " + std::to_string(order) : "exponent " + Say(exponents[row]),
        column > 0 ? "" : "exact");
    }
  }
  context.Shown = sheet.GetPicture();
}

//------------------------------------------------------------------------------
void RunRinging(Context& context)
{
  const std::vector<double> exponents = { 5.0, 20.0, 100.0 };
  const std::vector<int> orders =
    context.Short ? std::vector<int>{ 6 } : std::vector<int>{ 2, 6, 12 };
  const Pairs pairs = AtAngle(MakeSpherePairs(64), 40.0);
  const vtkSmartPointer<vtkLightSet> lights =
    MakeLights(context.MakeEnvironment("sky", 32), "median-cut", 16);
  double negative = 0.0;
  for (const double exponent : exponents)
  {
    const vtkSmartPointer<vtkBRDF> lobe = MakeLobe(exponent);
    for (int basis = vtkBasisBRDF::SPHERICAL_HARMONICS; basis <= vtkBasisBRDF::LEGENDRE_FOURIER;
         ++basis)
    {
      for (const int order : orders)
      {
        const vtkSmartPointer<vtkBRDF> projected = Project(lobe, basis, order);
        auto* basisBRDF = vtkBasisBRDF::SafeDownCast(projected);
        const double mass = basisBRDF->GetNegativeMass(Hemisphere, Hemisphere, Pairs14);
        context
          .Add(Name(basis, order), "negative mass before the clamp, exponent " + Say(exponent),
            mass, NegativeMass,
            "relative L2 error " +
              Say(vtkBRDFResampler::GetRelativeL2Error(lobe, projected, Pairs14)))
          .KnownUpTo(0.5, "order too low for the lobe");
        negative += CountBad(Integrate(MakeLightLoop(projected, nullptr, lights), pairs));
      }
    }
  }
  context.Add("all", "negative radiances after the clamp", negative, 0.0);

  // The product's answer: the advisor takes a fit where a basis would ring.
  for (const double exponent : exponents)
  {
    const tool::Advice advice = tool::Advise(MakeLobe(exponent), 6);
    const bool rings = advice.IsBasis && advice.NegativeMass > NegativeMass;
    context.Add("advisor", "a ringing basis recommended, exponent " + Say(exponent), rings, 0.0,
      advice.Reason);
  }
  DrawRinging(context, exponents);
}

//------------------------------------------------------------------------------
void RunExtrapolation(Context& context)
{
  const double outside[2] = { 57.0, 80.0 };
  for (const double exponent : { 2.0, 10.0, 50.0 })
  {
    const vtkSmartPointer<vtkBRDF> lobe = MakeLobe(exponent);
    vtkNew<vtkBasisProjector> projector;
    projector->SetInput(lobe);
    projector->SetBasis(vtkBasisBRDF::LEGENDRE_FOURIER);
    projector->SetIncidentZone(Zone[0], Zone[1]);
    projector->SetOutgoingZone(Zone[0], Zone[1]);
    if (!projector->Project())
    {
      throw tool::Error("projection: " + tool::TakeErrorText());
    }
    const auto measure = [&](vtkBRDF* brdf)
    { return vtkBRDFResampler::GetZoneRelativeL2Error(lobe, brdf, outside, Zone, Pairs14); };
    const double held = measure(projector->GetOutput());
    const laboratory::Extrapolation whole = laboratory::Extrapolate(projector->GetOutput());
    const double kept = measure(whole.IsAccepted ? whole.Output.Get() : projector->GetOutput());
    context.Add(whole.IsAccepted ? "accepted" : "refused",
      "error outside the zone over that of holding its edge, exponent " + Say(exponent),
      kept / held, 1.0, "residual inside " + Say(whole.InZoneResidual) + ", holding: " + Say(held));
    laboratory::ExtrapolationOptions unregularized;
    unregularized.How = laboratory::Criterion::Fixed;
    const laboratory::Extrapolation wild =
      laboratory::Extrapolate(projector->GetOutput(), unregularized);
    context
      .Add("unregularized",
        "error outside the zone over that of holding its edge, exponent " + Say(exponent),
        measure(wild.Output) / held, 1.0)
      .KnownUpTo(Unlimited, "ill-posed: shown on purpose; Extrapolate " +
                              std::string(wild.IsAccepted ? "accepts" : "refuses") + " it");
  }
}
}

namespace
{
//------------------------------------------------------------------------------
// Functions of an azimuth must vanish where it means nothing.
void RunZenith(Context& context)
{
  const vtkSmartPointer<vtkBRDF> lobe = context.Choose(MakePlastic(50.0));
  const double tilt = 1e-4;
  for (int basis = vtkBasisBRDF::SPHERICAL_HARMONICS; basis <= vtkBasisBRDF::LEGENDRE_FOURIER;
       ++basis)
  {
    const vtkSmartPointer<vtkBRDF> projected = Project(lobe, basis, 6);
    double worst = 0.0;
    for (const double degrees : { 10.0, 30.0, 60.0 })
    {
      const double angle = vtkMath::RadiansFromDegrees(degrees);
      const double o[3] = { std::sin(angle), 0.0, std::cos(angle) };
      double least = Unlimited;
      double most = 0.0;
      for (int k = 0; k < 16; ++k)
      {
        const double phi = 2.0 * vtkMath::Pi() * k / 16.0;
        const double i[3] = { tilt * std::cos(phi), tilt * std::sin(phi), 1.0 };
        double f[3];
        projected->Evaluate(i, o, f);
        least = std::min(least, f[0]);
        most = std::max(most, f[0]);
      }
      worst = std::max(worst, (most - least) / most);
    }
    context.Add(Name(basis, 6), "jump where light passes along the normal, relative", worst,
      { 0.01, { { Name(vtkBasisBRDF::LEGENDRE_FOURIER, 6), 1.0 } },
        "Legendre x Fourier does not vanish at a zone's edges, nor at the zenith" });
  }
}
}

namespace tool::stability
{
//------------------------------------------------------------------------------
void AddBasesCases(std::vector<Case>& cases)
{
  cases.push_back({ "ringing", "bases", "harmonics of low order on sharp lobes", RunRinging });
  cases.push_back(
    { "zenith", "bases", "light along the normal, where azimuths mean nothing", RunZenith });
  cases.push_back(
    { "extrapolation", "bases", "harmonics beyond the zone that was measured", RunExtrapolation });
}
} // namespace tool::stability
