// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material as rows of samples: those that its table holds, or f at the angles of MERL's tables.
 * Without Qt.
 */

#ifndef SampleTable_h
#define SampleTable_h

#include "Inputs.h"
#include "State.h"

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"
#include "vtkTabulatedBRDF.h"

#include <array>
#include <string>

namespace explorer
{
/**
 * Nothing is copied: a row is read, or evaluated, when it is asked for. Rows are in the order of
 * vtkTabulatedBRDF's volume.
 */
class SampleTable
{
public:
  SampleTable() = default;

  /// brdf: prepared, and not changed while this is used; null: no rows.
  explicit SampleTable(vtkBRDF* brdf);

  /// Whether rows are values of a table; else f is evaluated.
  bool IsStored() const { return this->Table != nullptr; }

  int GetNumberOfRows() const;

  /// Columns: three angles in degrees, then red, green and blue.
  std::array<std::string, 6> GetNames() const;

  /// Of GetNames' first three.
  std::array<double, 3> GetAngles(int row) const;

  /// Whether both directions are above the horizon; other rows hold no material.
  bool IsAbove(int row) const;

  /// False where there is no value: below the horizon, or not measured.
  bool GetValue(int row, std::array<float, 3>& rgb) const;

  /// The nearest row to theta_h, theta_d, phi_d in degrees, whatever the table's own angles are.
  int FindRow(const std::array<double, 3>& degrees) const;

  /// What a reader should know: what the values are.
  std::string GetNote() const;

private:
  std::array<int, 3> GetCell(int row) const;
  bool GetDirections(int row, double i[3], double o[3]) const;
  bool IsHalfDifference() const;

  vtkSmartPointer<vtkBRDF> BRDF;
  vtkTabulatedBRDF* Table = nullptr; // BRDF, or null
  std::array<int, 3> Dimensions = { 0, 0, 0 };
  int AzimuthRange = vtkTabulatedBRDF::HALF_TURN;
};

/// A copy with other values in some rows; without edits the material itself. Edits that its table
/// has no rows for are left out, which its notes say. Throws tool::Error.
tool::Material ApplyEdits(const tool::Material& original, const SampleEdits& edits);
} // namespace explorer

#endif
