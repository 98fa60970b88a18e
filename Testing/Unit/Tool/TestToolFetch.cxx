// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The list of downloads, and what addresses are allowed.
#include "Download.h"
#include "FetchCatalog.h"

#include <gtest/gtest.h>

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
  for (const tool::FetchEntry& each : tool::GetFetchCatalog())
  {
    EXPECT_TRUE(tool::IsAllowedUrl(each.Url)) << each.Name;
    EXPECT_GT(each.Limit, 0u) << each.Name;
  }
}
