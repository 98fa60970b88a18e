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

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{
using Tuples = std::vector<std::vector<double>>;

constexpr std::size_t Count = 3000; // several threads

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
  Tuples numbers(count, std::vector<double>(2));
  for (std::vector<double>& pair : numbers)
  {
    pair = { number(engine), number(engine) };
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

vtkSmartPointer<vtkDoubleArray> NewDoubles(const Tuples& tuples)
{
  return NewArray<vtkDoubleArray>(tuples);
}

// The same value in every bit, as float where the array holds floats.
void ExpectTuple(vtkDataArray* array, vtkIdType k, const std::vector<double>& expected)
{
  ASSERT_EQ(array->GetNumberOfComponents(), static_cast<int>(expected.size()));
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    const double value = expected[static_cast<std::size_t>(c)];
    const bool isFloat = array->GetDataType() == VTK_FLOAT;
    EXPECT_EQ(array->GetComponent(k, c), isFloat ? static_cast<float>(value) : value)
      << "tuple " << k << ", component " << c;
  }
}

std::vector<double> GetTuple(vtkDataArray* array, vtkIdType k)
{
  std::vector<double> tuple(static_cast<std::size_t>(array->GetNumberOfComponents()));
  array->GetTuple(array->GetNumberOfTuples() == 1 ? 0 : k, tuple.data());
  return tuple;
}

std::vector<double> EvaluateTuple(
  vtkBRDF* brdf, const std::vector<double>& i, const std::vector<double>& o)
{
  std::vector<double> f(3);
  brdf->Evaluate(i.data(), o.data(), f.data());
  return f;
}

// Three of them against their scalar forms; i, o and u as the arrays give them.
void ExpectScalarValues(
  vtkBRDF* brdf, vtkDataArray* i, vtkDataArray* o, vtkDataArray* u, vtkDataArray* result)
{
  SCOPED_TRACE(brdf->GetClassName());
  const auto expect = [&](vtkDataArray* other, const auto& getExpected)
  {
    const vtkIdType count = std::max(other->GetNumberOfTuples(), o->GetNumberOfTuples());
    ASSERT_EQ(result->GetNumberOfTuples(), count);
    for (vtkIdType k = 0; k < count; ++k)
    {
      ExpectTuple(result, k, getExpected(GetTuple(other, k), GetTuple(o, k)));
    }
  };
  ASSERT_TRUE(brdf->EvaluateArray(i, o, result));
  expect(i, [&](const auto& light, const auto& view) { return EvaluateTuple(brdf, light, view); });
  ASSERT_TRUE(brdf->PdfArray(i, o, result));
  expect(i, [&](const auto& light, const auto& view)
    { return std::vector<double>{ brdf->Pdf(light.data(), view.data()) }; });
  ASSERT_TRUE(brdf->SampleArray(o, u, result));
  expect(u,
    [&](const auto& numbers, const auto& view)
    {
      std::vector<double> drawn(3);
      brdf->Sample(view.data(), numbers[0], numbers[1], drawn.data());
      return drawn;
    });
}

std::vector<vtkSmartPointer<vtkBRDF>> NewMaterials()
{
  auto lobe = vtkSmartPointer<vtkAshikhminShirleyBRDF>::New();
  lobe->SetExponents(40.0, 900.0); // anisotropic
  auto sum = vtkSmartPointer<vtkSumBRDF>::New();
  sum->AddTerm(vtkNew<vtkLambertBRDF>());
  sum->AddTerm(vtkNew<vtkDistributionBRDF>());
  return { lobe, sum };
}
} // namespace

TEST(Arrays, AreTheScalarCalls)
{
  const Tuples i = NewDirections(Count, 1), o = NewDirections(Count, 2), u = NewNumbers(Count);
  for (vtkBRDF* brdf : NewMaterials())
  {
    ExpectScalarValues(brdf, NewDoubles(i), NewDoubles(o), NewDoubles(u), vtkNew<vtkDoubleArray>());
    ExpectScalarValues(brdf, NewArray<vtkFloatArray>(i), NewArray<vtkFloatArray>(o),
      NewArray<vtkFloatArray>(u), vtkNew<vtkFloatArray>());
  }
  // Any layout and type.
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  ExpectScalarValues(brdf, NewArray<vtkSOADataArrayTemplate<double>>(i),
    NewArray<vtkSOADataArrayTemplate<float>>(o), NewArray<vtkSOADataArrayTemplate<double>>(u),
    vtkNew<vtkSOADataArrayTemplate<float>>());
  ExpectScalarValues(brdf, NewDoubles(i), NewArray<vtkIntArray>({ { 0.0, 1.0, 2.0 } }),
    NewArray<vtkFloatArray>(u), vtkNew<vtkSOADataArrayTemplate<double>>());
}

TEST(Arrays, OneTupleServesForAll)
{
  const auto many = NewDoubles(NewDirections(Count, 1));
  const auto one = NewArray<vtkFloatArray>({ { 0.3, 0.1, 0.5 } });
  const auto u = NewDoubles(NewNumbers(Count));
  const auto oneU = NewDoubles({ { 0.25, 0.75 } });
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
  vtkNew<vtkDoubleArray> albedos;
  for (vtkBRDF* brdf : NewMaterials())
  {
    ASSERT_TRUE(brdf->GetDirectionalAlbedoArray(NewDoubles(o), albedos));
    ASSERT_EQ(albedos->GetNumberOfTuples(), 4);
    for (vtkIdType k = 0; k < 4; ++k)
    {
      std::vector<double> albedo(3);
      brdf->GetDirectionalAlbedo(o[static_cast<std::size_t>(k)].data(), albedo.data());
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
  const auto one = NewDoubles({ { 0.0, 0.0, 1.0 } });
  ASSERT_TRUE(brdf->EvaluateArray(none, one, result)); // as arrays broadcast elsewhere
  EXPECT_EQ(result->GetNumberOfTuples(), 0);
}

TEST(Arrays, TheResultMayBeAnInput)
{
  const Tuples i = NewDirections(Count, 1), o = NewDirections(Count, 2);
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  const auto incoming = NewDoubles(i), outgoing = NewDoubles(o);
  ASSERT_TRUE(brdf->PdfArray(incoming, outgoing, incoming)); // of another size, too
  ASSERT_TRUE(brdf->EvaluateArray(outgoing, outgoing, outgoing));
  // As two NumPy views of one array do; memory of another owner is filled.
  const auto shared = NewDoubles(i);
  vtkNew<vtkDoubleArray> result;
  result->SetNumberOfComponents(3);
  result->SetArray(shared->GetPointer(0), 3 * static_cast<vtkIdType>(Count), 1);
  ASSERT_TRUE(brdf->EvaluateArray(shared, NewDoubles({ { 0.0, 0.0, 1.0 } }), result));
  EXPECT_EQ(result->GetPointer(0), shared->GetPointer(0));
  for (std::size_t k = 0; k < Count; ++k)
  {
    const auto at = static_cast<vtkIdType>(k);
    ExpectTuple(incoming, at, { brdf->Pdf(i[k].data(), o[k].data()) });
    ExpectTuple(outgoing, at, EvaluateTuple(brdf, o[k], o[k]));
    ExpectTuple(result, at, EvaluateTuple(brdf, i[k], { 0.0, 0.0, 1.0 }));
  }
}

TEST(Arrays, WhatDoesNotFitIsRefused)
{
  vtkNew<vtkLambertBRDF> brdf;
  ErrorCatcher errors(brdf);
  const auto seven = NewDoubles(NewDirections(7, 1)), six = NewDoubles(NewDirections(6, 1));
  const auto pairs = NewDoubles(NewNumbers(7));
  const auto result = NewDoubles({ { 5.0 } });
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
