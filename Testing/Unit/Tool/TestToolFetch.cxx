// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The list of downloads, and what addresses are allowed.
#include "Download.h"
#include "FetchCatalog.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

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
  const std::vector<std::string> near = tool::FindNearFetchNames("satin_purpel");
  EXPECT_NE(std::find(near.begin(), near.end(), "satin_purple"), near.end());
  EXPECT_EQ(tool::FindNearFetchNames("gold-paint"), std::vector<std::string>{ "merl-gold-paint" });
  EXPECT_TRUE(tool::FindNearFetchNames(std::string(100000, 'x')).empty());
}
