// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFAnalysis.h"

#include "HalfVector.h"
#include "LocalFrame.h"
#include "Setters.h"
#include "vtkBasisBRDF.h"
#include "vtkObjectFactory.h"
#include "vtkTabulatedBRDF.h"

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtc/type_ptr.hpp>
#include <glm/gtx/component_wise.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace measuredbrdf;

namespace
{
// One row of a table, zeros outside it.
void CopyRow(const std::vector<std::array<double, 3>>& table, int index, double rgb[3])
{
  std::fill_n(rgb, 3, 0.0);
  if (index >= 0 && static_cast<std::size_t>(index) < table.size())
  {
    std::copy_n(table[static_cast<std::size_t>(index)].begin(), 3, rgb);
  }
}
} // namespace

vtkStandardNewMacro(vtkBRDFAnalysis);

//------------------------------------------------------------------------------
vtkBRDFAnalysis::vtkBRDFAnalysis()
  : Angles({ 0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0 })
{
}

//------------------------------------------------------------------------------
vtkBRDFAnalysis::~vtkBRDFAnalysis() = default;

//------------------------------------------------------------------------------
vtkCxxSetSmartPointerMacro(vtkBRDFAnalysis, BRDF, vtkBRDF);

//------------------------------------------------------------------------------
void vtkBRDFAnalysis::SetAngles(int count, const double* degrees)
{
  if (count < 0 ||
      !std::all_of(degrees, degrees + count, [](double a) { return a >= 0.0 && a < 90.0; }))
  {
    vtkErrorMacro("SetAngles: angles must be in [0,90) degrees.");
    return;
  }
  this->Angles.assign(degrees, degrees + count);
  this->Albedos.clear();
  this->Reflectances.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
double vtkBRDFAnalysis::GetAngle(int index)
{
  return index >= 0 && index < this->GetNumberOfAngles()
           ? this->Angles[static_cast<std::size_t>(index)]
           : 0.0;
}

//------------------------------------------------------------------------------
void vtkBRDFAnalysis::GetAlbedo(int index, double rgb[3]) { CopyRow(this->Albedos, index, rgb); }

//------------------------------------------------------------------------------
void vtkBRDFAnalysis::GetReflectance(int index, double rgb[3])
{
  CopyRow(this->Reflectances, index, rgb);
}

//------------------------------------------------------------------------------
bool vtkBRDFAnalysis::Update()
{
  if (!this->BRDF)
  {
    vtkErrorMacro("Update: there is no BRDF.");
    return false;
  }
  this->BRDF->Prepare();
  this->UpdateAlbedos();
  this->UpdatePairs();
  this->UpdateNegativeMass();
  return true;
}

//------------------------------------------------------------------------------
void vtkBRDFAnalysis::UpdateAlbedos()
{
  const int azimuths = this->BRDF->IsIsotropic() ? 1 : 8;
  this->Albedos.clear();
  this->Reflectances.clear();
  glm::dvec3 largestAlbedo(0.0), largestReflectance(0.0);
  for (const double angle : this->Angles)
  {
    glm::dvec3 albedos(0.0), reflectances(0.0);
    for (int k = 0; k < azimuths; ++k)
    {
      const glm::dvec3 d = ToDirection(std::cos(ToRadians(angle)), 2.0 * Pi * k / azimuths);
      glm::dvec3 albedo, reflectance;
      this->BRDF->GetDirectionalAlbedo(&d.x, &albedo.x);
      this->BRDF->GetDirectionalReflectance(&d.x, &reflectance.x);
      albedos += albedo / static_cast<double>(azimuths);
      reflectances += reflectance / static_cast<double>(azimuths);
      largestAlbedo = glm::max(largestAlbedo, albedo);
      largestReflectance = glm::max(largestReflectance, reflectance);
    }
    this->Albedos.push_back({ albedos.x, albedos.y, albedos.z });
    this->Reflectances.push_back({ reflectances.x, reflectances.y, reflectances.z });
  }
  this->LargestAlbedo = glm::compMax(glm::max(largestAlbedo, largestReflectance));
  this->GainsEnergy = glm::compMax(largestReflectance) > 1.005;
}

//------------------------------------------------------------------------------
void vtkBRDFAnalysis::UpdatePairs()
{
  glm::dvec3 least(std::numeric_limits<double>::infinity()), largest(0.0);
  double difference = 0.0;
  double sum = 0.0;
  double squaredDifference = 0.0;
  double squaredSum = 0.0;
  // The engine's bits are fixed by the standard; its distributions are not.
  std::mt19937 engine(1);
  const auto random = [&engine]() { return static_cast<double>(engine()) * 0x1p-32; };
  for (int k = 0; k < this->NumberOfPairs; ++k)
  {
    glm::dvec3 o, i, f, swapped;
    double u[4];
    std::generate_n(u, 4, random);
    SampleCosine(u[0], u[1], &o.x);
    if (k % 2 == 0)
    {
      SampleCosine(u[2], u[3], &i.x);
    }
    else if (!this->BRDF->Sample(&o.x, u[2], u[3], &i.x))
    {
      continue; // below the horizon: weight 0
    }
    const double cosine = i.z / Pi;
    const double weight = cosine / (0.5 * (cosine + this->BRDF->Pdf(&i.x, &o.x)));
    this->BRDF->Evaluate(&i.x, &o.x, &f.x);
    this->BRDF->Evaluate(&o.x, &i.x, &swapped.x);
    least = glm::min(least, f);
    largest = glm::max(largest, f);
    const glm::dvec3 d = f - swapped;
    difference += weight * glm::compAdd(glm::abs(d));
    sum += weight * glm::compAdd(f);
    squaredDifference += weight * glm::dot(d, d);
    squaredSum += weight * glm::dot(f, f);
  }
  std::copy_n(&least.x, 3, this->Minimum);
  std::copy_n(&largest.x, 3, this->Maximum);
  this->ReciprocityError = sum > 0.0 ? difference / sum : 0.0;
  this->ReciprocityRMSError = squaredSum > 0.0 ? std::sqrt(squaredDifference / squaredSum) : 0.0;
}

//------------------------------------------------------------------------------
void vtkBRDFAnalysis::UpdateNegativeMass()
{
  this->NegativeMass = 0.0;
  if (auto* table = vtkTabulatedBRDF::SafeDownCast(this->BRDF))
  {
    this->NegativeMass = this->GetTableNegativeMass(table);
  }
  else if (auto* basis = vtkBasisBRDF::SafeDownCast(this->BRDF))
  {
    const double hemisphere[2] = { 0.0, 90.0 };
    this->NegativeMass = basis->GetNegativeMass(hemisphere, hemisphere, this->NumberOfPairs);
  }
}

//------------------------------------------------------------------------------
double vtkBRDFAnalysis::GetTableNegativeMass(vtkTabulatedBRDF* table)
{
  if (table->GetVolume().empty() || !table->IsIsotropic())
  {
    return 0.0;
  }
  const int* size = table->GetDimensions();
  const int parameterization = table->GetParameterization();
  glm::dvec3 negative(0.0), total(0.0);
  for (int cell = 0; cell < size[0] * size[1] * size[2]; ++cell)
  {
    const int x = cell % size[0], y = cell / size[0] % size[1], z = cell / size[0] / size[1];
    const glm::dvec3 value(glm::make_vec3(&table->GetVolume()[3 * static_cast<std::size_t>(cell)]));
    glm::dvec3 i, o;
    if (!vtkTabulatedBRDF::GetCellDirections(
          parameterization, table->GetAzimuthRange(), size, x, y, z, &i.x, &o.x) ||
        !std::isfinite(glm::compAdd(value)))
    {
      continue;
    }
    // di do = 4 cos(theta_d) dh dd (Rusinkiewicz 1998), theta_h on a quadratic axis; or the plain
    // solid angles. Factors common to all cells are left out.
    double weight = i.z * o.z;
    if (parameterization == vtkTabulatedBRDF::HALF_DIFFERENCE)
    {
      const double axis = (z + 0.5) / size[2];
      const double thetaD = 0.5 * Pi * (y + 0.5) / size[1];
      weight *= std::cos(thetaD) * std::sin(thetaD) * std::sin(UnitToThetaH(axis)) * axis;
    }
    else
    {
      weight *= std::sqrt((1.0 - i.z * i.z) * (1.0 - o.z * o.z));
    }
    total += weight * glm::abs(value);
    negative += weight * glm::max(-value, 0.0);
  }
  const double all = glm::compAdd(total);
  return all > 0.0 ? glm::compAdd(negative) / all : 0.0;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBRDFAnalysis, NumberOfPairs, int, 100, 100000000);

//------------------------------------------------------------------------------
void vtkBRDFAnalysis::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "NumberOfPairs: " << this->NumberOfPairs << "\n";
  for (int k = 0; k < this->GetNumberOfAngles(); ++k)
  {
    double rgb[3];
    this->GetAlbedo(k, rgb);
    os << indent << "Albedo at " << this->GetAngle(k) << " degrees: " << rgb[0] << " " << rgb[1]
       << " " << rgb[2];
    this->GetReflectance(k, rgb);
    os << ", reflectance: " << rgb[0] << " " << rgb[1] << " " << rgb[2] << "\n";
  }
  os << indent << "LargestAlbedo: " << this->LargestAlbedo << "\n";
  os << indent << "GainsEnergy: " << this->GainsEnergy << "\n";
  os << indent << "ReciprocityError: " << this->ReciprocityError << "\n";
  os << indent << "ReciprocityRMSError: " << this->ReciprocityRMSError << "\n";
  os << indent << "Minimum: " << this->Minimum[0] << " " << this->Minimum[1] << " "
     << this->Minimum[2] << "\n";
  os << indent << "Maximum: " << this->Maximum[0] << " " << this->Maximum[1] << " "
     << this->Maximum[2] << "\n";
  os << indent << "NegativeMass: " << this->NegativeMass << "\n";
}
