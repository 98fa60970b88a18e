// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBasisRadianceIntegrator.h"

#include "AzimuthalBasis.h"
#include "CosinePowerWarp.h"
#include "LightSplatter.h"
#include "LocalFrame.h"
#include "ModuleShader.h"
#include "NumberText.h"
#include "ParallelFor.h"
#include "PixelCosts.h"
#include "RadialFunctions.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkBRDFEnvironmentBasis.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBasisBRDF.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkVarianceLightSetGenerator.h"

#include <Eigen/Core>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBasisRadianceIntegrator);

namespace
{
constexpr int ViewColumns = ViewNodes + 2;

// The normal at a texel of a chart (false beyond the part that look-ups reach) and its frame, which
// goes on smoothly past the rim.
bool GetChartFrame(int chart, int side, int x, int y, Frame& frame)
{
  const double scale = 2.0 / (side - 2);
  const double p = (x + 0.5 - 0.5 * side) * scale;
  const double q = (y + 0.5 - 0.5 * side) * scale;
  const double r2 = p * p + q * q;
  const double reach = 1.0 + 1.5 * scale;
  if (r2 > reach * reach)
  {
    return false;
  }
  const double s = chart == 0 ? 1.0 : -1.0;
  const double l = std::sqrt(2.0 - r2);
  frame = FrameAbout(glm::dvec3(p * l, q * l, s * (1.0 - r2)), s);
  return true;
}
} // namespace

//------------------------------------------------------------------------------
// What GLSL and IntegratePart read.
struct vtkBasisRadianceIntegrator::Tables
{
  std::vector<Radial> Radials; // orders ascending
  int NumberOfFunctions = 0;
  double TruncationError = 0.0;
  int Side = 0;
  int Rows = 0;             // of Views
  std::vector<float> Maps;  // 2 Side x Side NumberOfFunctions RGB
  std::vector<float> Views; // ViewColumns x Rows RGB

  void MakeViews()
  {
    this->NumberOfFunctions = 0;
    for (const Radial& radial : this->Radials)
    {
      this->NumberOfFunctions += radial.Order > 0 ? 2 : 1;
      this->AddViews(radial.Order, 0.0f, radial.Cosine);
      if (!radial.Sine.empty())
      {
        this->AddViews(radial.Order, 1.0f, radial.Sine);
      }
    }
  }

  glm::dvec3 FetchMap(int function, const double texel[2], int chart) const
  {
    const int x = static_cast<int>(texel[0]);
    const int y = static_cast<int>(texel[1]);
    const std::size_t stride = 6 * static_cast<std::size_t>(this->Side);
    const float* p = &this->Maps[static_cast<std::size_t>(function * this->Side + y) * stride +
                                 3 * static_cast<std::size_t>(chart * this->Side + x)];
    const auto inRow = [&](const float* row)
    {
      return glm::mix(
        glm::dvec3(glm::make_vec3(row)), glm::dvec3(glm::make_vec3(row + 3)), texel[0] - x);
    };
    return glm::mix(inRow(p), inRow(p + stride), texel[1] - y);
  }

private:
  void AddViews(int order, float kind, const std::vector<glm::dvec3>& views)
  {
    this->Views.insert(this->Views.end(), { static_cast<float>(order), kind, 0.0f });
    const auto add = [this](const glm::dvec3& rgb)
    {
      for (int c = 0; c < 3; ++c)
      {
        this->Views.push_back(static_cast<float>(rgb[c]));
      }
    };
    add(order % 2 == 0 ? views[0] : -views[0]);
    for (const glm::dvec3& rgb : views)
    {
      add(rgb);
    }
    ++this->Rows;
  }
};

//------------------------------------------------------------------------------
vtkBasisRadianceIntegrator::vtkBasisRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkBasisRadianceIntegrator::~vtkBasisRadianceIntegrator() = default;

//------------------------------------------------------------------------------
int vtkBasisRadianceIntegrator::GetNumberOfTerms()
{
  return this->Current ? this->Current->NumberOfFunctions : 0;
}

//------------------------------------------------------------------------------
double vtkBasisRadianceIntegrator::GetTruncationError()
{
  return this->Current ? this->Current->TruncationError : 0.0;
}

//------------------------------------------------------------------------------
bool vtkBasisRadianceIntegrator::Begin()
{
  if (!this->Environment || this->Environment->GetPixels().empty())
  {
    vtkErrorMacro("Prepare: there is no environment, or it is empty.");
    return false;
  }
  if (!this->BRDF->IsIsotropic())
  {
    vtkErrorMacro("Prepare: basis pre-integration needs an isotropic BRDF; this "
                  << this->BRDF->GetClassName() << " is anisotropic.");
    return false;
  }
  this->Abort = false;
  auto tables = std::make_unique<Tables>();
  if (!this->MakeTerms(*tables) || !this->MakeMaps(*tables))
  {
    vtkErrorMacro("Prepare: aborted.");
    return false;
  }
  this->Current = std::move(tables);
  return true;
}

//------------------------------------------------------------------------------
bool vtkBasisRadianceIntegrator::MakeTerms(Tables& tables)
{
  vtkBasisBRDF* own = vtkBasisBRDF::SafeDownCast(this->BRDF);
  if (this->UseOwnBasis && own && !own->GetCoefficients().empty())
  {
    tables.Radials = GetOwnBasis(own);
  }
  else
  {
    AzimuthalBasis basis;
    // A sine part that is a tenth of what may be left out is not worth its look-ups.
    if (!basis.Compute(this->BRDF, 0.1 * this->Tolerance,
          [this](double share) { return this->Report(0.5 * share); }))
    {
      return false;
    }
    const int count = basis.FindNumberOfTerms(this->Tolerance, this->MaximumNumberOfTerms);
    tables.TruncationError = basis.GetTruncationError(count);
    for (int k = 0; k < count; ++k)
    {
      tables.Radials.push_back(ToRadial(basis.GetTerms()[static_cast<std::size_t>(k)]));
    }
    std::stable_sort(tables.Radials.begin(), tables.Radials.end(),
      [](const Radial& a, const Radial& b) { return a.Order < b.Order; });
  }
  if (tables.Radials.empty()) // a black material
  {
    tables.Radials.push_back(
      { 0, Eigen::VectorXf::Zero(IncidentNodes), std::vector<glm::dvec3>(ViewNodes), {} });
  }
  tables.MakeViews();
  return true;
}

//------------------------------------------------------------------------------
bool vtkBasisRadianceIntegrator::MakeMaps(Tables& tables)
{
  const int side = this->MapSize;
  tables.Side = side;
  const std::size_t rowSize = 6 * static_cast<std::size_t>(side);
  tables.Maps.assign(rowSize * static_cast<std::size_t>(side * tables.NumberOfFunctions), 0.0f);
  vtkNew<vtkVarianceLightSetGenerator> generator;
  vtkNew<vtkLightSet> set;
  if (!generator->Generate(this->Environment, this->NumberOfClusters, set))
  {
    return false;
  }
  std::vector<MapLight> lights(static_cast<std::size_t>(set->GetNumberOfLights()));
  for (int k = 0; k < set->GetNumberOfLights(); ++k)
  {
    MapLight& light = lights[static_cast<std::size_t>(k)];
    set->GetDirection(k, &light.Direction.x);
    set->GetIrradiance(k, &light.Irradiance.x);
  }
  const auto makeRow = [&](int y)
  {
    LightSplatter splatter(tables.Radials.back().Order + 1);
    for (int column = 0; column < 2 * side; ++column)
    {
      Frame frame;
      if (!GetChartFrame(column / side, side, column % side, y, frame))
      {
        continue;
      }
      splatter.Gather(lights, frame);
      float* texel =
        &tables.Maps[static_cast<std::size_t>(y) * rowSize + 3 * static_cast<std::size_t>(column)];
      for (const Radial& radial : tables.Radials)
      {
        const Eigen::Matrix<float, 6, 1> e = splatter.Contract(radial);
        for (int part = 0; part < (radial.Order > 0 ? 2 : 1); ++part)
        {
          std::copy_n(e.data() + 3 * part, 3, texel);
          texel += rowSize * static_cast<std::size_t>(side);
        }
      }
    }
  };
  constexpr int stride = 8;
  for (int first = 0; first < side; first += stride)
  {
    const int last = std::min(first + stride, side);
    measuredbrdf::ParallelFor(first, last, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType y = begin; y < end; ++y)
        {
          makeRow(static_cast<int>(y));
        }
      });
    if (!this->Report(0.5 + 0.5 * last / side))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkBasisRadianceIntegrator::IntegratePart(int vtkNotUsed(part), const double n[3],
  const double o[3], const double vtkNotUsed(t)[3], double radiance[3])
{
  const Tables& tables = *this->Current;
  const Frame frame = FrameAbout(glm::make_vec3(n));
  const glm::dvec3 view = LiftView(ToLocal(frame, glm::make_vec3(o)));
  const double l = std::hypot(view.x, view.y);
  const glm::dvec2 turn = l > 1e-6 ? glm::dvec2(view) / l : glm::dvec2(1.0, 0.0);

  const int chart = n[2] >= 0.0 ? 0 : 1;
  const double scale = (0.5 * tables.Side - 1.0) / std::sqrt(1.0 + std::abs(n[2]));
  const double texel[2] = { n[0] * scale + 0.5 * tables.Side - 0.5,
    n[1] * scale + 0.5 * tables.Side - 0.5 };
  const double column = CosineToWarp(view.z, MinimumViewCosine) * ViewNodes + 1.5;
  const int first = std::min(static_cast<int>(column), ViewColumns - 1);
  const int second = std::min(first + 1, ViewColumns - 1);
  const double weight = column - first;

  glm::dvec3 sum(0.0), even(0.0), odd(0.0);
  glm::dvec2 angle(1.0, 0.0);
  int m = 0;
  int function = 0;
  for (int row = 0; row < tables.Rows; ++row)
  {
    const float* views = &tables.Views[3 * static_cast<std::size_t>(row * ViewColumns)];
    for (; m < static_cast<int>(views[0]); ++m)
    {
      angle = glm::dvec2(angle.x * turn.x - angle.y * turn.y, angle.x * turn.y + angle.y * turn.x);
    }
    const glm::dvec3 u = (1.0 - weight) * glm::dvec3(glm::make_vec3(views + 3 * first)) +
                         weight * glm::dvec3(glm::make_vec3(views + 3 * second));
    if (views[1] > 0.5f)
    {
      sum += u * odd;
      continue;
    }
    even = tables.FetchMap(function++, texel, chart);
    if (views[0] > 0.5f)
    {
      const glm::dvec3 sine = tables.FetchMap(function++, texel, chart);
      odd = sine * angle.x - even * angle.y;
      even = even * angle.x + sine * angle.y;
    }
    sum += u * even;
  }
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] += std::max(sum[c], 0.0);
  }
}

//------------------------------------------------------------------------------
bool vtkBasisRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  if (!this->Prepare())
  {
    return false;
  }
  const Tables& tables = *this->Current;
  vtkBRDFShaderInputs::Texture maps;
  maps.Name = "brdfMaps";
  maps.Dimensions = { 2 * tables.Side, tables.Side * tables.NumberOfFunctions, 1 };
  maps.Data = tables.Maps;
  vtkBRDFShaderInputs::Texture views;
  views.Name = "brdfViews";
  views.Dimensions = { ViewColumns, tables.Rows, 1 };
  views.Data = tables.Views;
  TextStream text;
  text << tables.NumberOfFunctions << " pre-integrated functions, " << tables.Side << " x "
       << tables.Side << " normals a half, truncation " << 100.0 * tables.TruncationError << " %";
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFEnvironmentBasis", vtkBRDFEnvironmentBasis);
  // A row's head and weight, and a map; a map of the cosine and one of the sine are of two rows.
  term.Fetches = 3 * tables.Rows;
  term.Textures = { std::move(maps), std::move(views) };
  form = vtkBRDFShaderInputs();
  form.Description = text.str();
  form.ResamplingError = tables.TruncationError;
  form.QuantizationError = 0x1p-23;
  form.Terms.push_back(std::move(term));
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBasisRadianceIntegrator, Tolerance, double, 1e-4, 1.0);
measuredbrdfSetClampedMacro(vtkBasisRadianceIntegrator, MaximumNumberOfTerms, int, 1, 256);
measuredbrdfSetClampedMacro(vtkBasisRadianceIntegrator, MapSize, int, 8, 128);
measuredbrdfSetClampedMacro(vtkBasisRadianceIntegrator, NumberOfClusters, int, 64, 1048576);

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkBasisRadianceIntegrator::GetSizes()
{
  return { { "functions", 1, 256, this->MaximumNumberOfTerms },
    { "map size", 8, 128, this->MapSize } };
}

//------------------------------------------------------------------------------
std::string vtkBasisRadianceIntegrator::GetSizesText()
{
  return "at most " + std::to_string(this->MaximumNumberOfTerms) + " functions";
}

//------------------------------------------------------------------------------
void vtkBasisRadianceIntegrator::SetSize(int index, int value)
{
  if (index == 0)
  {
    this->SetMaximumNumberOfTerms(value);
  }
  else
  {
    this->SetMapSize(value);
  }
}

//------------------------------------------------------------------------------
void vtkBasisRadianceIntegrator::CopyProperties(vtkRadianceIntegrator* source)
{
  this->Superclass::CopyProperties(source);
  if (auto* basis = vtkBasisRadianceIntegrator::SafeDownCast(source))
  {
    this->SetTolerance(basis->Tolerance);
    this->SetNumberOfClusters(basis->NumberOfClusters);
    this->SetUseOwnBasis(basis->UseOwnBasis);
  }
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> vtkBasisRadianceIntegrator::GetCandidateSizes(bool all)
{
  return all && this->BRDF->IsIsotropic() ? std::vector<std::vector<int>>{ { 9 }, { 25 }, { 64 } }
                                          : std::vector<std::vector<int>>();
}

//------------------------------------------------------------------------------
double vtkBasisRadianceIntegrator::EstimateCost()
{
  const int prepared = this->GetNumberOfTerms();
  return PixelCosts::Pixel +
         PixelCosts::Function * (prepared > 0 ? prepared : this->MaximumNumberOfTerms);
}

//------------------------------------------------------------------------------
vtkIdType vtkBasisRadianceIntegrator::EstimateTextureBytes()
{
  const vtkIdType side = this->MapSize;
  return 12 * 2 * side * side * this->MaximumNumberOfTerms;
}

//------------------------------------------------------------------------------
void vtkBasisRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfTerms: " << this->MaximumNumberOfTerms << "\n";
  os << indent << "MapSize: " << this->MapSize << "\n";
  os << indent << "NumberOfClusters: " << this->NumberOfClusters << "\n";
  os << indent << "UseOwnBasis: " << (this->UseOwnBasis ? "On" : "Off") << "\n";
  os << indent << "NumberOfTerms: " << this->GetNumberOfTerms() << "\n";
  os << indent << "TruncationError: " << this->GetTruncationError() << "\n";
}
