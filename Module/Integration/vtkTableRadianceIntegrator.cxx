// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTableRadianceIntegrator.h"

#include "EnvironmentPrecomputation.h"
#include "LocalFrame.h"
#include "LogFactorial.h"
#include "MaterialPrecomputation.h"
#include "ModuleShader.h"
#include "Neighbors.h"
#include "Printable.h"
#include "Setters.h"
#include "TableCandidates.h"
#include "WignerD.h"
#include "vtkBRDF.h"
#include "vtkBRDFEnvironmentTable.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"
#include "vtkRadianceCostModel.h"
#include "vtkSMPTools.h"

#include <Eigen/Core>
#include <glm/gtc/type_ptr.hpp>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

using namespace measuredbrdf;

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr int ProfileSize = LobeViews::NumberOfViews;
constexpr int IrradianceRows = 129;    // of the map of irradiance, poles included
constexpr int IrradianceDegree = 128;  // the cosine's coefficients fall as l^-2.5
constexpr double LargestValue = 32768; // of a 16-bit texture, with room to spare

const double LastView = LobeViews::GetLastAngle();

// Radiance of kernels given by their harmonics, over all positions of their axis: a map of rows
// (poles included) x columns of the axis' polar angle and azimuth, for each kernel, channel and
// azimuthal order k a field of complex values G_k such that radiance = G_0 + sum_k>0 2 Re(e^(-i k
// psi) G_k), psi being the plane of incidence's azimuth from the meridian's direction of growing
// polar angle. G_k = sum_m e^(-i m phi) sum_l d^l_mk(theta) b_lk conj(a_lm).
class FieldSynthesis
{
public:
  FieldSynthesis(const EnvironmentHarmonics& environment, int rows, int columns)
    : Environment(environment)
    , Rows(rows)
    , Columns(columns)
  {
  }

  using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic>;

  using Field = std::vector<std::complex<float>>;

  // kernels of each channel: degrees x kernels. result of each channel: [kernel][row][column].
  void Run(int order, const std::array<Matrix, 3>& kernels, std::array<Field, 3>& result)
  {
    const int degree = static_cast<int>(kernels[0].rows()) - 1;
    const Eigen::Index count = kernels[0].cols();
    const std::size_t kinds = 3 * static_cast<std::size_t>(count);
    const std::size_t orders = 2 * static_cast<std::size_t>(degree) + 1;
    const std::size_t rows = static_cast<std::size_t>(this->Rows);
    const std::size_t columns = static_cast<std::size_t>(this->Columns);
    Field series(orders * kinds * rows); // [m][channel][kernel][row]
    vtkSMPTools::For(0, static_cast<vtkIdType>(orders), 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        std::vector<double> d(static_cast<std::size_t>(degree) + 1);
        for (vtkIdType item = begin; item < end; ++item)
        {
          const int m = static_cast<int>(item) - degree;
          const WignerD functions(m, order, degree);
          const int first = functions.GetFirst();
          const int size = degree + 1 - first;
          if (size <= 0)
          {
            continue;
          }
          Matrix turns(size, this->Rows); // the same for all channels and kernels
          for (int row = 0; row < this->Rows; ++row)
          {
            functions.Evaluate(Pi * row / (this->Rows - 1), d.data());
            turns.col(row) = Eigen::Map<const Eigen::VectorXd>(d.data(), size).cast<float>();
          }
          Matrix lit(size, 2 * 3 * count); // real and imaginary parts of b_lk conj(a_lm)
          for (int channel = 0; channel < 3; ++channel)
          {
            const Matrix& of = kernels[static_cast<std::size_t>(channel)];
            for (int k = 0; k < size; ++k)
            {
              std::complex<double> a = this->Environment.Get(channel, first + k, std::abs(m));
              a = m >= 0 ? std::conj(a) : (m % 2 != 0 ? -a : a);
              for (Eigen::Index kernel = 0; kernel < count; ++kernel)
              {
                const Eigen::Index column = 2 * (channel * count + kernel);
                lit(k, column) = of(first + k, kernel) * static_cast<float>(a.real());
                lit(k, column + 1) = of(first + k, kernel) * static_cast<float>(a.imag());
              }
            }
          }
          const Matrix product = turns.transpose() * lit;
          std::complex<float>* out = &series[static_cast<std::size_t>(item) * kinds * rows];
          for (std::size_t kind = 0; kind < kinds; ++kind)
          {
            const Eigen::Index column = static_cast<Eigen::Index>(2 * kind);
            for (std::size_t row = 0; row < rows; ++row)
            {
              const Eigen::Index r = static_cast<Eigen::Index>(row);
              out[kind * rows + row] = { product(r, column), product(r, column + 1) };
            }
          }
        }
      });
    for (Field& field : result)
    {
      field.resize(rows * columns * static_cast<std::size_t>(count));
    }
    vtkSMPTools::For(0, static_cast<vtkIdType>(rows), 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        Eigen::FFT<float> transform;
        Field line(columns), field(columns);
        const std::size_t each = static_cast<std::size_t>(count);
        for (std::size_t row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end);
             ++row)
        {
          for (std::size_t kind = 0; kind < kinds; ++kind)
          {
            std::fill(line.begin(), line.end(), 0.0f);
            for (std::size_t item = 0; item < orders; ++item)
            {
              const int m = static_cast<int>(item) - degree;
              const int n = static_cast<int>(columns);
              line[static_cast<std::size_t>((m % n + n) % n)] +=
                series[(item * kinds + kind) * rows + row];
            }
            transform.fwd(field, line);
            std::copy(field.begin(), field.end(),
              result[kind / each].begin() +
                static_cast<std::ptrdiff_t>((kind % each * rows + row) * columns));
          }
        }
      });
  }

private:
  const EnvironmentHarmonics& Environment;
  int Rows;
  int Columns;
};

// Where a direction lies in a map of rows (poles included) x columns: its frame is the meridian's
// and the parallel's direction of growing angles.
struct MapPosition
{
  explicit MapPosition(const glm::dvec3& d)
  {
    // The harmonics' frame is the environment's (z, x, y).
    const double sine = std::hypot(d.z, d.x);
    const glm::dvec2 azimuth = sine > 1e-7 ? glm::dvec2(d.z, d.x) / sine : glm::dvec2(1.0, 0.0);
    this->Azimuth = std::atan2(azimuth.y, azimuth.x) / (2.0 * Pi);
    this->Polar = std::atan2(sine, d.y) / Pi;
    this->Along = glm::dvec3(azimuth.y * d.y, -sine, azimuth.x * d.y);
    this->Across = glm::dvec3(azimuth.x, 0.0, -azimuth.y);
  }
  double Azimuth; // in turns
  double Polar;   // in half turns
  glm::dvec3 Along;
  glm::dvec3 Across;
};
} // namespace

struct vtkTableRadianceIntegrator::Tables
{
  int Rows = 0;
  int Columns = 0;
  int Azimuths = 0;
  int Angles = 0;
  double Scale = 1.0;
  bool HasFloor = false;
  std::vector<float> Profile; // RGB, ProfileSize x 3: (angle, cos, sin delta); share; c
  // RGB, Columns x Rows x Angles (Azimuths + 1): the first azimuth comes again after the last.
  std::vector<float> Radiance;
  // RGB, 2 (IrradianceRows - 1) x IrradianceRows; null: there is no floor. Of all materials.
  std::shared_ptr<const std::vector<float>> Irradiance;

  glm::dvec3 GetProfile(int row, double u) const
  {
    const double exact = u * (ProfileSize - 1);
    const int low = std::min(static_cast<int>(exact), ProfileSize - 2);
    return glm::mix(GetTexel(this->Profile, ProfileSize * row + low),
      GetTexel(this->Profile, ProfileSize * row + low + 1), exact - low);
  }

  static glm::dvec3 GetTexel(const std::vector<float>& data, int index)
  {
    return glm::dvec3(glm::make_vec3(&data[3 * static_cast<std::size_t>(index)]));
  }

  // Bilinear in a map that begins at the given texel.
  static glm::dvec3 GetMapValue(const std::vector<float>& data, int rows, int columns,
    std::size_t firstTexel, const MapPosition& at)
  {
    const Neighbors x = PeriodicNeighbors(at.Azimuth + 0.5 / columns, columns);
    const double exact = at.Polar * (rows - 1);
    const int low = std::min(static_cast<int>(exact), rows - 2);
    const auto row = [&](int k)
    {
      const int first = static_cast<int>(firstTexel) + columns * k;
      return glm::mix(GetTexel(data, first + x.First), GetTexel(data, first + x.Second), x.Weight);
    };
    return glm::mix(row(low), row(low + 1), exact - low);
  }
};

vtkStandardNewMacro(vtkTableRadianceIntegrator);

//------------------------------------------------------------------------------
vtkTableRadianceIntegrator::vtkTableRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkTableRadianceIntegrator::~vtkTableRadianceIntegrator() = default;

//------------------------------------------------------------------------------
bool vtkTableRadianceIntegrator::Begin()
{
  this->Abort = false; // one that an earlier run left
  if (!this->Environment || this->Environment->GetPixels().empty())
  {
    vtkErrorMacro("Prepare: there is no environment, or it is empty.");
    return false;
  }
  if (!this->BRDF->IsIsotropic())
  {
    vtkErrorMacro(
      "Prepare: tables of radiance are for isotropic materials; "
      << (this->BRDF->GetName().empty() ? "this one" : measuredbrdf::Quote(this->BRDF->GetName()))
      << " is not.");
    return false;
  }
  auto tables = std::make_unique<Tables>();
  tables->Rows = this->NumberOfRows;
  tables->Columns = 2 * (this->NumberOfRows - 1);
  tables->Angles = this->NumberOfViewAngles;
  tables->Azimuths = this->NumberOfAzimuths;
  const int orders = this->NumberOfAzimuths / 2; // as many as the azimuths can tell apart
  const int degree = this->HarmonicDegree > 0 ? this->HarmonicDegree : this->NumberOfRows;
  const auto parts = this->Shared ? this->Shared : std::make_shared<Precomputation>();
  EnvironmentPrecomputation& ofEnvironment = this->Environment->GetParts();
  const auto goOn = [this]() { return this->Report(0.0); };
  const auto harmonics = ofEnvironment.GetHarmonics(
    this->Environment, this->Rest, std::max(degree, IrradianceDegree), goOn);
  if (!harmonics)
  {
    vtkErrorMacro("Prepare: aborted.");
    return false;
  }
  const LobeViews& views = parts->GetViews(this->BRDF, this->Abort);
  const int angles = this->NumberOfViewAngles;
  const MaterialPrecomputation::Kernels& knots =
    parts->GetKernels(this->BRDF, angles, this->NumberOfNodes, this->Abort);
  std::vector<std::vector<float>> kernels(static_cast<std::size_t>(angles));
  vtkSMPTools::For(0, angles, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end && !this->Abort; ++k)
      {
        const LobeHarmonics& knot = *knots[static_cast<std::size_t>(k)];
        kernels[static_cast<std::size_t>(k)] = knot.Expand(knot.GetMeans().Delta, degree, orders);
      }
    });

  // The table.
  const std::size_t texels =
    static_cast<std::size_t>(tables->Columns) * static_cast<std::size_t>(tables->Rows);
  const std::size_t slices = static_cast<std::size_t>(tables->Azimuths) + 1;
  tables->Radiance.assign(3 * texels * slices * static_cast<std::size_t>(angles), 0.0f);
  FieldSynthesis synthesis(*harmonics, tables->Rows, tables->Columns);
  std::array<FieldSynthesis::Matrix, 3> matrices;
  std::array<FieldSynthesis::Field, 3> fields;
  for (int order = 0; order <= orders && !this->Abort; ++order)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      FieldSynthesis::Matrix& matrix = matrices[static_cast<std::size_t>(channel)];
      matrix.resize(degree + 1, angles);
      for (int angle = 0; angle < angles; ++angle)
      {
        const std::size_t index = static_cast<std::size_t>(angle);
        const std::size_t begin =
          static_cast<std::size_t>(3 * order + channel) * static_cast<std::size_t>(degree + 1);
        matrix.col(angle) = Eigen::Map<const Eigen::VectorXf>(&kernels[index][begin], degree + 1) *
                            static_cast<float>(knots[index]->GetMeans().Amplitude[channel]);
      }
    }
    synthesis.Run(order, matrices, fields);
    vtkSMPTools::For(0, static_cast<vtkIdType>(slices), 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType azimuth = begin; azimuth < end; ++azimuth)
        {
          const std::complex<float> turn = std::polar(order == 0 ? 1.0f : 2.0f,
            static_cast<float>(
              -2.0 * Pi * order * static_cast<double>(azimuth) / tables->Azimuths));
          for (std::size_t angle = 0; angle < static_cast<std::size_t>(angles); ++angle)
          {
            const std::size_t slice = angle * slices + static_cast<std::size_t>(azimuth);
            float* out = &tables->Radiance[3 * slice * texels];
            for (std::size_t channel = 0; channel < 3; ++channel)
            {
              const std::complex<float>* in = &fields[channel][angle * texels];
              for (std::size_t texel = 0; texel < texels; ++texel)
              {
                out[3 * texel + channel] +=
                  turn.real() * in[texel].real() - turn.imag() * in[texel].imag();
              }
            }
          }
        }
      });
    this->Report((order + 1.0) / (orders + 1));
  }
  if (this->Abort)
  {
    vtkErrorMacro("Prepare: aborted.");
    return false;
  }
  float largest = 0.0f;
  for (const float value : tables->Radiance)
  {
    largest = std::max(largest, std::abs(value));
  }
  // To the peak: 16-bit floats lose digits below 6e-5, too.
  tables->Scale = largest > 0.0f ? largest / LargestValue : 1.0;
  for (float& value : tables->Radiance)
  {
    value = static_cast<float>(value / tables->Scale);
  }

  // The profile over all view angles.
  tables->Profile.resize(3 * 3 * ProfileSize);
  for (int k = 0; k < ProfileSize; ++k)
  {
    const LobeMeans& lobe = views.GetViews()[static_cast<std::size_t>(k)].Means;
    const double theta = LobeViews::GetAngle(k);
    // Between the table's view angles both parts are interpolated, however steeply one hands over
    // to the other; what they miss of the directional albedo goes to the rest.
    const double w = std::clamp((angles - 1) * theta / LastView, 0.0, angles - 1.0);
    const std::size_t low = std::min(static_cast<std::size_t>(w), knots.size() - 2);
    const double t = w - static_cast<double>(low);
    const LobeMeans& below = knots[low]->GetMeans();
    const LobeMeans& above = knots[low + 1]->GetMeans();
    const glm::dvec3 floor = glm::mix(below.Floor, above.Floor, t);
    const glm::dvec3 amplitude = glm::mix(below.Amplitude, above.Amplitude, t);
    glm::dvec3 share(0.0);
    for (int c = 0; c < 3; ++c)
    {
      const double wanted = lobe.Amplitude[c] + Pi * (lobe.Floor[c] - floor[c]);
      share[c] = amplitude[c] > 0.0 ? std::max(wanted, 0.0) / amplitude[c] : 0.0;
    }
    const glm::dvec3 rowsOf[3] = { { w, std::cos(lobe.Delta), std::sin(lobe.Delta) },
      share * tables->Scale, floor };
    for (int row = 0; row < 3; ++row)
    {
      for (int c = 0; c < 3; ++c)
      {
        tables->Profile[3 * static_cast<std::size_t>(row * ProfileSize + k) +
                        static_cast<std::size_t>(c)] = static_cast<float>(rowsOf[row][c]);
      }
    }
    tables->HasFloor = tables->HasFloor || floor != glm::dvec3(0.0);
  }
  if (tables->HasFloor)
  {
    tables->Irradiance = ofEnvironment.GetIrradiance(
      this->Rest, goOn, [&harmonics]() { return MakeIrradiance(*harmonics); });
    if (!tables->Irradiance)
    {
      vtkErrorMacro("Prepare: aborted.");
      return false;
    }
  }
  this->Data = std::move(tables);
  return true;
}

//------------------------------------------------------------------------------
std::shared_ptr<const std::vector<float>> vtkTableRadianceIntegrator::MakeIrradiance(
  const EnvironmentHarmonics& environment)
{
  // The clamped cosine's harmonics (Ramamoorthi, Hanrahan 2001).
  FieldSynthesis::Matrix cosine = FieldSynthesis::Matrix::Zero(IrradianceDegree + 1, 1);
  for (int l = 0; l <= IrradianceDegree; ++l)
  {
    double value = l == 1 ? 2.0 * Pi / 3.0 : 0.0;
    if (l % 2 == 0)
    {
      value = 2.0 * Pi * (l % 4 == 0 ? -1.0 : 1.0) / ((l + 2.0) * (l - 1.0)) *
              std::exp(LogFactorial(l) - 2.0 * LogFactorial(l / 2) - l * std::log(2.0));
    }
    cosine(l, 0) = static_cast<float>(value * std::sqrt((2.0 * l + 1.0) / (4.0 * Pi)));
  }
  const int columns = 2 * (IrradianceRows - 1);
  FieldSynthesis synthesis(environment, IrradianceRows, columns);
  auto irradiance =
    std::make_shared<std::vector<float>>(3 * static_cast<std::size_t>(columns * IrradianceRows));
  std::array<FieldSynthesis::Field, 3> fields;
  synthesis.Run(0, { cosine, cosine, cosine }, fields);
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    for (std::size_t texel = 0; texel < fields[channel].size(); ++texel)
    {
      (*irradiance)[3 * texel + channel] = fields[channel][texel].real();
    }
  }
  return irradiance;
}

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const Tables& tables = *this->Data;
  const Frame frame = FrameAbout(glm::make_vec3(n), glm::make_vec3(t));
  const glm::dvec3 view = LiftView(ToLocal(frame, glm::make_vec3(o)));
  const double sine = std::hypot(view.x, view.y);
  const double u = 1.0 - std::sqrt(std::max(1.0 - std::atan2(sine, view.z) / LastView, 0.0));
  const glm::dvec3 axis = tables.GetProfile(0, u);
  const glm::dvec2 azimuth = sine > 1e-6 ? glm::dvec2(view) / sine : glm::dvec2(1.0, 0.0);
  const glm::dvec3 across = frame[0] * azimuth.x + frame[1] * azimuth.y;
  const glm::dvec3 d = glm::normalize(axis.y * frame[2] - axis.z * across);
  const glm::dvec3 along = axis.y * across + axis.z * frame[2];

  const MapPosition at(d);
  const double psi = std::atan2(glm::dot(along, at.Across), glm::dot(along, at.Along)) / (2.0 * Pi);
  const Neighbors turn = PeriodicNeighbors(psi + 0.5 / tables.Azimuths, tables.Azimuths);
  const std::size_t texels =
    static_cast<std::size_t>(tables.Columns) * static_cast<std::size_t>(tables.Rows);
  const double w = std::clamp(axis.x, 0.0, tables.Angles - 1.0);
  const int angle = std::min(static_cast<int>(w), tables.Angles - 2);
  const auto value = [&](int azimuth, int k)
  {
    return Tables::GetMapValue(tables.Radiance, tables.Rows, tables.Columns,
      static_cast<std::size_t>(k * (tables.Azimuths + 1) + azimuth) * texels, at);
  };
  const auto between = [&](int k)
  { return glm::mix(value(turn.First, k), value(turn.Second, k), turn.Weight); };
  glm::dvec3 sum = glm::mix(between(angle), between(angle + 1), w - angle);
  sum *= tables.GetProfile(1, u);
  if (tables.HasFloor)
  {
    sum += tables.GetProfile(2, u) * Tables::GetMapValue(*tables.Irradiance, IrradianceRows,
                                       2 * (IrradianceRows - 1), 0, MapPosition(frame[2]));
  }
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] += std::max(sum[c], 0.0);
  }
}

//------------------------------------------------------------------------------
std::string vtkTableRadianceIntegrator::GetPrepared()
{
  if (!this->Data)
  {
    return "";
  }
  const Tables& tables = *this->Data;
  std::string bytes;
  const std::vector<float> none;
  const std::vector<float>& irradiance = tables.HasFloor ? *tables.Irradiance : none;
  const auto put = [&bytes](const void* data, std::size_t size)
  { bytes.append(static_cast<const char*>(data), size); };
  const std::uint64_t header[] = { static_cast<std::uint64_t>(tables.Rows),
    static_cast<std::uint64_t>(tables.Angles), static_cast<std::uint64_t>(tables.Azimuths),
    tables.Profile.size(), tables.Radiance.size(), irradiance.size() };
  put(header, sizeof(header));
  put(&tables.Scale, sizeof(tables.Scale));
  for (const std::vector<float>* values : { &tables.Profile, &tables.Radiance, &irradiance })
  {
    put(values->data(), values->size() * sizeof(float));
  }
  return bytes;
}

//------------------------------------------------------------------------------
bool vtkTableRadianceIntegrator::TakePrepared(const std::string& bytes)
{
  std::uint64_t header[6];
  auto tables = std::make_unique<Tables>();
  std::size_t at = sizeof(header) + sizeof(tables->Scale);
  if (bytes.size() < at)
  {
    return false;
  }
  std::memcpy(header, bytes.data(), sizeof(header));
  std::memcpy(&tables->Scale, bytes.data() + sizeof(header), sizeof(tables->Scale));
  tables->Rows = this->NumberOfRows;
  tables->Columns = 2 * (this->NumberOfRows - 1);
  tables->Angles = this->NumberOfViewAngles;
  tables->Azimuths = this->NumberOfAzimuths;
  const std::uint64_t radiance =
    3ull * static_cast<std::uint64_t>(tables->Rows) * static_cast<std::uint64_t>(tables->Columns) *
    static_cast<std::uint64_t>(tables->Angles) * static_cast<std::uint64_t>(tables->Azimuths + 1);
  const std::uint64_t irradiance = 3ull * 2 * (IrradianceRows - 1) * IrradianceRows;
  const std::uint64_t expected[] = { static_cast<std::uint64_t>(tables->Rows),
    static_cast<std::uint64_t>(tables->Angles), static_cast<std::uint64_t>(tables->Azimuths),
    3ull * 3 * ProfileSize, radiance, header[5] == 0 ? 0 : irradiance };
  if (!std::equal(header, header + 6, expected) ||
      bytes.size() != at + sizeof(float) * (header[3] + header[4] + header[5]))
  {
    return false;
  }
  tables->HasFloor = header[5] != 0;
  int part = 3;
  auto irradianceMap = std::make_shared<std::vector<float>>();
  for (std::vector<float>* values : { &tables->Profile, &tables->Radiance, irradianceMap.get() })
  {
    values->resize(static_cast<std::size_t>(header[part++]));
    std::memcpy(values->data(), bytes.data() + at, values->size() * sizeof(float));
    at += values->size() * sizeof(float);
    if (!std::all_of(values->begin(), values->end(), [](float v) { return std::isfinite(v); }))
    {
      return false;
    }
  }
  tables->Irradiance = irradianceMap;
  this->Data = std::move(tables);
  this->PrepareTime.Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkTableRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  if (!this->Prepare())
  {
    return false;
  }
  const Tables& tables = *this->Data;
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFEnvironmentTable", vtkBRDFEnvironmentTable);
  term.Constants = { { "HAS_FLOOR", tables.HasFloor ? "1" : "0" } };
  term.Uniforms.push_back({ "brdfTableAngles", { static_cast<float>(tables.Angles) } });
  term.Uniforms.push_back({ "brdfTableLastView", { static_cast<float>(LastView * 2.0 / Pi) } });
  const auto add = [&term](const char* name, int width, int height, int depth, bool half,
                     const std::vector<float>& data)
  {
    vtkBRDFShaderInputs::Texture texture;
    texture.Name = name;
    texture.Dimensions = { width, height, depth };
    texture.ThreeD = depth > 1;
    texture.HalfFloat = half;
    texture.Repeat[0] = name != std::string("brdfTableProfile");
    texture.Data = data;
    term.Textures.push_back(std::move(texture));
  };
  add("brdfTableProfile", ProfileSize, 3, 1, false, tables.Profile);
  add("brdfTableRadiance", tables.Columns, tables.Rows, tables.Angles * (tables.Azimuths + 1), true,
    tables.Radiance);
  if (tables.HasFloor)
  {
    add("brdfTableIrradiance", 2 * (IrradianceRows - 1), IrradianceRows, 1, false,
      *tables.Irradiance);
  }
  form = vtkBRDFShaderInputs();
  form.QuantizationError = std::ldexp(1.0, -11);
  form.Description = "radiance table, " + std::to_string(tables.Columns) + " x " +
                     std::to_string(tables.Rows) + " axes x " + std::to_string(tables.Angles) +
                     " view angles x " + std::to_string(tables.Azimuths) + " azimuths";
  form.Terms.push_back(std::move(term));
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfRows, int, 9, 513);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfViewAngles, int, 2, 64);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfAzimuths, int, 4, 64);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, HarmonicDegree, int, 0, 1024);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfNodes, int, 16, 1024);

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkTableRadianceIntegrator::GetSizes()
{
  return { { "rows", 9, 513, this->NumberOfRows },
    { "view angles", 2, 64, this->NumberOfViewAngles },
    { "azimuths", 4, 64, this->NumberOfAzimuths } };
}

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::SetSize(int index, int value)
{
  switch (index)
  {
    case 0:
      return this->SetNumberOfRows(value);
    case 1:
      return this->SetNumberOfViewAngles(value);
    default:
      this->SetNumberOfAzimuths(value);
  }
}

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::CopyProperties(vtkRadianceIntegrator* source)
{
  this->Superclass::CopyProperties(source);
  if (auto* table = vtkTableRadianceIntegrator::SafeDownCast(source))
  {
    this->SetHarmonicDegree(table->HarmonicDegree);
    this->SetNumberOfNodes(table->NumberOfNodes);
  }
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> vtkTableRadianceIntegrator::GetCandidateSizes(bool)
{
  return this->BRDF->IsIsotropic() ? GetTableCandidates() : std::vector<std::vector<int>>();
}

//------------------------------------------------------------------------------
double vtkTableRadianceIntegrator::EstimateCost(vtkRadianceCostModel* costs)
{
  return costs->GetCost("base") + costs->GetCost("table");
}

//------------------------------------------------------------------------------
vtkIdType vtkTableRadianceIntegrator::EstimateTextureBytes()
{
  return GetTableBytes(this->NumberOfRows, this->NumberOfViewAngles, this->NumberOfAzimuths);
}

//------------------------------------------------------------------------------
bool vtkTableRadianceIntegrator::CanPrune(const std::vector<Attempt>& attempts, double error)
{
  return CanPruneTable(
    { this->NumberOfRows, this->NumberOfViewAngles, this->NumberOfAzimuths }, attempts, error);
}

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRows: " << this->NumberOfRows << "\n";
  os << indent << "NumberOfViewAngles: " << this->NumberOfViewAngles << "\n";
  os << indent << "NumberOfAzimuths: " << this->NumberOfAzimuths << "\n";
  os << indent << "HarmonicDegree: " << this->HarmonicDegree << "\n";
  os << indent << "NumberOfNodes: " << this->NumberOfNodes << "\n";
}
