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
  curl_easy_setopt(curl, CURLOPT_URL, request.Url.c_str());
  curl_easy_setopt(curl, CURLOPT_USERAGENT, "measured-brdf/" MEASUREDBRDF_VERSION);
  curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl, CURLOPT_FAILONERROR, 1L);
  curl_easy_setopt(curl, CURLOPT_FOLLOWLOCATION, 1L);
  curl_easy_setopt(curl, CURLOPT_MAXREDIRS, 5L);
  // A server elsewhere cannot redirect to http; only a mirror on this machine can.
  const bool isSecure = request.Url.compare(0, 5, "https") == 0;
#if LIBCURL_VERSION_NUM >= 0x075500
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(curl, CURLOPT_REDIR_PROTOCOLS_STR, isSecure ? "https" : "http,https");
#else
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS, long(CURLPROTO_HTTP | CURLPROTO_HTTPS));
  curl_easy_setopt(curl, CURLOPT_REDIR_PROTOCOLS,
    long(isSecure ? CURLPROTO_HTTPS : CURLPROTO_HTTP | CURLPROTO_HTTPS));
#endif
  curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, static_cast<long>(request.Timeout));
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_LIMIT, 1024L);
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_TIME, static_cast<long>(request.Timeout));
  curl_easy_setopt(curl, CURLOPT_MAXFILESIZE_LARGE, static_cast<curl_off_t>(request.Limit));
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
[[noreturn]] void ThrowFailure(
  const tool::DownloadRequest& request, CURLcode code, const std::string& text)
{
  switch (code)
  {
    case CURLE_FILESIZE_EXCEEDED:
      ThrowTooLong(request);
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
  const auto check = [&request, &curl]()
  {
    long status = 0;
    curl_easy_getinfo(curl.get(), CURLINFO_RESPONSE_CODE, &status);
    if (status != 0 && status != (IsRange(request) ? 206 : 200))
    {
      ThrowStatus(request, status);
    }
  };
  const std::function<void(const char*, std::size_t)> takeChecked =
    [&check, &take](const char* bytes, std::size_t count)
  {
    check();
    take(bytes, count);
  };
  Exchange exchange{ request, takeChecked, progress, 0, nullptr };
  curl_easy_setopt(curl.get(), CURLOPT_WRITEFUNCTION, MeasuredBRDFToolBytes);
  curl_easy_setopt(curl.get(), CURLOPT_WRITEDATA, &exchange);
  curl_easy_setopt(curl.get(), CURLOPT_XFERINFOFUNCTION, MeasuredBRDFToolProgress);
  curl_easy_setopt(curl.get(), CURLOPT_XFERINFODATA, &exchange);
  curl_easy_setopt(curl.get(), CURLOPT_NOPROGRESS, 0L);

  const CURLcode code = curl_easy_perform(curl.get());
  Interruptible::Check();
  if (exchange.Thrown)
  {
    std::rethrow_exception(exchange.Thrown);
  }
  if (code == CURLE_OK || code == CURLE_HTTP_RETURNED_ERROR || code == CURLE_FILESIZE_EXCEEDED)
  {
    check();
  }
  if (code != CURLE_OK)
  {
    ThrowFailure(request, code, *details ? details : curl_easy_strerror(code));
  }
  curl_off_t length = -1;
  curl_easy_getinfo(curl.get(), CURLINFO_CONTENT_LENGTH_DOWNLOAD_T, &length);
  return length >= 0;
}

//------------------------------------------------------------------------------
void Retry(int retries, const std::function<void()>& attempt)
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
      PrintNote(std::string(e.what()) + "; trying again");
      const auto end =
        std::chrono::steady_clock::now() + std::chrono::seconds(1 << (k < 5 ? k : 5));
      while (std::chrono::steady_clock::now() < end)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        Interruptible::Check();
      }
    }
  }
}

//------------------------------------------------------------------------------
bool IsAllowedUrl(const std::string& url)
{
  const std::unique_ptr<CURLU, void (*)(CURLU*)> address(curl_url(), curl_url_cleanup);
  if (!address || curl_url_set(address.get(), CURLUPART_URL, url.c_str(), 0) != CURLUE_OK)
  {
    return false;
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
  return get(CURLUPART_USER).empty() && get(CURLUPART_PASSWORD).empty() && !host.empty() &&
         (scheme == "https" || (scheme == "http" && isThisMachine));
}
} // namespace tool
