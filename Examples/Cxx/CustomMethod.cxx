// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// A method of your own, with its GLSL: the irradiance of the environment in nine spherical
// harmonics (Ramamoorthi and Hanrahan, SIGGRAPH 2001), for Lambert materials. It needs no texture
// at all. Registered, it is one of the candidates of every planner: the program shows that it is
// chosen where it is accurate enough, and that a table is chosen where it is not.
//
//   CustomMethod [IMAGE.png]

#include <vtkActor.h>
#include <vtkBRDFShaderInputs.h>
#include <vtkCamera.h>
#include <vtkDoubleArray.h>
#include <vtkEnvironment.h>
#include <vtkLambertBRDF.h>
#include <vtkMeasuredBRDFMapper.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPNGWriter.h>
#include <vtkRadianceIntegrator.h>
#include <vtkRadianceMethods.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

constexpr double Pi = 3.14159265358979323846;

// Y_lm of the first three bands at n, each times its band's factor A_l of the cosine lobe.
void EvaluateHarmonics(const double n[3], double y[9])
{
  const double a0 = Pi, a1 = 2.0 * Pi / 3.0, a2 = Pi / 4.0;
  y[0] = a0 * 0.282095;
  y[1] = a1 * 0.488603 * n[1];
  y[2] = a1 * 0.488603 * n[2];
  y[3] = a1 * 0.488603 * n[0];
  y[4] = a2 * 1.092548 * n[0] * n[1];
  y[5] = a2 * 1.092548 * n[1] * n[2];
  y[6] = a2 * 0.315392 * (3.0 * n[2] * n[2] - 1.0);
  y[7] = a2 * 1.092548 * n[0] * n[2];
  y[8] = a2 * 0.546274 * (n[0] * n[0] - n[1] * n[1]);
}

class HarmonicsMethod : public vtkRadianceIntegrator
{
public:
  static HarmonicsMethod* New();
  vtkTypeMacro(HarmonicsMethod, vtkRadianceIntegrator);

  // What a planner asks: one candidate, for Lambert materials only, and what a pixel of it costs,
  // times a table's: less, as it fetches nothing.
  std::string GetMethodName() override { return "harmonics"; }
  std::string GetMethodDescription() override { return "irradiance in nine spherical harmonics"; }
  std::vector<std::vector<int>> GetCandidateSizes(bool) override
  {
    return vtkLambertBRDF::SafeDownCast(this->BRDF) ? std::vector<std::vector<int>>{ {} }
                                                    : std::vector<std::vector<int>>();
  }
  std::string GetSizesText() override { return "9 functions"; }
  double EstimateCost() override { return 0.55; }

  bool GetShaderInputs(vtkBRDFShaderInputs& inputs) override
  {
    if (!this->Prepare())
    {
      return false;
    }
    vtkBRDFShaderInputs::Term term;
    term.Shader = "harmonics";
    for (int k = 0; k < 9; ++k)
    {
      const std::string name = "harmonic" + std::to_string(k) + "x";
      term.Source += "uniform vec3 " + name + "INSTANCE;\n";
      term.Uniforms.push_back({ name,
        { static_cast<float>(this->Radiance[k][0]), static_cast<float>(this->Radiance[k][1]),
          static_cast<float>(this->Radiance[k][2]) } });
    }
    // The third column of frame is the normal in the environment's frame.
    term.Source += R"(
vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)
{
  vec3 n = frame[2];
  vec3 sum = 0.886227 * harmonic0xINSTANCE
    + 1.023328 * (n.y * harmonic1xINSTANCE + n.z * harmonic2xINSTANCE + n.x * harmonic3xINSTANCE)
    + 0.858086 * (n.x * n.y * harmonic4xINSTANCE + n.y * n.z * harmonic5xINSTANCE
                + n.x * n.z * harmonic7xINSTANCE)
    + 0.247708 * (3.0 * n.z * n.z - 1.0) * harmonic6xINSTANCE
    + 0.429043 * (n.x * n.x - n.y * n.y) * harmonic8xINSTANCE;
  return max(sum, vec3(0.0));
}
)";
    inputs = vtkBRDFShaderInputs();
    inputs.Terms.push_back(term);
    inputs.Description = "nine spherical harmonics";
    return true;
  }

protected:
  // The environment's coefficients, times f.
  bool Begin() override
  {
    const double up[3] = { 0.0, 0.0, 1.0 };
    double f[3];
    this->BRDF->Evaluate(up, up, f);
    std::fill(&this->Radiance[0][0], &this->Radiance[0][0] + 27, 0.0);
    const double bands[9] = { Pi, 2.0 * Pi / 3.0, 2.0 * Pi / 3.0, 2.0 * Pi / 3.0, Pi / 4.0,
      Pi / 4.0, Pi / 4.0, Pi / 4.0, Pi / 4.0 };
    for (int row = 0; row < this->Environment->GetHeight(); ++row)
    {
      for (int column = 0; column < this->Environment->GetWidth(); ++column)
      {
        double direction[3], rgb[3], y[9];
        this->Environment->GetTexelDirection(column, row, direction);
        this->Environment->GetPixel(column, row, rgb);
        EvaluateHarmonics(direction, y);
        for (int k = 0; k < 27; ++k)
        {
          this->Radiance[k / 3][k % 3] += f[k % 3] * rgb[k % 3] * y[k / 3] / bands[k / 3] *
                                          this->Environment->GetTexelSolidAngle(row);
        }
      }
    }
    return true;
  }

  void IntegratePair(const double n[3], const double*, const double*, double radiance[3]) override
  {
    double y[9];
    EvaluateHarmonics(n, y);
    for (int c = 0; c < 3; ++c)
    {
      double sum = 0.0;
      for (int k = 0; k < 9; ++k)
      {
        sum += y[k] * this->Radiance[k][c];
      }
      radiance[c] += std::max(sum, 0.0);
    }
  }

  double Radiance[9][3];
};
vtkStandardNewMacro(HarmonicsMethod);

int main(int argc, char* argv[])
{
  const std::string image = argc > 1 ? argv[1] : "CustomMethod.png";
  vtkNew<HarmonicsMethod> method;
  if (!vtkRadianceMethods::Register(method))
  {
    return EXIT_FAILURE;
  }

  vtkNew<vtkLambertBRDF> clay;
  clay->SetAlbedo(0.6, 0.35, 0.25);
  vtkNew<vtkEnvironment> sky;
  sky->SetToProceduralSky();
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  mapper->SetBRDF(clay);
  mapper->SetEnvironment(sky);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);

  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->ResetCamera();
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(200, 200);
  window->AddRenderer(renderer);

  // 0.1 %: a table. 10 %: the nine harmonics.
  mapper->SetErrorTolerance(0.01);
  window->Render();
  const std::string exacting = mapper->GetPlan();
  mapper->SetErrorTolerance(0.1);
  window->Render();
  const std::string easy = mapper->GetPlan();
  std::cout << exacting << "\n" << easy << "\n";
  if (exacting.find("table, ") != 0 || easy.find("harmonics, ") != 0)
  {
    std::cerr << "expected a table, then the harmonics\n";
    return EXIT_FAILURE;
  }

  // The pixel in the middle sees the normal +z. The mapper writes radiance^(1/2.2).
  vtkNew<vtkUnsignedCharArray> pixel;
  window->GetRGBACharPixelData(100, 100, 100, 100, 1, pixel);
  vtkNew<vtkDoubleArray> normal, radiance;
  normal->SetNumberOfComponents(3);
  normal->InsertNextTuple3(0.0, 0.0, 1.0);
  vtkRadianceIntegrator* drawn = mapper->GetCurrentIntegrator();
  if (!drawn || !drawn->Integrate(normal, normal, radiance))
  {
    return EXIT_FAILURE;
  }
  for (int c = 0; c < 3; ++c)
  {
    const double expected =
      255.0 * std::pow(std::min(radiance->GetComponent(0, c), 1.0), 1.0 / 2.2);
    if (std::abs(pixel->GetValue(c) - expected) > 1.5)
    {
      std::cerr << "the pixel shows " << int(pixel->GetValue(c)) << ", expected " << expected
                << "\n";
      return EXIT_FAILURE;
    }
  }

  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grabber->GetOutputPort());
  writer->SetFileName(image.c_str());
  writer->Write();
  return EXIT_SUCCESS;
}
