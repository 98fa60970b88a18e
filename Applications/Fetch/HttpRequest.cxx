// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HttpRequest.h"

#include "MeasuredBRDFToolVersion.h"
#include "Progress.h"

#include <curl/curl.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <exception>
#include <memory>

namespace
{
constexpr int MaximumRedirects = 5;
constexpr long LeastSpeed = 1024; // bytes a second

using Handle = std::unique_ptr<CURL, void (*)(CURL*)>;
using List = std::unique_ptr<curl_slist, void (*)(curl_slist*)>;

//------------------------------------------------------------------------------
// What the callbacks of one exchange share. libcurl is C: exceptions wait here.
struct Exchange
{
  const tool::HttpRequest& Request;
  CURL* Curl;
  tool::HttpAnswer Answer;
  bool Answered = false;
  bool IsRedirect = false;
  std::exception_ptr Thrown;

  // Once for the last answer: at its first byte, or at its end.
  bool TellAnswer()
  {
    if (!this->Answered && !this->IsRedirect)
    {
      this->Answered = true;
      try
      {
        this->Request.OnAnswer(this->Answer);
      }
      catch (...)
      {
        this->Thrown = std::current_exception();
        return false;
      }
    }
    return true;
  }
};

//------------------------------------------------------------------------------
std::string Trim(const std::string& text)
{
  const char* blanks = " \t\r\n";
  const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

//------------------------------------------------------------------------------
void TakeHeader(tool::HttpAnswer& answer, std::string name, const std::string& value)
{
  std::transform(name.begin(), name.end(), name.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::uint64_t length = 0;
  if (name == "content-length" &&
      std::from_chars(value.data(), value.data() + value.size(), length).ec == std::errc())
  {
    answer.Length = length;
  }
  else if (name == "content-range")
  {
    answer.Range = value;
  }
  else if (name == "etag")
  {
    answer.Tag = value;
  }
  else if (name == "last-modified")
  {
    answer.Modified = value;
  }
  else if (name == "content-encoding")
  {
    answer.Encoding = value;
  }
  else if (name == "location")
  {
    answer.Location = value;
  }
}
}

//------------------------------------------------------------------------------
extern "C" std::size_t MeasuredBRDFToolHeader(
  char* data, std::size_t, std::size_t count, void* user)
{
  auto* exchange = static_cast<Exchange*>(user);
  const std::string line(data, count);
  const std::size_t colon = line.find(':');
  if (line.rfind("HTTP/", 0) == 0)
  {
    exchange->Answer = tool::HttpAnswer(); // a proxy's answer, or "100 Continue", came before
  }
  else if (colon != std::string::npos)
  {
    TakeHeader(exchange->Answer, line.substr(0, colon), Trim(line.substr(colon + 1)));
  }
  else if (Trim(line).empty()) // the headers' end
  {
    curl_easy_getinfo(exchange->Curl, CURLINFO_RESPONSE_CODE, &exchange->Answer.Status);
    const long status = exchange->Answer.Status;
    exchange->IsRedirect =
      status == 301 || status == 302 || status == 303 || status == 307 || status == 308;
    if (exchange->IsRedirect)
    {
      return 0; // its text is not wanted, and may have no end
    }
  }
  return count;
}

//------------------------------------------------------------------------------
extern "C" std::size_t MeasuredBRDFToolBytes(char* data, std::size_t, std::size_t count, void* user)
{
  auto* exchange = static_cast<Exchange*>(user);
  if (!exchange->TellAnswer())
  {
    return 0;
  }
  try
  {
    exchange->Request.OnBytes(data, count);
  }
  catch (...)
  {
    exchange->Thrown = std::current_exception();
    return 0;
  }
  return count;
}

//------------------------------------------------------------------------------
extern "C" int MeasuredBRDFToolProgress(void*, curl_off_t, curl_off_t, curl_off_t, curl_off_t)
{
  return tool::Interruptible::IsInterrupted() ? 1 : 0;
}

namespace
{
//------------------------------------------------------------------------------
Handle MakeHandle()
{
  static const CURLcode ready = curl_global_init(CURL_GLOBAL_DEFAULT);
  Handle handle(ready == CURLE_OK ? curl_easy_init() : nullptr, curl_easy_cleanup);
  if (!handle)
  {
    throw tool::Error("libcurl could not be started");
  }
  return handle;
}

//------------------------------------------------------------------------------
void SetLimits(CURL* curl, int timeout)
{
  curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl, CURLOPT_FOLLOWLOCATION, 0L); // each one is looked at first
#if LIBCURL_VERSION_NUM >= 0x075500
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
#else
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS, long(CURLPROTO_HTTP | CURLPROTO_HTTPS));
#endif
  curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, static_cast<long>(timeout));
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_LIMIT, LeastSpeed);
  curl_easy_setopt(curl, CURLOPT_LOW_SPEED_TIME, static_cast<long>(timeout));
  curl_easy_setopt(curl, CURLOPT_USERAGENT, "measured-brdf/" MEASUREDBRDF_VERSION);
}

//------------------------------------------------------------------------------
// Whether it helps to try once more.
bool IsTransient(CURLcode code)
{
  switch (code)
  {
    case CURLE_COULDNT_RESOLVE_PROXY:
    case CURLE_COULDNT_RESOLVE_HOST:
    case CURLE_COULDNT_CONNECT:
    case CURLE_HTTP2:
    case CURLE_HTTP2_STREAM:
    case CURLE_PARTIAL_FILE:
    case CURLE_OPERATION_TIMEDOUT:
    case CURLE_GOT_NOTHING:
    case CURLE_SEND_ERROR:
    case CURLE_RECV_ERROR:
      return true;
    default:
      return false;
  }
}

//------------------------------------------------------------------------------
std::string DescribeFailure(CURLcode code, const char* details, int timeout)
{
  const std::string text = *details ? details : curl_easy_strerror(code);
  if (code == CURLE_OPERATION_TIMEDOUT)
  {
    return "the server was too slow: expected an answer within " + std::to_string(timeout) +
           " s and 1 KiB/s on average over that time (--timeout): " + text;
  }
  if (code == CURLE_PARTIAL_FILE || code == CURLE_RECV_ERROR || code == CURLE_GOT_NOTHING)
  {
    return "the connection was cut: " + text;
  }
  return text;
}

//------------------------------------------------------------------------------
// An address as a redirect to it from another one is meant (RFC 3986); "" for none.
std::string Resolve(const std::string& url, const std::string& location)
{
  const std::unique_ptr<CURLU, void (*)(CURLU*)> address(curl_url(), curl_url_cleanup);
  char* text = nullptr;
  if (!address || location.empty() ||
      curl_url_set(address.get(), CURLUPART_URL, url.c_str(), 0) != CURLUE_OK ||
      curl_url_set(address.get(), CURLUPART_URL, location.c_str(), CURLU_NON_SUPPORT_SCHEME) !=
        CURLUE_OK ||
      curl_url_get(address.get(), CURLUPART_URL, &text, 0) != CURLUE_OK)
  {
    return "";
  }
  const std::string result = text;
  curl_free(text);
  return result;
}

//------------------------------------------------------------------------------
// One exchange; the address that it redirects to, or "".
std::string RunOnce(const tool::HttpRequest& request, const std::string& url)
{
  const Handle handle = MakeHandle();
  CURL* curl = handle.get();
  Exchange exchange{ request, curl, {}, false, false, nullptr };
  char details[CURL_ERROR_SIZE] = "";
  SetLimits(curl, request.Timeout);
  curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, details);
  curl_easy_setopt(curl, CURLOPT_URL, url.c_str());
  curl_easy_setopt(curl, CURLOPT_HEADERFUNCTION, MeasuredBRDFToolHeader);
  curl_easy_setopt(curl, CURLOPT_HEADERDATA, &exchange);
  curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, MeasuredBRDFToolBytes);
  curl_easy_setopt(curl, CURLOPT_WRITEDATA, &exchange);
  curl_easy_setopt(curl, CURLOPT_XFERINFOFUNCTION, MeasuredBRDFToolProgress);
  curl_easy_setopt(curl, CURLOPT_NOPROGRESS, 0L);
  // libcurl's own CURLOPT_RANGE takes an answer without it for a failure of the server's.
  List headers(nullptr, curl_slist_free_all);
  const auto add = [&headers](const std::string& line)
  { headers.reset(curl_slist_append(headers.release(), line.c_str())); };
  if (request.HasRange)
  {
    add("Range: bytes=" + std::to_string(request.First) + "-" +
        (request.Last == 0 ? "" : std::to_string(request.Last)));
  }
  if (!request.IfRange.empty())
  {
    add("If-Range: " + request.IfRange);
  }
  curl_easy_setopt(curl, CURLOPT_HTTPHEADER, headers.get());

  const CURLcode code = curl_easy_perform(curl);
  if (code == CURLE_ABORTED_BY_CALLBACK || tool::Interruptible::IsInterrupted())
  {
    throw tool::Error("interrupted");
  }
  if (exchange.IsRedirect)
  {
    const std::string next = Resolve(url, exchange.Answer.Location);
    if (next.empty())
    {
      throw tool::DownloadError(
        url + " redirects (HTTP status " + std::to_string(exchange.Answer.Status) + ") to nowhere",
        false);
    }
    return next;
  }
  if (exchange.Thrown || (code == CURLE_OK && !exchange.TellAnswer())) // it had no bytes
  {
    std::rethrow_exception(exchange.Thrown);
  }
  if (code != CURLE_OK)
  {
    throw tool::DownloadError(DescribeFailure(code, details, request.Timeout), IsTransient(code));
  }
  return "";
}
}

namespace tool
{
//------------------------------------------------------------------------------
void HttpRequest::Run() const
{
  std::string url = this->Url;
  for (int redirects = 0; !url.empty(); ++redirects)
  {
    // A server far away must not send us to one of this machine.
    const bool isSafe =
      redirects == 0 || this->Url.compare(0, 5, "https") != 0 || url.compare(0, 5, "https") == 0;
    if (!IsAllowedUrl(url) || !isSafe)
    {
      throw DownloadError((redirects > 0 ? "the server redirects to " + url : url) +
                            ", which is not used: expected https (http on this machine only), and "
                            "no user name",
        false);
    }
    if (redirects > MaximumRedirects)
    {
      throw DownloadError(
        "more than " + std::to_string(MaximumRedirects) + " redirects, the last of them to " + url,
        false);
    }
    url = RunOnce(*this, url);
  }
}
} // namespace tool
