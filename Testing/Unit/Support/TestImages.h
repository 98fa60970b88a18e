// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Images that tests write, and what the readers make of them.
 */

#ifndef TestImages_h
#define TestImages_h

#include "TestIOHelpers.h"

#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkPictureReader.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace testio
{
/// Whether the program has the decoder of builds without OpenImageIO.
#ifdef MEASUREDBRDF_TEST_IMAGES_BY_VTK
constexpr bool ReadsByVTK = true;
#else
constexpr bool ReadsByVTK = false;
#endif

/// Pixels as files have them: top row first.
inline void WriteImage(
  const std::string& path, const OIIO::ImageSpec& spec, const std::vector<float>& pixels)
{
  auto out = OIIO::ImageOutput::create(path);
  ASSERT_TRUE(out) << OIIO::geterror();
  ASSERT_TRUE(out->open(path, spec)) << out->geterror();
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data())) << out->geterror();
  out->close();
}

inline void WriteImage(const std::string& path, int width, int height, int channels,
  const std::vector<float>& pixels, OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT,
  const std::string& colorSpace = "")
{
  OIIO::ImageSpec spec(width, height, channels, type);
  if (!colorSpace.empty())
  {
    spec.attribute("oiio:ColorSpace", colorSpace);
  }
  WriteImage(path, spec, pixels);
}

inline vtkSmartPointer<vtkEnvironmentReader> ReadProbe(
  const std::string& path, const std::string& layer = "")
{
  auto reader = vtkSmartPointer<vtkEnvironmentReader>::New();
  reader->SetFileName(path);
  reader->SetLayer(layer);
  EXPECT_TRUE(reader->Read()) << reader->GetErrorMessage();
  return reader;
}

struct FoundImage
{
  int Width = 0;
  int Height = 0;
  std::vector<double> Values; // RGB, top row first
  std::string Notes;
};

/// What vtkEnvironmentReader reads.
inline FoundImage ReadTopFirst(const std::string& path, const std::string& layer = "")
{
  const auto reader = ReadProbe(path, layer);
  FoundImage found;
  found.Notes = reader->GetNotes();
  if (vtkEnvironment* environment = reader->GetEnvironment())
  {
    found.Width = environment->GetWidth();
    found.Height = environment->GetHeight();
    for (int y = found.Height - 1; y >= 0; --y)
    {
      const float* row = &environment->GetPixels()[std::size_t(3 * found.Width * y)];
      found.Values.insert(found.Values.end(), row, row + 3 * found.Width);
    }
  }
  return found;
}

inline void ExpectValues(const FoundImage& found, const std::vector<double>& expected,
  double tolerance = 0.0, const std::string& trace = "")
{
  SCOPED_TRACE(trace);
  ASSERT_EQ(found.Values.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
  {
    EXPECT_NEAR(found.Values[k], expected[k], tolerance) << k;
  }
}

/// A reader's Read fails with one error, whose message holds the path and the words.
template <typename Reader>
void ExpectReadFails(Reader* reader, const std::string& path, const std::vector<std::string>& words)
{
  vtkNew<ErrorCounter> errors;
  const unsigned long tag = reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->SetFileName(path);
  EXPECT_FALSE(reader->Read()) << path;
  reader->RemoveObserver(tag);
  EXPECT_EQ(errors->Count, 1) << path;
  const std::string message = reader->GetErrorMessage();
  for (const std::string& word : words)
  {
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' in: " << message;
  }
  EXPECT_NE(message.find(path), std::string::npos) << message;
}

/// No image for vtkEnvironmentReader nor for vtkPictureReader; what the first read before stays.
inline void ExpectImageRefused(const Folder& folder, const std::string& path,
  const std::vector<std::string>& words, const std::string& layer = "")
{
  WriteImage(folder("good.exr"), 2, 1, 3, std::vector<float>(6, 1.0f));
  const auto reader = ReadProbe(folder("good.exr"));
  vtkEnvironment* before = reader->GetEnvironment();
  reader->SetLayer(layer);
  ExpectReadFails(reader.Get(), path, words);
  EXPECT_EQ(reader->GetEnvironment(), before);
  if (layer.empty())
  {
    ExpectReadFails(vtkNew<vtkPictureReader>().Get(), path, {});
  }
}

inline void ExpectImageBytesRefused(
  const Folder& folder, const std::string& bytes, const std::vector<std::string>& words)
{
  ExpectImageRefused(folder, WriteBytes(folder("bad.image"), bytes), words);
}
} // namespace testio

#endif
