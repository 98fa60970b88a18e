// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Download.h"

#include "MeasuredBRDFToolVersion.h"
#include "Progress.h"
#include "Tool.h"

#include <arpa/inet.h>
#include <curl/curl.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>
#include <thread>

namespace
{
/// A request failed and another one may succeed: the connection was cut, or the server is busy.
struct TransientError : tool::Error
{
  using Error::Error;
};

/// What libcurl's callbacks need. libcurl is written in C: exceptions wait here until it returns.
struct Exchange
{
  CURL* Curl;
  const tool::DownloadRequest& Request;
  std::string& Bytes;
  tool::ProgressBar Bar{ Request.Name };
  std::exception_ptr Thrown = nullptr;
};

//------------------------------------------------------------------------------
// Checks an answer's head before its first byte is taken, and where there is none.
void CheckAnswer(CURL* curl)
{
  long status = 0;
  const char* url = nullptr; // where redirects led to
  curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &status);
  curl_easy_getinfo(curl, CURLINFO_EFFECTIVE_URL, &url);
  if (status != 0 && url && !tool::IsAllowedUrl(url))
  {
    throw tool::Error(std::string("the server redirects to ") + url + ", expected https");
  }
  const std::string text = "the server answered with HTTP status " + std::to_string(status) +
                           (status == 404 || status == 410 ? " (no such file)" : "") +
                           ", expected 200";
  if (status == 408 || status == 429 || status >= 500)
  {
    throw TransientError(text);
  }
  if (status != 0 && status != 200)
  {
    throw tool::Error(text);
  }
}
}

//------------------------------------------------------------------------------
extern "C" std::size_t MeasuredBRDFToolBytes(char* data, std::size_t, std::size_t count, void* user)
{
  auto* exchange = static_cast<Exchange*>(user);
  try
  {
    CheckAnswer(exchange->Curl);
    if (exchange->Bytes.size() + count > exchange->Request.Limit)
    {
      throw tool::Error("the server sends more than the " +
                        std::to_string(exchange->Request.Limit) + " bytes expected");
    }
    exchange->Bytes.append(data, count);
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
    static_cast<Exchange*>(user)->Bar.Update(static_cast<double>(now) / static_cast<double>(total));
  }
  return tool::Interruptible::IsInterrupted() ? 1 : 0;
}

namespace
{
//------------------------------------------------------------------------------
// One part of an address, as libcurl understands it; "" where it does not.
std::string GetPart(const std::string& url, CURLUPart part)
{
  const std::unique_ptr<CURLU, void (*)(CURLU*)> address(curl_url(), curl_url_cleanup);
  char* text = nullptr;
  if (address && curl_url_set(address.get(), CURLUPART_URL, url.c_str(), 0) == CURLUE_OK)
  {
    curl_url_get(address.get(), part, &text, 0);
  }
  const std::string result = text ? text : "";
  curl_free(text);
  return result;
}

//------------------------------------------------------------------------------
void Attempt(const tool::DownloadRequest& request, std::string& bytes)
{
  static const CURLcode ready = curl_global_init(CURL_GLOBAL_DEFAULT);
  const std::unique_ptr<CURL, void (*)(CURL*)> handle(
    ready == CURLE_OK ? curl_easy_init() : nullptr, curl_easy_cleanup);
  CURL* curl = handle.get();
  if (!curl)
  {
    throw tool::Error("libcurl could not be started");
  }
  Exchange exchange{ curl, request, bytes };
  char details[CURL_ERROR_SIZE] = "";
  curl_easy_setopt(curl, CURLOPT_URL, request.Url.c_str());
  curl_easy_setopt(curl, CURLOPT_USERAGENT, "measured-brdf/" MEASUREDBRDF_VERSION);
  curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl, CURLOPT_FAILONERROR, 1L);
  curl_easy_setopt(curl, CURLOPT_FOLLOWLOCATION, 1L);
  curl_easy_setopt(curl, CURLOPT_MAXREDIRS, 5L);
  // Only an http server of this machine may redirect to http, and to this machine (CheckAnswer).
  const bool isSecure = GetPart(request.Url, CURLUPART_SCHEME) == "https";
#if LIBCURL_VERSION_NUM >= 0x075500
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(curl, CURLOPT_REDIR_PROTOCOLS_STR, isSecure ? "https" : "http,https");
#else
  const long both = CURLPROTO_HTTP | CURLPROTO_HTTPS;
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS, both);
  curl_easy_setopt(curl, CURLOPT_REDIR_PROTOCOLS, isSecure ? long(CURLPROTO_HTTPS) : both);
#endif
  curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, static_cast<long>(request.Timeout));
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_LIMIT, 1024L);
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_TIME, static_cast<long>(request.Timeout));
  curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, MeasuredBRDFToolBytes);
  curl_easy_setopt(curl, CURLOPT_WRITEDATA, &exchange);
  curl_easy_setopt(curl, CURLOPT_XFERINFOFUNCTION, MeasuredBRDFToolProgress);
  curl_easy_setopt(curl, CURLOPT_XFERINFODATA, &exchange);
  curl_easy_setopt(curl, CURLOPT_NOPROGRESS, 0L);
  curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, details);
  const CURLcode code = curl_easy_perform(curl);
  tool::Interruptible::Check();
  if (exchange.Thrown)
  {
    std::rethrow_exception(exchange.Thrown);
  }
  if (code == CURLE_OK || code == CURLE_HTTP_RETURNED_ERROR)
  {
    CheckAnswer(curl);
  }
  const std::string text = *details ? details : curl_easy_strerror(code);
  if (code == CURLE_OPERATION_TIMEDOUT)
  {
    throw TransientError("the server was too slow: expected an answer within " +
                         std::to_string(request.Timeout) +
                         " s and 1 KiB/s on average over that time (--timeout): " + text);
  }
  if (code != CURLE_OK)
  {
    const bool isCut =
      code == CURLE_PARTIAL_FILE || code == CURLE_RECV_ERROR || code == CURLE_GOT_NOTHING;
    throw TransientError((isCut ? "the connection was cut: " : "") + text);
  }
  if (bytes.size() < request.Size)
  {
    throw TransientError("the connection was closed before the end");
  }
  curl_off_t length = -1;
  curl_easy_getinfo(curl, CURLINFO_CONTENT_LENGTH_DOWNLOAD_T, &length);
  if (length < 0 && request.Size == 0)
  {
    throw tool::Error("the server does not say how long the file is, so a cut one could not "
                      "be told from a whole one; expected a Content-Length");
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
std::string Download(const DownloadRequest& request)
{
  std::string bytes;
  const auto describe = [&](const Error& error)
  { return request.Url + ", byte " + std::to_string(bytes.size()) + ": " + error.what(); };
  for (int k = 0;; ++k)
  {
    try
    {
      bytes.clear();
      Attempt(request, bytes);
      return bytes;
    }
    catch (const TransientError& e)
    {
      if (k >= request.Retries)
      {
        throw Error(describe(e) + ". Nothing was kept");
      }
      PrintNote(describe(e) + "; trying again");
    }
    catch (const Error& e)
    {
      throw Error(describe(e) + ". Nothing was kept");
    }
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1 << std::min(k, 5));
    while (std::chrono::steady_clock::now() < end)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      Interruptible::Check();
    }
  }
}

//------------------------------------------------------------------------------
bool IsAllowedUrl(const std::string& url)
{
  const std::string scheme = GetPart(url, CURLUPART_SCHEME);
  const std::string host = GetPart(url, CURLUPART_HOST);
  in_addr number;
  const bool isThisMachine =
    host == "localhost" || host == "[::1]" ||
    (inet_pton(AF_INET, host.c_str(), &number) == 1 && ntohl(number.s_addr) >> 24 == 127);
  return GetPart(url, CURLUPART_USER).empty() && GetPart(url, CURLUPART_PASSWORD).empty() &&
         !host.empty() && (scheme == "https" || (scheme == "http" && isThisMachine));
}
} // namespace tool
