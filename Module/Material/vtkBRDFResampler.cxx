// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFResampler.h"

#include "HalfDifferenceFill.h"
#include "HalfVector.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "Setters.h"
#include "VolumeInterpolation.h"
#include "vtkBasisBRDF.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBRDFResampler);

namespace
{
constexpr int ChoosingProbes = 1 << 14;
constexpr int ReportingProbes = 1 << 17;
constexpr vtkIdType ProbeBlock = 1 << 10; // for a thread

// Pairs of directions to compare two BRDFs at, with their weights and the reference's values.
struct Probe
{
  glm::dvec3 I, O, F;
  double Weight = 0.0; // c_i c_o over the density of the draw
};

// Cosines of a zone's edges.
struct Zone
{
  double Near;
  double Far;
};

constexpr Zone Hemisphere = { 1.0, 0.0 };

Zone ToZone(const double degrees[2])
{
  return { std::cos(ToRadians(degrees[0])),
    degrees[1] < 90.0 ? std::cos(ToRadians(degrees[1])) : 0.0 };
}

// Pairs number first + 1 ... first + count of a fixed sequence, of directions in two zones. The
// view's cosine: half in proportion to itself, half to its reciprocal, because f grows towards the
// horizon and errors sit there. i: half by the reference's own sampler (sharp lobes are met), half
// cosine-weighted (nothing is missed). Weights by the balance heuristic (Veach, Guibas 1995).
std::vector<Probe> MakeProbes(vtkBRDF* reference, int first, int count,
  const Zone& incident = Hemisphere, const Zone& outgoing = Hemisphere)
{
  reference->Prepare();
  std::vector<Probe> probes(static_cast<std::size_t>(count)); // of weight 0: missed
  const double most = outgoing.Near;
  const double least = std::max(outgoing.Far, MinimumViewCosine);
  const double logRange = std::log(most / least);
  const double nearSquare = incident.Near * incident.Near;
  const double squares = nearSquare - incident.Far * incident.Far;
  const auto draw = [&](int k)
  {
    Probe& probe = probes[static_cast<std::size_t>(k)];
    const std::uint32_t n = static_cast<std::uint32_t>(first + k) + 1;
    const double u = RadicalInverse(n, 2);
    const double z = RadicalInverse(n, 13) < 0.5
                       ? std::sqrt(least * least + u * (most * most - least * least))
                       : least * std::exp(u * logRange);
    const double viewDensity =
      0.5 * (2.0 * z / (most * most - least * least) + 1.0 / (z * logRange)) / (2.0 * Pi);
    probe.O = ToDirection(z, 2.0 * Pi * RadicalInverse(n, 3));
    const double u1 = RadicalInverse(n, 5), u2 = RadicalInverse(n, 7);
    if (RadicalInverse(n, 11) < 0.5)
    {
      SampleCosine(1.0 - nearSquare + u1 * squares, u2, &probe.I.x);
    }
    else if (!reference->Sample(&probe.O.x, u1, u2, &probe.I.x) || probe.I.z > incident.Near ||
             probe.I.z < incident.Far)
    {
      return;
    }
    const double density =
      0.5 * (reference->Pdf(&probe.I.x, &probe.O.x) + probe.I.z / (Pi * squares)) * viewDensity;
    probe.Weight = probe.I.z * z / density;
    reference->Evaluate(&probe.I.x, &probe.O.x, &probe.F.x);
  };
  measuredbrdf::ParallelFor(0, count, ProbeBlock,
    [&draw](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        draw(static_cast<int>(k));
      }
    });
  probes.erase(std::remove_if(probes.begin(), probes.end(),
                 [](const Probe& probe) { return !(probe.Weight > 0.0); }),
    probes.end());
  return probes;
}

// other: prepared, where it evaluates what it prepares.
double Compare(const std::vector<Probe>& probes, vtkBRDF* other, double* maximum = nullptr)
{
  std::vector<glm::dvec3> values(probes.size());
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(probes.size()), ProbeBlock,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (std::size_t k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      {
        other->Evaluate(&probes[k].I.x, &probes[k].O.x, &values[k].x);
      }
    });
  double difference = 0.0, total = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < probes.size(); ++k) // in this order: the same sums on all machines
  {
    const Probe& probe = probes[k];
    const glm::dvec3 d = values[k] - probe.F;
    difference += probe.Weight * glm::dot(d, d);
    total += probe.Weight * glm::dot(probe.F, probe.F);
    largest = std::max({ largest, std::abs(d.x), std::abs(d.y), std::abs(d.z) });
  }
  if (maximum)
  {
    *maximum = largest;
  }
  return total > 0.0 ? std::sqrt(difference / total) : (difference > 0.0 ? 1.0 : 0.0);
}

// By cell of a table of this size: whether some pair's value is interpolated from it.
std::vector<char> FindCells(const std::vector<Probe>& probes, const int size[3], bool reciprocal)
{
  std::vector<char> cells(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
                          static_cast<std::size_t>(size[2]));
  for (const Probe& probe : probes)
  {
    const glm::dvec3 u = ToHalfDifferenceUnit(probe.I, probe.O, reciprocal);
    ForCorners<3>(size, FindHalfDifferenceCorners(u, size),
      [&cells](std::size_t cell, double) { cells[cell] = 1; });
  }
  return cells;
}
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBRDFResampler, Tolerance, double, 1e-6, 1.0);

//------------------------------------------------------------------------------
void vtkBRDFResampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Input: " << this->Input.Get() << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Reciprocal: " << (this->Reciprocal ? "On" : "Off") << "\n";
  os << indent << "Output: " << this->Output.Get() << "\n";
}

//------------------------------------------------------------------------------
bool vtkBRDFResampler::ResampleTo(int nPhiD, int nThetaD, int nThetaH)
{
  const int dimensions[3] = { nPhiD, nThetaD, nThetaH };
  if (!this->Input || *std::min_element(dimensions, dimensions + 3) < 1 ||
      *std::max_element(dimensions, dimensions + 3) > 2048)
  {
    vtkErrorMacro("ResampleTo: expected an input and sizes in [1, 2048], got "
                  << nPhiD << " x " << nThetaD << " x " << nThetaH << ".");
    return false;
  }
  FillHalfDifference(this->Input, this->Reciprocal, dimensions, this->Output);
  this->Output->SetResamplingError(
    Compare(MakeProbes(this->Input, ChoosingProbes, ReportingProbes), this->Output));
  return true;
}

//------------------------------------------------------------------------------
bool vtkBRDFResampler::Resample()
{
  if (!this->Input)
  {
    vtkErrorMacro("Resample: no input.");
    return false;
  }
  const std::vector<Probe> probes = MakeProbes(this->Input, 0, ChoosingProbes);
  double error = std::numeric_limits<double>::max();
  int best[3] = { this->Reciprocal ? 8 : 16, 16, 32 };
  // The best size so far, or (trimming) any that meets the tolerance. Only the cells are evaluated
  // that the pairs read, a few of a large table's.
  const auto attempt = [&](const int size[3], bool trimming)
  {
    vtkNew<vtkTabulatedBRDF> table;
    const std::vector<char> wanted = FindCells(probes, size, this->Reciprocal);
    FillHalfDifference(this->Input, this->Reciprocal, size, table, &wanted);
    const double tableError = Compare(probes, table);
    const bool better = trimming ? tableError <= this->Tolerance : tableError < error;
    if (better)
    {
      error = tableError;
      std::copy_n(size, 3, best);
    }
    double progress = std::min(this->Tolerance / error, 1.0);
    this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
    return better;
  };

  // Up a ladder of sizes until one is good enough: even ones first, then shapes for features that
  // need one axis most (sharp lobes: theta_h).
  const int ladder[][3] = { { 16, 16, 32 }, { 32, 32, 64 }, { 64, 64, 128 }, { 32, 64, 512 },
    { 128, 64, 128 }, { 64, 128, 128 }, { 128, 128, 64 } };
  for (const int* step : ladder)
  {
    const int size[3] = { this->Reciprocal ? step[0] / 2 : step[0], step[1], step[2] };
    if (error > this->Tolerance)
    {
      attempt(size, false);
    }
  }
  // Down again: halve each axis for as long as it can be spared.
  bool isSpare[3] = { true, true, true };
  for (bool trimmed = error <= this->Tolerance; trimmed;)
  {
    trimmed = false;
    for (int axis = 2; axis >= 0; --axis)
    {
      int size[3] = { best[0], best[1], best[2] };
      size[axis] /= 2;
      isSpare[axis] = isSpare[axis] && size[axis] >= 8 && attempt(size, true);
      trimmed = trimmed || isSpare[axis];
    }
  }
  FillHalfDifference(this->Input, this->Reciprocal, best, this->Output);
  // The probes that chose the size flatter it: fresh ones report.
  error = Compare(MakeProbes(this->Input, ChoosingProbes, ReportingProbes), this->Output);
  this->Output->SetResamplingError(error);
  return error <= this->Tolerance;
}

//------------------------------------------------------------------------------
double vtkBRDFResampler::GetRelativeL2Error(vtkBRDF* a, vtkBRDF* b, int pairs, double* maximum)
{
  const double hemisphere[2] = { 0.0, 90.0 };
  return GetZoneRelativeL2Error(a, b, hemisphere, hemisphere, pairs, maximum);
}

//------------------------------------------------------------------------------
double vtkBRDFResampler::GetZoneRelativeL2Error(vtkBRDF* a, vtkBRDF* b, const double incident[2],
  const double outgoing[2], int pairs, double* maximum)
{
  if (!a || !b || pairs < 1)
  {
    vtkGenericWarningMacro("GetRelativeL2Error: expected two BRDFs and at least one pair.");
    return std::numeric_limits<double>::quiet_NaN();
  }
  for (const double* zone : { incident, outgoing })
  {
    const std::string problem = vtkBasisBRDF::FindZoneProblem(zone);
    if (!problem.empty())
    {
      vtkGenericWarningMacro("GetZoneRelativeL2Error: " << problem << ".");
      return std::numeric_limits<double>::quiet_NaN();
    }
  }
  b->Prepare();
  return Compare(
    MakeProbes(a, ChoosingProbes, pairs, ToZone(incident), ToZone(outgoing)), b, maximum);
}

//------------------------------------------------------------------------------
double vtkBRDFResampler::GetLogCosineDistance(vtkBRDF* a, vtkBRDF* b, int pairs)
{
  if (!a || !b || pairs < 1)
  {
    vtkGenericWarningMacro("GetLogCosineDistance: expected two BRDFs and at least one pair.");
    return std::numeric_limits<double>::quiet_NaN();
  }
  a->Prepare();
  b->Prepare();
  const double steepest = std::acos(MinimumViewCosine);
  double sum = 0.0;
  for (int k = 0; k < pairs; ++k)
  {
    const std::uint32_t n = static_cast<std::uint32_t>(k) + 1;
    const glm::dvec3 o =
      ToDirection(std::cos(steepest * RadicalInverse(n, 2)), 2.0 * Pi * RadicalInverse(n, 3));
    const glm::dvec3 i = ToDirection(1.0 - RadicalInverse(n, 5), 2.0 * Pi * RadicalInverse(n, 7));
    glm::dvec3 f, g;
    a->Evaluate(&i.x, &o.x, &f.x);
    b->Evaluate(&i.x, &o.x, &g.x);
    const glm::dvec3 difference = glm::log(1.0 + f * i.z) - glm::log(1.0 + g * i.z);
    sum += glm::dot(difference, difference);
  }
  return std::sqrt(sum / (3.0 * pairs));
}
