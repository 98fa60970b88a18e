// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// A BRDF model of your own, with its GLSL: Oren and Nayar's rough diffuse reflection (SIGGRAPH
// 1994), in Fujii's form. The mapper draws it by every method; the program checks a pixel. Files
// keep it as it is: the program writes it to an OpenEXR material and reads it again.
//
//   CustomModel [IMAGE.png [MATERIAL.exr]]

#include <vtkActor.h>
#include <vtkBRDF.h>
#include <vtkBRDFExchange.h>
#include <vtkBRDFModels.h>
#include <vtkBRDFReader.h>
#include <vtkBRDFShaderInputs.h>
#include <vtkBRDFWriter.h>
#include <vtkCamera.h>
#include <vtkLightSet.h>
#include <vtkLightSetRadianceIntegrator.h>
#include <vtkMeasuredBRDFMapper.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

constexpr double Pi = 3.14159265358979323846;

class OrenNayarBRDF : public vtkBRDF
{
public:
  static OrenNayarBRDF* New();
  vtkTypeMacro(OrenNayarBRDF, vtkBRDF);

  vtkSetClampMacro(Roughness, double, 0.0, 1.0);
  vtkGetMacro(Roughness, double);

  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override
  {
    vtkBRDFShaderInputs::Term term;
    term.Shader = "OrenNayar";
    term.Source = R"(
uniform vec3 orenNayarINSTANCE; // albedo / pi, A, B

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  float s = dot(i, o) - i.z * o.z;
  float t = s > 0.0 ? max(i.z, o.z) : 1.0;
  return vec3(orenNayarINSTANCE.x * (orenNayarINSTANCE.y + orenNayarINSTANCE.z * s / t));
}
)";
    term.Uniforms.push_back(
      { "orenNayar", { static_cast<float>(Albedo / Pi), static_cast<float>(this->GetA()),
                       static_cast<float>(this->GetB()) } });
    inputs.Terms.push_back(term);
    inputs.Description = "Oren-Nayar, closed form";
  }

  std::string GetModelName() override { return "OrenNayar"; }
  void ExchangeData(vtkBRDFExchange& exchange) override
  {
    exchange.Number(
      "roughness", this->Roughness, [this](double value) { this->SetRoughness(value); });
  }

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    const double s = i[0] * o[0] + i[1] * o[1];
    const double t = s > 0.0 ? std::max(i[2], o[2]) : 1.0;
    f[0] = f[1] = f[2] = Albedo / Pi * (this->GetA() + this->GetB() * s / t);
  }

  double GetA() const { return 1.0 / (1.0 + (Pi / 2.0 - 2.0 / 3.0) * this->Roughness); }
  double GetB() const { return this->Roughness * this->GetA(); }

  static constexpr double Albedo = 0.8;
  double Roughness = 0.8;
};
vtkStandardNewMacro(OrenNayarBRDF);

// Whether a file gives the same material back.
bool IsKept(OrenNayarBRDF* brdf, const std::string& path)
{
  vtkNew<vtkBRDFWriter> writer;
  writer->SetFileName(path);
  writer->SetBRDF(brdf);
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(path);
  if (!writer->Write() || !reader->Read())
  {
    return false;
  }
  OrenNayarBRDF* read = OrenNayarBRDF::SafeDownCast(reader->GetBRDF());
  return read && read->GetRoughness() == brdf->GetRoughness();
}

int main(int argc, char* argv[])
{
  const std::string image = argc > 1 ? argv[1] : "CustomModel.png";

  // A plane at 45 degrees to both the viewer and a light behind the viewer.
  vtkNew<vtkPlaneSource> plane;
  vtkNew<OrenNayarBRDF> brdf;
  brdf->SetRoughness(0.6);
  vtkNew<vtkLightSet> light;
  const double direction[3] = { 0.0, 0.0, 1.0 };
  const double irradiance[3] = { 2.0, 2.0, 2.0 };
  light->AddLight(direction, irradiance);

  vtkNew<vtkLightSetRadianceIntegrator> lights;
  lights->SetLightSet(light);
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  mapper->SetBRDF(brdf);
  mapper->SetIntegrator(lights);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->RotateY(45.0);

  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->ResetCamera();
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(200, 200);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkUnsignedCharArray> pixel;
  window->GetRGBACharPixelData(100, 100, 100, 100, 0, pixel);
  const double c = std::sqrt(0.5);
  const double o[3] = { c, 0.0, c };
  double f[3];
  brdf->Evaluate(o, o, f);
  const double expected = 255.0 * std::pow(f[0] * c * irradiance[0], 1.0 / 2.2);
  std::cout << "pixel " << static_cast<int>(pixel->GetValue(0)) << ", expected " << expected
            << "\n";

  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grab->GetOutputPort());
  writer->SetFileName(image.c_str());
  writer->Write();

  vtkBRDFModels::Register(vtkSmartPointer<OrenNayarBRDF>::New());
  const bool kept = IsKept(brdf, argc > 2 ? argv[2] : "CustomModel.exr");
  std::cout << "the file " << (kept ? "keeps" : "does not keep") << " the model\n";
  return kept && std::abs(pixel->GetValue(0) - expected) < 1.5 ? EXIT_SUCCESS : EXIT_FAILURE;
}
