// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SampleTable.h"

#include "HalfVector.h"
#include "Tool.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace
{
constexpr std::int64_t MostRows = 20000000; // that a view can scroll through
constexpr std::array<int, 3> MerlDimensions = { 180, 90, 90 };

//------------------------------------------------------------------------------
int Nearest(double share, int count)
{
  return std::clamp(static_cast<int>(std::lround(share * count - 0.5)), 0, count - 1);
}
}

namespace explorer
{
//------------------------------------------------------------------------------
SampleTable::SampleTable(vtkBRDF* brdf)
  : BRDF(brdf)
  , Table(vtkTabulatedBRDF::SafeDownCast(brdf))
{
  if (this->Table)
  {
    std::copy_n(this->Table->GetDimensions(), 3, this->Dimensions.begin());
    this->AzimuthRange = this->Table->GetAzimuthRange();
  }
  else if (brdf)
  {
    this->Dimensions = MerlDimensions;
  }
}

//------------------------------------------------------------------------------
int SampleTable::GetNumberOfRows() const
{
  const auto& n = this->Dimensions;
  return static_cast<int>(std::min(static_cast<std::int64_t>(n[0]) * n[1] * n[2], MostRows));
}

//------------------------------------------------------------------------------
bool SampleTable::IsHalfDifference() const
{
  return !this->Table || this->Table->GetParameterization() == vtkTabulatedBRDF::HALF_DIFFERENCE;
}

//------------------------------------------------------------------------------
std::array<std::string, 6> SampleTable::GetNames() const
{
  return this->IsHalfDifference()
           ? std::array<std::string, 6>{ "θh", "θd", "φd", "Red", "Green", "Blue" }
           : std::array<std::string, 6>{ "θi", "θo", "Δφ", "Red", "Green", "Blue" };
}

//------------------------------------------------------------------------------
std::array<int, 3> SampleTable::GetCell(int row) const
{
  const auto& n = this->Dimensions;
  return { row % n[0], row / n[0] % n[1], row / n[0] / n[1] };
}

//------------------------------------------------------------------------------
// As vtkTabulatedBRDF places its samples.
std::array<double, 3> SampleTable::GetAngles(int row) const
{
  const std::array<int, 3> cell = this->GetCell(row);
  const auto share = [&](std::size_t axis) { return (cell[axis] + 0.5) / this->Dimensions[axis]; };
  const double turn = this->AzimuthRange == vtkTabulatedBRDF::HALF_TURN ? 180.0 : 360.0;
  const double first = share(2);
  return { 90.0 * (this->IsHalfDifference() ? first * first : first), 90.0 * share(1),
    turn * share(0) };
}

//------------------------------------------------------------------------------
bool SampleTable::GetDirections(int row, double i[3], double o[3]) const
{
  const std::array<int, 3> cell = this->GetCell(row);
  return vtkTabulatedBRDF::GetCellDirections(
    this->Table ? this->Table->GetParameterization() : vtkTabulatedBRDF::HALF_DIFFERENCE,
    this->AzimuthRange, this->Dimensions.data(), cell[0], cell[1], cell[2], i, o);
}

//------------------------------------------------------------------------------
bool SampleTable::IsAbove(int row) const
{
  double i[3];
  double o[3];
  return this->GetDirections(row, i, o);
}

//------------------------------------------------------------------------------
bool SampleTable::GetValue(int row, std::array<float, 3>& rgb) const
{
  double i[3];
  double o[3];
  if (!this->GetDirections(row, i, o))
  {
    return false;
  }
  if (this->Table)
  {
    const float* sample = &this->Table->GetVolume()[3 * static_cast<std::size_t>(row)];
    const bool isMeasured =
      std::all_of(sample, sample + 3, [](float value) { return std::isfinite(value); });
    if (isMeasured)
    {
      std::copy_n(sample, 3, rgb.begin());
    }
    return isMeasured;
  }
  double f[3];
  this->BRDF->Evaluate(i, o, f);
  std::transform(f, f + 3, rgb.begin(), [](double value) { return static_cast<float>(value); });
  return true;
}

//------------------------------------------------------------------------------
int SampleTable::FindRow(const std::array<double, 3>& degrees) const
{
  const double turn = this->AzimuthRange == vtkTabulatedBRDF::HALF_TURN ? 180.0 : 360.0;
  double shares[3] = { degrees[2] / turn, degrees[1] / 90.0, std::sqrt(degrees[0] / 90.0) };
  if (!this->IsHalfDifference())
  {
    glm::dvec3 i;
    glm::dvec3 o;
    measuredbrdf::FromHalfDifference(
      { measuredbrdf::ToRadians(degrees[0]), measuredbrdf::ToRadians(degrees[1]),
        measuredbrdf::ToRadians(degrees[2]) },
      i, o);
    const double azimuth =
      std::abs(std::atan2(i.x * o.y - i.y * o.x, i.x * o.x + i.y * o.y)); // of half a turn
    const auto theta = [](const glm::dvec3& direction)
    { return measuredbrdf::ToDegrees(std::acos(std::clamp(direction.z, -1.0, 1.0))); };
    shares[0] = measuredbrdf::ToDegrees(azimuth) / turn;
    shares[1] = theta(o) / 90.0;
    shares[2] = theta(i) / 90.0;
  }
  const auto& n = this->Dimensions;
  const std::int64_t row =
    Nearest(shares[0], n[0]) +
    static_cast<std::int64_t>(n[0]) *
      (Nearest(shares[1], n[1]) + static_cast<std::int64_t>(n[1]) * Nearest(shares[2], n[2]));
  return static_cast<int>(std::min<std::int64_t>(row, this->GetNumberOfRows() - 1));
}

//------------------------------------------------------------------------------
std::string SampleTable::GetNote() const
{
  if (!this->BRDF)
  {
    return "";
  }
  if (!this->Table)
  {
    return std::string("This material is no table of theta_h, theta_d and phi_d, or of theta_i, "
                       "theta_o and phi: f is evaluated at the angles of MERL's tables") +
           (this->BRDF->IsIsotropic() ? "" : ", with the half vector over the tangent") +
           ". It cannot be edited.";
  }
  return std::string(this->Table->GetCosineWeighted() ? "The table holds f cos(theta_o), in 1/sr."
                                                      : "The table holds f, in 1/sr.") +
         " Edits are made in a copy; the file stays as it is.";
}

//------------------------------------------------------------------------------
tool::Material ApplyEdits(const tool::Material& original, const SampleEdits& edits)
{
  if (edits.empty())
  {
    return original;
  }
  tool::Material edited = original;
  auto copy = vtkSmartPointer<vtkBRDF>::Take(original.BRDF->NewSnapshot());
  auto* table = vtkTabulatedBRDF::SafeDownCast(copy);
  const SampleTable rows(table);
  const int count = table ? rows.GetNumberOfRows() : 0;
  const auto foreign = std::distance(edits.lower_bound(count), edits.end());
  if (foreign > 0)
  {
    edited.Notes += (edited.Notes.empty() ? "" : " ") + original.File + ": " +
                    std::to_string(foreign) +
                    " of its edits are for no row of its table, which has " +
                    std::to_string(count) + ", and are left out.";
  }
  if (edits.begin()->first >= count)
  {
    return edited;
  }
  std::vector<float> volume = table->GetVolume();
  for (auto edit = edits.begin(); edit != edits.lower_bound(count); ++edit)
  {
    const auto& [row, rgb] = *edit;
    std::copy(rgb.begin(), rgb.end(), &volume[3 * static_cast<std::size_t>(row)]);
  }
  const int dimensions[3] = { table->GetDimensions()[0], table->GetDimensions()[1],
    table->GetDimensions()[2] };
  if (!table->SetVolume(
        table->GetParameterization(), table->GetAzimuthRange(), dimensions, std::move(volume)))
  {
    throw tool::Error(original.File + ": editing: " + tool::TakeErrorText());
  }
  edited.Name += " (edited)";
  table->SetName(edited.Name);
  edited.BRDF = table;
  return edited;
}
} // namespace explorer
