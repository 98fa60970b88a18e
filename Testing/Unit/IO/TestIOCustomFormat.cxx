// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Formats that a program adds: readers and writers use them, and only while they are registered.

#include "ErrorCatcher.h"
#include "TestIOHelpers.h"
#include "vtkBRDFFormat.h"
#include "vtkBRDFFormats.h"
#include "vtkBRDFReader.h"
#include "vtkBRDFWriter.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <gtest/gtest.h>

#include <fstream>
#include <new>
#include <stdexcept>
#include <string>

namespace
{
// "own" and one character: what Read does.
class OwnFormat : public vtkBRDFFormat
{
public:
  static OwnFormat* New();
  vtkTypeMacro(OwnFormat, vtkBRDFFormat);

  std::string GetName() override { return "own format"; }
  std::string GetDescription() override { return "the test's .own"; }
  std::vector<std::string> GetExtensions() override { return { ".own" }; }
  bool CanRead(const File& file) override { return file.Bytes.substr(0, 3) == "own"; }
  std::vector<std::string> GetMaterialNames(const File&) override { return { "a", "b" }; }
  bool Read(const File& file, Content& content, std::string& error) override
  {
    switch (file.Bytes[3])
    {
      case 't':
        throw std::runtime_error("thrown\x1b[31m");
      case 'm':
        throw std::bad_alloc();
      case 'e':
        error = file.Path + ": wrong\x1b[31m";
        return false;
      case 'n':
        return true; // but no material
      default:
        vtkNew<vtkLambertBRDF> brdf;
        brdf->SetName(file.Material);
        content.BRDF = brdf;
        content.AddNote("a note");
        content.NumberOfInvalidValues = 3;
        return true;
    }
  }
  bool CanWrite() override { return true; }
  bool Write(vtkBRDF*, const std::string& path, bool, std::string&) override
  {
    std::ofstream(path) << "own!";
    return true;
  }
};
vtkStandardNewMacro(OwnFormat);

class CustomFormat : public ::testing::Test
{
protected:
  void SetUp() override { ASSERT_TRUE(vtkBRDFFormats::Register(this->Format)); }
  void TearDown() override { vtkBRDFFormats::Unregister(this->Format); }

  std::string Write(const std::string& text)
  {
    testio::WriteBytes(this->Folder("custom.own"), text);
    return this->Folder("custom.own");
  }

  const testio::Folder Folder;
  vtkNew<OwnFormat> Format;
  vtkNew<vtkBRDFReader> Reader;
};
} // namespace

//------------------------------------------------------------------------------
TEST_F(CustomFormat, IsReadAndWritten)
{
  vtkNew<vtkBRDFWriter> writer;
  vtkNew<vtkLambertBRDF> brdf;
  writer->SetBRDF(brdf);
  writer->SetFileName(this->Write(""));
  ASSERT_TRUE(writer->Write()) << writer->GetErrorMessage();
  this->Reader->SetFileName(writer->GetFileName() + "#b");
  ASSERT_TRUE(this->Reader->Read()) << this->Reader->GetErrorMessage();
  EXPECT_EQ(this->Reader->GetFormatName(), "own format");
  EXPECT_EQ(this->Reader->GetNotes(), "a note");
  EXPECT_EQ(this->Reader->GetNumberOfInvalidValues(), 3);
  EXPECT_EQ(this->Reader->GetBRDF()->GetName(), "b");
  EXPECT_EQ(this->Reader->GetMaterialNames(), (std::vector<std::string>{ "a", "b" }));
}

//------------------------------------------------------------------------------
// Whatever a format does, the reader says it once, and keeps the material that it has.
TEST_F(CustomFormat, ErrorsAreTheReaders)
{
  this->Reader->SetFileName(this->Write("own!"));
  ASSERT_TRUE(this->Reader->Read());
  vtkBRDF* const before = this->Reader->GetBRDF();
  const char* const said[][2] = { { "ownt", "thrown" }, { "ownm", "alloc" }, { "owne", "wrong" },
    { "ownn", "gave no material" } };
  for (const auto& [text, message] : said)
  {
    this->Reader->SetFileName(this->Write(text));
    ErrorCatcher errors(this->Reader);
    EXPECT_FALSE(this->Reader->Read());
    EXPECT_EQ(errors.Take(), 1) << text;
    EXPECT_NE(this->Reader->GetErrorMessage().find(message), std::string::npos)
      << this->Reader->GetErrorMessage();
    EXPECT_NE(this->Reader->GetErrorMessage().find("custom.own"), std::string::npos);
    EXPECT_EQ(this->Reader->GetErrorMessage().find('\x1b'), std::string::npos);
    EXPECT_EQ(this->Reader->GetBRDF(), before);
  }
}

//------------------------------------------------------------------------------
TEST(BuiltInFormats, NewInstancesReadNothing)
{
  for (const auto& format : vtkBRDFFormats::GetFormats())
  {
    const auto made = vtkSmartPointer<vtkBRDFFormat>::Take(format->NewInstance());
    const vtkBRDFFormat::File file;
    vtkBRDFFormat::Content content;
    std::string error;
    EXPECT_EQ(made->GetName(), "");
    EXPECT_FALSE(made->CanRead(file));
    EXPECT_FALSE(made->CanWrite());
    EXPECT_FALSE(made->Read(file, content, error));
    EXPECT_NE(error.find("no format"), std::string::npos) << error;
  }
}

//------------------------------------------------------------------------------
TEST_F(CustomFormat, IsListedWhileItIsRegistered)
{
  EXPECT_EQ(vtkBRDFFormats::GetFormats().front().Get(), this->Format.Get());
  EXPECT_EQ(vtkBRDFFormats::GetNames().find("own format"), 0u);
  EXPECT_NE(vtkBRDFFormats::GetDescriptions().find("the test's .own, "), std::string::npos);
  EXPECT_EQ(vtkBRDFFormats::GetExtensions(true), ".own, .exr or .binary");
  EXPECT_FALSE(vtkBRDFFormats::Register(this->Format)); // twice
  vtkNew<OwnFormat> namesake;
  EXPECT_FALSE(vtkBRDFFormats::Register(namesake));
  EXPECT_FALSE(vtkBRDFFormats::Register(nullptr));

  EXPECT_TRUE(vtkBRDFFormats::Unregister(this->Format));
  EXPECT_FALSE(vtkBRDFFormats::Unregister(this->Format));
  EXPECT_FALSE(vtkBRDFFormats::Unregister(vtkBRDFFormats::GetFormats().front())); // ours stay
  EXPECT_EQ(vtkBRDFFormats::GetExtensions(true), ".exr or .binary");
  this->Reader->SetFileName(this->Write("own\x01\x01\x01\x01\x01\x01\x01\x01\x01"));
  ErrorCatcher errors(this->Reader);
  EXPECT_FALSE(this->Reader->Read());
  EXPECT_NE(this->Reader->GetErrorMessage().find("MERL binary"), std::string::npos);
}
