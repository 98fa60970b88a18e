// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchFile.h"

#include "Download.h"
#include "Files.h"
#include "Progress.h"

#include <openssl/evp.h>

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace fs = std::filesystem;

namespace
{
//------------------------------------------------------------------------------
// Whether a file is there. Throws Error where something else has its name.
bool HasFile(const std::string& path)
{
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
  {
    throw tool::Error(path + " is in the way: it is no regular file. It was left alone");
  }
  return fs::exists(status);
}

//------------------------------------------------------------------------------
std::string ReadFile(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::string bytes{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  if (!file)
  {
    throw tool::Error(path + ": can't be read: " + std::strerror(errno));
  }
  return bytes;
}

//------------------------------------------------------------------------------
// The catalog's files are small: 35 MB at most.
std::string GetSha256(const std::string& bytes)
{
  unsigned char sum[32];
  if (EVP_Digest(bytes.data(), bytes.size(), sum, nullptr, EVP_sha256(), nullptr) != 1)
  {
    throw tool::Error("libcrypto gives no SHA-256");
  }
  std::string text;
  for (const unsigned char byte : sum)
  {
    char digits[3];
    std::snprintf(digits, sizeof(digits), "%02x", byte);
    text += digits;
  }
  return text;
}

//------------------------------------------------------------------------------
// The user's cache folder, made where it is missing.
std::string OpenCache()
{
  std::string path = tool::GetFetchCache();
  if (path.empty())
  {
    throw tool::Error("there is no folder for downloads (neither XDG_CACHE_HOME nor HOME is set); "
                      "name one with --to");
  }
  for (std::size_t end = 0; end != std::string::npos;)
  {
    end = path.find('/', end + 1);
    mkdir(path.substr(0, end).c_str(), 0700); // as XDG's specification says
  }
  struct stat status;
  if (lstat(path.c_str(), &status) != 0)
  {
    throw tool::Error(path + ": can't be used as a folder for downloads: " + std::strerror(errno));
  }
  if (!S_ISDIR(status.st_mode) || status.st_uid != geteuid() ||
      (status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
  {
    throw tool::Error(path + ": not used for downloads: expected a folder of this user's to which "
                             "nobody else may write. Change that, or name a folder with --to");
  }
  return path;
}

/// One file on its way.
class Job
{
public:
  Job(const tool::FetchEntry& entry, const tool::FetchOptions& options);
  bool IsDone() const;
  void CheckSumIsKnown() const;
  void Run();

  const std::string Folder;
  const std::string Path;

private:
  void Check(const std::string& bytes) const;
  std::string Bring() const;

  const tool::FetchEntry& Entry;
  const tool::FetchOptions& Options;
  const bool IsCache;
  tool::DownloadRequest Request;
  std::string Sum;     // "": not known
  std::string SumFrom; // who says so
};

//------------------------------------------------------------------------------
Job::Job(const tool::FetchEntry& entry, const tool::FetchOptions& options)
  : Folder(options.Folder.empty() ? OpenCache() : options.Folder)
  , Path((fs::path(this->Folder) / entry.File).string())
  , Entry(entry)
  , Options(options)
  , IsCache(options.Folder.empty())
  , Request{ entry.Url, entry.Size > 0 ? entry.Size : entry.Limit, entry.Size, options.Timeout,
    options.Retries }
  , Sum(options.Sha256)
  , SumFrom("--sha256")
{
  if (const std::string& base = options.BaseUrl; !base.empty())
  {
    this->Request.Url =
      base + (base.back() == '/' ? "" : "/") + entry.Url.substr(std::strlen("https://"));
  }
  std::transform(this->Sum.begin(), this->Sum.end(), this->Sum.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!this->Sum.empty() && !entry.Sha256.empty() && entry.Sha256 != this->Sum)
  {
    tool::PrintNote(
      entry.Name + ": --sha256 is used; this program knows another sum, " + entry.Sha256);
  }
  if (this->Sum.empty())
  {
    this->Sum = entry.Sha256;
    this->SumFrom = entry.SumKind == "copy" ? "this program, of a copy that came from elsewhere"
                                            : "this program, as others published it";
  }
  const std::string record = this->Path + ".sha256";
  if (this->Sum.empty() && HasFile(record))
  {
    this->Sum = ReadFile(record).substr(0, 64);
    this->SumFrom = "recorded at the first download: " + record;
    if (this->Sum.size() != 64)
    {
      throw tool::Error(
        record + ": expected one line, the SHA-256 of " + this->Path + " as sha256sum writes it");
    }
  }
}

//------------------------------------------------------------------------------
// Whether the right file is there already. Throws Error where another one is in the way; one in the
// cache is replaced.
bool Job::IsDone() const
{
  if (!HasFile(this->Path) || (this->Sum.empty() && this->IsCache))
  {
    return false;
  }
  if (this->Sum.empty())
  {
    throw tool::Error(this->Path +
                      " is there already, and no SHA-256 is known that would tell whether it is "
                      "right. It was left alone; move it, or give its sum by --sha256");
  }
  const std::string sum = GetSha256(ReadFile(this->Path));
  if (sum == this->Sum)
  {
    return true;
  }
  const std::string text = this->Path + " is there already with the SHA-256 " + sum +
                           ", expected " + this->Sum + " (" + this->SumFrom + ")";
  if (!this->IsCache)
  {
    throw tool::Error(text + ". It was left alone; move it, or name another folder");
  }
  tool::PrintNote(text + ". It is downloaded anew");
  return false;
}

//------------------------------------------------------------------------------
void Job::CheckSumIsKnown() const
{
  if (this->Sum.empty() && !this->Options.TrustFirst)
  {
    throw tool::Error(
      this->Entry.Name + ": this program does not know the SHA-256 of " + this->Entry.Url +
      ", so it could not tell a wrong file from the right one. Give the sum by --sha256, "
      "or say --trust-first: what comes first is taken, and checked against from then on");
  }
}

//------------------------------------------------------------------------------
void Job::Check(const std::string& bytes) const
{
  const std::string& begin = this->Entry.Collection->BeginsWith;
  const std::string sum = GetSha256(bytes);
  const std::string size = "the " + std::to_string(bytes.size()) + " bytes that came";
  if (this->Sum.empty() && bytes.compare(0, begin.size(), begin) != 0)
  {
    throw tool::Error(
      size + " begin with '" + bytes.substr(0, begin.size()) + "', expected '" + begin + "'");
  }
  if (!this->Sum.empty() && sum != this->Sum)
  {
    throw tool::Error("the SHA-256 of " + size + " is " + sum + ", expected " + this->Sum + " (" +
                      this->SumFrom + ")");
  }
}

//------------------------------------------------------------------------------
// The right bytes; without a sum nothing else would tell whether those of two attempts belong
// together.
std::string Job::Bring() const
{
  std::string bytes;
  try
  {
    tool::ProgressBar bar(this->Entry.Name);
    tool::Download(
      this->Request, bytes, !this->Sum.empty(), [&bar](double share) { bar.Update(share); });
    this->Check(bytes);
    return bytes;
  }
  catch (const tool::Error& e)
  {
    throw tool::Error(this->Request.Url + ", byte " + std::to_string(bytes.size()) + ": " +
                      e.what() + ". Nothing was kept");
  }
}

//------------------------------------------------------------------------------
void Job::Run()
{
  tool::CheckWritable(this->Path);
  const std::string content = this->Bring();
  if (HasFile(this->Path) && !this->IsCache)
  {
    throw tool::Error(this->Path + " appeared meanwhile. It was left alone");
  }
  if (this->Sum.empty())
  {
    const std::string sum = GetSha256(content);
    tool::WriteWhole(this->Path + ".sha256", sum + "  " + this->Entry.File + "\n");
    tool::PrintNote(this->Entry.Name + ": trusted at first sight. Its SHA-256 is " + sum +
                    ", recorded in " + this->Path + ".sha256");
  }
  tool::WriteWhole(this->Path, content);
}
}

namespace tool
{
//------------------------------------------------------------------------------
std::string FetchFile(
  const FetchEntry& entry, const FetchOptions& options, const std::function<void()>& show)
{
  Job job(entry, options);
  if (!job.IsDone())
  {
    job.CheckSumIsKnown();
    show();
    job.Run();
  }
  return job.Path;
}
} // namespace tool
