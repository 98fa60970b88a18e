// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WebAddress.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace
{
//------------------------------------------------------------------------------
bool IsPrintable(const std::string& text)
{
  return std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 127; });
}

//------------------------------------------------------------------------------
// "scheme" in lower case, and what stands behind "://".
bool Split(const std::string& url, std::string& scheme, std::string& rest)
{
  const std::size_t end = url.find("://");
  if (end == std::string::npos || !IsPrintable(url))
  {
    return false;
  }
  scheme = url.substr(0, end);
  std::transform(scheme.begin(), scheme.end(), scheme.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  rest = url.substr(end + 3);
  return true;
}

//------------------------------------------------------------------------------
// Of what stands behind "//": up to the path.
std::string GetAuthority(const std::string& rest)
{
  return rest.substr(0, rest.find_first_of("/?#\\"));
}

//------------------------------------------------------------------------------
bool IsThisMachine(const std::string& host)
{
  in_addr address;
  return host == "localhost" || host == "[::1]" ||
         (inet_pton(AF_INET, host.c_str(), &address) == 1 && ntohl(address.s_addr) >> 24 == 127);
}

//------------------------------------------------------------------------------
// The number that all of the text is.
bool Parse(const std::string& text, std::uint64_t& number)
{
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  return result.ec == std::errc() && result.ptr == end;
}
}

namespace tool
{
//------------------------------------------------------------------------------
bool IsAllowedUrl(const std::string& url)
{
  std::string scheme;
  std::string rest;
  if (!Split(url, scheme, rest))
  {
    return false;
  }
  const std::string authority = GetAuthority(rest);
  if (authority.empty() || HasUserName(url)) // names and passwords are for nobody here
  {
    return false;
  }
  if (scheme == "https")
  {
    return true;
  }
  const std::size_t bracket = authority.find(']');
  const std::size_t port = authority.find(':', bracket == std::string::npos ? 0 : bracket);
  return scheme == "http" && IsThisMachine(authority.substr(0, port));
}

//------------------------------------------------------------------------------
bool HasUserName(const std::string& address)
{
  const std::size_t slashes = address.find("//");
  const bool isWhole = // else they stand in a path
    slashes == 0 || (slashes != std::string::npos && address.find_first_of(":/?#") == slashes - 1);
  return isWhole && GetAuthority(address.substr(slashes + 2)).find('@') != std::string::npos;
}

//------------------------------------------------------------------------------
std::string MoveToBase(const std::string& url, const std::string& base)
{
  std::string scheme;
  std::string rest;
  if (base.empty() || !Split(url, scheme, rest))
  {
    return url;
  }
  return base + (base.back() == '/' ? "" : "/") + rest;
}

//------------------------------------------------------------------------------
std::optional<ContentRange> ParseContentRange(const std::string& text)
{
  const std::string unit = "bytes ";
  const std::size_t minus = text.find('-');
  const std::size_t slash = text.find('/');
  if (text.compare(0, unit.size(), unit) != 0 || minus == std::string::npos ||
      slash == std::string::npos || slash < minus)
  {
    return std::nullopt;
  }
  ContentRange range;
  if (!Parse(text.substr(unit.size(), minus - unit.size()), range.First) ||
      !Parse(text.substr(minus + 1, slash - minus - 1), range.Last) ||
      !Parse(text.substr(slash + 1), range.Total) || range.First > range.Last ||
      range.Last >= range.Total)
  {
    return std::nullopt;
  }
  return range;
}

//------------------------------------------------------------------------------
bool IsStrongTag(const std::string& tag)
{
  return tag.size() >= 2 && tag.size() <= 256 && tag.front() == '"' && tag.back() == '"' &&
         IsPrintable(tag) && tag.find('"', 1) == tag.size() - 1;
}
} // namespace tool
