// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Download.h"

#include "MeasuredBRDFToolVersion.h"
#include "Progress.h"

#include <arpa/inet.h>
#include <curl/curl.h>

#include <chrono>
#include <exception>
#include <memory>
#include <thread>

namespace
{
//------------------------------------------------------------------------------
// What libcurl's callbacks need. libcurl is written in C: exceptions wait here until it returns.
struct Exchange
{
  const tool::DownloadRequest& Request;
  const std::function<void(const char*, std::size_t)>& Take;
  const std::function<void(double)>& Progress;
  std::uint64_t Received = 0;
  std::exception_ptr Thrown;
};

//------------------------------------------------------------------------------
bool IsRange(const tool::DownloadRequest& request)
{
  return request.First > 0 || request.Count > 0;
}

//------------------------------------------------------------------------------
[[noreturn]] void ThrowTooLong(const tool::DownloadRequest& request)
{
  throw tool::WrongBytes(
    "the server sends more than the " + std::to_string(request.Limit) + " bytes expected");
}
}

//------------------------------------------------------------------------------
extern "C" std::size_t MeasuredBRDFToolBytes(char* data, std::size_t, std::size_t count, void* user)
{
  auto* exchange = static_cast<Exchange*>(user);
  try
  {
    if (count > exchange->Request.Limit - exchange->Received)
    {
      ThrowTooLong(exchange->Request);
    }
    exchange->Take(data, count);
    exchange->Received += count;
    return count;
  }
  catch (...)
  {
    exchange->Thrown = std::current_exception();
    return 0; // which ends the transfer
  }
}

//------------------------------------------------------------------------------
extern "C" int MeasuredBRDFToolProgress(
  void* user, curl_off_t total, curl_off_t now, curl_off_t, curl_off_t)
{
  if (total > 0)
  {
    static_cast<Exchange*>(user)->Progress(static_cast<double>(now) / static_cast<double>(total));
  }
  return tool::Interruptible::IsInterrupted() ? 1 : 0;
}

namespace
{
//------------------------------------------------------------------------------
void SetOptions(CURL* curl, const tool::DownloadRequest& request)
{
  curl_easy_setopt(curl, CURLOPT_USERAGENT, "measured-brdf/" MEASUREDBRDF_VERSION);
  curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl, CURLOPT_FAILONERROR, 1L);
  curl_easy_setopt(curl, CURLOPT_FOLLOWLOCATION, 1L);
  curl_easy_setopt(curl, CURLOPT_MAXREDIRS, 0L); // Follow() looks at each redirect
#if LIBCURL_VERSION_NUM >= 0x075500
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
#else
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS, long(CURLPROTO_HTTP | CURLPROTO_HTTPS));
#endif
  curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, static_cast<long>(request.Timeout));
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_LIMIT, 1024L);
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_TIME, static_cast<long>(request.Timeout));
  if (IsRange(request))
  {
    const std::string last =
      request.Count > 0 ? std::to_string(request.First + request.Count - 1) : "";
    curl_easy_setopt(curl, CURLOPT_RANGE, (std::to_string(request.First) + "-" + last).c_str());
  }
}

//------------------------------------------------------------------------------
[[noreturn]] void ThrowStatus(const tool::DownloadRequest& request, long status)
{
  const std::string text = "the server answered with HTTP status " + std::to_string(status) +
                           (status == 404 || status == 410 ? " (no such file)" : "") +
                           ", expected " + (IsRange(request) ? "206" : "200");
  if (status == 408 || status == 429 || (status >= 500 && status != 501))
  {
    throw tool::TransientError(text);
  }
  if (status == 416 || status < 300) // it has no such bytes, or gives all of them
  {
    throw tool::WrongBytes(text);
  }
  throw tool::Error(text);
}

//------------------------------------------------------------------------------
// Checks an answer's head; returns whether it says how many bytes follow.
bool CheckAnswer(CURL* curl, const tool::DownloadRequest& request)
{
  long status = 0;
  curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &status);
  if (status != 0 && status != (IsRange(request) ? 206 : 200))
  {
    ThrowStatus(request, status);
  }
  curl_off_t length = -1;
  curl_easy_getinfo(curl, CURLINFO_CONTENT_LENGTH_DOWNLOAD_T, &length);
  const auto count = static_cast<std::uint64_t>(length);
  if (length >= 0 && (request.IsExact ? count != request.Limit : count > request.Limit))
  {
    throw tool::WrongBytes(
      "the server announces " + std::to_string(length) + " bytes, expected " +
      (request.IsExact ? "" : "at most ") + std::to_string(request.Limit) +
      (request.First > 0 ? " from byte " + std::to_string(request.First) + " on" : ""));
  }
  return length >= 0;
}

//------------------------------------------------------------------------------
// Sends the request, and again to where the server redirects, five times at most.
CURLcode Follow(CURL* curl, const Exchange& exchange)
{
  std::string url = exchange.Request.Url;
  for (int redirects = 0;; ++redirects)
  {
    curl_easy_setopt(curl, CURLOPT_URL, url.c_str());
    const CURLcode code = curl_easy_perform(curl);
    if (tool::Interruptible::IsInterrupted())
    {
      throw tool::Error("interrupted");
    }
    if (exchange.Thrown)
    {
      std::rethrow_exception(exchange.Thrown);
    }
    const char* next = nullptr;
    curl_easy_getinfo(curl, CURLINFO_REDIRECT_URL, &next);
    if (code != CURLE_TOO_MANY_REDIRECTS || !next)
    {
      return code;
    }
    if (!tool::IsAllowedRedirect(url, next))
    {
      throw tool::Error(std::string("the server redirects to ") + next + ", expected https");
    }
    url = next;
    if (redirects == 5)
    {
      throw tool::Error("more than 5 redirects, the last one to " + url);
    }
  }
}

//------------------------------------------------------------------------------
[[noreturn]] void ThrowFailure(
  const tool::DownloadRequest& request, CURLcode code, const std::string& text)
{
  switch (code)
  {
    case CURLE_OPERATION_TIMEDOUT:
      throw tool::TransientError("the server was too slow: expected an answer within " +
                                 std::to_string(request.Timeout) +
                                 " s and 1 KiB/s on average over that time (--timeout): " + text);
    case CURLE_PARTIAL_FILE:
    case CURLE_RECV_ERROR:
    case CURLE_GOT_NOTHING:
      throw tool::TransientError("the connection was cut: " + text);
    case CURLE_COULDNT_RESOLVE_PROXY:
    case CURLE_COULDNT_RESOLVE_HOST:
    case CURLE_COULDNT_CONNECT:
    case CURLE_HTTP2:
    case CURLE_HTTP2_STREAM:
    case CURLE_SEND_ERROR:
      throw tool::TransientError(text);
    default:
      throw tool::Error(text);
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
bool Download(const DownloadRequest& request,
  const std::function<void(const char* bytes, std::size_t count)>& take,
  const std::function<void(double share)>& progress)
{
  static const CURLcode ready = curl_global_init(CURL_GLOBAL_DEFAULT);
  const std::unique_ptr<CURL, void (*)(CURL*)> curl(
    ready == CURLE_OK ? curl_easy_init() : nullptr, curl_easy_cleanup);
  if (!curl)
  {
    throw Error("libcurl could not be started");
  }
  SetOptions(curl.get(), request);
  char details[CURL_ERROR_SIZE] = "";
  curl_easy_setopt(curl.get(), CURLOPT_ERRORBUFFER, details);

  // An answer is checked before its first byte is taken.
  const std::function<void(const char*, std::size_t)> takeChecked =
    [&curl, &request, &take](const char* bytes, std::size_t count)
  {
    CheckAnswer(curl.get(), request);
    take(bytes, count);
  };
  Exchange exchange{ request, takeChecked, progress, 0, nullptr };
  curl_easy_setopt(curl.get(), CURLOPT_WRITEFUNCTION, MeasuredBRDFToolBytes);
  curl_easy_setopt(curl.get(), CURLOPT_WRITEDATA, &exchange);
  curl_easy_setopt(curl.get(), CURLOPT_XFERINFOFUNCTION, MeasuredBRDFToolProgress);
  curl_easy_setopt(curl.get(), CURLOPT_XFERINFODATA, &exchange);
  curl_easy_setopt(curl.get(), CURLOPT_NOPROGRESS, 0L);

  const CURLcode code = Follow(curl.get(), exchange);
  const bool hasLength =
    (code == CURLE_OK || code == CURLE_HTTP_RETURNED_ERROR) && CheckAnswer(curl.get(), request);
  if (code != CURLE_OK)
  {
    ThrowFailure(request, code, *details ? details : curl_easy_strerror(code));
  }
  if (request.IsExact && exchange.Received < request.Limit)
  {
    throw TransientError("the connection was closed before the end");
  }
  return hasLength;
}

//------------------------------------------------------------------------------
void Retry(
  int retries, const std::function<std::string()>& getPlace, const std::function<void()>& attempt)
{
  for (int k = 0;; ++k)
  {
    try
    {
      attempt();
      return;
    }
    catch (const TransientError& e)
    {
      if (k >= retries)
      {
        throw;
      }
      PrintNote(getPlace() + ": " + e.what() + "; trying again");
      const auto end =
        std::chrono::steady_clock::now() + std::chrono::seconds(1 << (k < 5 ? k : 5));
      while (std::chrono::steady_clock::now() < end)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (Interruptible::IsInterrupted())
        {
          throw Error("interrupted");
        }
      }
    }
  }
}

namespace
{
//------------------------------------------------------------------------------
// An address's scheme, in lower case; "" where files are not downloaded from there.
std::string GetAllowedScheme(const std::string& url)
{
  const std::unique_ptr<CURLU, void (*)(CURLU*)> address(curl_url(), curl_url_cleanup);
  if (!address || curl_url_set(address.get(), CURLUPART_URL, url.c_str(), 0) != CURLUE_OK)
  {
    return "";
  }
  const auto get = [&address](CURLUPart part)
  {
    char* text = nullptr;
    curl_url_get(address.get(), part, &text, 0);
    const std::string result = text ? text : "";
    curl_free(text);
    return result;
  };
  const std::string scheme = get(CURLUPART_SCHEME);
  const std::string host = get(CURLUPART_HOST);
  in_addr number;
  const bool isThisMachine =
    host == "localhost" || host == "[::1]" ||
    (inet_pton(AF_INET, host.c_str(), &number) == 1 && ntohl(number.s_addr) >> 24 == 127);
  const bool isAllowed = get(CURLUPART_USER).empty() && get(CURLUPART_PASSWORD).empty() &&
                         !host.empty() &&
                         (scheme == "https" || (scheme == "http" && isThisMachine));
  return isAllowed ? scheme : "";
}
}

//------------------------------------------------------------------------------
bool IsAllowedUrl(const std::string& url) { return !GetAllowedScheme(url).empty(); }

//------------------------------------------------------------------------------
bool IsAllowedRedirect(const std::string& from, const std::string& to)
{
  const std::string scheme = GetAllowedScheme(to);
  return scheme == "https" || (scheme == "http" && GetAllowedScheme(from) == "http");
}
} // namespace tool
