// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The array forms of a material's queries: the same values as the calls for single directions.

#include "ErrorCatcher.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace
{
using Tuples = std::vector<std::vector<double>>;

// Above the horizon and below, of any length, and some that are no directions.
Tuples NewDirections(std::size_t count, unsigned int seed)
{
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Tuples directions;
  for (std::size_t k = 0; k < count; ++k)
  {
    const double z = number(engine) + 0.6;
    directions.push_back({ 2.0 * number(engine), 2.0 * number(engine), z });
  }
  directions[3] = { 0.0, 0.0, 0.0 };
  directions[4] = { 0.0, std::numeric_limits<double>::quiet_NaN(), 1.0 };
  directions[5] = { std::numeric_limits<double>::infinity(), 0.0, 1.0 };
  return directions;
}

Tuples NewNumbers(std::size_t count)
{
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> number(0.0, 0.999);
  Tuples numbers;
  for (std::size_t k = 0; k < count; ++k)
  {
    numbers.push_back({ number(engine), number(engine) });
  }
  return numbers;
}

template <typename Array>
vtkSmartPointer<Array> NewArray(const Tuples& tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(static_cast<int>(tuples.front().size()));
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples.size()));
  for (std::size_t k = 0; k < tuples.size(); ++k)
  {
    array->SetTuple(static_cast<vtkIdType>(k), tuples[k].data());
  }
  return array;
}

// The same value in every bit, as float where the array holds floats.
void ExpectTuple(vtkDataArray* array, std::size_t k, const std::vector<double>& expected)
{
  ASSERT_EQ(array->GetNumberOfComponents(), static_cast<int>(expected.size()));
  for (std::size_t c = 0; c < expected.size(); ++c)
  {
    const double value = array->GetComponent(static_cast<vtkIdType>(k), static_cast<int>(c));
    const bool isFloat = array->GetDataType() == VTK_FLOAT;
    EXPECT_EQ(value, isFloat ? static_cast<float>(expected[c]) : expected[c])
      << "tuple " << k << ", component " << c;
  }
}

std::vector<double> GetTuple(vtkDataArray* array, std::size_t k)
{
  std::vector<double> tuple(static_cast<std::size_t>(array->GetNumberOfComponents()));
  array->GetTuple(array->GetNumberOfTuples() == 1 ? 0 : static_cast<vtkIdType>(k), tuple.data());
  return tuple;
}

// The four of them against their scalar forms; i, o and u as the arrays give them.
void ExpectScalarValues(
  vtkBRDF* brdf, vtkDataArray* i, vtkDataArray* o, vtkDataArray* u, vtkDataArray* result)
{
  const vtkIdType count = std::max(i->GetNumberOfTuples(), o->GetNumberOfTuples());
  ASSERT_TRUE(brdf->EvaluateArray(i, o, result));
  ASSERT_EQ(result->GetNumberOfTuples(), count);
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
  {
    std::vector<double> f(3);
    brdf->Evaluate(GetTuple(i, k).data(), GetTuple(o, k).data(), f.data());
    ExpectTuple(result, k, f);
  }
  ASSERT_TRUE(brdf->PdfArray(i, o, result));
  ASSERT_EQ(result->GetNumberOfTuples(), count);
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
  {
    ExpectTuple(result, k, { brdf->Pdf(GetTuple(i, k).data(), GetTuple(o, k).data()) });
  }
  ASSERT_TRUE(brdf->SampleArray(o, u, result));
  const vtkIdType draws = std::max(u->GetNumberOfTuples(), o->GetNumberOfTuples());
  ASSERT_EQ(result->GetNumberOfTuples(), draws);
  for (std::size_t k = 0; k < static_cast<std::size_t>(draws); ++k)
  {
    std::vector<double> drawn(3);
    const std::vector<double> numbers = GetTuple(u, k);
    brdf->Sample(GetTuple(o, k).data(), numbers[0], numbers[1], drawn.data());
    ExpectTuple(result, k, drawn);
  }
}

std::vector<vtkSmartPointer<vtkBRDF>> NewMaterials()
{
  auto lobe = vtkSmartPointer<vtkAshikhminShirleyBRDF>::New();
  lobe->SetExponents(40.0, 900.0); // anisotropic
  auto microfacets = vtkSmartPointer<vtkDistributionBRDF>::New();
  const double f0[3] = { 0.04, 0.5, 0.9 };
  microfacets->SetBlinnDistribution(30.0);
  microfacets->SetSchlickFresnel(f0);
  auto sum = vtkSmartPointer<vtkSumBRDF>::New();
  sum->AddTerm(vtkNew<vtkLambertBRDF>());
  sum->AddTerm(microfacets);
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  const int size[3] = { 8, 6, 7 };
  std::vector<float> values(std::size_t(3) * 8 * 6 * 7);
  std::mt19937 engine(3);
  for (float& value : values)
  {
    value = static_cast<float>(engine() % 1000) / 1000.0f;
  }
  table->SetVolume(
    vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, size, std::move(values));
  return { vtkSmartPointer<vtkLambertBRDF>::New(), lobe, microfacets, sum, table };
}

constexpr std::size_t Count = 3000; // several threads
} // namespace

TEST(Arrays, AreTheScalarCalls)
{
  const Tuples i = NewDirections(Count, 1);
  const Tuples o = NewDirections(Count, 2);
  const Tuples u = NewNumbers(Count);
  for (vtkBRDF* brdf : NewMaterials())
  {
    SCOPED_TRACE(brdf->GetClassName());
    ExpectScalarValues(brdf, NewArray<vtkDoubleArray>(i), NewArray<vtkDoubleArray>(o),
      NewArray<vtkDoubleArray>(u), vtkNew<vtkDoubleArray>());
    ExpectScalarValues(brdf, NewArray<vtkFloatArray>(i), NewArray<vtkFloatArray>(o),
      NewArray<vtkFloatArray>(u), vtkNew<vtkFloatArray>());
  }
}

TEST(Arrays, OfAnyLayoutAndType)
{
  const Tuples i = NewDirections(Count, 1);
  const Tuples o = NewDirections(Count, 2);
  const Tuples u = NewNumbers(Count);
  const Tuples integers = { { 0.0, 1.0, 2.0 } };
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  ExpectScalarValues(brdf, NewArray<vtkSOADataArrayTemplate<double>>(i),
    NewArray<vtkSOADataArrayTemplate<float>>(o), NewArray<vtkSOADataArrayTemplate<double>>(u),
    vtkNew<vtkSOADataArrayTemplate<float>>());
  ExpectScalarValues(brdf, NewArray<vtkDoubleArray>(i), NewArray<vtkIntArray>(integers),
    NewArray<vtkFloatArray>(u), vtkNew<vtkSOADataArrayTemplate<double>>());
}

TEST(Arrays, OneTupleServesForAll)
{
  const auto many = NewArray<vtkDoubleArray>(NewDirections(Count, 1));
  const auto one = NewArray<vtkFloatArray>({ { 0.3, 0.1, 0.5 } });
  const auto u = NewArray<vtkDoubleArray>(NewNumbers(Count));
  const auto oneU = NewArray<vtkDoubleArray>({ { 0.25, 0.75 } });
  vtkNew<vtkDoubleArray> result;
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  ExpectScalarValues(brdf, many, one, u, result);
  ExpectScalarValues(brdf, one, many, oneU, result);
  ExpectScalarValues(brdf, one, one, u, result);
  ExpectScalarValues(brdf, one, one, oneU, result);
  EXPECT_EQ(result->GetNumberOfTuples(), 1);
}

TEST(Arrays, AlbedosAreTheScalarCalls)
{
  const Tuples o = { { 0.0, 0.0, 1.0 }, { 0.9, 0.0, 0.2 }, { 0.0, 1.0, -1.0 }, { 3.0, 4.0, 5.0 } };
  const auto directions = NewArray<vtkDoubleArray>(o);
  vtkNew<vtkDoubleArray> albedos;
  for (vtkBRDF* brdf : NewMaterials())
  {
    SCOPED_TRACE(brdf->GetClassName());
    ASSERT_TRUE(brdf->GetDirectionalAlbedoArray(directions, albedos));
    ASSERT_EQ(albedos->GetNumberOfTuples(), 4);
    for (std::size_t k = 0; k < o.size(); ++k)
    {
      std::vector<double> albedo(3);
      brdf->GetDirectionalAlbedo(o[k].data(), albedo.data());
      ExpectTuple(albedos, k, albedo);
    }
  }
}

TEST(Arrays, NoneAreNoError)
{
  vtkNew<vtkLambertBRDF> brdf;
  vtkNew<vtkDoubleArray> none, result;
  none->SetNumberOfComponents(3);
  result->InsertNextValue(1.0);
  ASSERT_TRUE(brdf->EvaluateArray(none, none, result));
  EXPECT_EQ(result->GetNumberOfTuples(), 0);
  EXPECT_EQ(result->GetNumberOfComponents(), 3);
  const auto one = NewArray<vtkDoubleArray>({ { 0.0, 0.0, 1.0 } });
  ASSERT_TRUE(brdf->EvaluateArray(none, one, result)); // as arrays broadcast elsewhere
  EXPECT_EQ(result->GetNumberOfTuples(), 0);
}

TEST(Arrays, TheResultMayBeAnInput)
{
  const Tuples i = NewDirections(Count, 1);
  const Tuples o = NewDirections(Count, 2);
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  const auto incoming = NewArray<vtkDoubleArray>(i);
  const auto outgoing = NewArray<vtkDoubleArray>(o);
  ASSERT_TRUE(brdf->PdfArray(incoming, outgoing, incoming)); // of another size, too
  for (std::size_t k = 0; k < Count; ++k)
  {
    ExpectTuple(incoming, k, { brdf->Pdf(i[k].data(), o[k].data()) });
  }
  ASSERT_TRUE(brdf->EvaluateArray(outgoing, outgoing, outgoing));
  for (std::size_t k = 0; k < Count; ++k)
  {
    std::vector<double> f(3);
    brdf->Evaluate(o[k].data(), o[k].data(), f.data());
    ExpectTuple(outgoing, k, f);
  }
}

// As two NumPy views of one array do.
TEST(Arrays, TheResultMayShareMemoryWithAnInput)
{
  const Tuples directions = NewDirections(Count, 1);
  const auto i = NewArray<vtkDoubleArray>(directions);
  const auto o = NewArray<vtkDoubleArray>({ { 0.0, 0.0, 1.0 } });
  vtkNew<vtkDoubleArray> result;
  result->SetNumberOfComponents(3);
  result->SetArray(i->GetPointer(0), 3 * static_cast<vtkIdType>(Count), 1);
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  ASSERT_TRUE(brdf->EvaluateArray(i, o, result));
  const double view[3] = { 0.0, 0.0, 1.0 };
  for (std::size_t k = 0; k < Count; ++k)
  {
    std::vector<double> f(3);
    brdf->Evaluate(directions[k].data(), view, f.data());
    ExpectTuple(result, k, f);
  }
}

TEST(Arrays, MemoryOfAnotherOwnerIsFilled)
{
  const auto i = NewArray<vtkDoubleArray>(NewDirections(10, 1));
  const auto o = NewArray<vtkDoubleArray>({ { 0.0, 0.0, 1.0 } });
  std::vector<double> memory(30, -1.0);
  vtkNew<vtkDoubleArray> result;
  result->SetNumberOfComponents(3);
  result->SetArray(memory.data(), 30, 1);
  vtkNew<vtkLambertBRDF> brdf;
  ASSERT_TRUE(brdf->EvaluateArray(i, o, result));
  EXPECT_EQ(result->GetPointer(0), memory.data());
  for (const double value : memory)
  {
    EXPECT_GE(value, 0.0);
  }
}

TEST(Arrays, WhatDoesNotFitIsRefused)
{
  vtkNew<vtkLambertBRDF> brdf;
  ErrorCatcher errors(brdf);
  const auto seven = NewArray<vtkDoubleArray>(NewDirections(7, 1));
  const auto six = NewArray<vtkDoubleArray>(NewDirections(6, 1));
  const auto pairs = NewArray<vtkDoubleArray>(NewNumbers(7));
  const auto result = NewArray<vtkDoubleArray>({ { 5.0 } });
  const auto expect = [&](bool worked, const std::string& text)
  {
    EXPECT_FALSE(worked) << text;
    EXPECT_EQ(errors.Take(), 1) << text;
    EXPECT_NE(errors.GetText().find(text), std::string::npos) << errors.GetText();
    ExpectTuple(result, 0, { 5.0 });
    EXPECT_EQ(result->GetNumberOfTuples(), 1);
  };
  expect(brdf->EvaluateArray(nullptr, seven, result),
    "EvaluateArray: i: found no array, expected one of 3 components.");
  expect(brdf->EvaluateArray(seven, nullptr, result),
    "EvaluateArray: o: found no array, expected one of 3 components.");
  expect(brdf->EvaluateArray(seven, pairs, result),
    "EvaluateArray: o: found tuples of 2, expected 3 components.");
  expect(brdf->EvaluateArray(seven, six, result),
    "EvaluateArray: o: found 6 tuples, expected 7, as i has, or 1.");
  expect(
    brdf->PdfArray(seven, six, result), "PdfArray: o: found 6 tuples, expected 7, as i has, or 1.");
  expect(brdf->SampleArray(six, pairs, result),
    "SampleArray: u: found 7 tuples, expected 6, as o has, or 1.");
  expect(brdf->SampleArray(seven, seven, result),
    "SampleArray: u: found tuples of 3, expected 2 components.");
  expect(brdf->GetDirectionalAlbedoArray(pairs, result),
    "GetDirectionalAlbedoArray: o: found tuples of 2, expected 3 components.");
  expect(brdf->EvaluateArray(seven, seven, nullptr),
    "EvaluateArray: f: found no array, expected one to fill.");
  expect(brdf->GetDirectionalAlbedoArray(seven, vtkNew<vtkIntArray>()),
    "GetDirectionalAlbedoArray: albedo: found an array of type int, expected float or double.");
}
