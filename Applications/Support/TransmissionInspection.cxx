// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TransmissionInspection.h"

#include "BackgroundWork.h"
#include "Tool.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

using nlohmann::ordered_json;

namespace
{
constexpr double EnergyLimit = 1.005; // as vtkBRDFAnalysis::GetGainsEnergy: the estimates' error
}

namespace tool
{
//------------------------------------------------------------------------------
std::array<double, 3> MeasureTransmittance(
  vtkBTDF* transmission, double degrees, TransmissionRole role)
{
  if (BackgroundWork::Get() && BackgroundWork::Get()->IsStopped())
  {
    throw Error("interrupted");
  }
  const double theta = vtkMath::RadiansFromDegrees(degrees);
  const int azimuths = transmission->IsIsotropic() ? 1 : 8;
  std::array<double, 3> mean{};
  for (int k = 0; k < azimuths; ++k)
  {
    const double phi = 2.0 * vtkMath::Pi() * k / azimuths;
    const double z = std::cos(theta);
    const double direction[3] = { std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
      role == TransmissionRole::BackLight ? -z : z };
    double rgb[3];
    role == TransmissionRole::View ? transmission->GetSkyTransmittance(direction, rgb)
                                   : transmission->GetTransmittance(direction, rgb);
    for (std::size_t c = 0; c < 3; ++c)
    {
      mean[c] += rgb[c] / azimuths;
    }
  }
  return mean;
}

//------------------------------------------------------------------------------
ordered_json InspectTransmission(vtkBTDF* transmission, const ordered_json& info)
{
  const bool both =
    transmission->GetFolded(vtkBTDF::FRONT) && transmission->GetFolded(vtkBTDF::BACK);
  ordered_json result = { { "both_sides", both } };
  if (both)
  {
    result["reciprocity_error"] = transmission->GetReciprocityError();
  }
  double largest = 0.0;
  double largestOfBack = 0.0;
  for (const ordered_json& row : info["reflectance_per_angle"])
  {
    const double degrees = row["degrees"];
    const auto back = MeasureTransmittance(transmission, degrees, TransmissionRole::BackLight);
    const auto light = MeasureTransmittance(transmission, degrees, TransmissionRole::Light);
    result["per_angle"].push_back({ { "degrees", degrees },
      { "view", MeasureTransmittance(transmission, degrees, TransmissionRole::View) },
      { "light", light }, { "back_light", back } });
    for (std::size_t c = 0; c < 3; ++c)
    {
      largest = std::max(largest, light[c] + row["rgb"][c].get<double>());
      largestOfBack = std::max(largestOfBack, back[c]);
    }
  }
  result["largest_reflectance_and_transmittance"] = largest;
  // What the back reflects is not here; what it lets through must not be more than what comes.
  result["largest_transmittance_of_back"] = largestOfBack;
  result["gains_energy"] = std::max(largest, largestOfBack) > EnergyLimit;
  return result;
}

//------------------------------------------------------------------------------
std::string FormatTransmission(const ordered_json& transmission)
{
  std::string text =
    "\n        transmittance\n"
    "        (view at that angle,       (light from that angle)    (light from that"
    " angle,\n"
    "        a white sky behind)                                    on the back)\n"
    "  angle      R       G       B         R       G       B         R       G"
    "       B\n";
  for (const ordered_json& row : transmission["per_angle"])
  {
    char part[64];
    std::snprintf(part, sizeof(part), "  %4.0f", row["degrees"].get<double>());
    text += part;
    for (const char* role : { "view", "light", "back_light" })
    {
      const ordered_json& rgb = row[role];
      std::snprintf(part, sizeof(part), "%s%7.4f %7.4f %7.4f", role[0] == 'v' ? "  " : "   ",
        rgb[0].get<double>(), rgb[1].get<double>(), rgb[2].get<double>());
      text += part;
    }
    text += "\n";
  }
  char line[200];
  std::snprintf(line, sizeof(line),
    "  reflected and transmitted together: at most %.4f; light on the back: %.4f transmitted%s\n",
    transmission["largest_reflectance_and_transmittance"].get<double>(),
    transmission["largest_transmittance_of_back"].get<double>(),
    transmission["gains_energy"] ? " (more light than it gets)" : "");
  text += line;
  if (!transmission["both_sides"])
  {
    return text + "  one side is measured; the other follows by reciprocity\n";
  }
  std::snprintf(line, sizeof(line),
    "  both sides are measured; they differ from reciprocity by %.4g, relative\n",
    transmission["reciprocity_error"].get<double>());
  return text + line;
}
} // namespace tool
