// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFFailureMap.h"

#include "HalfVector.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h" // for GoldenRatio
#include "ParallelFor.h"
#include "Setters.h"

#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/component_wise.hpp>
#include <glm/gtx/rotate_vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBRDFFailureMap);

namespace
{
constexpr std::size_t LargestNumberOfWorst = 5;
constexpr double WorstDistance = 10.0; // degrees

//------------------------------------------------------------------------------
// Sums over the azimuths of a cell and over channels.
struct Cell
{
  double Difference = 0.0;
  double Reference = 0.0;
  double Largest = -1.0; // difference at one azimuth
  double Azimuth = 0.0;  // of that, in degrees

  double GetError() const
  {
    return this->Reference > 0.0 ? this->Difference / this->Reference
                                 : std::numeric_limits<double>::quiet_NaN();
  }
};

//------------------------------------------------------------------------------
// Compares both at all azimuths of a cell: getPair(azimuth, i, o) gives its pairs, those below the
// horizon, too. Where a BRDF is anisotropic, each pair is turned about the normal.
template <typename GetPair>
Cell CompareCell(vtkBRDF* reference, vtkBRDF* brdf, int azimuths, const GetPair& getPair)
{
  const bool isotropic = reference->IsIsotropic() && brdf->IsIsotropic();
  Cell cell;
  for (int k = 0; k < azimuths; ++k)
  {
    glm::dvec3 i, o, r, f;
    getPair(2.0 * Pi * k / azimuths, i, o);
    if (std::min(i.z, o.z) < MinimumViewCosine - 1e-9)
    {
      continue;
    }
    if (!isotropic)
    {
      const double turn = 2.0 * Pi * std::fmod(k * measuredbrdf::GoldenRatio, 1.0);
      i = glm::rotateZ(i, turn);
      o = glm::rotateZ(o, turn);
    }
    reference->Evaluate(&i.x, &o.x, &r.x);
    brdf->Evaluate(&i.x, &o.x, &f.x);
    const double difference = glm::compAdd(glm::abs(f - r));
    cell.Reference += glm::compAdd(r);
    cell.Difference += difference;
    if (difference > cell.Largest)
    {
      cell.Largest = difference;
      cell.Azimuth = 360.0 * k / azimuths;
    }
  }
  return cell;
}

//------------------------------------------------------------------------------
void FillImage(vtkImageData* image, const std::vector<Cell>& cells, int count, double width)
{
  const double spacing[2] = { width / count, 90.0 / count };
  vtkNew<vtkDoubleArray> errors;
  errors->SetName("Error");
  for (const Cell& cell : cells)
  {
    errors->InsertNextValue(cell.GetError());
  }
  image->SetDimensions(count, count, 1);
  image->SetSpacing(spacing[0], spacing[1], 1.0);
  image->SetOrigin(0.5 * spacing[0], 0.5 * spacing[1], 0.0);
  image->GetPointData()->SetScalars(errors);
}

//------------------------------------------------------------------------------
// Angles of a cell, in degrees.
glm::dvec2 GetAngles(std::size_t cell, int count)
{
  return 90.0 / count * (glm::dvec2(cell % count, cell / count) + 0.5);
}

//------------------------------------------------------------------------------
std::vector<std::array<double, 4>> FindWorst(const std::vector<Cell>& cells, int count)
{
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0);
  order.erase(std::remove_if(order.begin(), order.end(),
                [&](std::size_t k) { return !(cells[k].GetError() > 0.0); }),
    order.end());
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return cells[a].GetError() > cells[b].GetError(); });
  std::vector<std::array<double, 4>> worst;
  for (const std::size_t k : order)
  {
    const glm::dvec2 angles = GetAngles(k, count);
    const bool isNew = std::none_of(worst.begin(), worst.end(),
      [&](const std::array<double, 4>& other)
      { return glm::distance(glm::dvec2(other[0], other[1]), angles) < WorstDistance; });
    if (isNew && worst.size() < LargestNumberOfWorst)
    {
      worst.push_back({ angles.x, angles.y, cells[k].Azimuth, cells[k].GetError() });
    }
  }
  return worst;
}

//------------------------------------------------------------------------------
double GetWeightedError(const std::vector<Cell>& cells, int count)
{
  Cell sum;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    // cos sin of both angles, up to a factor.
    const double weight = glm::compMul(glm::sin(2.0 * glm::radians(GetAngles(k, count))));
    sum.Difference += weight * cells[k].Difference;
    sum.Reference += weight * cells[k].Reference;
  }
  return sum.GetError();
}
}

//------------------------------------------------------------------------------
vtkBRDFFailureMap::vtkBRDFFailureMap() = default;

//------------------------------------------------------------------------------
vtkBRDFFailureMap::~vtkBRDFFailureMap() = default;

//------------------------------------------------------------------------------
vtkCxxSetSmartPointerMacro(vtkBRDFFailureMap, Reference, vtkBRDF);
vtkCxxSetSmartPointerMacro(vtkBRDFFailureMap, BRDF, vtkBRDF);

//------------------------------------------------------------------------------
bool vtkBRDFFailureMap::Update()
{
  if (!this->Reference || !this->BRDF)
  {
    vtkErrorMacro("Update: there is no " << (this->Reference ? "BRDF." : "reference."));
    return false;
  }
  this->Abort = false;
  this->Reference->Prepare();
  this->BRDF->Prepare();
  const int count = this->NumberOfCells;
  const auto compare = [this](const auto& getPair)
  { return CompareCell(this->Reference, this->BRDF, this->NumberOfAzimuths, getPair); };
  const double step = 0.5 * Pi / count;
  const double steepest = std::acos(MinimumViewCosine);
  std::vector<Cell> incidentOutgoing(static_cast<std::size_t>(count) * count);
  std::vector<Cell> halfDifference(incidentOutgoing.size());
  // Rows by a few, so that the calling thread can tell of them.
  constexpr int group = 4;
  for (int first = 0; first < count; first += group)
  {
    measuredbrdf::ParallelFor(static_cast<vtkIdType>(first) * count,
      static_cast<vtkIdType>(std::min(first + group, count)) * count,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end; ++k)
        {
          const double x = static_cast<double>(k % count) + 0.5;
          const double y = static_cast<double>(k / count) + 0.5;
          const double thetaI = std::min(x * step, steepest);
          const double thetaO = std::min(y * step, steepest);
          incidentOutgoing[k] = compare(
            [&](double phi, glm::dvec3& i, glm::dvec3& o)
            {
              i = ToDirection(std::cos(thetaI), phi);
              o = ToDirection(std::cos(thetaO), 0.0);
            });
          halfDifference[k] = compare(
            [&](double phi, glm::dvec3& i, glm::dvec3& o) {
              FromHalfDifference({ UnitToThetaH(x / count), y * step, phi }, i, o);
            });
        }
      });
    double progress = std::min(1.0, static_cast<double>(first + group) / count);
    this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
    if (this->Abort)
    {
      vtkErrorMacro("Update: aborted.");
      return false;
    }
  }
  FillImage(this->IncidentOutgoing, incidentOutgoing, count, 90.0);
  FillImage(this->HalfDifference, halfDifference, count, 1.0);
  this->Worst = FindWorst(incidentOutgoing, count);
  this->RelativeL1 = GetWeightedError(incidentOutgoing, count);
  return true;
}

//------------------------------------------------------------------------------
void vtkBRDFFailureMap::GetWorstAngles(int index, double angles[3])
{
  std::fill_n(angles, 3, 0.0);
  if (index >= 0 && index < this->GetNumberOfWorstAngles())
  {
    std::copy_n(this->Worst[static_cast<std::size_t>(index)].begin(), 3, angles);
  }
}

//------------------------------------------------------------------------------
double vtkBRDFFailureMap::GetWorstError(int index)
{
  return index >= 0 && index < this->GetNumberOfWorstAngles()
           ? this->Worst[static_cast<std::size_t>(index)][3]
           : 0.0;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBRDFFailureMap, NumberOfCells, int, 2, 720);
measuredbrdfSetClampedMacro(vtkBRDFFailureMap, NumberOfAzimuths, int, 2, 3600);

//------------------------------------------------------------------------------
void vtkBRDFFailureMap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Reference: " << this->Reference.Get() << "\n";
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "NumberOfCells: " << this->NumberOfCells << "\n";
  os << indent << "NumberOfAzimuths: " << this->NumberOfAzimuths << "\n";
  os << indent << "RelativeL1: " << this->RelativeL1 << "\n";
  for (int k = 0; k < this->GetNumberOfWorstAngles(); ++k)
  {
    double angles[3];
    this->GetWorstAngles(k, angles);
    os << indent << "Worst: theta_i " << angles[0] << ", theta_o " << angles[1] << ", phi "
       << angles[2] << ": " << this->GetWorstError(k) << "\n";
  }
}
