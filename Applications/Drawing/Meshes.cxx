// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes.h"

#include "Files.h"
#include "Program.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkCompositeDataGeometryFilter.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkGLTFReader.h"
#include "vtkGenericDataObjectReader.h"
#include "vtkGeometryFilter.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkPLYReader.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyDataNormals.h"
#include "vtkSTLReader.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkTriangleFilter.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <new>
#include <set>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace tool
{
namespace
{
// Edges sharper than this stay sharp when normals are made.
constexpr double FeatureAngle = 60.0;

//------------------------------------------------------------------------------
// With smooth normals: points that lie on each other, as on the seam of a texture, become one. That
// spoils texture coordinates, by which this program draws nothing.
vtkSmartPointer<vtkPolyData> AddNormals(vtkPolyData* mesh, double featureAngle)
{
  vtkNew<vtkCleanPolyData> welded;
  welded->SetInputData(mesh);
  welded->SetTolerance(0.0);
  welded->Update();
  vtkPolyData* polygons = welded->GetOutput();
  polygons->SetLines(nullptr); // what has become of polygons without an area
  polygons->SetVerts(nullptr);
  polygons->GetCellData()->Initialize();
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(polygons);
  normals->SetFeatureAngle(featureAngle);
  normals->Update();
  return normals->GetOutput();
}

//------------------------------------------------------------------------------
template <typename Reader>
vtkSmartPointer<vtkAlgorithm> MakeReader(const std::string& path)
{
  auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(path.c_str());
  return reader;
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
  const auto fail = [&path](const std::string& what)
  { throw Error(path + ": PLY header: " + what); };
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  std::string header(1 << 20, ' ');
  std::ifstream file(path, std::ios::binary);
  file.read(header.data(), static_cast<std::streamsize>(header.size()));
  header.resize(static_cast<std::size_t>(file.gcount()));
  if (header.compare(0, 3, "ply") != 0)
  {
    fail("expected the word 'ply' first");
  }
  const std::size_t end = header.find("\nend_header");
  if (end == std::string::npos)
  {
    fail("'end_header' is missing");
  }
  std::string element;
  std::set<std::string> coordinates;
  bool isText = false;
  double count = 0.0;    // of the element
  double expected = 0.0; // bytes after the header, at least
  std::istringstream lines(header.substr(0, end));
  for (std::string line; std::getline(lines, line);)
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
  const std::uintmax_t left = size - std::min(header.find('\n', end + 1), header.size() - 1) - 1;
  if (expected > static_cast<double>(left) + 1.0)
  {
    fail("the elements take at least " + std::to_string(static_cast<std::uintmax_t>(expected)) +
         " bytes, but the file ends after " + std::to_string(left) + " of them");
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
        throw Error(path + ":" + std::to_string(places[f]) + ": index '" + part.substr(0, 20) +
                    "' points to none of the " + std::to_string(counts[k]) + " '" + names[k] +
                    "' lines");
      }
    }
  }
}

//------------------------------------------------------------------------------
// The tuples that hold a number that is not finite or, of directions, have no length.
std::vector<vtkIdType> FindBad(vtkDataArray* array, bool isDirection)
{
  std::vector<vtkIdType> bad;
  for (vtkIdType k = 0; array && k < array->GetNumberOfTuples(); ++k)
  {
    double sum = 0.0; // of squares: finite where all values are
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      sum += array->GetComponent(k, c) * array->GetComponent(k, c);
    }
    if (!std::isfinite(sum) || (isDirection && sum == 0.0))
    {
      bad.push_back(k);
    }
  }
  return bad;
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
  const std::vector<vtkIdType> bad =
    FindBad(mesh->GetPoints() ? mesh->GetPoints()->GetData() : nullptr, false);
  if (!bad.empty())
  {
    throw Error(path + ": point " + std::to_string(bad.front()) + " is not finite");
  }
  const double points = static_cast<double>(mesh->GetNumberOfPoints());
  const auto check = [&](vtkCellArray* cells)
  {
    double range[2] = { 0.0, -1.0 };
    if (cells && cells->GetNumberOfConnectivityIds() > 0)
    {
      cells->GetConnectivityArray()->GetRange(range, 0);
    }
    if (range[0] < 0.0 || range[1] >= points)
    {
      throw Error(path + ": a cell names point " +
                  FormatNumber(range[0] < 0.0 ? range[0] : range[1]) + ", but there are " +
                  FormatNumber(points) + " points");
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
// Normals where there are none, or bad ones, and tangents that are finite; what was bad is said.
vtkSmartPointer<vtkPolyData> RepairData(const std::string& path, vtkPolyData* mesh)
{
  vtkPointData* data = mesh->GetPointData();
  const auto note = [&](std::size_t count, const std::string& what)
  {
    if (count > 0)
    {
      PrintNote(path + ": " + std::to_string(count) + " of " +
                std::to_string(mesh->GetNumberOfPoints()) + " " + what);
    }
  };
  const std::vector<vtkIdType> badTangents = FindBad(data->GetTangents(), false);
  note(badTangents.size(), "tangents are not finite; they are taken as 0");
  for (const vtkIdType k : badTangents)
  {
    data->GetTangents()->SetTuple3(k, 0.0, 0.0, 0.0);
  }
  const std::vector<vtkIdType> badNormals = FindBad(data->GetNormals(), true);
  note(
    badNormals.size(), "normals are not finite or have no length; all are made from the polygons");
  return data->GetNormals() && badNormals.empty() ? vtkSmartPointer<vtkPolyData>(mesh)
                                                  : AddNormals(mesh, FeatureAngle);
}

//------------------------------------------------------------------------------
// The whole way from a file to a surface with normals, which trusts the file.
vtkSmartPointer<vtkPolyData> ReadMesh(const std::string& path)
{
  const std::string ending = Extension(path);
  if (ending == ".ply")
  {
    CheckPLYHeader(path);
  }
  else if (ending == ".obj")
  {
    CheckOBJIndices(path);
  }
  const vtkSmartPointer<vtkAlgorithm> reader =
    ending == ".ply"   ? MakeReader<vtkPLYReader>(path)
    : ending == ".stl" ? MakeReader<vtkSTLReader>(path)
    : ending == ".obj" ? MakeReader<vtkOBJReader>(path)
    : ending == ".vtp" ? MakeReader<vtkXMLPolyDataReader>(path)
    : ending == ".vtk" ? MakeReader<vtkGenericDataObjectReader>(path)
                       : MakeReader<vtkGLTFReader>(path);
  reader->Update();
  std::string errors = TakeErrorText();
  vtkDataObject* data = reader->GetOutputDataObject(0);
  if (!errors.empty() || !data)
  {
    throw Error(path + ": can't be read: " + (errors.empty() ? "no data in it" : errors));
  }

  CheckCells(path, data);
  vtkSmartPointer<vtkPolyData> surface = GetSurface(data);
  CheckCells(path, surface);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(surface);
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  triangles->Update();
  surface = RepairData(path, triangles->GetOutput());
  errors = TakeErrorText();
  const double size = surface->GetLength();
  if (!errors.empty() || surface->GetNumberOfPolys() == 0 || !std::isfinite(size) || !(size > 0.0))
  {
    throw Error(path + ": has no surface to show" + (errors.empty() ? "" : ": " + errors));
  }
  return surface;
}

//------------------------------------------------------------------------------
constexpr const char* NotesName = "Notes"; // the field that holds what the child had to say
constexpr int HasError = 1;                // exit status: the answer is a message

//------------------------------------------------------------------------------
// How a program ended, as waitpid says. It begins anew: a copy of this one would have its locks,
// and not its threads. It does not outlive the call.
int RunTool(std::string program, std::string path, std::string answer)
{
  struct Child
  {
    pid_t Id = -1;
    ~Child()
    {
      if (this->Id > 0)
      {
        kill(this->Id, SIGKILL);
        waitpid(this->Id, nullptr, 0);
      }
    }
  } child;
  struct sigaction given = {};
  if (sigaction(SIGCHLD, nullptr, &given) == 0 && given.sa_handler == SIG_IGN)
  {
    std::signal(SIGCHLD, SIG_DFL); // else nobody is told how a child ended
  }
  std::string option = ReadMeshOption;
  char* const words[] = { program.data(), option.data(), path.data(), answer.data(), nullptr };
  const int error = posix_spawn(&child.Id, program.c_str(), nullptr, nullptr, words, environ);
  if (error != 0)
  {
    child.Id = -1;
    throw Error(std::string("no process could be started: ") + std::strerror(error));
  }
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(child.Id, &status, WNOHANG)) == 0)
  {
    Interruptible::Check();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  child.Id = -1;
  Interruptible::Check(); // Ctrl-C may have ended the child, too
  if (ended < 0)
  {
    throw Error(
      std::string("it is not known how the reader's process ended: ") + std::strerror(errno));
  }
  return status;
}

//------------------------------------------------------------------------------
void WriteMesh(const std::string& answer, vtkPolyData* mesh, const std::string& notes)
{
  vtkNew<vtkPolyData> copy;
  copy->ShallowCopy(mesh);
  vtkNew<vtkStringArray> said;
  said->SetName(NotesName);
  said->InsertNextValue(notes);
  copy->GetFieldData()->AddArray(said);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(copy);
  writer->SetFileName(answer.c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToNone();
  if (!writer->Write())
  {
    throw Error("the mesh could not be handed over: " + TakeErrorText());
  }
}

//------------------------------------------------------------------------------
// In a process of the tool's program, where that lies beside this one. A crash there is an Error
// here that names the file, and Ctrl-C, or the stop of this thread's BackgroundWork, ends that
// process whatever it does.
vtkSmartPointer<vtkPolyData> ReadApart(const std::string& path)
{
  const std::string program = FindBeside("measured-brdf"); // which answers ReadMeshOption
  if (program.empty())
  {
    return ReadMesh(path);
  }
  // A file without a name for the child's answer: nothing is left of it, however both end.
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  if (!file)
  {
    throw Error(std::string("no temporary file can be made: ") + std::strerror(errno));
  }
  const std::string answer = "/proc/self/fd/" + std::to_string(fileno(file.get()));
  const int status = RunTool(program, path, answer);
  if (WIFEXITED(status) && WEXITSTATUS(status) == HasError)
  {
    std::ifstream message(answer, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(message), {});
    if (!text.empty())
    {
      throw Error(text);
    }
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
  {
    throw Error(path + ": is damaged: VTK's reader ended " +
                (WIFSIGNALED(status) ? "by signal " + std::to_string(WTERMSIG(status)) + " (" +
                                         strsignal(WTERMSIG(status)) + ")"
                                     : "without an answer") +
                ", expected a file that is whole, whose counts and indices fit together");
  }
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(answer.c_str());
  reader->Update();
  const std::string errors = TakeErrorText();
  if (!errors.empty())
  {
    throw Error("the mesh could not be handed over: " + errors);
  }
  vtkFieldData* said = reader->GetOutput()->GetFieldData();
  if (auto* notes = vtkStringArray::SafeDownCast(said->GetAbstractArray(NotesName)))
  {
    PrintNote(notes->GetValue(0));
    said->RemoveArray(NotesName);
  }
  return reader->GetOutput();
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
  return ReadApart(path);
}

//------------------------------------------------------------------------------
int AnswerLoadMesh(const std::string& path, const std::string& answer)
{
  std::signal(SIGINT, SIG_IGN); // the parent's to answer
  const rlimit none = { 0, 0 };
  setrlimit(RLIMIT_CORE, &none);
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  dup2(STDERR_FILENO, STDOUT_FILENO);    // what VTK's readers print is no part of the answer
  const std::atomic<bool> stop{ false }; // a signal stops the process
  BackgroundWork work(stop, [](const std::string&, double) {});
  std::string problem;
  try
  {
    const vtkSmartPointer<vtkPolyData> mesh = ReadMesh(path);
    WriteMesh(answer, mesh, work.Notes);
    return 0;
  }
  catch (const std::bad_alloc&)
  {
    problem = path + ": its data need more memory than there is";
  }
  catch (const std::exception& error)
  {
    problem = error.what();
  }
  std::ofstream(answer, std::ios::binary | std::ios::trunc) << problem;
  return HasError;
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
  const double pi = vtkMath::Pi();
  constexpr double ball = 0.64;
  constexpr double ballHeight = 1.0;
  const double join = 0.75 * pi; // polar angle where the ball ends
  constexpr double neck = 0.5;
  constexpr double rim = 0.2;
  const double neckX = (ball + neck) * std::sin(join);
  const double neckY = ballHeight + (ball + neck) * std::cos(join);
  // The neck turns from the ball's tangent to the horizontal: its angle shrinks from join to 0.
  const double lengths[3] = { ball * join, neck * join, rim * 0.5 * pi };
  const double total = lengths[0] + lengths[1] + lengths[2];

  vtkNew<vtkPlaneSource> grid; // x: the azimuth, y: from the foot up along the profile
  grid->SetResolution(360, 240);
  grid->SetOrigin(0.0, 0.0, 0.0);
  grid->SetPoint1(1.0, 0.0, 0.0);
  grid->SetPoint2(0.0, 1.0, 0.0);
  grid->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  grid->Update();
  vtkPolyData* mesh = grid->GetOutput();
  for (vtkIdType k = 0; k < mesh->GetNumberOfPoints(); ++k)
  {
    double at[3];
    mesh->GetPoint(k, at);
    const double length = (1.0 - at[1]) * total;
    double x, y;
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
    const double azimuth = at[0] < 1.0 ? 2.0 * pi * at[0] : 0.0; // both ends are one place
    x *= 1.0 + depth * std::cos(11.0 * azimuth + 4.0 * below);
    mesh->GetPoints()->SetPoint(k, x * std::sin(azimuth), y, x * std::cos(azimuth));
  }
  mesh->GetPointData()->Initialize();
  return AddNormals(mesh, 180.0);
}
} // namespace tool
