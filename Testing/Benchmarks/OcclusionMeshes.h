// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Meshes that hide parts of the sky from themselves, with point normals.
 */

#ifndef OcclusionMeshes_h
#define OcclusionMeshes_h

#include "vtkAdaptiveSubdivisionFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkContourFilter.h"
#include "vtkFloatArray.h"
#include "vtkLinearExtrusionFilter.h"
#include "vtkNew.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricTorus.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkRTAnalyticSource.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkTriangleFilter.h"
#include "vtkXMLPolyDataReader.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace occlusionmeshes
{
inline void AddSphere(vtkAppendPolyData* all, const double center[3], double radius, int steps)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(center[0], center[1], center[2]);
  source->SetRadius(radius);
  source->SetThetaResolution(3 * steps);
  source->SetPhiResolution(2 * steps);
  source->Update();
  all->AddInputData(source->GetOutput());
}

inline void AddTorus(vtkAppendPolyData* all, double ring, double section, double height)
{
  vtkNew<vtkParametricTorus> torus;
  torus->SetRingRadius(ring);
  torus->SetCrossSectionRadius(section);
  vtkNew<vtkParametricFunctionSource> source;
  source->SetParametricFunction(torus);
  source->SetUResolution(120);
  source->SetVResolution(40);
  vtkNew<vtkTransform> turn; // z to y
  turn->Translate(0.0, height, 0.0);
  turn->RotateX(-90.0);
  vtkNew<vtkTransformPolyDataFilter> moved;
  moved->SetTransform(turn);
  moved->SetInputConnection(source->GetOutputPort());
  moved->Update();
  all->AddInputData(moved->GetOutput());
}

inline void AddGround(vtkAppendPolyData* all, double half, double height)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-half, height, half);
  plane->SetPoint1(half, height, half);
  plane->SetPoint2(-half, height, -half);
  plane->SetResolution(60, 60);
  plane->Update();
  all->AddInputData(plane->GetOutput());
}

// A sphere in a ring on a plate.
inline void AddKnob(vtkAppendPolyData* all)
{
  const double center[3] = { 0.0, 0.0, 0.0 };
  AddSphere(all, center, 1.0, 32);
  AddTorus(all, 1.25, 0.3, -0.7);
  AddGround(all, 2.2, -1.0);
}

// Spheres that touch and cut one another.
inline void AddMolecule(vtkAppendPolyData* all)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<std::vector<double>> centers = { { 0.0, 0.0, 0.0 } };
  while (centers.size() < 40)
  {
    const std::vector<double> from = centers[generator() % centers.size()];
    double d[3] = { uniform(generator), uniform(generator), uniform(generator) };
    const double length = std::hypot(d[0], d[1], d[2]);
    std::vector<double> center = { from[0] + 1.3 * d[0] / length, from[1] + 1.3 * d[1] / length,
      from[2] + 1.3 * d[2] / length };
    bool isFree = length > 0.1;
    for (const std::vector<double>& other : centers)
    {
      isFree = isFree &&
               std::hypot(center[0] - other[0], center[1] - other[1], center[2] - other[2]) > 1.1;
    }
    if (isFree)
    {
      centers.push_back(center);
    }
  }
  for (const std::vector<double>& center : centers)
  {
    AddSphere(all, center.data(), 0.85 + 0.15 * uniform(generator), 12);
  }
}

// A sphere with dents, of 1.5 steps^2 points.
inline void AddBumps(vtkAppendPolyData* all, int steps)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.0);
  source->SetThetaResolution(3 * steps / 2);
  source->SetPhiResolution(steps);
  source->Update();
  vtkNew<vtkPolyData> surface;
  surface->DeepCopy(source->GetOutput());
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
  {
    double p[3];
    surface->GetPoint(k, p);
    const double height =
      1.0 + 0.12 * std::sin(9.0 * p[0]) * std::sin(8.0 * p[1] + 1.0) * std::sin(7.0 * p[2] + 2.0) +
      0.08 * std::cos(17.0 * p[0] + 3.0 * p[1]) * std::cos(15.0 * p[2]);
    surface->GetPoints()->SetPoint(k, height * p[0], height * p[1], height * p[2]);
  }
  surface->GetPointData()->SetNormals(nullptr);
  all->AddInputData(surface);
}

// A toothed wheel with a hub: a machine part of large flat faces, refined.
inline void AddGear(vtkAppendPolyData* all)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  const double steps[4][2] = { { 0.0, 0.8 }, { 0.12, 0.8 }, { 0.17, 1.05 }, { 0.3, 1.05 } };
  std::vector<vtkIdType> ids;
  for (int tooth = 0; tooth < 16; ++tooth)
  {
    for (const auto& step : steps)
    {
      const double turn = 2.0 * 3.14159265358979 * tooth / 16.0 + step[0];
      ids.push_back(
        points->InsertNextPoint(step[1] * std::cos(turn), step[1] * std::sin(turn), 0.0));
    }
  }
  polygons->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  ids.clear();
  for (int k = 0; k < 60; ++k)
  {
    const double turn = 2.0 * 3.14159265358979 * k / 60.0;
    ids.push_back(points->InsertNextPoint(0.35 * std::cos(turn), 0.35 * std::sin(turn), 0.35));
  }
  polygons->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  vtkNew<vtkPolyData> outline;
  outline->SetPoints(points);
  outline->SetPolys(polygons);
  vtkNew<vtkLinearExtrusionFilter> solid;
  solid->SetInputData(outline);
  solid->SetExtrusionTypeToVectorExtrusion();
  solid->SetVector(0.0, 0.0, 0.4);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(solid->GetOutputPort());
  vtkNew<vtkAdaptiveSubdivisionFilter> fine;
  fine->SetInputConnection(triangles->GetOutputPort());
  fine->SetMaximumEdgeLength(0.05);
  fine->Update();
  all->AddInputData(fine->GetOutput());
}

inline void AddIsosurface(vtkAppendPolyData* all)
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-20, 20, -20, 20, -20, 20);
  source->SetXFreq(40.0);
  source->SetYFreq(20.0);
  source->SetZFreq(30.0);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(source->GetOutputPort());
  contour->SetValue(0, 160.0);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  all->AddInputData(contour->GetOutput());
}
}

/// One of these names, or a .vtp file.
inline vtkSmartPointer<vtkPolyData> MakeOcclusionMesh(const std::string& name)
{
  if (name.find(".vtp") != std::string::npos)
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(name.c_str());
    reader->Update();
    return reader->GetOutput();
  }
  vtkNew<vtkAppendPolyData> all;
  if (name == "knob")
  {
    occlusionmeshes::AddKnob(all);
  }
  else if (name == "molecule")
  {
    occlusionmeshes::AddMolecule(all);
  }
  else if (name == "bumps" || name == "fine-bumps")
  {
    occlusionmeshes::AddBumps(all, name == "bumps" ? 160 : 378);
  }
  else if (name == "gear")
  {
    occlusionmeshes::AddGear(all);
  }
  else if (name == "isosurface")
  {
    occlusionmeshes::AddIsosurface(all);
  }
  else
  {
    occlusionmeshes::AddTorus(all, 0.7, 0.35, 0.0);
  }
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(all->GetOutputPort());
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(triangles->GetOutputPort());
  normals->SetFeatureAngle(40.0);
  normals->SetAutoOrientNormals(name == "gear"); // which is closed
  normals->Update();
  return normals->GetOutput();
}

#endif
