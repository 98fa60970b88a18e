// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAnisotropicTableRadianceIntegrator.h"

#include "Candidates.h"
#include "DirectionPairs.h"
#include "EnvironmentHarmonics.h"
#include "EnvironmentPrecomputation.h"
#include "FieldSynthesis.h"
#include "HalfVector.h" // for Pi
#include "LobePlacement.h"
#include "LobeViews.h"
#include "MaterialPrecomputation.h"
#include "ModuleShader.h"
#include "ParallelFor.h"
#include "RadianceTable.h"
#include "Setters.h"
#include "TableSynthesis.h"
#include "vtkBRDF.h"
#include "vtkBRDFEnvironmentAnisotropic.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace measuredbrdf
{
struct AnisotropicTable
{
  AnisotropicTable(int rows, int angles, int azimuths, int viewAzimuths)
    : Rows(rows)
    , Columns(2 * (rows - 1))
    , Angles(angles)
    , Azimuths(azimuths)
    , ViewAzimuths(viewAzimuths)
  {
  }

  int Rows;
  int Columns;
  int Angles;
  int Azimuths;
  int ViewAzimuths; // over the period
  int Periods = 1;  // of f in a turn, 1 or 2
  bool HasFloor = false;
  // RGB, AnisotropicViews::Angles x Azimuths x 3: (the axis' parts along and across the view's part
  // along the surface, view angle); share; c
  std::vector<float> Profile;
  // Columns x (Rows ViewAzimuths) x (Angles (Azimuths + 1)): psi's first value comes again after
  // the last.
  RadianceTable::Texels Radiance;
  std::shared_ptr<const ScaledTexels> Irradiance; // as RadianceTable's

  std::size_t GetNumberOfTexels() const
  {
    return static_cast<std::size_t>(this->Columns) * this->Rows;
  }

  /// Where the map of a view angle, an azimuth psi and a view's azimuth begins, in texels.
  std::size_t GetMap(int angle, int azimuth, int viewAzimuth) const
  {
    return static_cast<std::size_t>(
             (angle * (this->Azimuths + 1) + azimuth) * this->ViewAzimuths + viewAzimuth) *
           this->GetNumberOfTexels();
  }

  /// Radiance towards o about the normal n, as the shader looks it up; t: a unit tangent or zero.
  glm::dvec3 Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t) const;

private:
  glm::dvec3 GetProfile(int layer, double u, double period) const;
};

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

glm::dvec3 AnisotropicTable::Evaluate(
  const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t) const
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
    { return this->GetMap(k, psiIndex, again ? 0 : viewAzimuth); };
    return MixTexels(this->Radiance, this->Columns, { map(turn.First), map(turn.Second) },
      GetMapColumns(this->Columns, at), GetMapRows(this->Rows, at), turn.Weight);
  };
  const auto between = [&](int k)
  { return glm::mix(value(k, first), value(k, first + 1), p - first); };
  glm::dvec3 sum = glm::mix(between(angle), between(angle + 1), w - angle);
  sum *= this->GetProfile(1, u, phi);
  if (this->HasFloor)
  {
    sum += this->GetProfile(2, u, phi) * RadianceTable::GetIrradiance(*this->Irradiance, n);
  }
  return glm::max(sum, glm::dvec3(0.0));
}

namespace
{
constexpr int NumberOfNodes = 64; // of the kernels' integrals over theta_i

using Kernels = MaterialPrecomputation::AnisotropicKernels;
using Expanded = std::vector<std::vector<std::complex<float>>>;

Expanded ExpandKernels(const Kernels& knots, int degree, int orders)
{
  Expanded kernels(knots.size());
  measuredbrdf::ParallelForEach(
    knots.size(), [&](std::size_t k) { kernels[k] = knots[k]->Expand(degree, orders); });
  return kernels;
}

// One order's kernels of one view angle: the real part and the imaginary part of each azimuth of
// the view.
FieldSynthesis::Kernels PickOrder(
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

// The table's radiance, of its kernels up to a harmonic degree. goOn gets the share that is done;
// where it says false, the table is not complete, and the result is 0. Else it is what undoes the
// radiance's scaling.
double SynthesizeAnisotropic(const EnvironmentHarmonics& environment, const Kernels& knots,
  int degree, const std::function<bool(double)>& goOn, AnisotropicTable& table)
{
  const int orders = std::min(table.Azimuths / 2, degree); // as many as the azimuths can tell apart
  const Expanded kernels = ExpandKernels(knots, degree, orders);
  // An angle's maps at all azimuths of the view lie side by side.
  const std::size_t texels = table.GetNumberOfTexels();
  AzimuthSeries series(
    table.Angles, table.Azimuths, texels * static_cast<std::size_t>(table.ViewAzimuths));
  FieldSynthesis synthesis(MapPart(table.Rows, table.Columns), MapNodes::Poles);
  for (int angle = 0; angle < table.Angles; ++angle)
  {
    const std::size_t first = angle * table.ViewAzimuths;
    for (int order = 0; order <= orders; ++order)
    {
      FieldSynthesis::Fields fields;
      synthesis.Run(order,
        { { environment,
          PickOrder(kernels, first, table.ViewAzimuths, order, degree, table.Rows) } },
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
      if (!goOn((angle * (orders + 1.0) + order + 1.0) / (table.Angles * (orders + 1.0))))
      {
        return 0.0;
      }
    }
  }
  std::vector<float> radiance = series.TakeRadiance();
  LiftDarkRings(
    radiance, static_cast<std::size_t>(table.Rows), static_cast<std::size_t>(table.Columns));
  return PackRadiance(radiance, table.Radiance);
}

// A table's profile over all views; scale: what undoes its radiance's scaling.
void MakeAnisotropicProfile(
  const AnisotropicViews& views, const Kernels& knots, double scale, AnisotropicTable& table)
{
  table.Periods = views.GetPeriods();
  const int count = AnisotropicViews::Angles * AnisotropicViews::Azimuths;
  table.Profile.resize(3 * 3 * static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
  {
    const int angleIndex = k % AnisotropicViews::Angles;
    const int azimuthIndex = k / AnisotropicViews::Angles;
    const LobeMeans& lobe = views.Get(angleIndex, azimuthIndex);
    // What interpolation between the kernels misses of the directional albedo goes to the rest.
    const double w =
      LobeViews::GetKnotPosition(AnisotropicViews::GetAngle(angleIndex), table.Angles);
    const int low = std::min(static_cast<int>(w), table.Angles - 2);
    const double p =
      static_cast<double>(azimuthIndex * table.ViewAzimuths) / AnisotropicViews::Azimuths;
    const int from = static_cast<int>(p);
    LobeMeans between;
    for (int corner = 0; corner < 4; ++corner)
    {
      const int angle = low + corner % 2;
      const int azimuth = (from + corner / 2) % table.ViewAzimuths;
      between.Add(knots[angle * table.ViewAzimuths + azimuth]->GetMeans(),
        (corner % 2 ? w - low : 1.0 - w + low) * (corner / 2 ? p - from : 1.0 - p + from));
    }
    const double phi = views.GetAzimuth(azimuthIndex);
    const glm::dvec2 out(std::cos(phi), std::sin(phi));
    const bool hasFloor = PutProfile(lobe, between,
      { lobe.Axis.x * out.x + lobe.Axis.y * out.y, lobe.Axis.y * out.x - lobe.Axis.x * out.y, w },
      scale, static_cast<std::size_t>(k), table.Profile);
    table.HasFloor = table.HasFloor || hasFloor;
  }
}
} // namespace measuredbrdf

using namespace measuredbrdf;

struct vtkAnisotropicTableRadianceIntegrator::Tables : AnisotropicTable
{
  using AnisotropicTable::AnisotropicTable;
};

vtkStandardNewMacro(vtkAnisotropicTableRadianceIntegrator);

//------------------------------------------------------------------------------
vtkAnisotropicTableRadianceIntegrator::vtkAnisotropicTableRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkAnisotropicTableRadianceIntegrator::~vtkAnisotropicTableRadianceIntegrator() = default;

//------------------------------------------------------------------------------
bool vtkAnisotropicTableRadianceIntegrator::Begin()
{
  if (!this->HasLight())
  {
    return false;
  }
  auto table = std::make_unique<Tables>(this->NumberOfRows, this->NumberOfViewAngles,
    this->NumberOfAzimuths, this->NumberOfViewAzimuths);
  if (!this->MakeTable(*table))
  {
    vtkErrorMacro("Prepare: aborted.");
    return false;
  }
  this->Data = std::move(table);
  return true;
}

//------------------------------------------------------------------------------
// False where it was aborted.
bool vtkAnisotropicTableRadianceIntegrator::MakeTable(Tables& table)
{
  const int degree = GetMapDegree(this->NumberOfRows);
  const auto parts = this->Shared ? this->Shared : std::make_shared<Precomputation>();
  EnvironmentPrecomputation& ofEnvironment = this->Environment->GetParts();
  const auto goOn = [this]() { return this->Report(0.0); };
  const auto harmonics = ofEnvironment.GetHarmonics(
    this->Environment, this->Rest, std::max(degree, IrradianceDegree), goOn);
  if (!harmonics)
  {
    return false;
  }
  const AnisotropicViews& views = parts->GetAnisotropicViews(this->BRDF, this->Abort);
  const MaterialPrecomputation::AnisotropicKernels& knots = parts->GetAnisotropicKernels(
    this->BRDF, table.Angles, table.ViewAzimuths, NumberOfNodes, this->Abort);
  const double scale = this->Abort ? 0.0
                                   : SynthesizeAnisotropic(
                                       *harmonics, knots, degree,
                                       [this](double share) { return this->Report(share); }, table);
  if (!(scale > 0.0))
  {
    return false;
  }
  MakeAnisotropicProfile(views, knots, scale, table);
  if (table.HasFloor)
  {
    table.Irradiance = ofEnvironment.GetIrradiance(
      this->Rest, goOn, [&harmonics]() { return MakeIrradiance(*harmonics); });
  }
  return !table.HasFloor || table.Irradiance;
}

//------------------------------------------------------------------------------
void vtkAnisotropicTableRadianceIntegrator::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const glm::dvec3 sum =
    this->Data->Evaluate(glm::make_vec3(n), glm::make_vec3(o), glm::make_vec3(t));
  measuredbrdf::AddRGB(sum, radiance);
}

//------------------------------------------------------------------------------
int vtkAnisotropicTableRadianceIntegrator::GetNumberOfPeriods()
{
  return this->Data ? this->Data->Periods : 0;
}

//------------------------------------------------------------------------------
bool vtkAnisotropicTableRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  if (!this->Prepare())
  {
    return false;
  }
  const AnisotropicTable& table = *this->Data;
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(
    term, "vtkBRDFEnvironmentAnisotropic", vtkBRDFEnvironmentAnisotropic);
  term.Constants = { { "HAS_FLOOR", table.HasFloor ? "1" : "0" },
    { "PERIODS", std::to_string(table.Periods) + ".0" },
    { "VIEW_ANGLES", std::to_string(table.Angles) + ".0" },
    { "VIEW_AZIMUTHS", std::to_string(table.ViewAzimuths) + ".0" } };
  term.Uniforms.push_back(
    { "brdfTableLastView", { static_cast<float>(LobeViews::GetLastAngle() * 2.0 / Pi) } });
  term.Fetches = 6; // two of the profile, four views
  vtkBRDFShaderInputs::Texture& profile =
    AddTexture(term, "brdfTableProfile", AnisotropicViews::Angles, AnisotropicViews::Azimuths, 3);
  profile.Data = table.Profile;
  profile.Repeat[1] = true;
  vtkBRDFShaderInputs::Texture& radiance = AddTexture(term, "brdfTableRadiance", table.Columns,
    table.Rows * table.ViewAzimuths, table.Angles * (table.Azimuths + 1));
  radiance.SharedExponents = table.Radiance;
  radiance.Repeat[0] = true;
  if (table.HasFloor)
  {
    constexpr int side = RadianceTable::IrradianceSide;
    AddTexture(term, "brdfTableIrradiance", side, side).SharedExponents = table.Irradiance->Texels;
    term.Uniforms.push_back({ "brdfTableIrradianceScale", { table.Irradiance->Scale } });
    term.Fetches += 2; // with its profile
  }
  form = vtkBRDFShaderInputs();
  form.QuantizationError = std::ldexp(1.0, -9);
  form.Description = "anisotropic radiance table, " + std::to_string(table.Columns) + " x " +
                     std::to_string(table.Rows) + " axes x " + std::to_string(table.Azimuths) +
                     " azimuths x " + std::to_string(table.Angles) + " x " +
                     std::to_string(table.ViewAzimuths) + " views";
  form.Terms.push_back(std::move(term));
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkAnisotropicTableRadianceIntegrator, NumberOfRows, int, 9, 129);
measuredbrdfSetClampedMacro(vtkAnisotropicTableRadianceIntegrator, NumberOfViewAngles, int, 2, 32);
measuredbrdfSetClampedMacro(vtkAnisotropicTableRadianceIntegrator, NumberOfAzimuths, int, 4, 64);
measuredbrdfSetClampedMacro(
  vtkAnisotropicTableRadianceIntegrator, NumberOfViewAzimuths, int, 2, 32);

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkAnisotropicTableRadianceIntegrator::GetSizes()
{
  return { { "rows", 9, 129, this->NumberOfRows,
             [this](int value) { this->SetNumberOfRows(value); } },
    { "view angles", 2, 32, this->NumberOfViewAngles,
      [this](int value) { this->SetNumberOfViewAngles(value); } },
    { "azimuths", 4, 64, this->NumberOfAzimuths,
      [this](int value) { this->SetNumberOfAzimuths(value); } },
    { "view azimuths", 2, 32, this->NumberOfViewAzimuths,
      [this](int value) { this->SetNumberOfViewAzimuths(value); } } };
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> vtkAnisotropicTableRadianceIntegrator::GetCandidateSizes(bool)
{
  if (this->BRDF->IsIsotropic())
  {
    return {};
  }
  std::vector<std::vector<int>> sizes = GetAnisotropicCandidates();
  const auto goOn = [this]() { return this->Report(0.0); };
  if (CountPlannedLights(this->Environment, LampAngle, goOn) > 0)
  {
    sizes.pop_back(); // tables beside lamps take over
  }
  return sizes;
}

//------------------------------------------------------------------------------
double vtkAnisotropicTableRadianceIntegrator::EstimateCost()
{
  return 2.0 * PixelCosts::Table - PixelCosts::Pixel; // two tables in one pixel
}

//------------------------------------------------------------------------------
vtkIdType vtkAnisotropicTableRadianceIntegrator::EstimateTextureBytes()
{
  const vtkIdType columns = 2 * (this->NumberOfRows - 1);
  const vtkIdType maps = static_cast<vtkIdType>(this->NumberOfViewAngles) *
                         (this->NumberOfAzimuths + 1) * this->NumberOfViewAzimuths;
  return 4 * columns * this->NumberOfRows * maps +
         12 * 3 * AnisotropicViews::Angles * AnisotropicViews::Azimuths +
         4 * RadianceTable::IrradianceSide * RadianceTable::IrradianceSide;
}

//------------------------------------------------------------------------------
void vtkAnisotropicTableRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRows: " << this->NumberOfRows << "\n";
  os << indent << "NumberOfViewAngles: " << this->NumberOfViewAngles << "\n";
  os << indent << "NumberOfAzimuths: " << this->NumberOfAzimuths << "\n";
  os << indent << "NumberOfViewAzimuths: " << this->NumberOfViewAzimuths << "\n";
}
