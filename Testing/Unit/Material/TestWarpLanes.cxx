// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of many lights at once, in single precision, against those of the mathematics
// library, and what is looked up there against the tables in double precision; in each form that
// the processor has.

#include "HalfVector.h"
#include "PackedWarp.h"
#include "SharedData.h"
#include "WarpLanes.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkNew.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <random>
#include <string>
#include <vector>

using namespace measuredbrdf;

namespace
{
// 61 of them: no multiple of the numbers that are calculated at once.
std::vector<glm::dvec3> MakeLights(const glm::dvec3& view)
{
  std::vector<glm::dvec3> lights = { { 0.0, 0.0, 1.0 }, view, { -view.x, -view.y, view.z },
    glm::normalize(glm::dvec3(1e-9 - view.x, -view.y, view.z)),
    glm::normalize(glm::dvec3(-view.x, -view.y, 1e-9)) };
  std::mt19937 engine(3);
  while (lights.size() < 61)
  {
    const double z = (engine() + 0.5) * 0x1p-32;
    const double phi = 2.0 * Pi * engine() * 0x1p-32;
    const double s = std::sqrt(1.0 - z * z);
    lights.emplace_back(s * std::cos(phi), s * std::sin(phi), z);
  }
  return lights;
}

// One coordinate after the other.
struct Lights
{
  explicit Lights(const std::vector<glm::dvec3>& lights)
  {
    for (const glm::dvec3& light : lights)
    {
      for (int c = 0; c < 3; ++c)
      {
        this->Values[c].push_back(static_cast<float>(light[c]));
      }
    }
    for (int c = 0; c < 3; ++c)
    {
      this->Pointers[c] = this->Values[c].data();
    }
  }
  std::vector<float> Values[3];
  const float* Pointers[3];
};

std::string GetFormName(const testing::TestParamInfo<VectorForm>& form)
{
  const char* const names[] = { "None", "Narrow", "Wide" };
  return names[static_cast<int>(form.param)];
}

std::vector<VectorForm> ListForms()
{
  std::vector<VectorForm> forms;
  for (int form = 0; form <= static_cast<int>(GetWidestForm()); ++form)
  {
    forms.push_back(static_cast<VectorForm>(form));
  }
  return forms;
}
}

//------------------------------------------------------------------------------
class WarpForms : public testing::TestWithParam<VectorForm>
{
};
INSTANTIATE_TEST_SUITE_P(All, WarpForms, testing::ValuesIn(ListForms()), GetFormName);

//------------------------------------------------------------------------------
TEST_P(WarpForms, LanesAreTheAnglesOfTheMathematicsLibrary)
{
  for (const double theta : { 0.0, 0.3, 1.0, 1.55 })
  {
    const glm::dvec3 view(std::sin(theta) * 0.6, std::sin(theta) * -0.8, std::cos(theta));
    const std::vector<glm::dvec3> all = MakeLights(view);
    for (const std::size_t count : { std::size_t(1), std::size_t(9), all.size() })
    {
      const std::vector<glm::dvec3> lights(all.begin(), all.begin() + static_cast<long>(count));
      WarpLanes lanes;
      FindWarpLanes(
        static_cast<int>(count), Lights(lights).Pointers, &view.x, lanes, this->GetParam());
      for (std::size_t k = 0; k < count; ++k)
      {
        const glm::dvec3& i = lights[k];
        const glm::dvec3 h = HalfVector(i, view);
        const double round = std::hypot(i.x, i.y);
        const double sine = std::hypot(h.x, h.y);
        const double thetaI = std::atan2(round, i.z);
        EXPECT_NEAR(lanes.Theta[k], thetaI, 1e-6) << theta << " " << k;
        EXPECT_NEAR(lanes.UnitTheta[k] * lanes.UnitTheta[k], thetaI / (0.5 * Pi), 1e-6);
        // The half vector of a grazing pair is short: its error is larger.
        const double error = 1e-6 + 3e-7 / glm::length(i + view);
        EXPECT_NEAR(
          lanes.UnitThetaH[k] * lanes.UnitThetaH[k], std::atan2(sine, h.z) / (0.5 * Pi), error)
          << theta << " " << k;
        EXPECT_GE(lanes.UnitPhiH[k], 0.0f);
        EXPECT_LE(lanes.UnitPhiH[k], 1.0f);
        if (sine > 1e-3 && (round > 1e-3 || round == 0.0)) // else it has hardly an azimuth
        {
          const double turn = std::atan2(h.y, h.x) - (round == 0.0 ? 0.0 : std::atan2(i.y, i.x));
          EXPECT_NEAR(
            std::remainder(lanes.UnitPhiH[k] - 0.5 - turn / (2.0 * Pi), 1.0), 0.0, error / sine)
            << theta << " " << k;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// Other sizes for each table, so that one is not taken for another; densities that differ by 1000.
TEST_P(WarpForms, PackedTablesHoldTheSame)
{
  std::mt19937 engine(5);
  const auto draw = [&engine](int count)
  {
    std::vector<float> values;
    for (int k = 0; k < count; ++k)
    {
      values.push_back(static_cast<float>(std::pow(10.0, 3.0 * engine() * 0x1p-32)));
    }
    return values;
  };
  for (const std::vector<float>& thetas :
    { std::vector<float>{ 0.0f, 0.1f, 0.5f, 1.2f, 1.5f }, std::vector<float>{ 0.7f } })
  {
    const auto slices = static_cast<int>(thetas.size());
    const std::vector<std::vector<float>> axes = { { 0.0f }, thetas };
    const BilinearWarp ndf(draw(9 * 3), 9, 3, {}, false);
    std::vector<float> row = draw(13);
    row.insert(row.end(), row.begin(), row.end());
    const BilinearWarp sigma(row, 13, 2, {}, false);
    const BilinearWarp vndf(draw(slices * 17 * 11), 17, 11, axes, true);
    const BilinearWarp rgb[3] = { { draw(slices * 7 * 5), 7, 5, axes, false },
      { draw(slices * 7 * 5), 7, 5, axes, false }, { draw(slices * 7 * 5), 7, 5, axes, false } };
    for (const bool jacobian : { false, true })
    {
      const PackedWarp packed({ ndf, sigma, vndf, rgb, thetas, jacobian });
      const glm::dvec3 view = glm::normalize(glm::dvec3(0.3, -0.2, 0.7));
      const std::vector<glm::dvec3> lights = MakeLights(view);
      const auto count = static_cast<int>(lights.size());
      WarpLanes lanes;
      FindWarpLanes(count, Lights(lights).Pointers, &view.x, lanes);
      float f[3][WarpLanes::Most];
      float* const to[3] = { f[0], f[1], f[2] };
      packed.Evaluate(count, lanes, view.z, to, this->GetParam());
      for (int k = 0; k < count; ++k)
      {
        const double incident[2] = { 0.0, lanes.Theta[k] };
        const glm::dvec2 half(lanes.UnitThetaH[k], lanes.UnitPhiH[k]);
        const BilinearWarp::Slices between = vndf.FindSlices(incident);
        double density = 0.0;
        const glm::dvec2 s = vndf.Invert(half, between, density);
        const BilinearWarp::Slices none = ndf.FindSlices(nullptr);
        const double scale = jacobian
                               ? ndf.Evaluate(half, none) /
                                   (4.0 * sigma.Evaluate(glm::dvec2(lanes.UnitTheta[k], 0.5), none))
                               : 1.0;
        for (int c = 0; c < 3; ++c)
        {
          const double expected = rgb[c].Evaluate(s, between) * scale / view.z;
          // Single precision, and colors that change a thousandfold within a cell.
          EXPECT_NEAR(f[c][k], expected, 2e-4 * expected) << k;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(AdaptiveWarp, ManyLightsAreEvaluatedAsOneByOne)
{
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(SharedData + "/materials/rgl/chm_light_blue_rgb.bsdf");
  if (!std::ifstream(reader->GetFileName()).good())
  {
    GTEST_SKIP() << "no measured data at " << SharedData;
  }
  ASSERT_TRUE(reader->Read());
  auto* brdf = vtkAdaptiveWarpBRDF::SafeDownCast(reader->GetBRDF());
  ASSERT_TRUE(brdf);
  const glm::dvec3 view = glm::normalize(glm::dvec3(0.5, 0.2, 0.7));
  std::vector<glm::dvec3> lights = MakeLights(view);
  lights.insert(lights.end(), lights.begin(), lights.end()); // more than are evaluated at once
  std::vector<float> many[3];
  float* to[3];
  for (int c = 0; c < 3; ++c)
  {
    many[c].resize(lights.size());
    to[c] = many[c].data();
  }
  brdf->EvaluateLights(static_cast<int>(lights.size()), Lights(lights).Pointers, &view.x, to);
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    glm::dvec3 f;
    brdf->Evaluate(&lights[k].x, &view.x, &f.x);
    EXPECT_GT(f.y, 0.0);
    const glm::dvec3 h = HalfVector(lights[k], view);
    const double sine = std::hypot(h.x, h.y);
    for (int c = 0; c < 3; ++c)
    {
      // Single precision: where h is nearly the normal, its azimuth is any.
      EXPECT_NEAR(many[c][k], f[c], (sine > 1e-4 ? 1e-4 : 1e-2) * f[c]) << k;
    }
  }
}
