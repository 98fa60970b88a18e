// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTabulatedBRDF.h"

#include "ContentHash.h"
#include "HalfVector.h"
#include "HalfVectorSampler.h"
#include "LaneMath.h"
#include "ModuleShader.h"
#include "Neighbors.h"
#include "NumberText.h"
#include "OneByOne.h"
#include "Setters.h"
#include "SharedExponent.h"
#include "TabulatedLevels.h"
#include "TabulatedStorage.h"
#include "VolumeInterpolation.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFHalfDifference.h"
#include "vtkBRDFHalfDifferenceSoft.h"
#include "vtkBRDFIncidentOutgoing.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkTabulatedBRDF);

struct vtkTabulatedBRDF::Sampler : public HalfVectorSampler
{
  using HalfVectorSampler::HalfVectorSampler;
};

struct vtkTabulatedBRDF::Levels
{
  std::once_flag Made; // by the first of many threads that asks
  std::optional<TabulatedLevels> Values;
};

namespace
{
static_assert(static_cast<int>(TabulatedStorage::Shared) == vtkTabulatedBRDF::SHARED_EXPONENT &&
              static_cast<int>(TabulatedStorage::Half) == vtkTabulatedBRDF::FLOAT16 &&
              static_cast<int>(TabulatedStorage::Float) == vtkTabulatedBRDF::FLOAT32);

// Invalid cells are premultiplied away: the filter then skips them as Evaluate does.
void FillTexture(vtkBRDFShaderInputs::Texture& texture, const std::vector<float>& volume,
  const TabulatedStorage& storage)
{
  const float scale = storage.Scale;
  const std::size_t cells = volume.size() / 3;
  texture.HalfFloat = storage.HalfFloat;
  if (storage.SharedExponents)
  {
    texture.SharedExponents.reserve(cells);
    for (std::size_t k = 0; k < cells; ++k)
    {
      texture.SharedExponents.push_back(
        measuredbrdf::PackSharedExponent(scale * glm::make_vec3(&volume[3 * k])));
    }
    return;
  }
  texture.Data.reserve(cells * static_cast<std::size_t>(texture.Components));
  for (std::size_t k = 0; k < cells; ++k)
  {
    const float* v = &volume[3 * k];
    const bool valid = !std::isnan(v[0]);
    for (int c = 0; c < 3; ++c)
    {
      texture.Data.push_back(valid ? v[c] * scale : 0.0f);
    }
    if (texture.Components == 4)
    {
      texture.Data.push_back(valid ? 1.0f : 0.0f);
    }
  }
}

// What surrounds coordinates u in a half/difference volume's level.
VolumeSum GatherLevel(const TabulatedLevels& levels, int level, const std::vector<float>& volume,
  const int dimensions[3], const glm::dvec3& u)
{
  if (level == 0)
  {
    return GatherCorners(volume, dimensions,
      { FindCorners(u.x, dimensions[0], true), FindCorners(u.y, dimensions[1], false),
        FindCorners(u.z, dimensions[2], false) });
  }
  const std::array<int, 3>& size = levels.GetDimensions();
  const Neighbors z = levels.FindSlices(level, u.z);
  return GatherCorners(levels.GetVolume(), size.data(),
    { FindCorners(u.x, size[0], true), FindCorners(u.y, size[1], false),
      { { z.First, z.Second }, { 1.0 - z.Weight, z.Weight } } });
}

// Angles of a pair in units of the axes, each in [0,1] (azimuth: any real number, periodic).
glm::dvec3 ToUnit(int parameterization, int azimuthRange, const glm::dvec3& i, const glm::dvec3& o)
{
  const bool half = azimuthRange == vtkTabulatedBRDF::HALF_TURN;
  if (parameterization == vtkTabulatedBRDF::HALF_DIFFERENCE)
  {
    return ToHalfDifferenceUnit(i, o, half);
  }
  double phi = std::atan2(i.x * o.y - i.y * o.x, i.x * o.x + i.y * o.y);
  if (half)
  {
    phi = std::abs(phi);
  }
  return { phi / (half ? Pi : 2.0 * Pi), std::atan2(std::hypot(o.x, o.y), o.z) * (2.0 / Pi),
    std::atan2(std::hypot(i.x, i.y), i.z) * (2.0 / Pi) };
}

// The same for several lights, to single precision; the azimuth of what lies nearly in its axis is
// less exact.
MEASUREDBRDF_INLINE void FindIncidentOutgoingInLanes(
  const LaneDirections& light, const double o[3], bool isHalfTurn, Floats units[3])
{
  const LaneDirections view = FillDirections(o);
  const Floats along = light.X * view.X + light.Y * view.Y;
  const Floats across = light.X * view.Y - light.Y * view.X;
  const Floats turns = FindTurns(along, across);
  units[0] = isHalfTurn ? 2.0f * turns : (across < 0.0f ? -turns : turns);
  units[1] = Fill(static_cast<float>(std::atan2(std::hypot(o[0], o[1]), o[2]) * (2.0 / Pi)));
  units[2] = FindQuarterTurns(FindHalfDistance(light, { Floats{}, Floats{}, Fill(1.0f) }));
}

MEASUREDBRDF_INLINE void FindHalfDifferenceInLanes(
  const LaneDirections& light, const LaneDirections& h, bool isHalfTurn, Floats units[3])
{
  // The frame of h: along the plane of h and the normal, and across it. Times the sine of theta_h.
  const Floats square = h.X * h.X + h.Y * h.Y;
  const Floats x = square > 1e-14f ? h.X : Fill(1.0f);
  const Floats y = square > 1e-14f ? h.Y : Floats{};
  const Floats below = square > 1e-14f ? square * light.Z : Floats{};
  const Floats along = h.Z * (x * light.X + y * light.Y) - below;
  const Floats across = x * light.Y - y * light.X;
  const Floats turns = FindTurns(along, across);
  units[0] = (across < 0.0f ? -turns : turns) * (isHalfTurn ? 2.0f : 1.0f);
  units[1] = FindQuarterTurns(FindHalfDistance(light, h));
  units[2] = SquareRoot(FindQuarterTurns(FindHalfDistance(h, { Floats{}, Floats{}, Fill(1.0f) })));
}

// The samples of an axis about coordinates, as FindCorners finds them.
struct AxisLanes
{
  Integers First, Second;
  Floats Weight; // of the second
};

MEASUREDBRDF_INLINE AxisLanes FindAxisLanes(Floats unit, int count, bool periodic)
{
  const auto n = static_cast<float>(count);
  Floats x = unit * n - 0.5f;
  x = periodic ? x + 2.0f * n : Smaller(Larger(x, Floats{}), Fill(n - 1.0f)); // unit > -1
  Integers first = ToIntegers(x);
  const Floats weight = x - ToFloats(first);
  for (int turn = 0; turn < 3 && periodic; ++turn)
  {
    first = first >= count ? first - count : first;
  }
  const Integers next = first + 1;
  const Integers beyond = Integers{} + (periodic ? 0 : count - 1);
  return { first, next >= count ? beyond : next, weight };
}

// The volume's value in one lane, of a volume without invalid cells: red, green, blue and a number.
MEASUREDBRDF_INLINE Float4 InterpolateInLanes(
  const std::vector<float>& volume, const int dimensions[3], const AxisLanes axes[3], int k)
{
  const std::ptrdiff_t x[2] = { axes[0].First[k], axes[0].Second[k] };
  const std::ptrdiff_t y[2] = { axes[1].First[k], axes[1].Second[k] };
  const std::ptrdiff_t z[2] = { axes[2].First[k], axes[2].Second[k] };
  const float u = axes[0].Weight[k];
  const float v = axes[1].Weight[k];
  const float w = axes[2].Weight[k];
  const float weights[4] = { (1.0f - v) * (1.0f - w), v * (1.0f - w), (1.0f - v) * w, v * w };
  const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(volume.size()) - 4;
  Float4 sum{};
  for (int row = 0; row < 4; ++row)
  {
    const std::ptrdiff_t start = dimensions[0] * (y[row % 2] + dimensions[1] * z[row / 2]);
    for (int side = 0; side < 2; ++side)
    {
      const std::ptrdiff_t at = 3 * (start + x[side]);
      const float* const rgb = volume.data() + at;
      const float weight = weights[row] * (side == 0 ? 1.0f - u : u);
      const Float4 color = at <= last ? Load<Float4>(rgb) : Float4{ rgb[0], rgb[1], rgb[2], 0.0f };
      sum += weight * color;
    }
  }
  return sum;
}
}

//------------------------------------------------------------------------------
vtkTabulatedBRDF::vtkTabulatedBRDF() = default;

//------------------------------------------------------------------------------
vtkTabulatedBRDF::~vtkTabulatedBRDF() = default;

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkTabulatedBRDF, Precision, int, AUTOMATIC, SHARED_EXPONENT);
measuredbrdfSetClampedMacro(vtkTabulatedBRDF, ResamplingError, double, 0.0, 1e6);

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Parameterization: "
     << (this->Parameterization == HALF_DIFFERENCE ? "half/difference" : "incident/outgoing")
     << "\n";
  os << indent << "AzimuthRange: " << (this->AzimuthRange == HALF_TURN ? "pi" : "2 pi") << "\n";
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "CosineWeighted: " << (this->CosineWeighted ? "On" : "Off") << "\n";
  os << indent << "Precision: " << this->Precision << "\n";
  os << indent << "ResamplingError: " << this->ResamplingError << "\n";
  os << indent << "NumberOfInvalidCells: " << this->NumberOfInvalidCells << "\n";
}

//------------------------------------------------------------------------------
bool vtkTabulatedBRDF::SetVolume(
  int parameterization, int azimuthRange, const int dimensions[3], std::vector<float> rgb)
{
  std::size_t cells = 1;
  for (int a = 0; a < 3; ++a)
  {
    if (dimensions[a] < 1 || dimensions[a] > 2048)
    {
      vtkErrorMacro("SetVolume: found " << dimensions[a] << " samples along axis " << a
                                        << ", expected 1 to 2048; the volume stays.");
      return false;
    }
    cells *= static_cast<std::size_t>(dimensions[a]);
  }
  if (rgb.size() != 3 * cells || parameterization < HALF_DIFFERENCE ||
      parameterization > INCIDENT_OUTGOING || azimuthRange < HALF_TURN || azimuthRange > FULL_TURN)
  {
    vtkErrorMacro("SetVolume: found " << rgb.size() << " values, parameterization "
                                      << parameterization << " and azimuth range " << azimuthRange
                                      << ", expected " << 3 * cells
                                      << " values and 0 or 1 both; the volume stays.");
    return false;
  }
  this->Parameterization = parameterization;
  this->AzimuthRange = azimuthRange;
  std::copy_n(dimensions, 3, this->Dimensions);
  this->Volume = std::move(rgb);
  this->NumberOfInvalidCells = 0;
  for (std::size_t k = 0; k < this->Volume.size(); k += 3)
  {
    float* v = &this->Volume[k];
    if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2]))
    {
      v[0] = v[1] = v[2] = std::numeric_limits<float>::quiet_NaN();
      ++this->NumberOfInvalidCells;
    }
  }
  this->HalfVectorSampler.reset();
  this->WidenedLevels = std::make_shared<Levels>();
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
vtkImageData* vtkTabulatedBRDF::NewImageData()
{
  vtkImageData* image = vtkImageData::New();
  image->SetDimensions(this->Dimensions);
  vtkNew<vtkFloatArray> values;
  values->SetName("BRDF");
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(static_cast<vtkIdType>(this->Volume.size() / 3));
  std::copy(this->Volume.begin(), this->Volume.end(), values->GetPointer(0));
  image->GetPointData()->SetScalars(values);
  return image;
}

//------------------------------------------------------------------------------
bool vtkTabulatedBRDF::GetCellDirections(int parameterization, int azimuthRange,
  const int dimensions[3], int x, int y, int z, double i[3], double o[3])
{
  const double phi = (azimuthRange == HALF_TURN ? Pi : 2.0 * Pi) * (x + 0.5) / dimensions[0];
  const double second = 0.5 * Pi * (y + 0.5) / dimensions[1];
  glm::dvec3 light, view;
  if (parameterization == HALF_DIFFERENCE)
  {
    FromHalfDifference({ UnitToThetaH((z + 0.5) / dimensions[2]), second, phi }, light, view);
  }
  else
  {
    const double first = 0.5 * Pi * (z + 0.5) / dimensions[2];
    light = glm::dvec3(std::sin(first), 0.0, std::cos(first));
    view = glm::dvec3(
      std::sin(second) * std::cos(phi), std::sin(second) * std::sin(phi), std::cos(second));
  }
  std::copy_n(glm::value_ptr(light), 3, i);
  std::copy_n(glm::value_ptr(view), 3, o);
  return light.z > 0.0 && view.z > 0.0;
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  if (this->Volume.empty())
  {
    return;
  }
  const glm::dvec3 u =
    ToUnit(this->Parameterization, this->AzimuthRange, glm::make_vec3(i), glm::make_vec3(o));
  // The mirror-symmetric azimuth of incident/outgoing tables ends at 0 and pi, all others close.
  const bool periodic =
    this->Parameterization == HALF_DIFFERENCE || this->AzimuthRange == FULL_TURN;
  const VolumeCorners corners = { FindCorners(u.x, this->Dimensions[0], periodic),
    FindCorners(u.y, this->Dimensions[1], false), FindCorners(u.z, this->Dimensions[2], false) };
  DivideByValid(
    GatherCorners(this->Volume, this->Dimensions, corners), this->CosineWeighted ? o[2] : 1.0, f);
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::EvaluateLights(
  int count, const float* const i[3], const double o[3], float* const f[3])
{
  if (this->NumberOfInvalidCells > 0 || this->Volume.empty())
  {
    EvaluateLightsOneByOne(this, count, i, o, f);
    return;
  }
  const bool isHalfDifference = this->Parameterization == HALF_DIFFERENCE;
  const bool isHalfTurn = this->AzimuthRange == HALF_TURN;
  const float scale = this->CosineWeighted ? static_cast<float>(1.0 / o[2]) : 1.0f;
  struct State : LaneState
  {
    LaneDirections Half;
    AxisLanes Axes[3];
  };
  const auto findHalf = [&](State& s) MEASUREDBRDF_INLINED
  {
    Floats cosine;
    s.Half = FindHalf(s.Light, FillDirections(o), cosine);
  };
  const auto findPlaces = [&](State& s) MEASUREDBRDF_INLINED
  {
    Floats units[3];
    if (isHalfDifference)
    {
      FindHalfDifferenceInLanes(s.Light, s.Half, isHalfTurn, units);
    }
    else
    {
      FindIncidentOutgoingInLanes(s.Light, o, isHalfTurn, units);
    }
    for (int a = 0; a < 3; ++a)
    {
      const bool isPeriodic = a == 0 && (isHalfDifference || !isHalfTurn);
      s.Axes[a] = FindAxisLanes(units[a], this->Dimensions[a], isPeriodic);
    }
  };
  const auto interpolate = [&](State& s) MEASUREDBRDF_INLINED
  {
    Float4 colors[LaneCount];
    for (int k = 0; k < LaneCount; ++k)
    {
      colors[k] = scale * InterpolateInLanes(this->Volume, this->Dimensions, s.Axes, k);
    }
    Floats columns[4];
    Transpose(colors, columns);
    std::copy_n(columns, 3, s.Color);
  };
  EvaluateLanes<State>(count, i, f, findHalf, findPlaces, interpolate);
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::EvaluateSoftAbove(
  const double i[3], const double o[3], double spread, double f[3])
{
  const Levels* levels = this->GetLevels();
  if (!levels)
  {
    this->EvaluateAbove(i, o, f);
    return;
  }
  const glm::dvec3 light = glm::make_vec3(i);
  const glm::dvec3 view = glm::make_vec3(o);
  const glm::dvec3 u = ToUnit(this->Parameterization, this->AzimuthRange, light, view);
  const Neighbors around =
    levels->Values->FindLevels(HalfVectorSpread(spread, glm::dot(HalfVector(light, view), view)));
  const VolumeSum first =
    GatherLevel(*levels->Values, around.First, this->Volume, this->Dimensions, u);
  const VolumeSum second =
    GatherLevel(*levels->Values, around.Second, this->Volume, this->Dimensions, u);
  VolumeSum sum;
  for (int c = 0; c < 3; ++c)
  {
    sum.Values[c] = glm::mix(first.Values[c], second.Values[c], around.Weight);
  }
  sum.Valid = glm::mix(first.Valid, second.Valid, around.Weight);
  DivideByValid(sum, this->CosineWeighted ? o[2] : 1.0, f);
}

//------------------------------------------------------------------------------
const vtkTabulatedBRDF::Levels* vtkTabulatedBRDF::GetLevels()
{
  if (!this->WidenedLevels || this->Parameterization != HALF_DIFFERENCE)
  {
    return nullptr;
  }
  std::call_once(this->WidenedLevels->Made,
    [this]()
    {
      this->WidenedLevels->Values.emplace(
        std::array<int, 3>{ this->Dimensions[0], this->Dimensions[1], this->Dimensions[2] },
        this->AzimuthRange == HALF_TURN, this->Volume);
    });
  return this->WidenedLevels.get();
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::Prepare()
{
  if (this->HalfVectorSampler || this->Volume.empty())
  {
    return;
  }
  // Density of h from the table itself: mean over the difference angles.
  constexpr int nTheta = 90;
  this->HalfVectorSampler = std::make_unique<Sampler>(
    MeanOverDifferenceAngles(nTheta, 1,
      [this](const double i[3], const double o[3], double f[3]) { this->Evaluate(i, o, f); }),
    nTheta, 1, 0.5);
}

//------------------------------------------------------------------------------
bool vtkTabulatedBRDF::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  this->Prepare();
  if (!this->HalfVectorSampler)
  {
    return this->Superclass::SampleAbove(o, u1, u2, i);
  }
  glm::dvec3 direction;
  const bool above = this->HalfVectorSampler->Sample(glm::make_vec3(o), u1, u2, direction);
  std::copy_n(glm::value_ptr(direction), 3, i);
  return above;
}

//------------------------------------------------------------------------------
double vtkTabulatedBRDF::PdfAbove(const double i[3], const double o[3])
{
  this->Prepare();
  return this->HalfVectorSampler
           ? this->HalfVectorSampler->Pdf(glm::make_vec3(i), glm::make_vec3(o))
           : this->Superclass::PdfAbove(i, o);
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::GetBounds(double minimumCosine, double lower[3], double upper[3])
{
  // Interpolation never leaves the range of the samples. Where no cell is valid f is 0.
  const double divisor = this->CosineWeighted ? std::clamp(minimumCosine, 1e-6, 1.0) : 1.0;
  for (int c = 0; c < 3; ++c)
  {
    float low = this->NumberOfInvalidCells > 0 || this->Volume.empty()
                  ? 0.0f
                  : std::numeric_limits<float>::max();
    float high = 0.0f;
    for (std::size_t k = static_cast<std::size_t>(c); k < this->Volume.size(); k += 3)
    {
      if (!std::isnan(this->Volume[k]))
      {
        low = std::min(low, this->Volume[k]);
        high = std::max(high, this->Volume[k]);
      }
    }
    lower[c] = std::max(low, 0.0f);
    upper[c] = high / divisor;
  }
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  vtkBRDFShaderInputs::Term term;
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = "brdfVolume";
  texture.ThreeD = true;
  texture.Dimensions = { this->Dimensions[0], this->Dimensions[1], this->Dimensions[2] };
  texture.Components = this->NumberOfInvalidCells > 0 ? 4 : 3;
  const bool periodic =
    this->Parameterization == HALF_DIFFERENCE || this->AzimuthRange == FULL_TURN;
  texture.Repeat = { periodic, false, false };

  const TabulatedStorage storage =
    TabulatedStorage::Choose(this->Precision, this->ResamplingTolerance, this->Volume);
  FillTexture(texture, this->Volume, storage);

  const bool half = this->AzimuthRange == HALF_TURN;
  if (this->Parameterization == HALF_DIFFERENCE)
  {
    measuredbrdf::SetModuleShader(term, "vtkBRDFHalfDifference", vtkBRDFHalfDifference);
  }
  else
  {
    measuredbrdf::SetModuleShader(term, "vtkBRDFIncidentOutgoing", vtkBRDFIncidentOutgoing);
  }
  term.Uniforms.push_back({ "brdfScale", { 1.0f / storage.Scale } });
  term.Uniforms.push_back({ "brdfTurns", { half ? 2.0f : 1.0f } });
  term.Uniforms.push_back({ "brdfCosineWeighted", { this->CosineWeighted ? 1.0f : 0.0f } });
  TextStream text;
  text << (this->Parameterization == HALF_DIFFERENCE ? "half/difference" : "incident/outgoing")
       << " volume " << this->Dimensions[0] << " x " << this->Dimensions[1] << " x "
       << this->Dimensions[2] << ", " << storage.GetText() << ", " << texture.GetBytes()
       << " bytes";
  if (this->ResamplingError > 0.0)
  {
    text << ", resampling error " << this->ResamplingError;
  }
  const Levels* levels = form.SoftLights ? this->GetLevels() : nullptr;
  term.Fetches = levels ? 2 : 1;
  if (levels)
  {
    vtkBRDFShaderInputs::Texture wider;
    wider.Name = "brdfLevels";
    wider.ThreeD = true;
    wider.Dimensions = levels->Values->GetDimensions();
    wider.Components = texture.Components;
    wider.Repeat = texture.Repeat;
    FillTexture(wider, levels->Values->GetVolume(), storage);
    term.SoftSource = vtkBRDFHalfDifferenceSoft;
    term.Uniforms.push_back(
      { "brdfNumberOfLevels", { static_cast<float>(levels->Values->GetNumberOfLevels()) } });
    term.Uniforms.push_back(
      { "brdfFirstCount", { static_cast<float>(levels->Values->GetFirstCount()) } });
    term.Uniforms.push_back(
      { "brdfOwnVariance", { static_cast<float>(levels->Values->GetOwnVariance()) } });
    text << ", wider for soft lights: " << levels->Values->GetNumberOfLevels() << " levels, "
         << wider.GetBytes() << " bytes";
    term.Textures.push_back(std::move(wider));
  }
  term.Textures.insert(term.Textures.begin(), std::move(texture));
  form.QuantizationError = std::max(form.QuantizationError, storage.GetRounding());
  form.ResamplingError = std::max(form.ResamplingError, this->ResamplingError);
  form.Description = text.str();
  form.Terms.push_back(std::move(term));
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  exchange.Option("precision", { "automatic", "float16", "float32", "shared-exponent" },
    this->Precision, [this](int value) { this->SetPrecision(value); });
  exchange.Option("cosineWeighted", { "off", "on" }, this->CosineWeighted,
    [this](int value) { this->SetCosineWeighted(value == 1); });
  exchange.Number("resamplingError", this->ResamplingError,
    [this](double value) { this->SetResamplingError(value); });
  int parameterization = this->Parameterization;
  int azimuthRange = this->AzimuthRange;
  exchange.Option("parameterization", { "half-difference", "incident-outgoing" }, parameterization,
    [&](int value) { parameterization = value; });
  exchange.Option("azimuthRange", { "half-turn", "full-turn" }, azimuthRange,
    [&](int value) { azimuthRange = value; });
  if (!exchange.IsLoading())
  {
    exchange.SaveArray(
      "volume", { this->Dimensions[2], this->Dimensions[1], this->Dimensions[0] }, 3, this->Volume);
    return;
  }
  auto volume = exchange.LoadArray("volume", 3, 3);
  const int dimensions[3] = { volume.Shape[2], volume.Shape[1], volume.Shape[0] };
  if (!this->SetVolume(parameterization, azimuthRange, dimensions, std::move(volume.Values)))
  {
    exchange.Fail("array 'volume' was refused");
  }
}

//------------------------------------------------------------------------------
vtkBRDF* vtkTabulatedBRDF::NewCopy()
{
  vtkTabulatedBRDF* copy = vtkTabulatedBRDF::New();
  copy->Parameterization = this->Parameterization;
  copy->AzimuthRange = this->AzimuthRange;
  std::copy_n(this->Dimensions, 3, copy->Dimensions);
  copy->Precision = this->Precision;
  copy->CosineWeighted = this->CosineWeighted;
  copy->ResamplingError = this->ResamplingError;
  copy->Volume = this->Volume;
  copy->NumberOfInvalidCells = this->NumberOfInvalidCells;
  copy->WidenedLevels = this->WidenedLevels;
  return copy;
}

//------------------------------------------------------------------------------
std::pair<std::type_index, std::string> vtkTabulatedBRDF::GetContent()
{
  measuredbrdf::ContentHash hash;
  hash.AddValue(this->Parameterization);
  hash.AddValue(this->AzimuthRange);
  hash.Add(this->Dimensions, sizeof(this->Dimensions));
  hash.AddValue(this->Precision);
  hash.AddValue(this->CosineWeighted);
  hash.AddValue(this->ResamplingError);
  hash.AddValues(this->Volume);
  return { typeid(vtkTabulatedBRDF), hash.GetText() };
}
