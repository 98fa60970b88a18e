// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// CPU Evaluate = GLSL for every representation: invariant 1 of the design. A grid of quads, each
// with its own random normal and tangent, is drawn once per random light; every quad's pixel is
// f(i,o) cos(theta_i) for its own pair of directions.
#include "RenderFixture.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkBasisBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <glm/glm.hpp>

#include <fstream>
#include <random>

namespace
{
constexpr int Side = 16; // quads a side; 4 pixels each
constexpr int NumberOfLights = 12;

class Parity : public RenderFixture
{
protected:
  void SetUp() override
  {
    RenderFixture::SetUp();
    if (IsSkipped())
    {
      return;
    }
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkFloatArray> normals;
    vtkNew<vtkFloatArray> tangents;
    normals->SetNumberOfComponents(3);
    tangents->SetNumberOfComponents(3);
    tangents->SetName("Tangents");
    this->Normals->SetNumberOfComponents(3);
    this->Views->SetNumberOfComponents(3);
    this->Tangents->SetNumberOfComponents(3);
    for (int k = 0; k < Side * Side; ++k)
    {
      const double x = 2.0 * (k % Side) / Side - 1.0;
      const double y = 2.0 * (k / Side) / Side - 1.0;
      const double d = 2.0 / Side;
      const vtkIdType first = points->InsertNextPoint(x, y, 0.0);
      points->InsertNextPoint(x + d, y, 0.0);
      points->InsertNextPoint(x + d, y + d, 0.0);
      points->InsertNextPoint(x, y + d, 0.0);
      const vtkIdType ids[4] = { first, first + 1, first + 2, first + 3 };
      cells->InsertNextCell(4, ids);
      // Down to 87 degrees from the view; a few turned away a little, as at silhouettes.
      const glm::dvec3 n = this->Direction(k % 16 == 0 ? -0.02 : 0.05);
      const glm::dvec3 t = glm::normalize(glm::cross(n, this->Direction(-1.0)));
      for (int corner = 0; corner < 4; ++corner)
      {
        normals->InsertNextTuple3(n.x, n.y, n.z);
        tangents->InsertNextTuple3(t.x, t.y, t.z);
      }
      double tuple[3];
      normals->GetTuple(first, tuple); // as float, like the GPU
      this->Normals->InsertNextTuple(tuple);
      tangents->GetTuple(first, tuple);
      this->Tangents->InsertNextTuple(tuple);
      this->Views->InsertNextTuple3(0.0, 0.0, 1.0);
    }
    vtkNew<vtkPolyData> quads;
    quads->SetPoints(points);
    quads->SetPolys(cells);
    quads->GetPointData()->SetNormals(normals);
    quads->GetPointData()->SetTangents(tangents);
    this->Mapper->SetInputData(quads);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
  }

  glm::dvec3 Direction(double minimumZ)
  {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const double z = minimumZ + (1.0 - minimumZ) * uniform(this->Random);
    const double phi = 6.283185307179586 * uniform(this->Random);
    const double s = std::sqrt(std::max(1.0 - z * z, 0.0));
    return glm::dvec3(s * std::cos(phi), s * std::sin(phi), z);
  }

  /// Of every pixel's hemisphere; or, where FromNormal is set, so many degrees about one of the
  /// normals: narrow zones are hardly met else.
  glm::dvec3 GetLight(int light)
  {
    if (this->FromNormal[1] <= 0.0)
    {
      return this->Direction(-0.5);
    }
    glm::dvec3 n;
    this->Normals->GetTuple(10 * light + 1, &n.x);
    const glm::dvec3 across = glm::normalize(glm::cross(n, this->Direction(-1.0)));
    const double u = (light + 0.5) / NumberOfLights;
    const double angle = glm::radians(glm::mix(this->FromNormal[0], this->FromNormal[1], u));
    return std::cos(angle) * n + std::sin(angle) * across;
  }

  /// Largest relative difference where the value exceeds 1 % of the largest met. OfBrightest:
  /// relative to the brightest channel.
  double GetError(vtkBRDF* brdf, int& pairs)
  {
    vtkBRDF* renderable = brdf->GetRenderable();
    renderable->Prepare();
    this->Mapper->SetBRDF(brdf);
    std::vector<double> expected, actual;
    for (int light = 0; light < NumberOfLights; ++light)
    {
      const glm::dvec3 l = this->GetLight(light);
      const double direction[3] = { static_cast<float>(l.x), static_cast<float>(l.y),
        static_cast<float>(l.z) };
      const double irradiance[3] = { 1.0, 1.0, 1.0 };
      vtkNew<vtkLightSet> lights;
      lights->AddLight(direction, irradiance, 0.0, light % 4 == 0 ? 0.0 : this->Concentration);
      vtkNew<vtkLightSetRadianceIntegrator> loop;
      loop->SetLightSet(lights);
      loop->SetSoftLights(this->Concentration > 0.0);
      this->Mapper->SetIntegrator(loop);
      const FloatImage image = this->RenderLinear();

      vtkNew<vtkLightSetRadianceIntegrator> integrator;
      integrator->SetSoftLights(this->Concentration > 0.0);
      integrator->SetBRDF(renderable);
      integrator->SetLightSet(lights);
      vtkNew<vtkDoubleArray> radiance;
      integrator->Integrate(this->Normals, this->Views, radiance, this->Tangents);
      for (int k = 0; k < Side * Side; ++k)
      {
        const bool isTurnedAway = this->Normals->GetComponent(k, 2) <= 0.0; // as at silhouettes
        const float* pixel = image.At(4 * (k % Side) + 2, 4 * (k / Side) + 2);
        for (int c = 0; c < 3; ++c)
        {
          EXPECT_TRUE(std::isfinite(pixel[c]) && pixel[c] >= 0.0f);
          if (!isTurnedAway)
          {
            expected.push_back(radiance->GetComponent(k, c));
            actual.push_back(pixel[c]);
          }
        }
      }
    }
    const double largest = *std::max_element(expected.begin(), expected.end());
    EXPECT_GT(largest, 0.0);
    double error = 0.0;
    this->MeanError = 0.0;
    pairs = 0;
    for (std::size_t k = 0; k < expected.size(); ++k)
    {
      const double* pixel = &expected[k / 3 * 3];
      const double value = this->OfBrightest ? *std::max_element(pixel, pixel + 3) : expected[k];
      if (value > 0.01 * largest)
      {
        error = std::max(error, std::abs(actual[k] - expected[k]) / value);
        this->MeanError += std::abs(actual[k] - expected[k]) / value;
        ++pairs;
      }
      else
      {
        error = std::max(error, std::abs(actual[k] - expected[k]) / largest);
      }
    }
    this->MeanError /= pairs;
    pairs = static_cast<int>(expected.size() / 3);
    return error;
  }

  /// Largest difference between an integrator's GLSL and C++, relative to the channel's radiance or
  /// a hundredth of its largest.
  double GetIntegratorError(vtkRadianceIntegrator* integrator)
  {
    integrator->SetBRDF(this->Mapper->GetBRDF());
    integrator->SetEnvironment(this->Mapper->GetEnvironment());
    this->Mapper->SetIntegrator(integrator);
    const FloatImage image = this->RenderLinear();
    const double error = this->GetDifference(integrator, image);
    if (this->GetWeightStep() > 0.0)
    {
      std::cout << "mean " << this->MeanError << "; ";
      EXPECT_LT(this->MeanError, 0.4 * this->GetWeightStep());
    }
    return error;
  }

  /// Weights in steps are off by half a step, times a texel's difference from its neighbor: in C++
  /// with weights of 8 bits instead of exact ones the integrators of these tests had at most 0.29
  /// of a step in the mean and 14 at worst.
  double GetLimit(double exact) { return std::max(exact, 16.0 * this->GetWeightStep()); }

  double GetDifference(vtkRadianceIntegrator* integrator, const FloatImage& image)
  {
    vtkNew<vtkDoubleArray> radiance;
    EXPECT_TRUE(integrator->Integrate(this->Normals, this->Views, radiance, this->Tangents));
    double error = 0.0;
    this->MeanError = 0.0;
    int values = 0;
    for (int c = 0; c < 3; ++c)
    {
      double range[2];
      radiance->GetRange(range, c);
      for (int k = 0; k < Side * Side; ++k)
      {
        if (this->Normals->GetComponent(k, 2) > 0.0)
        {
          const float value = image.At(4 * (k % Side) + 2, 4 * (k / Side) + 2)[c];
          const double expected = radiance->GetComponent(k, c);
          EXPECT_TRUE(std::isfinite(value) && value >= 0.0f);
          const double difference =
            std::abs(value - expected) / std::max({ expected, 0.01 * range[1], 1e-30 });
          error = std::max(error, difference);
          this->MeanError += difference;
          ++values;
        }
      }
    }
    this->MeanError /= values;
    return error;
  }

  void CheckIntegrator(const std::string& name, vtkRadianceIntegrator* integrator, vtkBRDF* brdf,
    vtkEnvironment* environment, double limit = 2e-3)
  {
    this->Mapper->SetBRDF(brdf);
    this->Mapper->SetEnvironment(environment);
    const double error = this->GetIntegratorError(integrator);
    std::cout << name << ": " << error << "\n";
    EXPECT_GT(error, 0.0) << name;
    EXPECT_LT(error, this->GetLimit(limit)) << name;
  }

  /// On renderers whose filter weights have steps a material's tables differ by more: neighboring
  /// texels of measured gloss by a factor of 10, so by several steps.
  void Check(const char* name, vtkBRDF* brdf, double tolerance)
  {
    int pairs = 0;
    const double error = this->GetError(brdf, pairs);
    const double largest = tolerance + 8.0 * this->GetWeightStep();
    const double mean = tolerance + 0.5 * this->GetWeightStep();
    std::cout << name << ": " << pairs << " pairs, largest relative difference " << error
              << " (limit " << largest << "), mean " << this->MeanError << " (limit " << mean
              << ")\n";
    EXPECT_GE(pairs, 1000);
    EXPECT_LE(error, largest) << name;
    EXPECT_LE(this->MeanError, mean) << name;
  }

  // The basis form's two tables, without and with the cosines that a sum may carry.
  void CheckBasis(int basis);

  std::mt19937 Random{ 7 };
  double Concentration = 0.0; // of three of four lights; 0: hard lights
  bool OfBrightest = false;
  double MeanError = 0.0; // the last difference's; GetError's is of values above 1 % of the largest
  double FromNormal[2] = { 0.0, 0.0 };
  vtkNew<vtkDoubleArray> Normals;
  vtkNew<vtkDoubleArray> Views;
  vtkNew<vtkDoubleArray> Tangents;
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
};

/// A colored material of random coefficients that fall with the degree; positive nearly
/// everywhere.
vtkSmartPointer<vtkBasisBRDF> MakeBasis(
  int basis, int order, int nPhi, double begin = 9.0, double end = 57.0)
{
  const double incident[2] = { begin, end }, outgoing[2] = { 5.0, 80.0 };
  const int nTheta = 10;
  std::mt19937 random(17);
  const auto draw = [&random]() { return static_cast<float>(random()) * 0x1p-31f - 1.0f; };
  std::vector<float> rgb;
  for (int l = 0; l <= order; ++l)
  {
    for (int k = -l; k <= l; ++k)
    {
      const float size = l == 0 ? 2.0f : 0.5f * draw() / static_cast<float>(1 + l * l);
      for (int v = 0; v < nTheta * nPhi; ++v)
      {
        const float c = size * (1.0f + 0.1f * draw());
        rgb.insert(rgb.end(), { c, 0.5f * c * (1.0f + 0.1f * draw()), 0.2f * c });
      }
    }
  }
  auto brdf = vtkSmartPointer<vtkBasisBRDF>::New();
  EXPECT_EQ(brdf->SetCoefficients(basis, order, incident, outgoing, nTheta, nPhi, rgb), "");
  return brdf;
}

vtkNew<vtkEnvironment> NewTurnedHall()
{
  vtkNew<vtkEnvironment> hall;
  hall->SetToProceduralHall();
  hall->SetRotationY(33.0);
  return hall;
}

vtkNew<vtkEnvironment> NewPixel()
{
  vtkNew<vtkEnvironment> pixel;
  EXPECT_TRUE(pixel->SetPixels(1, 1, { 1e5f, 0.5f, 0.25f })); // beyond half float
  return pixel;
}

/// A lobe without a Lambert part.
vtkNew<vtkBlinnPhongBRDF> NewGlossy(double exponent)
{
  vtkNew<vtkBlinnPhongBRDF> glossy;
  glossy->SetSpecular(0.3, 0.2, 0.1);
  glossy->SetExponent(exponent);
  return glossy;
}

vtkNew<vtkAshikhminShirleyBRDF> NewCoated(double u, double v)
{
  vtkNew<vtkAshikhminShirleyBRDF> coated;
  coated->SetDiffuse(0.3, 0.2, 0.1);
  coated->SetExponents(u, v);
  return coated;
}

/// Lamps of one texel, so many from the left and from the top, in a dark map whose upper third is
/// as bright as given.
vtkNew<vtkEnvironment> NewDark(const std::vector<std::array<int, 2>>& texels, float above)
{
  constexpr int width = 256;
  std::vector<float> rgb(3 * width * 128, 0.01f);
  std::fill_n(rgb.begin(), rgb.size() / 3, above);
  for (const auto& [x, y] : texels)
  {
    for (int c = 0; c < 3; ++c)
    {
      rgb[static_cast<std::size_t>(3 * (width * y + x) + c)] = 1e4f / static_cast<float>(c + 1);
    }
  }
  vtkNew<vtkEnvironment> dark;
  EXPECT_TRUE(dark->SetPixels(width, 128, rgb));
  return dark;
}

/// A bumpy, colored table; every 7th cell invalid where asked for.
void FillTable(vtkTabulatedBRDF* table, int parameterization, int range, bool invalid)
{
  const int dimensions[3] = { 24, 16, 20 };
  std::vector<float> rgb;
  for (int k = 0; k < dimensions[0] * dimensions[1] * dimensions[2]; ++k)
  {
    const int x = k % 24, y = k / 24 % 16, z = k / 24 / 16;
    const float v = 0.2f + 5.0f * std::exp(-0.4f * z) + 0.05f * std::sin(0.7f * y) +
                    0.05f * std::cos(6.2831853f * (x + 0.5f) / 24.0f);
    rgb.insert(rgb.end(), { v, 0.5f * v, 0.1f + 0.01f * y });
    if (invalid && k % 7 == 0)
    {
      rgb[3 * k] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  ASSERT_TRUE(table->SetVolume(parameterization, range, dimensions, rgb));
}

// The first channel in all three: shared exponents round each to 2^-9 of the largest.
void MakeGray(vtkTabulatedBRDF* table, int parameterization, int range)
{
  const int dimensions[3] = { 24, 16, 20 };
  std::vector<float> rgb = table->GetVolume();
  for (std::size_t k = 0; k < rgb.size(); ++k)
  {
    rgb[k] = rgb[k / 3 * 3];
  }
  ASSERT_TRUE(table->SetVolume(parameterization, range, dimensions, rgb));
}
}

TEST_F(Parity, ClosedForms)
{
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(0.7, 0.4, 0.1);
  this->Check("Lambert", lambert, 1e-4);

  for (double n : { 1.0, 20.0, 500.0 })
  {
    vtkNew<vtkBlinnPhongBRDF> phong;
    phong->SetSpecular(0.3, 0.2, 0.1);
    phong->SetExponent(n);
    this->Check("Blinn-Phong", phong, 1e-4);
  }

  vtkNew<vtkAshikhminShirleyBRDF> isotropic;
  isotropic->SetReflectance(0.1, 0.5, 0.9);
  isotropic->SetDiffuse(0.3, 0.2, 0.1);
  isotropic->SetExponents(80.0, 80.0);
  this->Check("Ashikhmin-Shirley", isotropic, 1e-4);
  isotropic->SetFresnelModelToDielectric();
  isotropic->SetIndexOfRefraction(2.5);
  this->Check("Ashikhmin-Shirley, dielectric", isotropic, 1e-4);

  vtkNew<vtkAshikhminShirleyBRDF> anisotropic;
  anisotropic->SetReflectance(0.4, 0.4, 0.4);
  anisotropic->SetExponents(10.0, 200.0);
  this->Check("Ashikhmin-Shirley, anisotropic", anisotropic, 1e-4);

  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  sum->AddTerm(isotropic);
  sum->AddTerm(anisotropic);
  this->Check("Sum", sum, 1e-4);
}

TEST_F(Parity, Tables)
{
  vtkNew<vtkDistributionBRDF> distribution;
  this->Check("D-BRDF", distribution, 1e-4);
  std::vector<float> rgb;
  for (int phi = 0; phi < 8; ++phi)
  {
    for (int theta = 0; theta < 32; ++theta)
    {
      const float v = 2.0f * std::exp(-0.1f * theta) * (1.2f + std::sin(0.785398f * (phi + 0.5f)));
      rgb.insert(rgb.end(), { v, 0.8f * v, 0.5f });
    }
  }
  ASSERT_TRUE(distribution->SetDistribution(32, 8, rgb));
  this->Check("D-BRDF, anisotropic", distribution, 1e-4);

  const char* names[2][2] = { { "half/difference, pi", "half/difference, 2 pi" },
    { "in/out, pi", "in/out, 2 pi" } };
  for (int parameterization : { 0, 1 })
  {
    for (int range : { 0, 1 })
    {
      for (bool invalid : { false, true })
      {
        vtkNew<vtkTabulatedBRDF> table;
        FillTable(table, parameterization, range, invalid);
        table->SetPrecision(vtkTabulatedBRDF::FLOAT32);
        this->Check(names[parameterization][range], table, 1e-4);
        table->SetPrecision(vtkTabulatedBRDF::FLOAT16);
        this->Check(names[parameterization][range], table, 2e-3);
        MakeGray(table, parameterization, range);
        table->SetPrecision(vtkTabulatedBRDF::SHARED_EXPONENT);
        this->Check(names[parameterization][range], table, 3e-3);
        if (parameterization == vtkTabulatedBRDF::INCIDENT_OUTGOING)
        {
          table->SetPrecision(vtkTabulatedBRDF::FLOAT32);
          table->CosineWeightedOn();
          this->Check("in/out, f cos(theta_o)", table, 1e-4);
        }
      }
    }
  }
}

TEST_F(Parity, AnisotropicTables)
{
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetReflectance(0.4, 0.3, 0.2);
  brushed->SetDiffuse(0.2, 0.2, 0.2);
  brushed->SetExponents(5.0, 60.0);
  for (const int range : { 0, 1 })
  {
    vtkNew<vtkTabulatedBRDF> table;
    // Few samples of theta_d: a mistake at the ends of that axis shows.
    const int size[4] = { 12, range == 0 ? 3 : 10, range == 0 ? 7 : 14, 16 };
    ASSERT_TRUE(table->Resample(brushed, range, size));
    this->Check("anisotropic table, 16 bits", table, 2e-3);
    table->SetResamplingTolerance(1e-4);
    this->Check("anisotropic table, 32 bits", table, 1e-4);
    table->SetCosineWeighted(false);
    this->Check("anisotropic table of f", table, 1e-4);
  }
}

TEST_F(Parity, SoftLights)
{
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkBlinnPhongBRDF> phong;
  phong->SetExponent(500.0);
  vtkNew<vtkAshikhminShirleyBRDF> anisotropic;
  anisotropic->SetReflectance(0.4, 0.4, 0.4);
  anisotropic->SetDiffuse(0.3, 0.2, 0.1);
  anisotropic->SetExponents(10.0, 200.0);
  vtkNew<vtkDistributionBRDF> distribution;
  distribution->SetBlinnDistribution(300.0);
  vtkNew<vtkDistributionBRDF> ridged;
  std::vector<float> rgb;
  for (int k = 0; k < 8 * 4; ++k)
  {
    rgb.insert(rgb.end(), 3, 1.0f / static_cast<float>(1 + k % 8 + k / 8));
  }
  ASSERT_TRUE(ridged->SetDistribution(8, 4, rgb));
  vtkNew<vtkTabulatedBRDF> table;
  FillTable(table, vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, false);
  table->SetPrecision(vtkTabulatedBRDF::FLOAT32);
  vtkNew<vtkTabulatedBRDF> stayingHard;
  FillTable(stayingHard, vtkTabulatedBRDF::INCIDENT_OUTGOING, vtkTabulatedBRDF::HALF_TURN, false);
  stayingHard->SetPrecision(vtkTabulatedBRDF::FLOAT32);
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  sum->AddTerm(table);
  sum->AddTerm(stayingHard);
  sum->AddTerm(phong);
  sum->AddTerm(distribution);
  for (const double concentration : { 0.003, 5.0, 100.0, 1e4 })
  {
    this->Concentration = concentration;
    this->Check("soft Blinn-Phong", phong, 1e-4);
    this->Check("soft Ashikhmin-Shirley", anisotropic, 1e-4);
    this->Check("soft D-BRDF", distribution, 1e-4);
    this->Check("soft D-BRDF, anisotropic", ridged, 1e-4);
    this->Check("soft sum", sum, 1e-4);
  }
}

TEST_F(Parity, SoftTables)
{
  for (const double concentration : { 0.003, 100.0, 1e4 })
  {
    this->Concentration = concentration;
    for (int range : { 0, 1 })
    {
      for (bool invalid : { false, true })
      {
        vtkNew<vtkTabulatedBRDF> table;
        FillTable(table, vtkTabulatedBRDF::HALF_DIFFERENCE, range, invalid);
        table->SetCosineWeighted(range == vtkTabulatedBRDF::FULL_TURN);
        table->SetPrecision(vtkTabulatedBRDF::FLOAT32);
        this->Check(range == 0 ? "soft table, pi" : "soft table, 2 pi", table, 1e-4);
        table->SetPrecision(vtkTabulatedBRDF::FLOAT16);
        this->Check(range == 0 ? "soft table, pi" : "soft table, 2 pi", table, 2e-3);
        MakeGray(table, vtkTabulatedBRDF::HALF_DIFFERENCE, range);
        table->SetPrecision(vtkTabulatedBRDF::SHARED_EXPONENT);
        this->Check(range == 0 ? "soft table, pi" : "soft table, 2 pi", table, 3e-3);
      }
    }
  }
}

// A table of one sample along an axis still is a volume to the shader.
TEST_F(Parity, TablesOfOneSample)
{
  for (const int axis : { 0, 1, 2 })
  {
    int dimensions[3] = { 6, 5, 4 };
    dimensions[axis] = 1;
    std::vector<float> rgb;
    for (int k = 0; k < dimensions[0] * dimensions[1] * dimensions[2]; ++k)
    {
      rgb.insert(rgb.end(), { 0.2f + 0.01f * static_cast<float>(k % 7), 0.5f, 0.3f });
    }
    for (const int parameterization : { 0, 1 })
    {
      vtkNew<vtkTabulatedBRDF> table;
      ASSERT_TRUE(table->SetVolume(parameterization, vtkTabulatedBRDF::HALF_TURN, dimensions, rgb));
      table->SetPrecision(vtkTabulatedBRDF::FLOAT32);
      this->Check("one sample", table, 1e-4);
    }
  }
}

void Parity::CheckBasis(int basis)
{
  for (const int nPhi : { 1, 8 })
  {
    for (const int flags : { 0, 1, 2, 3 })
    {
      const auto brdf = MakeBasis(basis, 4, nPhi);
      ASSERT_TRUE(brdf);
      brdf->SetIncidentCosine((flags & 1) != 0);
      brdf->SetOutgoingCosine((flags & 2) != 0);
      const std::string name = vtkBasisBRDF::GetBasisName(basis) +
                               (nPhi == 1 ? ", isotropic" : "") + (flags & 1 ? ", i.z" : "") +
                               (flags & 2 ? ", o.z" : "");
      brdf->SetResamplingTolerance(1.9e-3); // 32 bits
      // Divided by i.z, sums that don't fall towards the horizon end within a cosine of 0.01 of
      // it, which magnifies the rounding of directions to 32-bit floats.
      const bool cliff = (flags & 1) && basis < vtkBasisBRDF::ZONAL;
      this->Check(name.c_str(), brdf, cliff ? 5e-4 : 1e-4);
      if (flags == 3)
      {
        brdf->SetResamplingTolerance(0.02); // 16 bits
        this->Check(name.c_str(), brdf, 2e-3);
      }
    }
  }
}

TEST_F(Parity, SphericalHarmonics) { this->CheckBasis(vtkBasisBRDF::SPHERICAL_HARMONICS); }

TEST_F(Parity, Hemispherical) { this->CheckBasis(vtkBasisBRDF::HEMISPHERICAL); }

TEST_F(Parity, Zonal) { this->CheckBasis(vtkBasisBRDF::ZONAL); }

TEST_F(Parity, LegendreFourier) { this->CheckBasis(vtkBasisBRDF::LEGENDRE_FOURIER); }

// The zone's own height must not be lost in 32 bits: one that begins at the normal, and the
// narrowest there (its cosines are 1.5e-4 apart) and at the horizon.
TEST_F(Parity, ZonesOfBases)
{
  for (const auto& zone :
    { std::array{ 0.0, 57.0 }, std::array{ 0.0, 1.0 }, std::array{ 88.0, 90.0 } })
  {
    std::copy_n(zone.begin(), 2, this->FromNormal);
    const auto brdf = MakeBasis(vtkBasisBRDF::LEGENDRE_FOURIER, 12, 1, zone[0], zone[1]);
    brdf->SetResamplingTolerance(1.9e-3); // 32 bits
    const std::string name =
      "order 12, " + std::to_string(zone[0]) + " to " + std::to_string(zone[1]) + " degrees";
    this->Check(name.c_str(), brdf, 1e-4);
  }
}

TEST_F(Parity, LargeBasesAndSums)
{
  // The largest, and two inside a sum.
  const auto large = MakeBasis(vtkBasisBRDF::LEGENDRE_FOURIER, 20, 1);
  large->SetResamplingTolerance(0.1);
  this->Check("order 20", large, 2e-3);
  const auto first = MakeBasis(vtkBasisBRDF::LEGENDRE_FOURIER, 7, 1);
  first->SetResamplingTolerance(1.9e-3);
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  const auto second = MakeBasis(vtkBasisBRDF::ZONAL, 2, 8);
  second->SetResamplingTolerance(1.9e-3);
  sum->AddTerm(second);
  sum->AddTerm(first);
  this->Check("sum", sum, 1e-4);
}

// A basis that rings takes nothing away from other lights: its negative sums count as 0.
TEST_F(Parity, NegativeSumsAreZeroForEachLight)
{
  // Order 1: a constant and k = 3 ~ x; negative for half of the lights.
  vtkNew<vtkBasisBRDF> brdf;
  const double whole[2] = { 0.0, 90.0 };
  const int functions = 4, nTheta = 2;
  std::vector<float> rgb(3 * functions * nTheta, 0.0f);
  std::fill_n(rgb.begin(), 3 * nTheta, 0.2f);
  std::fill_n(rgb.begin() + 3 * 3 * nTheta, 3 * nTheta, 2.0f);
  ASSERT_EQ(
    brdf->SetCoefficients(vtkBasisBRDF::SPHERICAL_HARMONICS, 1, whole, whole, nTheta, 1, rgb), "");
  brdf->SetResamplingTolerance(1e-3);
  vtkNew<vtkLightSet> lights;
  const double irradiance[3] = { 0.1, 0.1, 0.1 };
  for (int light = 0; light < NumberOfLights; ++light)
  {
    const glm::dvec3 direction = this->GetLight(light);
    lights->AddLight(&direction.x, irradiance);
  }
  vtkNew<vtkLightSetRadianceIntegrator> loop;
  loop->SetLightSet(lights);
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(loop);
  const FloatImage image = this->RenderLinear();
  vtkNew<vtkLightSetRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetLightSet(lights);
  vtkNew<vtkDoubleArray> radiance;
  ASSERT_TRUE(integrator->Integrate(this->Normals, this->Views, radiance, this->Tangents));
  const double largest = radiance->GetRange(0)[1];
  for (int k = 0; k < Side * Side; ++k)
  {
    if (this->Normals->GetComponent(k, 2) > 0.0)
    {
      EXPECT_NEAR(image.At(4 * (k % Side) + 2, 4 * (k / Side) + 2)[0], radiance->GetComponent(k, 0),
        2e-3 * largest);
    }
  }
}

// The number of functions is part of the shader's text: every change needs another program.
TEST_F(Parity, BasesAfterEachOther)
{
  for (const int order : { 2, 5, 0, 5, 2 })
  {
    const auto brdf = MakeBasis(vtkBasisBRDF::ZONAL, order, 1);
    brdf->SetResamplingTolerance(1.9e-3);
    this->Check("another order", brdf, 1e-4);
  }
  // The same material with other coefficients.
  const auto brdf = MakeBasis(vtkBasisBRDF::ZONAL, 3, 1);
  brdf->SetResamplingTolerance(1.9e-3);
  this->Check("before", brdf, 1e-4);
  const auto other = MakeBasis(vtkBasisBRDF::HEMISPHERICAL, 6, 4);
  ASSERT_EQ(brdf->SetCoefficients(other->GetBasis(), other->GetOrder(), other->GetIncidentZone(),
              other->GetOutgoingZone(), other->GetNumberOfTheta(), other->GetNumberOfPhi(),
              other->GetCoefficients()),
    "");
  this->Check("after", brdf, 1e-4);
}

TEST_F(Parity, EmbeddedMaterials)
{
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); k += 3)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    ASSERT_TRUE(brdf);
    // Lobes of exponents up to 7e4 magnify the rounding of directions to 32-bit floats.
    this->Check(name.c_str(), brdf, 2e-3);
  }
}

TEST_F(Parity, EmbeddedMeasurement)
{
  auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("blue-car-paint"));
  ASSERT_TRUE(brdf);
  this->Check("blue-car-paint", brdf, 2e-3);
}

TEST_F(Parity, RealFiles)
{
  const std::string folder = std::string(MEASUREDBRDF_SHARED_DATA) + "/materials/";
  if (!std::ifstream(folder + "rgl/satin_purple_rgb.bsdf"))
  {
    GTEST_SKIP() << "no measured files beside the checkout";
  }
  for (const char* file : { "rgl/acrylic_felt_pink_rgb.bsdf", "rgl/satin_purple_rgb.bsdf",
         "rgl/chm_light_blue_rgb.bsdf" })
  {
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(folder + file);
    ASSERT_TRUE(reader->Read());
    // Shared exponents round a dark channel by 2^-9 of the brightest one.
    this->OfBrightest = true;
    this->Check(file, reader->GetBRDF(), 3e-3);
    this->OfBrightest = false;
    auto* table = vtkTabulatedBRDF::SafeDownCast(reader->GetBRDF()->GetRenderable());
    ASSERT_TRUE(table);
    table->SetPrecision(vtkTabulatedBRDF::FLOAT16);
    this->Check(file, table, 2e-3);
  }
}

// The 16-bit table's rounding: relative to the brightest of the texels that take part.
TEST_F(Parity, TableIntegrator)
{
  const auto hall = NewTurnedHall(), pixel = NewPixel();
  vtkNew<vtkLambertBRDF> matte;
  const auto glossy = NewGlossy(60.0);
  const auto hybrid = NewCoated(100.0, 100.0);
  for (vtkEnvironment* environment : { hall.Get(), pixel.Get() })
  {
    for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(matte), static_cast<vtkBRDF*>(glossy),
           static_cast<vtkBRDF*>(hybrid) })
    {
      vtkNew<vtkTableRadianceIntegrator> integrator;
      integrator->SetNumberOfRows(33);
      this->CheckIntegrator(brdf->GetClassName(), integrator, brdf, environment);
    }
  }
}

// Tiles of a finer map beside the map that is everywhere.
TEST_F(Parity, TableIntegratorWithTiles)
{
  for (const int rows : { 137, 193 })
  {
    vtkNew<vtkTableRadianceIntegrator> integrator;
    integrator->SetSizes({ rows, 4, 4 });
    this->CheckIntegrator(
      std::to_string(rows) + " rows", integrator, NewCoated(3000.0, 3000.0), NewTurnedHall());
  }
}

// The small table, and maps of the sharp part with and without the azimuth.
TEST_F(Parity, FactoredIntegrator)
{
  const auto glossy = NewGlossy(60.0);
  const auto coated = NewCoated(1000.0, 1000.0);
  for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(glossy), static_cast<vtkBRDF*>(coated) })
  {
    for (const int maps : { 1, 12 })
    {
      vtkNew<vtkTableRadianceIntegrator> integrator;
      integrator->SetSizes({ 33, 12, 8 });
      integrator->SetNumberOfMapRows(128);
      integrator->SetNumberOfMaps(maps);
      // Beside a lamp, table and maps nearly cancel: 16-bit floats show.
      this->CheckIntegrator(
        std::to_string(maps) + " maps", integrator, brdf, NewTurnedHall(), 0.008);
    }
  }
}

// f that repeats itself after half a turn, and after a whole turn only.
TEST_F(Parity, AnisotropicTableIntegrator)
{
  const auto brushed = NewCoated(100.0, 10.0);
  const auto lopsided = MakeBasis(vtkBasisBRDF::HEMISPHERICAL, 3, 4);
  for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(brushed), static_cast<vtkBRDF*>(lopsided) })
  {
    vtkNew<vtkTableRadianceIntegrator> integrator;
    integrator->SetSizes({ 33, 8, 16, 8 });
    this->CheckIntegrator(brdf->GetClassName(), integrator, brdf, NewTurnedHall());
    EXPECT_EQ(integrator->GetNumberOfPeriods(), brdf == brushed ? 2 : 1);
  }
}

// Filtered importance sampling: the same tables and the same map on both sides.
TEST_F(Parity, FilteredIntegrator)
{
  const auto hall = NewTurnedHall(), pixel = NewPixel();
  const auto glossy = NewGlossy(100.0);
  const auto hybrid = NewCoated(300.0, 300.0);
  for (vtkEnvironment* environment : { hall.Get(), pixel.Get() })
  {
    for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(glossy), static_cast<vtkBRDF*>(hybrid) })
    {
      vtkNew<vtkFilteredRadianceIntegrator> integrator;
      this->CheckIntegrator(brdf->GetClassName(), integrator, brdf, environment);
      EXPECT_EQ(integrator->GetNumberOfExtractedLights() > 0, environment == hall.Get());
    }
  }
}

// Table, maps and lights in one shader.
TEST_F(Parity, HybridIntegrator)
{
  vtkNew<vtkHybridRadianceIntegrator> integrator;
  ASSERT_TRUE(integrator->SetSizes({ 128, 12, 8, 8 }));
  this->CheckIntegrator( // 16-bit floats, as above
    "hybrid", integrator, NewCoated(1000.0, 1000.0), NewTurnedHall(), 0.012);
  EXPECT_GT(integrator->GetNumberOfLights(), 0);
}

// More lamps than are unrolled, some of them near each other.
TEST_F(Parity, HybridOfManyLamps)
{
  std::vector<std::array<int, 2>> lamps;
  for (int k = 0; k < 40; ++k)
  {
    lamps.push_back({ k < 3 ? 11 + 3 * k : (37 * k + 11) % 256, 30 + 7 * k % 60 });
  }
  for (const int most : { 8, 64 })
  {
    vtkNew<vtkHybridRadianceIntegrator> integrator;
    ASSERT_TRUE(integrator->SetSizes({ 33, 8, 8, 0, most }));
    this->CheckIntegrator(
      std::to_string(most) + " lights", integrator, NewCoated(300.0, 300.0), NewDark(lamps, 0.01f));
    EXPECT_GT(integrator->GetNumberOfLights(), most > 32 ? 32 : 4);
  }
}

// Lamps that narrow lobes see as areas: near each other, beside maps and a table, and on their own.
TEST_F(Parity, HybridOfWideLamps)
{
  for (const int count : { 1, 6 })
  {
    std::vector<std::array<int, 2>> texels;
    for (int k = 0; k < count; ++k)
    {
      const int x = k < 3 ? 11 + 4 * k : 37 * k;
      texels.push_back({ x, 30 + 9 * k });
      if (k % 2 == 0) // a part of its own
      {
        texels.push_back({ x + 1, 30 + 9 * k });
      }
    }
    for (const int maps : { 0, 4 })
    {
      vtkNew<vtkHybridRadianceIntegrator> integrator;
      ASSERT_TRUE(integrator->SetSizes({ maps > 0 ? 64 : 33, 8, 8, maps, 8, 20 }));
      this->CheckIntegrator(std::to_string(count) + " lights, " + std::to_string(maps) + " maps",
        integrator, NewCoated(20000.0, 20000.0), NewDark(texels, 0.03f), maps > 0 ? 0.012 : 2e-3);
      EXPECT_EQ(integrator->GetNumberOfLights(), count);
      EXPECT_FALSE(integrator->UsesBRDFOnGPU());
    }
  }
}

// An anisotropic table and lights.
TEST_F(Parity, AnisotropicHybridIntegrator)
{
  vtkNew<vtkHybridRadianceIntegrator> integrator;
  ASSERT_TRUE(integrator->SetSizes({ 17, 6, 12, 0 }));
  this->CheckIntegrator("anisotropic", integrator, NewCoated(100.0, 10.0), NewTurnedHall());
  EXPECT_GT(integrator->GetNumberOfLights(), 0);
}
