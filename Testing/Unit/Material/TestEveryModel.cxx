// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What every model promises of its data: snapshots are the same and no longer the original's; keys
// tell materials apart by their class, parameters and data.

#include "EveryModel.h"
#include "LowDiscrepancy.h"
#include "TestDirections.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFModels.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace
{
/// What inherits a model and says nothing of its own.
class HalfPhong : public vtkBlinnPhongBRDF
{
public:
  static HalfPhong* New();
  vtkTypeMacro(HalfPhong, vtkBlinnPhongBRDF);

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    this->Superclass::EvaluateAbove(i, o, f);
    f[0] *= 0.5;
  }
};
vtkStandardNewMacro(HalfPhong);

// One without even a name of its own.
class NamelessBRDF : public vtkLambertBRDF
{
public:
  static NamelessBRDF* New() { VTK_STANDARD_NEW_BODY(NamelessBRDF); }
};

std::vector<float> MakeUneven(std::size_t count)
{
  std::vector<float> values;
  for (std::size_t k = 0; k < count; ++k)
  {
    values.push_back(0.2f + 0.1f * static_cast<float>(k % 7));
  }
  return values;
}

std::vector<vtkSmartPointer<vtkBRDF>> MakeAllModels()
{
  std::vector<vtkSmartPointer<vtkBRDF>> all = testio::MakeEveryModel(MakeUneven);
  auto zonal = vtkSmartPointer<vtkBasisBRDF>::New();
  const double in[2] = { 9.0, 57.0 }, out[2] = { 9.0, 60.0 };
  EXPECT_EQ(zonal->SetCoefficients(vtkBasisBRDF::ZONAL, 1, in, out, 3, 1, MakeUneven(36)), "");
  all.emplace_back(zonal);
  EXPECT_EQ(all.size(), 13u);
  return all;
}

std::vector<double> GetValues(vtkBRDF* brdf)
{
  brdf->Prepare();
  std::vector<double> values;
  const auto draw = [](unsigned int k, unsigned int base)
  {
    return FromAngles(std::acos(1.0 - 0.95 * measuredbrdf::RadicalInverse(k, base)),
      6.28 * measuredbrdf::RadicalInverse(k, base + 2));
  };
  for (unsigned int k = 1; k <= 50; ++k)
  {
    const glm::dvec3 i = draw(k, 3), o = draw(k, 5);
    glm::dvec3 soft;
    brdf->EvaluateSoft(&i.x, &o.x, 0.05, &soft.x);
    const glm::dvec3 f = Evaluate(brdf, i, o);
    values.insert(values.end(), { f.x, f.y, f.z, soft.x, soft.y, soft.z, brdf->Pdf(&i.x, &o.x) });
  }
  return values;
}

/// Puts data into a material that is there.
class Loading : public vtkBRDFExchange
{
public:
  explicit Loading(vtkBRDFData& data)
    : vtkBRDFExchange(data, true)
  {
  }

protected:
  void SaveTerm(vtkBRDF*, vtkBRDFData&) override {}
  void LoadTerm(vtkBRDFData&, const std::function<void(vtkBRDF*)>& add) override
  {
    add(vtkNew<vtkLambertBRDF>());
  }
};

// Data that differ in one number, choice or value, with its name; not all of them are good.
std::vector<std::pair<std::string, vtkBRDFData>> Vary(const vtkBRDFData& data)
{
  std::vector<std::pair<std::string, vtkBRDFData>> all;
  const char* choices[] = { "on", "off", "float32", "shared-exponent", "incident-outgoing",
    "half-turn", "full-turn", "schlick", "legendre-fourier", "zonal" };
  for (const auto& [name, option] : data.Options)
  {
    for (const char* choice : choices)
    {
      all.emplace_back(name, data);
      all.back().second.Options[name] = choice;
      if (option == choice)
      {
        all.pop_back();
      }
    }
  }
  for (const auto& [name, numbers] : data.Numbers)
  {
    for (std::size_t k = 0; k < numbers.size(); ++k)
    {
      all.emplace_back(name, data);
      double& number = all.back().second.Numbers[name][k];
      number = std::nextafter(number, 0.2637);
    }
  }
  for (const auto& [name, array] : data.Arrays)
  {
    for (std::size_t k = 0; k < array.Values.size(); ++k)
    {
      const float value = array.Values[k];
      all.emplace_back(name, data); // a ring that ends at 90 degrees stays
      all.back().second.Arrays[name].Values[k] =
        value == 90.0f ? NAN : std::nextafter(value, 0.2637f);
    }
  }
  return all;
}

bool IsWhole(const std::string& name)
{
  return name == "nodes" || name == "children" || name == "order" ||
         name.find("Patches") != std::string::npos;
}
}

TEST(EveryModel, SnapshotsAreTheSameAndIndependent)
{
  for (vtkBRDF* original : MakeAllModels())
  {
    SCOPED_TRACE(original->GetClassName());
    original->SetName("one");
    original->SetSource("somewhere");
    original->SetResamplingTolerance(0.02);
    auto snapshot = vtkSmartPointer<vtkBRDF>::Take(original->NewSnapshot());
    ASSERT_TRUE(snapshot);
    EXPECT_NE(snapshot.Get(), original);
    EXPECT_STREQ(snapshot->GetClassName(), original->GetClassName());
    EXPECT_EQ(snapshot->GetName(), "one");
    EXPECT_EQ(snapshot->GetSource(), "somewhere");
    EXPECT_EQ(snapshot->GetResamplingTolerance(), 0.02);
    EXPECT_EQ(snapshot->IsIsotropic(), original->IsIsotropic());
    const std::string key = vtkBRDFModels::GetContentKey(original);
    EXPECT_EQ(vtkBRDFModels::GetContentKey(snapshot), key);
    const std::vector<double> values = GetValues(snapshot);
    EXPECT_EQ(values, GetValues(original));
    // All that it holds changes.
    vtkBRDFData data;
    ASSERT_EQ(vtkBRDFModels::Save(original, data), "");
    for (auto& [name, numbers] : data.Numbers)
    {
      for (double& number : numbers)
      {
        number *= name == "specular" || name == "diffuse" || name == "albedo" ? 0.5 : 1.0;
      }
    }
    for (auto& [name, array] : data.Arrays)
    {
      for (float& value : array.Values)
      {
        value *= IsWhole(name) || name.find("heta") != std::string::npos ||
                     name.find("hi") != std::string::npos
                   ? 1.0f
                   : 0.5f;
      }
    }
    Loading loading(data);
    original->ExchangeData(loading);
    EXPECT_NE(values, GetValues(original));
    EXPECT_EQ(values, GetValues(snapshot));
    EXPECT_EQ(vtkBRDFModels::GetContentKey(snapshot), key);
  }
}

// Every parameter and every value counts; names and where the material is from do not.
TEST(EveryModel, EverythingThatCountsChangesTheKey)
{
  std::set<std::string> keys, varied;
  for (vtkBRDF* original : MakeAllModels())
  {
    vtkBRDFData data;
    ASSERT_EQ(vtkBRDFModels::Save(original, data), "");
    SCOPED_TRACE(data.Model);
    EXPECT_TRUE(keys.insert(vtkBRDFModels::GetContentKey(original)).second);
    const auto isLeftOut = [&data](const std::string& name) // this basis has no zone of its own
    {
      return IsWhole(name) ||
             (data.Options["basis"] == "hemispherical" && name.find("incident") == 0);
    };
    for (auto& [name, changed] : Vary(data))
    {
      vtkSmartPointer<vtkBRDF> brdf;
      if (isLeftOut(name) || !vtkBRDFModels::Load(changed, brdf).empty())
      {
        continue;
      }
      varied.insert(data.Model + "." + name);
      const std::string key = vtkBRDFModels::GetContentKey(brdf);
      EXPECT_EQ(key.size(), 32u);
      EXPECT_TRUE(keys.insert(key).second) << name;
      const auto copy = vtkSmartPointer<vtkBRDF>::Take(brdf->NewSnapshot());
      ASSERT_TRUE(copy);
      copy->SetName("another");
      copy->SetSource("elsewhere");
      EXPECT_EQ(vtkBRDFModels::GetContentKey(copy), key) << name;
    }
    for (const auto& [name, numbers] : data.Numbers)
    {
      EXPECT_TRUE(isLeftOut(name) || varied.count(data.Model + "." + name)) << name;
    }
    for (const auto& [name, array] : data.Arrays)
    {
      const bool isRing = array.Values == std::vector<float>(1, 90.0f);
      EXPECT_TRUE(isRing || IsWhole(name) || varied.count(data.Model + "." + name)) << name;
    }
  }
  for (const char* option :
    { "AshikhminShirley.fresnelModel", "Tabulated.precision", "Tabulated.cosineWeighted",
      "Tabulated.parameterization", "Tabulated.azimuthRange", "AnisotropicTabulated.cosineWeighted",
      "AnisotropicTabulated.azimuthRange", "Basis.basis", "Basis.incidentCosine",
      "Basis.outgoingCosine", "Basis.incidentBegin", "Basis.incidentEnd", "AdaptiveWarp.jacobian" })
  {
    EXPECT_TRUE(varied.count(option)) << option;
  }
}

TEST(EveryModel, SumsAreTheirTerms)
{
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkBlinnPhongBRDF> phong;
  std::set<std::string> keys;
  vtkNew<vtkSumBRDF> sum, turned;
  keys.insert(vtkBRDFModels::GetContentKey(sum));
  sum->AddTerm(lambert);
  keys.insert(vtkBRDFModels::GetContentKey(sum));
  sum->AddTerm(phong);
  keys.insert(vtkBRDFModels::GetContentKey(sum));
  turned->AddTerm(phong);
  turned->AddTerm(lambert); // another form for the GPU
  keys.insert(vtkBRDFModels::GetContentKey(turned));
  EXPECT_EQ(keys.size(), 4u);
  const auto snapshot = vtkSmartPointer<vtkBRDF>::Take(sum->NewSnapshot());
  const std::vector<double> values = GetValues(snapshot);
  phong->SetExponent(3.0);
  EXPECT_NE(values, GetValues(sum));
  EXPECT_EQ(values, GetValues(snapshot));
}

TEST(EveryModel, WhatSaysNothingHasNeitherKeyNorSnapshot)
{
  vtkNew<HalfPhong> half;
  EXPECT_EQ(half->NewSnapshot(), nullptr);
  EXPECT_EQ(vtkBRDFModels::GetContentKey(half), "");
  EXPECT_EQ(vtkBRDFModels::GetContentKey(vtkSmartPointer<NamelessBRDF>::New()), "");
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(vtkNew<vtkLambertBRDF>());
  EXPECT_NE(vtkBRDFModels::GetContentKey(sum), "");
  sum->AddTerm(half);
  EXPECT_EQ(sum->NewSnapshot(), nullptr);
  EXPECT_EQ(vtkBRDFModels::GetContentKey(sum), "");
}

TEST(EnvironmentSnapshots, ShareWhatNeverChanges)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetPixels(4, 2, std::vector<float>(24, 1.0f));
  environment->SetRotationY(30.0);
  environment->SetName("room");
  auto snapshot = vtkSmartPointer<vtkEnvironment>::Take(environment->NewSnapshot());
  EXPECT_EQ(snapshot->GetName(), "room");
  EXPECT_EQ(&snapshot->GetPixels(), &environment->GetPixels()); // not twice in memory
  double before[9], after[9];
  environment->GetWorldToEnvironment(before);
  environment->SetRotationY(60.0);
  snapshot->GetWorldToEnvironment(after);
  EXPECT_EQ(std::vector<double>(before, before + 9), std::vector<double>(after, after + 9));
  const vtkMTimeType time = snapshot->GetPixelsMTime();
  environment->SetPixels(2, 1, std::vector<float>(6, 2.0f));
  EXPECT_EQ(snapshot->GetWidth(), 4);
  EXPECT_EQ(snapshot->GetPixels(), std::vector<float>(24, 1.0f));
  EXPECT_EQ(snapshot->GetPixelsMTime(), time);
}
