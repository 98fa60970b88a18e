// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnisotropicTable.h"

#include "FieldSynthesis.h"
#include "HalfVector.h" // for Pi
#include "LobePlacement.h"
#include "ModuleShader.h"
#include "RadianceTable.h"
#include "vtkBRDFEnvironmentAnisotropic.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

namespace measuredbrdf
{
// u: as profiles over theta_o are read; period: of the view's azimuth, in [0,1].
glm::dvec3 AnisotropicTable::GetProfile(int layer, double u, double period) const
{
  constexpr int angles = AnisotropicViews::Angles;
  constexpr int azimuths = AnisotropicViews::Azimuths;
  const double exact = u * (angles - 1);
  const int low = std::min(static_cast<int>(exact), angles - 2);
  return MixTexels(this->Profile, angles,
    static_cast<std::size_t>(layer) * static_cast<std::size_t>(angles * azimuths),
    { low, low + 1, exact - low }, PeriodicNeighbors(period + 0.5 / azimuths, azimuths));
}

// No lamps lie beside it: hybrids evaluate all of them.
glm::dvec3 AnisotropicTable::Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t,
  const TableLamps* vtkNotUsed(lamps)) const
{
  Frame frame = FrameAbout(n, t);
  glm::dvec3 view = LiftView(ToLocal(frame, o));
  if (this->Periods == 2 && view.y < 0.0) // the same after half a turn
  {
    frame[0] = -frame[0];
    frame[1] = -frame[1];
    view = glm::dvec3(-view.x, -view.y, view.z);
  }
  const double sine = std::hypot(view.x, view.y);
  const glm::dvec2 azimuth = sine > 1e-6 ? glm::dvec2(view) / sine : glm::dvec2(1.0, 0.0);
  double phi = std::atan2(azimuth.y, azimuth.x) / (2.0 * Pi);
  phi = this->Periods * (phi - std::floor(phi));
  const double u = GetProfilePosition(std::atan2(sine, view.z));

  // The axis, and the tangent carried there by the smallest rotation.
  const glm::dvec3 parts = this->GetProfile(0, u, phi);
  const glm::dvec2 level(
    parts.x * azimuth.x - parts.y * azimuth.y, parts.x * azimuth.y + parts.y * azimuth.x);
  const double up = std::sqrt(std::max(1.0 - glm::dot(level, level), 0.0));
  const glm::dvec3 axis = glm::normalize(frame * glm::dvec3(level, up));
  const glm::dvec3 along = frame * glm::dvec3(1.0 - level.x * level.x / (1.0 + up),
                                     -level.x * level.y / (1.0 + up), -level.x);
  const MapPosition at(axis);
  const double psi = std::atan2(glm::dot(along, at.Across), glm::dot(along, at.Along)) / (2.0 * Pi);

  const double w = std::clamp(parts.z, 0.0, this->Angles - 1.0);
  const int angle = std::min(static_cast<int>(w), this->Angles - 2);
  const double p = phi * this->ViewAzimuths;
  const int first = std::min(static_cast<int>(p), this->ViewAzimuths - 1);
  const auto value = [&](int k, int viewAzimuth)
  {
    // After the last azimuth the first one comes again, in a frame that is turned by the period.
    const bool again = viewAzimuth == this->ViewAzimuths;
    const Neighbors turn = PeriodicNeighbors(
      psi + (again ? 1.0 / this->Periods : 0.0) + 0.5 / this->Azimuths, this->Azimuths);
    const auto map = [&](int psiIndex)
    {
      const int slice = k * (this->Azimuths + 1) + psiIndex;
      return (slice * this->ViewAzimuths + (again ? 0 : viewAzimuth)) * this->GetNumberOfTexels();
    };
    return MixTexels(this->Radiance, this->Columns, { map(turn.First), map(turn.Second) },
      GetMapColumns(this->Columns, at), GetMapRows(this->Rows, at), turn.Weight);
  };
  const auto between = [&](int k)
  { return glm::mix(value(k, first), value(k, first + 1), p - first); };
  glm::dvec3 sum = glm::mix(between(angle), between(angle + 1), w - angle);
  sum *= this->GetProfile(1, u, phi);
  if (this->HasFloor)
  {
    sum += this->GetProfile(2, u, phi) * this->GetIrradiance(n);
  }
  return glm::max(sum, glm::dvec3(0.0));
}

namespace
{
using Expanded = std::vector<std::vector<std::complex<float>>>;

// One order's kernels of one view angle: the real part and the imaginary part of each azimuth of
// the view.
FieldSynthesis::Kernels PickTurnedOrder(
  const Expanded& kernels, std::size_t first, int count, int order, int degree, int rows)
{
  FieldSynthesis::Kernels picked(3 * 2 * count, degree + 1);
  for (int l = 0; l <= degree; ++l)
  {
    const float taper = static_cast<float>(GetTaper(l, degree, rows));
    for (int k = 0; k < 3 * count; ++k)
    {
      const std::complex<float> of = kernels[first + static_cast<std::size_t>(k % count)]
                                            [(3 * order + k / count) * (degree + 1) + l];
      picked(2 * k, l) = taper * of.real();
      picked(2 * k + 1, l) = taper * of.imag();
    }
  }
  return picked;
}
}

double AnisotropicTable::Synthesize(const EnvironmentHarmonics& environment,
  const MaterialKernels& knots, int degree, const std::function<bool(double)>& goOn)
{
  const int orders = std::min(this->Azimuths / 2, degree); // as many as the azimuths can tell apart
  const Expanded kernels = ExpandAnisotropicLobes(knots.At, degree, orders);
  // An angle's maps at all azimuths of the view lie side by side.
  const std::size_t texels = this->GetNumberOfTexels();
  AzimuthSeries series(
    this->Angles, this->Azimuths, texels * static_cast<std::size_t>(this->ViewAzimuths));
  FieldSynthesis synthesis(MapPart(this->Rows, this->Columns), MapNodes::Poles);
  for (int angle = 0; angle < this->Angles; ++angle)
  {
    const std::size_t first = angle * this->ViewAzimuths;
    for (int order = 0; order <= orders; ++order)
    {
      FieldSynthesis::Fields fields;
      synthesis.Run(order,
        { { environment,
          PickTurnedOrder(kernels, first, this->ViewAzimuths, order, degree, this->Rows) } },
        fields);
      for (FieldSynthesis::Field& field : fields) // real and imaginary parts of kernels become one
      {
        for (std::size_t k = 0; k < field.size() / 2; ++k)
        {
          const std::complex<float>* of = &field[k / texels * 2 * texels + k % texels];
          field[k] = of[0] + std::complex<float>(-of[texels].imag(), of[texels].real());
        }
        field.resize(field.size() / 2);
      }
      series.Set(order, fields, static_cast<std::size_t>(angle));
      if (!goOn((angle * (orders + 1.0) + order + 1.0) / (this->Angles * (orders + 1.0))))
      {
        return 0.0;
      }
    }
  }
  std::vector<float> radiance = series.TakeRadiance();
  LiftDarkRings(
    radiance, static_cast<std::size_t>(this->Rows), static_cast<std::size_t>(this->Columns));
  return PackRadiance(radiance, this->Radiance);
}

void AnisotropicTable::MakeProfile(
  const AnisotropicViews& views, const MaterialKernels& knots, double scale)
{
  this->Periods = views.GetPeriods();
  const int count = AnisotropicViews::Angles * AnisotropicViews::Azimuths;
  this->Profile.resize(3 * 3 * static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
  {
    const int angleIndex = k % AnisotropicViews::Angles;
    const int azimuthIndex = k / AnisotropicViews::Angles;
    const LobeMeans& lobe = views.Get(angleIndex, azimuthIndex);
    // What interpolation between the kernels misses of the directional albedo goes to the rest.
    const double w =
      LobeViews::GetKnotPosition(AnisotropicViews::GetAngle(angleIndex), this->Angles);
    const int low = std::min(static_cast<int>(w), this->Angles - 2);
    const double p =
      static_cast<double>(azimuthIndex * this->ViewAzimuths) / AnisotropicViews::Azimuths;
    const int from = static_cast<int>(p);
    LobeMeans between;
    for (int corner = 0; corner < 4; ++corner)
    {
      const int angle = low + corner % 2;
      const int azimuth = (from + corner / 2) % this->ViewAzimuths;
      between.Add(knots.At[angle * this->ViewAzimuths + azimuth].Means,
        (corner % 2 ? w - low : 1.0 - w + low) * (corner / 2 ? p - from : 1.0 - p + from));
    }
    const double phi = views.GetAzimuth(azimuthIndex);
    const glm::dvec2 out(std::cos(phi), std::sin(phi));
    const bool hasFloor = PutProfile(lobe, between,
      { lobe.Axis.x * out.x + lobe.Axis.y * out.y, lobe.Axis.y * out.x - lobe.Axis.x * out.y, w },
      scale, static_cast<std::size_t>(k), this->Profile);
    this->HasFloor = this->HasFloor || hasFloor;
  }
}

vtkBRDFShaderInputs AnisotropicTable::GetShaderInputs() const
{
  vtkBRDFShaderInputs::Term term;
  SetModuleShader(term, "vtkBRDFEnvironmentAnisotropic", vtkBRDFEnvironmentAnisotropic);
  term.Constants = { { "PERIODS", std::to_string(this->Periods) + ".0" },
    { "VIEW_ANGLES", std::to_string(this->Angles) + ".0" },
    { "VIEW_AZIMUTHS", std::to_string(this->ViewAzimuths) + ".0" } };
  term.Fetches = 6; // two of the profile, four views
  vtkBRDFShaderInputs::Texture& profile =
    AddTexture(term, "brdfTableProfile", AnisotropicViews::Angles, AnisotropicViews::Azimuths, 3);
  profile.Data = this->Profile;
  profile.Repeat[1] = true;
  vtkBRDFShaderInputs inputs = this->MakeForm(
    std::move(term), this->Rows * this->ViewAzimuths, this->Angles * (this->Azimuths + 1));
  inputs.Description = "anisotropic radiance table, " + std::to_string(this->Columns) + " x " +
                       std::to_string(this->Rows) + " axes x " + std::to_string(this->Azimuths) +
                       " azimuths x " + std::to_string(this->Angles) + " x " +
                       std::to_string(this->ViewAzimuths) + " views";
  return inputs;
}
} // namespace measuredbrdf
