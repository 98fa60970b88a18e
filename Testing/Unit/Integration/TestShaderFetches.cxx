// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// How many textures a pixel fetches, as methods and materials say it, against their own GLSL text:
// every fetch in a function counts as often as the function is called.
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkDistributionBRDF.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkTabulatedBRDF.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace
{
// Of a text whose loops, if there are any, count once. evaluations: how often brdfEvaluate is
// called, which is not in the text.
class FetchCounter
{
public:
  explicit FetchCounter(const vtkBRDFShaderInputs::Term& term)
  {
    std::string text = std::regex_replace(term.Source, std::regex("//[^\n]*"), "");
    for (const vtkBRDFShaderInputs::Constant& constant : term.Constants)
    {
      text = std::regex_replace(text, std::regex("\\b" + constant.Name + "\\b"), constant.Value);
    }
    text = std::regex_replace(text, std::regex(R"(if \(0 != 0\)\s*\{[^}]*\})"), "");
    const std::regex head(R"((?:vec[234]|float|void)\s+(\w+)\([^)]*\)\s*\{)");
    for (std::sregex_iterator it(text.begin(), text.end(), head), end; it != end; ++it)
    {
      std::size_t at = static_cast<std::size_t>(it->position() + it->length());
      const std::size_t first = at;
      for (int depth = 1; depth > 0 && at < text.size(); ++at)
      {
        depth += text[at] == '{' ? 1 : text[at] == '}' ? -1 : 0;
      }
      this->Bodies[(*it)[1]] = text.substr(first, at - first);
    }
  }

  int Count(const std::string& function, bool evaluations = false) const
  {
    const std::string& body = this->Bodies.at(function);
    const std::regex call(R"(\b(\w+)\()");
    int count = 0;
    for (std::sregex_iterator it(body.begin(), body.end(), call), end; it != end; ++it)
    {
      const std::string name = (*it)[1];
      const bool isFetch = name == "texture" || name == "texelFetch";
      const bool isEvaluation = name == "brdfEvaluate";
      count += evaluations ? isEvaluation : isFetch;
      count += this->Bodies.count(name) > 0 ? this->Count(name, evaluations) : 0;
    }
    return count;
  }

private:
  std::map<std::string, std::string> Bodies;
};

vtkSmartPointer<vtkBRDF> NewMaterial(const char* name)
{
  return vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
}

vtkSmartPointer<vtkEnvironment> NewEnvironment(const char* name)
{
  return vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment(name));
}
}

TEST(ShaderFetches, Materials)
{
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkAshikhminShirleyBRDF> closed;
  vtkNew<vtkDistributionBRDF> distribution;
  vtkNew<vtkTabulatedBRDF> half;
  vtkNew<vtkTabulatedBRDF> both;
  vtkNew<vtkTabulatedBRDF> brushed;
  const int size[3] = { 2, 2, 2 };
  const int four[4] = { 2, 2, 1, 2 };
  ASSERT_TRUE(half->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, 0, size, std::vector<float>(24)));
  ASSERT_TRUE(brushed->SetVolume(0, four, std::vector<float>(24)));
  ASSERT_TRUE(
    both->SetVolume(vtkTabulatedBRDF::INCIDENT_OUTGOING, 0, size, std::vector<float>(24)));
  const std::pair<vtkBRDF*, int> expected[] = { { lambert, 0 }, { closed, 0 }, { distribution, 2 },
    { half, 1 }, { both, 1 }, { brushed, 2 } };
  for (const auto& [brdf, fetches] : expected)
  {
    vtkBRDFShaderInputs inputs;
    brdf->GetShaderInputs(inputs);
    ASSERT_EQ(inputs.Terms.size(), 1u);
    EXPECT_EQ(inputs.Terms[0].Fetches, fetches) << brdf->GetClassName();
    EXPECT_TRUE(brdf->IsRenderable() && brdf->GetRenderable() == brdf) << brdf->GetClassName();
    EXPECT_EQ(FetchCounter(inputs.Terms[0]).Count("brdfTermINSTANCE"), fetches)
      << brdf->GetClassName();
  }
}

// What inputs say is what their text does.
TEST(ShaderFetches, Methods)
{
  const auto metal = NewMaterial("nickel");
  const auto felt = NewMaterial("pink-felt");
  const auto room = NewEnvironment("room"); // with lamps
  const auto sky = NewEnvironment("sky");
  vtkNew<vtkTableRadianceIntegrator> table;
  table->SetSizes({ 17, 4, 8 });
  vtkNew<vtkTableRadianceIntegrator> tiles;
  tiles->SetSizes({ 137, 2, 4 });
  vtkNew<vtkTableRadianceIntegrator> factored;
  factored->SetSizes({ 9, 4, 8 });
  factored->SetNumberOfMaps(5);
  factored->SetNumberOfMapRows(32);
  vtkNew<vtkHybridRadianceIntegrator> hybrid;
  hybrid->SetSizes({ 32, 4, 8, 4 });
  vtkNew<vtkHybridRadianceIntegrator> lights; // one or two
  lights->SetSizes({ 17, 4, 8, 0 });
  const struct
  {
    vtkRadianceIntegrator* Integrator;
    vtkEnvironment* Environment;
    vtkBRDF* BRDF;
  } cases[] = { { table, sky, metal }, { table, sky, felt }, { tiles, room, metal },
    { factored, room, metal }, { hybrid, room, metal }, { lights, sky, metal } };
  for (const auto& [integrator, environment, brdf] : cases)
  {
    ASSERT_TRUE(brdf && environment);
    integrator->SetBRDF(brdf);
    integrator->SetEnvironment(environment);
    vtkBRDFShaderInputs inputs;
    ASSERT_TRUE(integrator->GetShaderInputs(inputs)) << integrator->GetClassName();
    for (const vtkBRDFShaderInputs::Term& term : inputs.Terms)
    {
      const FetchCounter counter(term);
      EXPECT_EQ(term.Fetches, counter.Count("brdfEnvironmentINSTANCE")) << inputs.Description;
      EXPECT_EQ(term.Evaluations, counter.Count("brdfEnvironmentINSTANCE", true))
        << inputs.Description;
    }
  }
}

TEST(ShaderFetches, EachLightEvaluatesTheMaterial)
{
  vtkBRDFShaderInputs method;
  method.Terms.resize(2);
  method.Terms[0].Fetches = 4;
  method.Terms[1].Evaluations = 3;
  vtkBRDFShaderInputs material;
  material.Terms.resize(2);
  material.Terms[0].Fetches = 1;
  material.Terms[1].Fetches = 2;
  EXPECT_EQ(method.CountFetches(material), 4 + 3 * 3);
  EXPECT_EQ(method.CountFetches({}), 4);
}
