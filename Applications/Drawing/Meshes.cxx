// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes.h"

#include "Files.h"
#include "ReadApart.h"
#include "Tool.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataGeometryFilter.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFloatArray.h"
#include "vtkGLTFReader.h"
#include "vtkGenericDataObjectReader.h"
#include "vtkGeometryFilter.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkPLYReader.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyDataNormals.h"
#include "vtkSTLReader.h"
#include "vtkSphereSource.h"
#include "vtkStaticPointLocator.h"
#include "vtkTriangleFilter.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataReader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <iomanip>
#include <locale>
#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace tool
{
namespace
{
//------------------------------------------------------------------------------
// For each point the first one at its place.
std::vector<vtkIdType> FindPlaces(vtkPolyData* mesh)
{
  std::vector<vtkIdType> places(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(mesh);
  locator->BuildLocator();
  locator->MergePoints(0.0, places.data());
  return places;
}

//------------------------------------------------------------------------------
// The polygons over the places, with normals of points.
vtkSmartPointer<vtkPolyData> MakeNormals(
  vtkPolyData* mesh, const std::vector<vtkIdType>& places, vtkPolyDataNormals* normals)
{
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> ids;
  for (vtkIdType k = 0; k < mesh->GetNumberOfPolys(); ++k)
  {
    mesh->GetPolys()->GetCellAtId(k, ids);
    for (vtkIdType n = 0; n < ids->GetNumberOfIds(); ++n)
    {
      ids->SetId(n, places[static_cast<std::size_t>(ids->GetId(n))]);
    }
    polygons->InsertNextCell(ids);
  }
  vtkNew<vtkPolyData> welded;
  welded->SetPoints(mesh->GetPoints());
  welded->SetPolys(polygons);
  normals->SetInputData(welded);
  normals->Update();
  return normals->GetOutput();
}

//------------------------------------------------------------------------------
bool IsDirection(const double n[3])
{
  const double length = vtkMath::Norm(n);
  return std::isfinite(length) && length > 0.0;
}
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> AddNormals(vtkPolyData* mesh, double featureAngle)
{
  const std::vector<vtkIdType> places = FindPlaces(mesh);
  vtkNew<vtkPolyDataNormals> filter;
  filter->SetFeatureAngle(featureAngle);
  const vtkSmartPointer<vtkPolyData> smooth = MakeNormals(mesh, places, filter);
  vtkDataArray* normals = smooth->GetPointData()->GetNormals();
  if (!normals || smooth->GetNumberOfPolys() != mesh->GetNumberOfPolys())
  {
    return mesh;
  }

  // A corner has its point's data and its place's normal: a point for each pair of these.
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(mesh->GetPoints()->GetDataType());
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkFloatArray> directions;
  directions->SetName("Normals");
  directions->SetNumberOfComponents(3);
  vtkPointData* data = result->GetPointData();
  data->CopyAllocate(mesh->GetPointData(), mesh->GetNumberOfPoints());
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> made;
  vtkNew<vtkIdList> before;
  vtkNew<vtkIdList> after;
  for (vtkIdType k = 0; k < mesh->GetNumberOfPolys(); ++k)
  {
    mesh->GetPolys()->GetCellAtId(k, before);
    smooth->GetPolys()->GetCellAtId(k, after); // may be turned around
    for (vtkIdType n = 0; n < after->GetNumberOfIds(); ++n)
    {
      const vtkIdType split = after->GetId(n);
      double place[3];
      smooth->GetPoint(split, place);
      vtkIdType own = before->GetId(n);
      for (vtkIdType m = 0; m < before->GetNumberOfIds(); ++m)
      {
        double p[3];
        mesh->GetPoint(before->GetId(m), p);
        own = p[0] == place[0] && p[1] == place[1] && p[2] == place[2] ? before->GetId(m) : own;
      }
      const auto [it, isNew] =
        made.emplace(std::make_pair(own, split), points->GetNumberOfPoints());
      if (isNew)
      {
        points->InsertNextPoint(place);
        directions->InsertNextTuple(normals->GetTuple(split));
        data->CopyData(mesh->GetPointData(), own, it->second);
      }
      after->SetId(n, it->second);
    }
    polygons->InsertNextCell(after);
  }
  result->SetPoints(points);
  result->SetPolys(polygons);
  result->GetCellData()->ShallowCopy(mesh->GetCellData());
  data->SetNormals(directions);
  return result;
}

//------------------------------------------------------------------------------
vtkIdType RepairNormals(vtkPolyData* mesh)
{
  vtkDataArray* given = mesh->GetPointData()->GetNormals();
  std::vector<vtkIdType> bad;
  for (vtkIdType k = 0; given && k < mesh->GetNumberOfPoints(); ++k)
  {
    double n[3];
    given->GetTuple(k, n);
    if (!IsDirection(n))
    {
      bad.push_back(k);
    }
  }
  if (bad.empty())
  {
    return 0;
  }
  const std::vector<vtkIdType> places = FindPlaces(mesh);
  vtkNew<vtkPolyDataNormals> filter;
  filter->SplittingOff();
  filter->ConsistencyOff();
  const vtkSmartPointer<vtkPolyData> smooth = MakeNormals(mesh, places, filter);
  vtkDataArray* computed = smooth->GetPointData()->GetNormals();
  const auto compute = [&](vtkIdType point, double n[3])
  {
    computed->GetTuple(places[static_cast<std::size_t>(point)], n);
    return IsDirection(n);
  };
  double agreement = 0.0; // below 0: the file's normals turn to the other side
  for (vtkIdType k = 0; k < mesh->GetNumberOfPoints(); ++k)
  {
    double n[3];
    double m[3];
    given->GetTuple(k, n);
    agreement += IsDirection(n) && compute(k, m) ? (vtkMath::Dot(n, m) > 0.0 ? 1.0 : -1.0) : 0.0;
  }
  vtkNew<vtkFloatArray> repaired;
  repaired->DeepCopy(given);
  repaired->SetName(given->GetName());
  for (const vtkIdType k : bad)
  {
    double n[3] = { 0.0, 0.0, 1.0 };
    if (compute(k, n))
    {
      vtkMath::MultiplyScalar(n, agreement < 0.0 ? -1.0 : 1.0);
    }
    else
    {
      n[0] = n[1] = 0.0; // of no polygon with an area
      n[2] = 1.0;
    }
    repaired->SetTuple(k, n);
  }
  mesh->GetPointData()->SetNormals(repaired);
  return static_cast<vtkIdType>(bad.size());
}

namespace
{
// Edges sharper than this stay sharp when normals are made.
constexpr double FeatureAngle = 60.0;

//------------------------------------------------------------------------------
template <typename Reader>
vtkSmartPointer<vtkAlgorithm> Read(const std::string& path)
{
  auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(path.c_str());
  return reader;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeReader(const std::string& path)
{
  const std::string extension = tool::Extension(path);
  if (extension == ".ply")
  {
    return Read<vtkPLYReader>(path);
  }
  if (extension == ".stl")
  {
    return Read<vtkSTLReader>(path);
  }
  if (extension == ".obj")
  {
    return Read<vtkOBJReader>(path);
  }
  if (extension == ".vtp")
  {
    return Read<vtkXMLPolyDataReader>(path);
  }
  if (extension == ".vtk")
  {
    return Read<vtkGenericDataObjectReader>(path);
  }
  return Read<vtkGLTFReader>(path);
}

//------------------------------------------------------------------------------
// Of a number in a binary PLY file.
double CountPLYBytes(const std::string& type)
{
  const auto isOne = [&type](std::initializer_list<const char*> names)
  { return std::find(names.begin(), names.end(), type) != names.end(); };
  return isOne({ "double", "float64" })                    ? 8.0
         : isOne({ "char", "uchar", "int8", "uint8" })     ? 1.0
         : isOne({ "short", "ushort", "int16", "uint16" }) ? 2.0
                                                           : 4.0;
}

//------------------------------------------------------------------------------
// VTK's PLY reader trusts its header: what it would make up is refused first.
void CheckPLYHeader(const std::string& path)
{
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::string element;
  std::set<std::string> coordinates;
  bool isText = false;
  double count = 0.0;    // of the element
  double expected = 0.0; // bytes after the header, at least
  const auto fail = [&path](const std::string& what)
  { throw tool::Error(path + ": PLY header: " + what); };
  const auto next = [&]()
  {
    line.clear();
    for (char c; line.size() < 4096 && file.get(c) && c != '\n';)
    {
      line += c == '\r' ? ' ' : c;
    }
    return !line.empty() || file.good();
  };
  if (!next() || line.compare(0, 3, "ply") != 0)
  {
    fail("expected the word 'ply' first");
  }
  while (next() && line.compare(0, 10, "end_header") != 0)
  {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "format")
    {
      words >> word;
      isText = word == "ascii";
    }
    else if (word == "element")
    {
      count = -1.0;
      words >> element >> count;
      if (!(count >= 0.0) || count > static_cast<double>(size))
      {
        fail("element '" + element + "' has a count that a file of " + std::to_string(size) +
             " bytes cannot hold");
      }
    }
    else if (word == "property")
    {
      std::string type;
      words >> type >> word; // of a list: the type of its length
      expected += count * (isText ? 2.0 : CountPLYBytes(type == "list" ? word : type));
      if (element == "vertex")
      {
        coordinates.insert(word);
      }
    }
  }
  if (line.compare(0, 10, "end_header") != 0)
  {
    fail("'end_header' is missing");
  }
  const double left = static_cast<double>(size) - static_cast<double>(file.tellg());
  if (expected > left + 1.0)
  {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::setprecision(15) << "the elements take at least " << expected
         << " bytes, but the file ends after " << left << " of them";
    fail(text.str());
  }
  for (const char* name : { "x", "y", "z" })
  {
    if (!coordinates.count(name))
    {
      fail(std::string("vertex property '") + name + "' is missing");
    }
  }
}

//------------------------------------------------------------------------------
// VTK's OBJ reader follows the indices of faces wherever they point.
void CheckOBJIndices(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  const char* const names[3] = { "v", "vt", "vn" };
  long long counts[3] = { 0, 0, 0 };
  std::vector<std::string> faces;
  std::vector<int> places;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
  {
    std::istringstream words(line);
    std::string word;
    words >> word;
    for (int k = 0; k < 3; ++k)
    {
      counts[k] += word == names[k];
    }
    if (word == "f" || word == "l" || word == "p")
    {
      while (words >> word && word[0] != '#')
      {
        faces.push_back(word);
        places.push_back(number);
      }
    }
  }
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    std::istringstream parts(faces[f]);
    std::string part;
    for (int k = 0; k < 3 && std::getline(parts, part, '/'); ++k)
    {
      const long long index = part.empty() ? 1 : std::strtoll(part.c_str(), nullptr, 10);
      if (!part.empty() && (index == 0 || std::llabs(index) > counts[k]))
      {
        throw tool::Error(path + ":" + std::to_string(places[f]) + ": index '" +
                          part.substr(0, 20) + "' points to none of the " +
                          std::to_string(counts[k]) + " '" + names[k] + "' lines");
      }
    }
  }
}

//------------------------------------------------------------------------------
// Filters follow cells to their points wherever these are.
void CheckCells(const std::string& path, vtkDataObject* data)
{
  auto* mesh = vtkPointSet::SafeDownCast(data);
  if (!mesh)
  {
    return;
  }
  const vtkIdType points = mesh->GetNumberOfPoints();
  for (vtkIdType k = 0; k < points; ++k)
  {
    double p[3];
    mesh->GetPoint(k, p);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    {
      throw tool::Error(path + ": point " + std::to_string(k) + " is not finite");
    }
  }
  const auto check = [&path, points](vtkCellArray* cells)
  {
    vtkNew<vtkIdList> ids;
    for (vtkIdType k = 0; cells && k < cells->GetNumberOfCells(); ++k)
    {
      cells->GetCellAtId(k, ids);
      for (vtkIdType n = 0; n < ids->GetNumberOfIds(); ++n)
      {
        if (ids->GetId(n) < 0 || ids->GetId(n) >= points)
        {
          throw tool::Error(path + ": a cell names point " + std::to_string(ids->GetId(n)) +
                            ", but there are " + std::to_string(points) + " points");
        }
      }
    }
  };
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    check(surface->GetVerts());
    check(surface->GetLines());
    check(surface->GetPolys());
    check(surface->GetStrips());
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    check(grid->GetCells());
  }
}

//------------------------------------------------------------------------------
// A surface from whatever the reader gave: polygons as they are, parts put together, else the skin.
vtkSmartPointer<vtkPolyData> GetSurface(vtkDataObject* data)
{
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    return surface;
  }
  if (vtkDataSet::SafeDownCast(data))
  {
    vtkNew<vtkGeometryFilter> skin;
    skin->SetInputData(data);
    skin->Update();
    return skin->GetOutput();
  }
  vtkNew<vtkCompositeDataGeometryFilter> parts;
  parts->SetInputDataObject(data);
  parts->Update();
  return parts->GetOutput();
}

//------------------------------------------------------------------------------
// What can't be drawn is repaired, and said.
void RepairData(const std::string& path, vtkPolyData* mesh)
{
  const vtkIdType normals = tool::RepairNormals(mesh);
  if (normals > 0)
  {
    tool::PrintNote(path + ": " + std::to_string(normals) + " of " +
                    std::to_string(mesh->GetNumberOfPoints()) +
                    " normals are not finite or have no length; the polygons around give theirs");
  }
  for (vtkDataArray* array :
    { mesh->GetPointData()->GetTCoords(), mesh->GetPointData()->GetTangents() })
  {
    vtkIdType bad = 0;
    for (vtkIdType k = 0; array && k < array->GetNumberOfTuples(); ++k)
    {
      const int components = std::min(array->GetNumberOfComponents(), 4);
      double tuple[4];
      bool isFinite = true;
      for (int c = 0; c < components; ++c)
      {
        tuple[c] = array->GetComponent(k, c);
        isFinite = isFinite && std::isfinite(tuple[c]);
      }
      for (int c = 0; !isFinite && c < components; ++c)
      {
        array->SetComponent(k, c, 0.0);
      }
      bad += isFinite ? 0 : 1;
    }
    if (bad > 0)
    {
      tool::PrintNote(
        path + ": " + std::to_string(bad) + " of " + std::to_string(mesh->GetNumberOfPoints()) +
        (array == mesh->GetPointData()->GetTangents() ? " tangents" : " texture coordinates") +
        " are not finite; they are taken as 0");
    }
  }
}

//------------------------------------------------------------------------------
// The whole way from a file to a surface with normals, which trusts the file.
vtkSmartPointer<vtkPolyData> ReadMesh(const std::string& path)
{
  const vtkSmartPointer<vtkAlgorithm> reader = MakeReader(path);
  if (tool::Extension(path) == ".ply")
  {
    CheckPLYHeader(path);
  }
  else if (tool::Extension(path) == ".obj")
  {
    CheckOBJIndices(path);
  }
  reader->Update();
  std::string errors = tool::TakeErrorText();
  vtkDataObject* data = reader->GetOutputDataObject(0);
  if (!errors.empty() || !data)
  {
    throw tool::Error(path + ": can't be read: " + (errors.empty() ? "no data in it" : errors));
  }

  CheckCells(path, data);
  vtkSmartPointer<vtkPolyData> surface = GetSurface(data);
  CheckCells(path, surface);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(surface);
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  triangles->Update();
  surface = triangles->GetOutput();
  if (!surface->GetPointData()->GetNormals())
  {
    surface = tool::AddNormals(surface, FeatureAngle);
  }
  RepairData(path, surface);
  errors = tool::TakeErrorText();
  const double size = surface->GetLength();
  if (!errors.empty() || surface->GetNumberOfPolys() == 0 || !std::isfinite(size) || !(size > 0.0))
  {
    throw tool::Error(path + ": has no surface to show" + (errors.empty() ? "" : ": " + errors));
  }
  return surface;
}

//------------------------------------------------------------------------------
struct Point
{
  double X;
  double Y;
  double Z;
};

//------------------------------------------------------------------------------
// position(s, t), s and t in [0,1], as a grid of quads with normals by central differences, on the
// side from which s runs to the right where t runs downwards.
vtkSmartPointer<vtkPolyData> MakeParametric(
  int ns, int nt, const std::function<Point(double, double)>& position)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetName("Normals");
  constexpr double e = 1e-4;
  for (int b = 0; b <= nt; ++b)
  {
    for (int a = 0; a <= ns; ++a)
    {
      const double s = static_cast<double>(a) / ns;
      const double t = static_cast<double>(b) / nt;
      const Point p = position(s, t);
      points->InsertNextPoint(p.X, p.Y, p.Z);

      // Poles have no derivative along s: look from a little beside.
      const double inside = std::min(std::max(t, 2.0 * e), 1.0 - 2.0 * e);
      const Point s0 = position(s - e, inside);
      const Point s1 = position(s + e, inside);
      const Point t0 = position(s, inside - e);
      const Point t1 = position(s, inside + e);
      const double ds[3] = { s1.X - s0.X, s1.Y - s0.Y, s1.Z - s0.Z };
      const double dt[3] = { t1.X - t0.X, t1.Y - t0.Y, t1.Z - t0.Z };
      double n[3];
      vtkMath::Cross(dt, ds, n);
      vtkMath::Normalize(n);
      normals->InsertNextTuple(n);
    }
  }
  vtkNew<vtkCellArray> quads;
  for (int b = 0; b < nt; ++b)
  {
    for (int a = 0; a < ns; ++a)
    {
      const vtkIdType k = static_cast<vtkIdType>(b) * (ns + 1) + a;
      const vtkIdType quad[4] = { k, k + ns + 1, k + ns + 2, k + 1 };
      quads->InsertNextCell(4, quad);
    }
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(quads);
  surface->GetPointData()->SetNormals(normals);
  return surface;
}
}

//------------------------------------------------------------------------------
const std::vector<std::string>& GetMeshExtensions()
{
  static const std::vector<std::string> endings = { ".ply", ".stl", ".obj", ".vtp", ".vtk", ".gltf",
    ".glb" };
  return endings;
}

//------------------------------------------------------------------------------
bool IsMeshFile(const std::string& path)
{
  const std::vector<std::string>& known = GetMeshExtensions();
  return path == "ball-on-foot" ||
         std::find(known.begin(), known.end(), Extension(path)) != known.end();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> LoadMesh(const std::string& path)
{
  if (path == "ball-on-foot")
  {
    return MakeBallOnFoot();
  }
  if (!IsMeshFile(path))
  {
    throw Error(path + ": is no mesh this tool reads (ply, stl, obj, vtp, vtk, gltf, glb)");
  }
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
  {
    throw Error(path + ": there is no such file");
  }
  return ReadApart(path, [&path]() { return ReadMesh(path); });
}

//------------------------------------------------------------------------------
int AnswerLoadMesh(const std::string& path)
{
  return AnswerApart(path, [&path]() { return ReadMesh(path); });
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSphere()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(256);
  sphere->SetPhiResolution(128);
  sphere->Update();
  return sphere->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeBallOnFoot()
{
  // Profile (radius, height): ball, concave neck, rounded rim; arcs that touch with equal tangents.
  constexpr double pi = 3.14159265358979323846;
  constexpr double ball = 0.64;
  constexpr double ballHeight = 1.0;
  constexpr double join = 0.75 * pi; // polar angle where the ball ends
  constexpr double neck = 0.5;
  constexpr double rim = 0.2;
  const double neckX = (ball + neck) * std::sin(join);
  const double neckY = ballHeight + (ball + neck) * std::cos(join);
  // The neck turns from the ball's tangent to the horizontal: its angle shrinks from join to 0.
  const double lengths[3] = { ball * join, neck * join, rim * 0.5 * pi };
  const double total = lengths[0] + lengths[1] + lengths[2];

  const auto position = [=](double s, double t)
  {
    double x;
    double y;
    const double length = t * total;
    if (length < lengths[0])
    {
      const double a = length / ball;
      x = ball * std::sin(a);
      y = ballHeight + ball * std::cos(a);
    }
    else if (length < lengths[0] + lengths[1])
    {
      const double a = join - (length - lengths[0]) / neck;
      x = neckX - neck * std::sin(a);
      y = neckY - neck * std::cos(a);
    }
    else
    {
      const double a = (length - lengths[0] - lengths[1]) / rim;
      x = neckX + rim * std::sin(a);
      y = neckY - neck - rim + rim * std::cos(a);
    }
    // Folds begin smoothly below the neck's narrowest place and turn a little on their way down.
    const double below = std::max(0.0, (length - lengths[0] - 0.35 * lengths[1]) / total);
    const double depth = 0.42 * below * below / (below + 0.2);
    const double azimuth = 2.0 * pi * s;
    x *= 1.0 + depth * std::cos(11.0 * azimuth + 4.0 * below);
    return Point{ x * std::sin(azimuth), y, x * std::cos(azimuth) };
  };
  return MakeParametric(360, 240, position);
}
} // namespace tool
