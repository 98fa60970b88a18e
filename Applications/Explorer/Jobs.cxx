// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Jobs.h"

#include "ParallelFor.h"
#include "Progress.h"

#include <QMetaObject>

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>

namespace explorer
{
struct Jobs::Job
{
  QString Key;
  QString Label;
  Jobs::Failed Failed;
  std::atomic<bool> Stopped{ false };
  double Share = 0.0; // for the window's thread
  std::thread Runner;
};

//------------------------------------------------------------------------------
Jobs::~Jobs()
{
  for (const auto& job : this->All)
  {
    job->Stopped = true;
  }
  for (const auto& job : this->All)
  {
    job->Runner.join();
  }
}

//------------------------------------------------------------------------------
void Jobs::Start(const QString& key, const QString& label, std::function<void(const Post&)> work,
  Jobs::Failed failed)
{
  this->Stop(key);
  const auto job = std::make_shared<Job>();
  job->Key = key;
  job->Label = label;
  job->Failed =
    failed ? std::move(failed) : [this](const QString& text) { Q_EMIT this->failed(text); };
  this->All.push_back(job);
  const auto problem = measuredbrdf::FindThrown( // where no thread is to be had
    [&]() { job->Runner = std::thread([=, work = std::move(work)]() { this->Run(job, work); }); });
  if (problem)
  {
    this->All.remove(job);
    job->Failed(QString::fromStdString(*problem));
  }
  this->Report();
}

//------------------------------------------------------------------------------
// On the job's thread. What people see comes first: this thread and those that it starts have a
// lower priority.
void Jobs::Run(const std::shared_ptr<Job>& job, const std::function<void(const Post&)>& work)
{
#ifdef __linux__
  constexpr int niceness = 5;
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), niceness);
#endif
  const auto queue = [this](const auto& what)
  { QMetaObject::invokeMethod(this, what, Qt::QueuedConnection); };
  const Post post = [=](std::function<void()> what)
  {
    queue(
      [job, what = std::move(what)]()
      {
        if (!job->Stopped)
        {
          what();
        }
      });
  };
  tool::BackgroundWork background(job->Stopped,
    [=](const std::string&, double share)
    {
      post(
        [=]()
        {
          job->Share = share;
          this->Report();
        });
    });
  if (const auto problem = measuredbrdf::FindThrown([&]() { work(post); }))
  {
    post([=]() { job->Failed(QString::fromStdString(*problem)); });
  }
  if (!background.Notes.empty())
  {
    post([=, notes = QString::fromStdString(background.Notes)]() { Q_EMIT this->noted(notes); });
  }
  queue(
    [=]() // also where it was stopped
    {
      job->Runner.join();
      job->Stopped = true;
      this->All.remove(job);
      this->Report();
    });
}

//------------------------------------------------------------------------------
void Jobs::Stop(const QString& key)
{
  for (const auto& job : this->All)
  {
    job->Stopped = job->Stopped || job->Key == key;
  }
  this->Report();
}

//------------------------------------------------------------------------------
bool Jobs::IsRunning(const QString& key) const
{
  return std::any_of(this->All.begin(), this->All.end(),
    [&key](const auto& job) { return job->Key == key && !job->Stopped; });
}

//------------------------------------------------------------------------------
bool Jobs::IsIdle() const
{
  return std::all_of(
    this->All.begin(), this->All.end(), [](const auto& job) { return job->Stopped.load(); });
}

//------------------------------------------------------------------------------
void Jobs::Report()
{
  QString line;
  double share = 0.0;
  for (const auto& job : this->All)
  {
    if (!job->Stopped)
    {
      line += (line.isEmpty() ? "" : ", ") + job->Label;
      share = job->Share;
    }
  }
  Q_EMIT this->progressed(line, share);
}
} // namespace explorer
