// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The list of downloads, and what comes out of archives.
#include "Download.h"
#include "FetchCatalog.h"
#include "ZipMember.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <string>

namespace
{
//------------------------------------------------------------------------------
std::string Number(std::uint64_t value, int bytes)
{
  std::string text;
  for (int k = 0; k < bytes; ++k)
  {
    text += static_cast<char>(value >> (8 * k));
  }
  return text;
}

//------------------------------------------------------------------------------
// An archive of one member, as APPNOTE.TXT lays it out.
struct SmallArchive
{
  explicit SmallArchive(const std::string& content, bool deflated = true)
  {
    std::string packed = content;
    if (deflated)
    {
      z_stream stream{};
      deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
      packed.resize(deflateBound(&stream, content.size()));
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
      stream.avail_in = static_cast<uInt>(content.size());
      stream.next_out = reinterpret_cast<Bytef*>(packed.data());
      stream.avail_out = static_cast<uInt>(packed.size());
      deflate(&stream, Z_FINISH);
      packed.resize(stream.total_out);
      deflateEnd(&stream);
    }
    const auto* bytes = reinterpret_cast<const Bytef*>(content.data());
    const uLong crc = crc32(crc32(0, nullptr, 0), bytes, static_cast<uInt>(content.size()));
    const std::string name = "folder/file";
    const std::string common = Number(0, 2) + Number(deflated ? 8 : 0, 2) + Number(0, 4) +
                               Number(crc, 4) + Number(packed.size(), 4) +
                               Number(content.size(), 4) + Number(name.size(), 2);
    this->Text = "before" + ("PK\3\4" + Number(20, 2)) + common + Number(3, 2) + name + "abc";
    this->First = this->Text.size();
    this->Text += packed;
    this->Directory = this->Text.size();
    this->Text += "PK\1\2" + Number(20, 2) + Number(20, 2) + common + Number(0, 2) + Number(0, 2) +
                  Number(0, 2) + Number(0, 2) + Number(0, 4) + Number(6, 4) + name;
    const std::size_t size = this->Text.size() - this->Directory;
    this->Text += "PK\5\6" + Number(0, 4) + Number(1, 2) + Number(1, 2) + Number(size, 4) +
                  Number(this->Directory, 4) + Number(2, 2) + "hi";
  }

  std::string Read(const std::string& name = "folder/file") const
  {
    const tool::ZipRange directory = tool::FindZipDirectory(this->Text, this->Text.size());
    const tool::ZipMember member = tool::FindZipMember(
      this->Text.substr(directory.First, directory.Size), name, this->Text.size());
    const std::uint64_t first =
      member.Header + tool::GetZipDataOffset(this->Text.substr(member.Header, tool::ZipHeaderSize));
    return tool::UnpackZipMember(member,
      this->Text.substr(std::min<std::size_t>(first, this->Text.size()), member.PackedSize));
  }

  std::string Text;
  std::size_t First = 0;
  std::size_t Directory = 0;
};
}

//------------------------------------------------------------------------------
TEST(Download, OnlyHttpsElsewhere)
{
  for (const char* url :
    { "https://example.org/a", "HTTPS://example.org", "http://127.0.0.1:8080/a",
      "http://127.1.2.3/", "http://localhost/a", "http://[::1]:80/a" })
  {
    EXPECT_TRUE(tool::IsAllowedUrl(url)) << url;
  }
  for (const char* url :
    { "", "example.org", "http://example.org/a", "ftp://127.0.0.1/", "file:///etc/passwd",
      "https://", "http://127.0.0.1@example.org/", "https://user@example.org/",
      "https://user:word@example.org/", "http://127.0.0.1.example.org/",
      "http://localhost.example.org", "http://10.0.0.1/", "http://[::2]/", "https://a b/",
      "https://a\n/", "http://example.org#127.0.0.1", "http://example.org?http://localhost" })
  {
    EXPECT_FALSE(tool::IsAllowedUrl(url)) << url;
  }
}

//------------------------------------------------------------------------------
TEST(Download, RedirectsStaySecure)
{
  const std::string local = "http://127.0.0.1:8080/a";
  for (const std::string from : { "https://example.org/a", "HTTPS://example.org/a" })
  {
    EXPECT_TRUE(tool::IsAllowedRedirect(from, "HTTPS://example.com/b"));
    EXPECT_FALSE(tool::IsAllowedRedirect(from, "http://example.org/a"));
    EXPECT_FALSE(tool::IsAllowedRedirect(from, local));
    EXPECT_TRUE(tool::IsAllowedRedirect(local, from));
  }
  EXPECT_TRUE(tool::IsAllowedRedirect(local, "http://localhost/b"));
  EXPECT_FALSE(tool::IsAllowedRedirect(local, "http://example.org/a"));
  EXPECT_FALSE(tool::IsAllowedRedirect(local, "https://user@example.org/a"));
}

//------------------------------------------------------------------------------
TEST(FetchCatalog, NamesAndFiles)
{
  const tool::FetchEntry* entry = tool::FindFetchEntry("satin_purple");
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->File, "satin_purple_rgb.bsdf");
  EXPECT_EQ(tool::FindFetchEntry("satin_purple_rgb.bsdf"), entry);
  EXPECT_EQ(entry->Url,
    "https://d38rqfq1h7iukm.cloudfront.net/media/materials/satin_purple/satin_purple_rgb.bsdf");
  EXPECT_FALSE(tool::FindFetchEntry("satin"));
  const tool::FetchEntry* merl = tool::FindFetchEntry("merl-gold-paint");
  ASSERT_TRUE(merl);
  EXPECT_EQ(merl->Member, "BRDFDatabase/brdfs/gold-paint.binary");
  EXPECT_EQ(merl->Size, 12u + 8u * 3u * 90u * 90u * 180u); // the format's
  EXPECT_TRUE(merl->Collection->NeedsAgreement);
  for (const tool::FetchEntry& each : tool::GetFetchCatalog())
  {
    EXPECT_TRUE(tool::IsAllowedUrl(each.Url)) << each.Name;
    EXPECT_GT(each.Limit, 0u) << each.Name;
  }
}

//------------------------------------------------------------------------------
TEST(FetchCatalog, NearNames)
{
  EXPECT_EQ(
    tool::FindNearFetchNames("satin_purpel", 1), std::vector<std::string>{ "satin_purple" });
  EXPECT_EQ(
    tool::FindNearFetchNames("gold-paint", 1), std::vector<std::string>{ "merl-gold-paint" });
  EXPECT_EQ(tool::FindNearFetchNames("satin", 3).size(), 3u);
  EXPECT_TRUE(tool::FindNearFetchNames(std::string(100000, 'x'), 5).empty());
}

//------------------------------------------------------------------------------
TEST(ZipMember, ReadsWhatIsThere)
{
  std::string content;
  for (int k = 0; k < 50000; ++k)
  {
    content += std::to_string(k * 7919);
  }
  EXPECT_EQ(SmallArchive(content).Read(), content);
  EXPECT_EQ(SmallArchive(content, false).Read(), content);
  EXPECT_THROW(SmallArchive(content).Read("folder/other"), tool::WrongBytes);
}

//------------------------------------------------------------------------------
TEST(ZipMember, RefusesWhatIsWrong)
{
  const std::string content(5000, 'x');
  for (const bool deflated : { true, false })
  {
    SmallArchive archive(content, deflated);
    archive.Text[archive.First + 3] ^= 1; // the data
    EXPECT_THROW(archive.Read(), tool::WrongBytes);
  }
  const auto broken = [&content](std::size_t at, const std::string& bytes, bool inEnd = false)
  {
    SmallArchive archive(content);
    archive.Text.replace(
      inEnd ? archive.Text.size() - 24 + at : archive.Directory + at, bytes.size(), bytes);
    EXPECT_THROW(archive.Read(), tool::WrongBytes) << at;
  };
  broken(0, "xx");                       // not an entry
  broken(8, Number(1, 2));               // encrypted
  broken(10, Number(12, 2));             // another method
  broken(16, Number(0, 4));              // another CRC
  broken(20, Number(0xffffffff, 4));     // packed size of ZIP64
  broken(24, Number(4999, 4));           // more than it says
  broken(24, Number(5001, 4));           // less than it says
  broken(28, Number(60000, 2));          // a name beyond the directory
  broken(42, Number(0xfffffff0, 4));     // a header beyond the archive
  broken(42, Number(7, 4));              // no header there
  broken(0, "xx", true);                 // no end record
  broken(4, Number(1, 2), true);         // several disks
  broken(12, Number(0xffffff, 4), true); // a directory too large
  broken(16, Number(0xffffffff, 4), true);
  EXPECT_THROW(tool::FindZipDirectory("", 0), tool::WrongBytes);
}

//------------------------------------------------------------------------------
// Any byte changed, and any end: the content, or an error.
TEST(ZipMember, GivesTheContentOrAnError)
{
  const std::string content =
    "The content of a small file, which is long enough to be packed well.";
  const std::string text = SmallArchive(content).Text;
  SmallArchive archive(content);
  const auto check = [&archive, &content](std::size_t at)
  {
    try
    {
      EXPECT_EQ(archive.Read(), content) << at;
    }
    catch (const tool::WrongBytes&)
    {
    }
  };
  for (std::size_t at = 0; at < text.size(); ++at)
  {
    for (const int flip : { 1, 0x80, 0xff })
    {
      archive.Text = text;
      archive.Text[at] = static_cast<char>(archive.Text[at] ^ flip);
      check(at);
    }
    archive.Text = text.substr(0, at);
    check(at);
  }
}
