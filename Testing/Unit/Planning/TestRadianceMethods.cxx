// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The list of methods: what each says of itself, copies, and methods of a program's own.
#include "ErrorCatcher.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRadianceMethods.h"
#include "vtkRadiancePlanner.h"
#include "vtkTableRadianceIntegrator.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{
/// What a Lambert material of albedo 0.5 reflects of white light; half of that in one step.
class WhiteMethod : public vtkRadianceIntegrator
{
public:
  static WhiteMethod* New();
  vtkTypeMacro(WhiteMethod, vtkRadianceIntegrator);
  std::string GetMethodName() override { return this->Name; }
  std::vector<Size> GetSizes() override
  {
    const auto set = [this](int value)
    {
      this->Steps = value;
      this->Modified();
    };
    return { { "steps", 1, 4, this->Steps, set } };
  }
  std::vector<std::vector<int>> GetCandidateSizes(bool) override { return { { 1 }, { 2 } }; }
  double EstimateCost() override { return 0.1 * this->Steps; }
  std::string Name = "white";
  bool Works = true;

protected:
  void CopyProperties(vtkRadianceIntegrator* source) override
  {
    this->Superclass::CopyProperties(source);
    auto* white = static_cast<WhiteMethod*>(source);
    this->Name = white->Name;
    this->Works = white->Works;
  }
  bool Begin() override
  {
    if (!this->Works)
    {
      vtkErrorMacro("Prepare: out of white.");
    }
    return this->Works;
  }
  void IntegratePart(
    int, const double[3], const double[3], const double[3], double radiance[3]) override
  {
    for (int c = 0; c < 3; ++c)
    {
      radiance[c] += this->Steps > 1 ? 0.5 : 0.25;
    }
  }
  int Steps = 1;
};
vtkStandardNewMacro(WhiteMethod);

/// In the list while it lives.
class Registered
{
public:
  explicit Registered(vtkRadianceIntegrator* method)
    : Method(method)
    , Done(vtkRadianceMethods::Register(method))
  {
  }
  ~Registered() { vtkRadianceMethods::Unregister(this->Method); }
  vtkRadianceIntegrator* Method;
  bool Done;
};

std::map<std::string, std::string> GetProperties(vtkObject* object)
{
  std::ostringstream text;
  object->Print(text);
  std::istringstream lines(text.str());
  std::map<std::string, std::string> properties;
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos)
    {
      properties[line.substr(line.find_first_not_of(' '), colon - line.find_first_not_of(' '))] =
        line.substr(colon + 2);
    }
  }
  return properties;
}

// Every property but what belongs to the object, its inputs and its last run.
void ExpectCopied(vtkRadianceIntegrator* changed, const std::set<std::string>& results)
{
  const auto copy = vtkSmartPointer<vtkRadianceIntegrator>::Take(changed->NewCopy());
  const auto fresh = vtkSmartPointer<vtkRadianceIntegrator>::Take(changed->NewInstance());
  const auto set = GetProperties(changed);
  const auto copied = GetProperties(copy);
  const auto defaults = GetProperties(fresh);
  const std::set<std::string> others = { "Debug", "Modified Time", "Reference Count",
    "Registered Events", "BRDF", "Environment", "Abort" };
  int compared = 0;
  for (const auto& [name, value] : set)
  {
    if (others.count(name) > 0 || results.count(name) > 0)
    {
      continue;
    }
    ++compared;
    EXPECT_NE(value, defaults.at(name)) << name << " is not set by this test";
    EXPECT_EQ(value, copied.at(name)) << name << " is not copied";
  }
  EXPECT_GT(compared, 0);
}

vtkSmartPointer<vtkRadiancePlanner> NewPlanner()
{
  vtkNew<vtkLambertBRDF> brdf;
  brdf->SetAlbedo(0.5, 0.5, 0.5);
  vtkNew<vtkEnvironment> white;
  white->SetPixels(32, 16, std::vector<float>(3 * 32 * 16, 1.0f));
  auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
  planner->SetBRDF(brdf);
  planner->SetEnvironment(white);
  planner->SetErrorTolerance(0.05);
  return planner;
}
}

//------------------------------------------------------------------------------
TEST(RadianceMethods, SayWhatTheyAre)
{
  EXPECT_EQ(
    vtkRadianceMethods::GetNames(), "table, hybrid, light-set, filtered, reference or exact");
  for (const auto& method : vtkRadianceMethods::GetMethods())
  {
    const std::string name = method->GetMethodName();
    EXPECT_TRUE(vtkRadianceMethods::IsBuiltIn(name));
    EXPECT_NE(method->GetMethodDescription(), "") << name;
    const auto made =
      vtkSmartPointer<vtkRadianceIntegrator>::Take(vtkRadianceMethods::NewIntegrator(name));
    ASSERT_TRUE(made);
    EXPECT_STREQ(made->GetClassName(), method->GetClassName());
    EXPECT_NE(made.Get(), method.Get());
    // The ends of each range are taken as they are; what lies outside changes nothing.
    std::vector<int> values;
    for (const auto& size : made->GetSizes())
    {
      values.push_back(size.Value);
    }
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      const auto size = made->GetSizes()[k];
      std::vector<int> other = values;
      for (const int end : { size.Least, size.Largest })
      {
        other[k] = end;
        EXPECT_TRUE(made->SetSizes(other)) << name << " " << size.Name;
        EXPECT_EQ(made->GetSizes()[k].Value, end) << name << " " << size.Name;
      }
      ErrorCatcher errors(made);
      for (const int wrong : { size.Least - 1, size.Largest + 1 })
      {
        other[k] = wrong;
        EXPECT_FALSE(made->SetSizes(other)) << name << " " << size.Name;
        EXPECT_EQ(made->GetSizes()[k].Value, size.Largest);
      }
      EXPECT_EQ(errors.Take(), 2);
      made->SetSizes(values);
    }
    ErrorCatcher errors(made);
    values.push_back(1);
    EXPECT_FALSE(made->SetSizes(values)) << name;
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_GT(made->EstimateCost(), 0.0) << name;
  }
  EXPECT_EQ(vtkRadianceMethods::NewIntegrator("none"), nullptr);
}

//------------------------------------------------------------------------------
TEST(RadianceMethods, CopiesHaveEveryProperty)
{
  vtkNew<vtkTableRadianceIntegrator> table;
  table->SetNumberOfRows(21);
  table->SetNumberOfViewAngles(5);
  table->SetNumberOfAzimuths(6);
  table->SetNumberOfViewAzimuths(7);
  table->SetNumberOfMaps(3);
  table->SetNumberOfMapRows(33);
  table->SetSmoothingDegree(3.0);
  table->SetNumberOfNodes(40);
  table->QuickOn();
  ExpectCopied(table, {});
  vtkNew<vtkHybridRadianceIntegrator> hybrid;
  hybrid->SetNumberOfRows(21);
  hybrid->SetNumberOfViewAngles(5);
  hybrid->SetNumberOfAzimuths(6);
  hybrid->SetNumberOfMaps(3);
  hybrid->SetMaximumNumberOfLights(7);
  hybrid->SetLightAngle(0.33);
  hybrid->QuickOn();
  ExpectCopied(hybrid, { "Lights" });
  vtkNew<vtkFilteredRadianceIntegrator> filtered;
  filtered->SetNumberOfSamples(5);
  ExpectCopied(filtered, { "Extracted lights" });
  vtkNew<vtkLightSetRadianceIntegrator> lights;
  lights->SetGenerator(vtkNew<vtkMedianCutLightSetGenerator>());
  lights->SetNumberOfLights(32);
  lights->SetLightSet(vtkNew<vtkLightSet>());
  lights->SoftLightsOn();
  lights->UnrolledOn();
  ExpectCopied(lights, { "CurrentLightSet" });
}

//------------------------------------------------------------------------------
TEST(RadianceMethods, RegisterRefuses)
{
  vtkNew<WhiteMethod> method;
  vtkObject::GlobalWarningDisplayOff();
  EXPECT_FALSE(vtkRadianceMethods::Register(nullptr));
  for (const char* name : { "table", "Two words", "", "caf\xc3\xa9" })
  {
    method->Name = name;
    EXPECT_FALSE(vtkRadianceMethods::Register(method)) << name;
  }
  method->Name = "white";
  EXPECT_TRUE(vtkRadianceMethods::Register(method));
  EXPECT_FALSE(vtkRadianceMethods::Register(method));
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_FALSE(vtkRadianceMethods::IsBuiltIn("white"));
  EXPECT_NE(vtkRadianceMethods::GetNames().find("white"), std::string::npos);
  EXPECT_TRUE(vtkRadianceMethods::Unregister(method));
  EXPECT_FALSE(vtkRadianceMethods::Unregister(method));
  EXPECT_EQ(vtkRadianceMethods::NewIntegrator("white"), nullptr);
}

//------------------------------------------------------------------------------
// Of a program's own method, sizes that are too coarse are tried and passed over.
TEST(RadianceMethods, PlannersTryThem)
{
  const auto planner = NewPlanner();
  ASSERT_TRUE(planner->Update());
  EXPECT_EQ(planner->GetMethodName(planner->GetChoice()), "table");
  vtkNew<WhiteMethod> method;
  const Registered registered(method);
  ASSERT_TRUE(registered.Done);
  planner->SetErrorTolerance(0.04); // a change: it plans again
  ASSERT_TRUE(planner->Update());
  ASSERT_EQ(planner->GetNumberOfCandidates(), 2);
  EXPECT_EQ(planner->GetDescription(0), "1 steps");
  EXPECT_NEAR(planner->GetPredictedError(0), 0.5, 0.03);
  EXPECT_EQ(planner->GetPredictedCost(0), 0.1);
  EXPECT_EQ(planner->GetDescription(1), "2 steps");
  EXPECT_NEAR(planner->GetPredictedError(1), 0.0, 0.02);
  ASSERT_EQ(planner->GetChoice(), 1);
  EXPECT_EQ(planner->GetMethodName(1), "white");
  const auto made = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
  EXPECT_TRUE(WhiteMethod::SafeDownCast(made));
}

//------------------------------------------------------------------------------
TEST(RadianceMethods, WhatFailsIsLeftOutWithAWarning)
{
  const auto planner = NewPlanner();
  vtkNew<WhiteMethod> method;
  method->Works = false;
  const Registered registered(method);
  std::string said;
  vtkNew<vtkCallbackCommand> listen;
  listen->SetClientData(&said);
  listen->SetCallback([](vtkObject*, unsigned long, void* data, void* text)
    { *static_cast<std::string*>(data) += static_cast<const char*>(text); });
  planner->AddObserver(vtkCommand::WarningEvent, listen);
  ASSERT_TRUE(planner->Update());
  EXPECT_EQ(planner->GetMethodName(planner->GetChoice()), "table");
  EXPECT_NE(said.find("white, 1 steps"), std::string::npos) << said;
  EXPECT_NE(said.find("out of white"), std::string::npos) << said;
}
