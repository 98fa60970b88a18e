// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a build without an optional library says where it would be needed.
#include "ErrorCatcher.h"
#include "TestIOHelpers.h"

#include "vtkBRDFFormats.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkLambertBRDF.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkPictureReader.h"
#include "vtkStringOutputWindow.h"

using namespace testio;

namespace
{
constexpr bool HasOpenEXR = MEASUREDBRDF_WITH_OPENEXR;
constexpr bool HasOpenImageIO = MEASUREDBRDF_WITH_OPENIMAGEIO;
const std::string NoOpenEXR = "this build has no OpenEXR (MEASUREDBRDF_WITH_OPENEXR)";

bool Holds(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// What is printed while run() runs.
template <typename Run>
std::string Listen(const Run& run)
{
  vtkNew<vtkStringOutputWindow> window;
  const vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkOutputWindow::SetInstance(window);
  run();
  vtkOutputWindow::SetInstance(before);
  return window->GetOutput();
}
}

//------------------------------------------------------------------------------
// Lists name what is there, and nothing else.
TEST(IOAbsent, ListsFollowTheBuild)
{
  EXPECT_EQ(Holds(vtkBRDFFormats::GetNames(), "OpenEXR material"), HasOpenEXR);
  EXPECT_EQ(Holds(vtkBRDFFormats::GetDescriptions(), ".exr"), HasOpenEXR);
  EXPECT_EQ(vtkBRDFFormats::GetExtensions(true), HasOpenEXR ? ".exr or .binary" : ".binary");
  EXPECT_EQ(vtkBRDFFormats::FindForWriting(".exr") != nullptr, HasOpenEXR);
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    EXPECT_TRUE(vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name))) << name;
    EXPECT_TRUE(HasOpenEXR || name != "blue-car-paint");
  }
  EXPECT_EQ(vtkEmbeddedEnvironments::GetNumberOfEnvironments(), HasOpenEXR ? 3 : 2);
  EXPECT_EQ(vtkEmbeddedEnvironments::GetName(0), HasOpenEXR ? "room" : "sky");
}

//------------------------------------------------------------------------------
TEST(IOAbsent, OpenEXR)
{
  if (HasOpenEXR)
  {
    GTEST_SKIP() << "this build has OpenEXR";
  }
  const Folder folder;
  const std::string path = folder("a.exr");
  std::ofstream(path, std::ios::binary) << "\x76\x2f\x31\x01 and so on";
  vtkNew<vtkBRDFReader> reader;
  ErrorCatcher readErrors(reader);
  reader->SetFileName(path);
  EXPECT_FALSE(reader->Read());
  EXPECT_EQ(readErrors.Take(), 1);
  EXPECT_EQ(reader->GetErrorMessage(), path + ": " + NoOpenEXR + ": .exr materials cannot be read");

  vtkNew<vtkBRDFWriter> writer;
  ErrorCatcher writeErrors(writer);
  writer->SetBRDF(vtkNew<vtkLambertBRDF>());
  writer->SetFileName(folder("b.exr"));
  EXPECT_FALSE(writer->Write());
  EXPECT_EQ(writeErrors.Take(), 1);
  EXPECT_EQ(writer->GetErrorMessage(),
    folder("b.exr") + ": " + NoOpenEXR + ": .exr materials cannot be written");
  EXPECT_FALSE(std::filesystem::exists(folder("b.exr")));

  const std::string paint =
    Listen([] { EXPECT_FALSE(vtkEmbeddedMaterials::NewBRDF("blue-car-paint")); });
  EXPECT_TRUE(Holds(paint, NoOpenEXR + ": the embedded material 'blue-car-paint'")) << paint;
  const std::string room =
    Listen([] { EXPECT_FALSE(vtkEmbeddedEnvironments::NewEnvironment("room")); });
  EXPECT_TRUE(Holds(room, NoOpenEXR + ": the embedded environment 'room'")) << room;
}

//------------------------------------------------------------------------------
TEST(IOAbsent, OpenImageIO)
{
  if (HasOpenImageIO)
  {
    GTEST_SKIP() << "this build has OpenImageIO";
  }
  const Folder folder;
  const std::string path = folder("a.hdr");
  std::ofstream(path, std::ios::binary)
    << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x81\x80\x80\x80\x81";
  vtkNew<vtkEnvironmentReader> reader;
  ErrorCatcher errors(reader);
  reader->SetFileName(path);
  EXPECT_FALSE(reader->Read());
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_EQ(reader->GetErrorMessage(),
    path + ": this build has no OpenImageIO (MEASUREDBRDF_WITH_OPENIMAGEIO): image files cannot be "
           "read");
  EXPECT_FALSE(reader->GetEnvironment());
  vtkNew<vtkPictureReader> pictures;
  ErrorCatcher pictureErrors(pictures);
  pictures->SetFileName(path);
  EXPECT_FALSE(pictures->Read());
  EXPECT_EQ(pictureErrors.Take(), 1);
  EXPECT_EQ(pictures->GetErrorMessage(), reader->GetErrorMessage());
}

//------------------------------------------------------------------------------
TEST(IOAbsent, ATypoGetsTheNames)
{
  const std::string said =
    Listen([] { EXPECT_FALSE(vtkEmbeddedMaterials::NewBRDF("gold_paint")); });
  EXPECT_TRUE(Holds(said, "no embedded material 'gold_paint'")) << said;
  EXPECT_TRUE(Holds(said, "'gold-paint', ")) << said;
  const std::string hostile =
    Listen([] { EXPECT_FALSE(vtkEmbeddedMaterials::NewBRDF(std::string(1 << 20, '\x1b'))); });
  EXPECT_LT(hostile.size(), 1500u);
  EXPECT_FALSE(Holds(hostile, "\x1b"));
}
