// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Models and integrators from outside the module, with GLSL text of their own: drawn where it is
// right; where it is wrong, one clear error and the superclass's picture.
#include "RenderFixture.h"
#include "vtkBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkSumBRDF.h"

#include <stdexcept>

namespace
{
const char* const RightTerm = R"(
uniform float brdfOwnINSTANCE;
vec3 brdfTermINSTANCE(vec3 i, vec3 o) { return vec3(brdfOwnINSTANCE * i.z * o.z, 0.1, 0.0); }
)";

// f = (value i.z o.z, 0.1, 0), or whatever its text says.
class OwnBRDF : public vtkBRDF
{
public:
  static OwnBRDF* New();
  vtkTypeMacro(OwnBRDF, vtkBRDF);
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override
  {
    if (this->Source.empty())
    {
      throw std::runtime_error("its own trouble");
    }
    vtkBRDFShaderInputs::Term term;
    term.Shader = "own term";
    term.Source = this->Source;
    term.Uniforms.push_back({ "brdfOwn", { 0.4f } });
    inputs.Terms.push_back(term);
  }
  std::string Source = RightTerm;

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    f[0] = 0.4 * i[2] * o[2];
    f[1] = 0.1;
    f[2] = 0.0;
  }
};
vtkStandardNewMacro(OwnBRDF);

// Radiance (0.25, 0.5, 0.75), or whatever its text says.
class OwnIntegrator : public vtkRadianceIntegrator
{
public:
  static OwnIntegrator* New();
  vtkTypeMacro(OwnIntegrator, vtkRadianceIntegrator);
  bool GetShaderInputs(vtkBRDFShaderInputs& inputs) override
  {
    vtkBRDFShaderInputs::Term term;
    term.Shader = "own integrator";
    term.Source = this->Source;
    inputs.Terms.push_back(term);
    return true;
  }
  std::string Source = "vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)\n"
                       "{\n  return vec3(0.25, 0.5, 0.75);\n}\n";

protected:
  void CopyProperties(vtkRadianceIntegrator* source) override
  {
    this->Source = static_cast<OwnIntegrator*>(source)->Source;
  }
  bool Begin() override { return true; }
  void IntegratePair(const double[3], const double[3], const double[3], double radiance[3]) override
  {
    radiance[0] += 0.25;
    radiance[1] += 0.5;
    radiance[2] += 0.75;
  }
};
vtkStandardNewMacro(OwnIntegrator);

class Extension : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-2.0, -2.0, 0.0);
    plane->SetPoint1(2.0, -2.0, 0.0);
    plane->SetPoint2(-2.0, 2.0, 0.0);
    this->Mapper->SetInputConnection(plane->GetOutputPort());
    this->Actor->SetMapper(this->Mapper);
    this->Actor->RotateY(30.0);
    this->Actor->GetProperty()->SetAmbient(1.0);
    this->Actor->GetProperty()->SetColor(0.3, 0.6, 0.9);
    this->Renderer->AddActor(this->Actor);
    const double direction[3] = { 0.0, 0.0, 1.0 };
    const double irradiance[3] = { 2.0, 2.0, 2.0 };
    this->Light->AddLight(direction, irradiance);
    this->Lights->SetLightSet(this->Light);
    this->Stock = this->RenderEncoded();
  }

  // Three frames of what is wrong: one error with these words, and the picture of no material.
  void ExpectStock(const std::string& words)
  {
    this->Errors.Count = 0;
    FloatImage image;
    for (int frame = 0; frame < 3; ++frame)
    {
      image = this->RenderEncoded();
    }
    EXPECT_EQ(this->Errors.Count, 1);
    EXPECT_EQ(this->Warnings.Count, 0);
    EXPECT_NE(this->Errors.Text.find(words), std::string::npos) << this->Errors.Text;
    EXPECT_EQ(image.RGBA, this->Stock.RGBA);
  }

  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkLightSet> Light;
  vtkNew<vtkLightSetRadianceIntegrator> Lights; // with that light
  vtkNew<OwnBRDF> Material;
  EventCounter Errors{ this->Mapper, vtkCommand::ErrorEvent };
  EventCounter Warnings{ this->Mapper, vtkCommand::WarningEvent };
  FloatImage Stock; // without a material
};
} // namespace

//------------------------------------------------------------------------------
TEST_F(Extension, ModelsAreDrawn)
{
  this->Mapper->SetBRDF(this->Material);
  this->Mapper->SetIntegrator(this->Lights);
  const FloatImage image = this->RenderLinear();
  const float* pixel = image.At(32, 32);
  const double c = std::cos(vtkMath::RadiansFromDegrees(30.0));
  EXPECT_NEAR(pixel[0], 2.0 * c * 0.4 * c * c, 1e-4);
  EXPECT_NEAR(pixel[1], 2.0 * c * 0.1, 1e-4);
  EXPECT_NEAR(pixel[2], 0.0, 1e-6);
}

//------------------------------------------------------------------------------
// Terms of one text in a sum do not meet; planned tables evaluate on the CPU.
TEST_F(Extension, ModelsAreSummedAndPlanned)
{
  vtkNew<vtkSumBRDF> sum;
  vtkNew<OwnBRDF> other;
  sum->AddTerm(this->Material);
  sum->AddTerm(other);
  this->Mapper->SetBRDF(sum);
  this->Mapper->SetIntegrator(this->Lights);
  const double c = std::cos(vtkMath::RadiansFromDegrees(30.0));
  EXPECT_NEAR(this->RenderLinear().RGBA[4 * (32 * 64 + 32) + 1], 2.0 * c * 0.2, 1e-4);

  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetBRDF(this->Material);
  vtkNew<vtkEnvironment> white;
  white->SetPixels(8, 4, std::vector<float>(96, 1.0f));
  this->Mapper->SetEnvironment(white);
  EXPECT_NEAR(this->RenderLinear().RGBA[4 * (32 * 64 + 32) + 1], 0.1 * vtkMath::Pi(),
    0.02 * 0.1 * vtkMath::Pi());
  EXPECT_EQ(this->Errors.Count, 0) << this->Errors.Text;
}

//------------------------------------------------------------------------------
TEST_F(Extension, WrongModelsAreSaidOnce)
{
  this->Mapper->SetIntegrator(this->Lights);
  this->Mapper->SetBRDF(this->Material);
  this->Material->Source = "vec3 brdfTermINSTANCE(vec3 i, vec3 o) { return nonsense; }\n";
  this->Material->Modified();
  this->ExpectStock("'own term': does not compile");
  this->Material->Source = "vec3 anotherName(vec3 i, vec3 o) { return i; }\n";
  this->Material->Modified();
  this->ExpectStock("no function brdfTermINSTANCE");
  this->Material->Source = "";
  this->Material->Modified();
  this->ExpectStock("its own trouble");

  this->Material->Source = RightTerm;
  this->Material->Modified();
  EXPECT_NEAR(this->RenderLinear().RGBA[4 * (32 * 64 + 32) + 2], 0.0, 1e-6); // mended
}

//------------------------------------------------------------------------------
TEST_F(Extension, IntegratorsAreDrawn)
{
  vtkNew<vtkEnvironment> white;
  white->SetPixels(8, 4, std::vector<float>(96, 1.0f));
  vtkNew<OwnIntegrator> integrator;
  this->Mapper->SetBRDF(this->Material);
  this->Mapper->SetEnvironment(white);
  this->Mapper->SetIntegrator(integrator);
  const FloatImage image = this->RenderLinear();
  EXPECT_NEAR(image.At(32, 32)[0], 0.25, 1e-4);
  EXPECT_NEAR(image.At(32, 32)[2], 0.75, 1e-4);
  EXPECT_EQ(integrator->GetBRDF(), nullptr); // the program's object stays as it was
  EXPECT_EQ(integrator->GetEnvironment(), nullptr);

  integrator->Source = "vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o) { return o.q; }\n";
  integrator->Modified();
  this->ExpectStock("'own integrator': does not compile");
}
