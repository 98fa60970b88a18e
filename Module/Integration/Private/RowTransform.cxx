// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RowTransform.h"

#include "HalfVector.h" // for Pi
#include "WideVectors.h"

#include <unsupported/Eigen/FFT>

#include <cmath>
#include <cstring>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t Lines = RowTransform::Lines;
constexpr std::size_t Item = RowTransform::Item;
constexpr std::size_t MostOdd = 25; // factor; larger ones are better left to Eigen

// Some lanes of a complex number. Vector: of floats, or one.
template <typename Vector>
struct Number
{
  Vector Real, Imaginary;

  MEASUREDBRDF_INLINE void Load(const float* item)
  {
    std::memcpy(&this->Real, item, sizeof(Vector));
    std::memcpy(&this->Imaginary, item + Lines, sizeof(Vector));
  }
  MEASUREDBRDF_INLINE void Store(float* item) const
  {
    std::memcpy(item, &this->Real, sizeof(Vector));
    std::memcpy(item + Lines, &this->Imaginary, sizeof(Vector));
  }
  MEASUREDBRDF_INLINE void Turn(const std::complex<float>& turn)
  {
    const Vector real = turn.real() * this->Real - turn.imag() * this->Imaginary;
    this->Imaginary = turn.real() * this->Imaginary + turn.imag() * this->Real;
    this->Real = real;
  }
};

// sum = first + second, difference = first - second; both may be the first's and second's places.
template <typename Vector>
MEASUREDBRDF_INLINE void Cross(Number<Vector>& first, Number<Vector>& second)
{
  const Number<Vector> sum{ first.Real + second.Real, first.Imaginary + second.Imaginary };
  second.Real = first.Real - second.Real;
  second.Imaginary = first.Imaginary - second.Imaginary;
  first = sum;
}

// Parts of an odd length, each by its definition.
template <typename Vector>
MEASUREDBRDF_INLINE void RunOddParts(
  float* lines, std::size_t size, std::size_t length, const std::complex<float>* turns)
{
  for (std::size_t part = 0; length > 1 && part < size; part += length)
  {
    for (std::size_t lane = 0; lane < Lines; lane += sizeof(Vector) / sizeof(float))
    {
      float* const at = lines + part * Item + lane;
      Number<Vector> in[MostOdd];
      for (std::size_t k = 0; k < length; ++k)
      {
        in[k].Load(at + k * Item);
      }
      for (std::size_t j = 0; j < length; ++j)
      {
        Number<Vector> sum = in[0];
        for (std::size_t k = 1; k < length; ++k)
        {
          const std::complex<float> turn = turns[j * k % length * (size / length)];
          sum.Real += turn.real() * in[k].Real - turn.imag() * in[k].Imaginary;
          sum.Imaginary += turn.real() * in[k].Imaginary + turn.imag() * in[k].Real;
        }
        sum.Store(at + j * Item);
      }
    }
  }
}

// From parts of `length` numbers to ones of twice as many.
template <typename Vector>
MEASUREDBRDF_INLINE void RunOneStage(
  float* lines, std::size_t size, std::size_t length, const std::complex<float>* turns)
{
  for (std::size_t part = 0; part < size; part += 2 * length)
  {
    for (std::size_t k = 0; k < length; ++k)
    {
      const std::complex<float> once = turns[k * (size / (2 * length))];
      for (std::size_t lane = 0; lane < Lines; lane += sizeof(Vector) / sizeof(float))
      {
        float* const at = lines + (part + k) * Item + lane;
        Number<Vector> a, b;
        a.Load(at);
        b.Load(at + length * Item);
        b.Turn(once);
        Cross(a, b);
        a.Store(at);
        b.Store(at + length * Item);
      }
    }
  }
}

// From parts of `length` numbers to ones of four times as many.
template <typename Vector>
MEASUREDBRDF_INLINE void RunTwoStages(
  float* lines, std::size_t size, std::size_t length, const std::complex<float>* turns)
{
  for (std::size_t part = 0; part < size; part += 4 * length)
  {
    for (std::size_t k = 0; k < length; ++k)
    {
      const std::complex<float> once = turns[k * (size / (2 * length))];
      const std::complex<float> twice = turns[k * (size / (4 * length))];
      for (std::size_t lane = 0; lane < Lines; lane += sizeof(Vector) / sizeof(float))
      {
        float* const at = lines + (part + k) * Item + lane;
        Number<Vector> a, b, c, d;
        a.Load(at);
        b.Load(at + length * Item);
        c.Load(at + 2 * length * Item);
        d.Load(at + 3 * length * Item);
        b.Turn(once);
        d.Turn(once);
        Cross(a, b);
        Cross(c, d);
        c.Turn(twice);
        d.Turn(twice);
        Cross(a, c);
        Number<Vector> right{ d.Imaginary, -d.Real }; // by another quarter of a turn
        Cross(b, right);
        a.Store(at);
        b.Store(at + length * Item);
        c.Store(at + 2 * length * Item);
        right.Store(at + 3 * length * Item);
      }
    }
  }
}

template <typename Vector>
MEASUREDBRDF_INLINE void RunStages(
  float* lines, std::size_t size, std::size_t odd, const std::complex<float>* turns)
{
  RunOddParts<Vector>(lines, size, odd, turns);
  std::size_t length = odd;
  for (std::size_t k = size / odd; k > 1; k /= 4)
  {
    if (k == 2)
    {
      RunOneStage<Vector>(lines, size, length, turns);
      length *= 2;
    }
  }
  for (; length < size; length *= 4)
  {
    RunTwoStages<Vector>(lines, size, length, turns);
  }
}

#ifdef MEASUREDBRDF_HAS_VECTORS
using Vector4 = float __attribute__((vector_size(16)));
using Vector8 = float __attribute__((vector_size(32)));

__attribute__((target("avx2,fma"))) void RunWide(
  float* lines, std::size_t size, std::size_t odd, const std::complex<float>* turns)
{
  RunStages<Vector8>(lines, size, odd, turns);
}
#endif

void RunAnywhere(float* lines, std::size_t size, std::size_t odd, const std::complex<float>* turns)
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  RunStages<Vector4>(lines, size, odd, turns);
#else
  RunStages<float>(lines, size, odd, turns);
#endif
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
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    return RunWide(lines, this->GetSize(), this->Odd, this->Turns.data());
  }
#endif
  RunAnywhere(lines, this->GetSize(), this->Odd, this->Turns.data());
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
