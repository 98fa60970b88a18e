// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Jobs.h"

#include "Progress.h"

#include <QMetaObject>

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <utility>

namespace
{
//------------------------------------------------------------------------------
// What people see comes first: this thread and those that it starts have a lower priority.
void StepBack()
{
#ifdef __linux__
  constexpr int niceness = 5;
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), niceness);
#endif
}
}

namespace explorer
{
struct Jobs::Job
{
  QString Key;
  QString Label;
  std::function<void(const Post&)> Work;
  Jobs::Failed Failed;
  std::atomic<bool> Stopped{ false };
  double Share = 0.0; // for the window's thread
  std::thread Runner;
};

//------------------------------------------------------------------------------
Jobs::Jobs(QObject* parent)
  : QObject(parent)
{
}

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
  auto job = std::make_shared<Job>();
  job->Key = key;
  job->Label = label;
  job->Work = std::move(work);
  job->Failed =
    failed ? std::move(failed) : [this](const QString& text) { Q_EMIT this->failed(text); };
  this->All.push_back(job);
  try
  {
    job->Runner = std::thread([this, job]() { this->Run(job); });
  }
  catch (const std::exception& error) // no thread is to be had
  {
    this->All.remove(job);
    job->Failed(QString::fromUtf8(error.what()));
  }
  this->Report();
}

//------------------------------------------------------------------------------
void Jobs::Stop(const QString& key)
{
  for (const auto& job : this->All)
  {
    if (job->Key == key)
    {
      job->Stopped = true;
    }
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
// On the job's thread.
void Jobs::Run(const std::shared_ptr<Job>& job)
{
  StepBack();
  const Post post = [this, job](std::function<void()> what)
  {
    QMetaObject::invokeMethod(
      this,
      [job, what = std::move(what)]()
      {
        if (!job->Stopped)
        {
          what();
        }
      },
      Qt::QueuedConnection);
  };
  const auto show = [this, &job, &post](const std::string&, double share)
  {
    post(
      [this, job, share]()
      {
        job->Share = share;
        this->Report();
      });
  };
  {
    tool::BackgroundWork work(job->Stopped, show);
    try
    {
      job->Work(post);
    }
    catch (const std::exception& error)
    {
      const QString text = QString::fromUtf8(error.what());
      post([job, text]() { job->Failed(text); });
    }
    if (!work.Notes.empty())
    {
      post([this, notes = QString::fromStdString(work.Notes)]() { Q_EMIT this->noted(notes); });
    }
  }
  // Also where it was stopped.
  QMetaObject::invokeMethod(
    this, [this, job]() { this->Finish(job); }, Qt::QueuedConnection);
}

//------------------------------------------------------------------------------
void Jobs::Finish(const std::shared_ptr<Job>& job)
{
  job->Runner.join();
  job->Stopped = true;
  job->Work = nullptr;
  this->All.remove(job);
  this->Report();
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
