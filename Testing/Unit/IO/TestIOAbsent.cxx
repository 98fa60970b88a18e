// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a build without an optional library says where it would be needed.
#include "ErrorCatcher.h"
#include "TestIOHelpers.h"

#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkPictureReader.h"
#include "vtkStringOutputWindow.h"

using namespace testio;

namespace
{

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
TEST(IOAbsent, OpenImageIO)
{
  if (MEASUREDBRDF_WITH_OPENIMAGEIO)
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
