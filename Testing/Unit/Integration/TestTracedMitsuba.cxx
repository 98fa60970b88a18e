// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Radiance with occlusion against Mitsuba's direct and path integrators
// (Testing/Mitsuba/compare_occlusion.py).
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTracedRadianceIntegrator.h"
#include "vtkTracedScene.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace
{
using nlohmann::json;

constexpr int Samples = 4096;
// Of the mean radiance: what both programs' samples leave, beside Mitsuba's standard errors.
constexpr double Mean = 0.004;
constexpr double Each = 0.03;
constexpr double EachBounced = 0.09; // single paths of what is hidden
constexpr double StandardErrors = 4.0;

vtkSmartPointer<vtkPolyData> MakeMesh(const json& result)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const json& p : result.at("points"))
  {
    points->InsertNextPoint(p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>());
  }
  vtkNew<vtkCellArray> triangles;
  for (const json& t : result.at("triangles"))
  {
    const vtkIdType corners[3] = { t.at(0).get<vtkIdType>(), t.at(1).get<vtkIdType>(),
      t.at(2).get<vtkIdType>() };
    triangles->InsertNextCell(3, corners);
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}

// Rows of the file begin at the top.
vtkSmartPointer<vtkEnvironment> MakeMap(const json& map)
{
  const int width = map.at("width").get<int>();
  const int height = map.at("height").get<int>();
  std::vector<float> pixels;
  for (int y = height; y-- > 0;)
  {
    for (int x = 0; x < width; ++x)
    {
      for (const json& value :
        map.at("rows_from_the_top").at(static_cast<std::size_t>(y * width + x)))
      {
        pixels.push_back(value.get<float>());
      }
    }
  }
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  EXPECT_TRUE(environment->SetPixels(width, height, pixels));
  return environment;
}

void Insert(const json& triple, vtkDoubleArray* array)
{
  array->InsertNextTuple3(
    triple.at(0).get<double>(), triple.at(1).get<double>(), triple.at(2).get<double>());
}

TEST(Traced, AgreesWithMitsuba)
{
  std::ifstream file(MEASUREDBRDF_MITSUBA_OCCLUSION);
  ASSERT_TRUE(file.good()) << MEASUREDBRDF_MITSUBA_OCCLUSION;
  const json record = json::parse(file);
  ASSERT_EQ(record.at("version"), 1);
  const vtkSmartPointer<vtkEnvironment> environment = MakeMap(record.at("map"));
  vtkNew<vtkLambertBRDF> diffuse;
  const json& color = record.at("color");
  diffuse->SetAlbedo(
    color.at(0).get<double>(), color.at(1).get<double>(), color.at(2).get<double>());
  ASSERT_EQ(record.at("results").size(), 3u);
  for (const json& result : record.at("results"))
  {
    vtkNew<vtkTracedScene> scene;
    scene->AddSurface(MakeMesh(result));
    vtkNew<vtkTracedRadianceIntegrator> integrator;
    integrator->SetScene(scene);
    integrator->SetBRDF(diffuse);
    integrator->SetEnvironment(environment);
    integrator->SetNumberOfSamples(Samples);
    vtkNew<vtkPolyData> receivers;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkDoubleArray> normals;
    vtkNew<vtkDoubleArray> views;
    normals->SetNumberOfComponents(3);
    views->SetNumberOfComponents(3);
    for (const json& receiver : result.at("receivers"))
    {
      const json& p = receiver.at("position");
      points->InsertNextPoint(p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>());
      Insert(receiver.at("normal"), normals);
      Insert(receiver.at("view"), views);
    }
    receivers->SetPoints(points);
    receivers->GetPointData()->SetNormals(normals);
    for (const int bounces : { 0, 1 })
    {
      const std::string kind = bounces > 0 ? "path" : "direct";
      const double each = bounces > 0 ? EachBounced : Each;
      integrator->SetNumberOfBounces(bounces);
      vtkNew<vtkDoubleArray> radiance;
      ASSERT_TRUE(integrator->Integrate(receivers, views, radiance));
      double difference = 0.0;
      double sum = 0.0;
      double worst = 0.0;
      for (vtkIdType k = 0; k < radiance->GetNumberOfTuples(); ++k)
      {
        const json& receiver = result.at("receivers").at(static_cast<std::size_t>(k));
        for (int c = 0; c < 3; ++c)
        {
          const auto channel = static_cast<std::size_t>(c);
          const double expected = receiver.at(kind).at(channel).get<double>();
          const double error = receiver.at(kind + "_error").at(channel).get<double>();
          const double off = radiance->GetComponent(k, c) - expected;
          EXPECT_LT(std::abs(off), StandardErrors * error + each * expected + 1e-4)
            << result.at("mesh") << ", " << kind << ", point " << k << ", channel " << c;
          difference += off;
          sum += expected;
          worst = std::max(worst, std::abs(off) / std::max(expected, 1e-2));
        }
      }
      std::printf("%s, %s: mean off by %+.3f %%, worst point %.2f %%, own noise %.2f %%\n",
        result.at("mesh").get<std::string>().c_str(), kind.c_str(), 100.0 * difference / sum,
        100.0 * worst, 100.0 * integrator->GetNoise());
      EXPECT_LT(std::abs(difference), Mean * sum) << result.at("mesh") << ", " << kind;
    }
  }
}
} // namespace
