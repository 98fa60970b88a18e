// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RowTransform.h"

#include "HalfVector.h" // for Pi
#include "Lanes.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t Lines = RowTransform::Lines;
constexpr std::size_t Item = RowTransform::Item;
constexpr std::size_t MostOdd = 25; // factor; larger ones are better left to Eigen

// Eight lines' complex numbers.
struct ComplexLanes
{
  Float8 Real, Imaginary;

  MEASUREDBRDF_INLINE explicit ComplexLanes(const float* item)
    : Real(Load<Float8>(item))
    , Imaginary(Load<Float8>(item + Lines))
  {
  }
  MEASUREDBRDF_INLINE void StoreTo(float* item) const
  {
    Store(this->Real, item);
    Store(this->Imaginary, item + Lines);
  }
  MEASUREDBRDF_INLINE void AddTurned(const ComplexLanes& other, const std::complex<float>& turn)
  {
    this->Real += turn.real() * other.Real - turn.imag() * other.Imaginary;
    this->Imaginary += turn.real() * other.Imaginary + turn.imag() * other.Real;
  }
};

// Parts of an odd length, each by its definition.
MEASUREDBRDF_INLINE void RunOddParts(
  float* lines, std::size_t size, std::size_t length, const std::complex<float>* turns)
{
  float sums[MostOdd * Item];
  for (std::size_t part = 0; length > 1 && part < size; part += length)
  {
    float* const at = lines + part * Item;
    for (std::size_t j = 0; j < length; ++j)
    {
      ComplexLanes sum(at);
      for (std::size_t k = 1; k < length; ++k)
      {
        sum.AddTurned(ComplexLanes(at + k * Item), turns[j * k % length * (size / length)]);
      }
      sum.StoreTo(sums + j * Item);
    }
    std::copy_n(sums, length * Item, at);
  }
}

// From parts of `length` numbers to ones of twice as many.
MEASUREDBRDF_INLINE void RunStage(
  float* lines, std::size_t size, std::size_t length, const std::complex<float>* turns)
{
  for (std::size_t part = 0; part < size; part += 2 * length)
  {
    for (std::size_t k = 0; k < length; ++k)
    {
      float* const at = lines + (part + k) * Item;
      const ComplexLanes other(at + length * Item);
      const std::complex<float> turn = turns[k * (size / (2 * length))];
      ComplexLanes sum(at);
      ComplexLanes difference = sum;
      sum.AddTurned(other, turn);
      difference.AddTurned(other, -turn);
      sum.StoreTo(at);
      difference.StoreTo(at + length * Item);
    }
  }
}
}

RowTransform::RowTransform(std::size_t size)
{
  std::size_t power = 1; // of two
  while (power < size && size / power % 2 == 0)
  {
    power *= 2;
  }
  const bool isLineByLine = size / power > MostOdd;
  this->Odd = isLineByLine ? 1 : size / power;
  for (std::size_t k = 0; k < size; ++k)
  {
    std::size_t place = 0;
    for (std::size_t bit = 1; bit < power; bit *= 2) // the bits in reverse
    {
      place = 2 * place + ((k & bit) != 0 ? 1 : 0);
    }
    this->Places.push_back(isLineByLine ? k : place * this->Odd + k / power);
    if (!isLineByLine)
    {
      const double angle = -2.0 * Pi * static_cast<double>(k) / static_cast<double>(size);
      this->Turns.emplace_back(
        static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
    }
  }
}

void RowTransform::Run(float* lines) const
{
  if (this->Turns.empty())
  {
    return this->RunLineByLine(lines);
  }
  RunWidest(
    [&]() MEASUREDBRDF_INLINED
    {
      const std::size_t size = this->GetSize();
      RunOddParts(lines, size, this->Odd, this->Turns.data());
      for (std::size_t length = this->Odd; length < size; length *= 2)
      {
        RunStage(lines, size, length, this->Turns.data());
      }
    });
}

void RowTransform::RunLineByLine(float* lines) const
{
  Eigen::FFT<float> transform;
  std::vector<std::complex<float>> in(this->GetSize()), out(this->GetSize());
  for (std::size_t line = 0; line < Lines; ++line)
  {
    for (std::size_t k = 0; k < in.size(); ++k)
    {
      in[k] = { lines[k * Item + line], lines[k * Item + Lines + line] };
    }
    transform.fwd(out.data(), in.data(), static_cast<Eigen::Index>(in.size()));
    for (std::size_t k = 0; k < in.size(); ++k)
    {
      lines[k * Item + line] = out[k].real();
      lines[k * Item + Lines + line] = out[k].imag();
    }
  }
}
} // namespace measuredbrdf
