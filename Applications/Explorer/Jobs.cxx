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

#include <exception>
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
  Work Function;
  Jobs::Failed Failed;
  std::atomic<bool> Stopped{ false };
  double Share = 0.0; // for the window's thread
  std::thread Runner;
};

//------------------------------------------------------------------------------
class Jobs::Thread : public JobThread
{
public:
  Thread(Jobs* jobs, std::shared_ptr<Job> job)
    : All(jobs)
    , Own(std::move(job))
  {
  }

  void Post(std::function<void()> what) override
  {
    QMetaObject::invokeMethod(
      this->All,
      [job = this->Own, what = std::move(what)]()
      {
        if (!job->Stopped)
        {
          what();
        }
      },
      Qt::QueuedConnection);
  }

private:
  Jobs* All;
  std::shared_ptr<Job> Own;
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
void Jobs::Start(const QString& key, const QString& label, Work work, Jobs::Failed failed)
{
  this->Stop(key);
  auto job = std::make_shared<Job>();
  job->Key = key;
  job->Label = label;
  job->Function = std::move(work);
  job->Failed = std::move(failed);
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
  for (const auto& job : this->All)
  {
    if (job->Key == key && !job->Stopped)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool Jobs::IsIdle() const
{
  for (const auto& job : this->All)
  {
    if (!job->Stopped)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// On the job's thread.
void Jobs::Run(const std::shared_ptr<Job>& job)
{
  Thread thread(this, job);
  StepBack();
  const auto show = [this, job, &thread](const std::string&, double share)
  {
    thread.Post(
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
      job->Function(thread);
    }
    catch (const std::exception& error)
    {
      const QString text = QString::fromUtf8(error.what());
      thread.Post([job, text]() { job->Failed(text); });
    }
    if (!work.Notes.empty())
    {
      thread.Post(
        [this, notes = QString::fromStdString(work.Notes)]() { emit this->noted(notes); });
    }
  }
  // Not by Post: also where it was stopped.
  QMetaObject::invokeMethod(
    this, [this, job]() { this->Finish(job); }, Qt::QueuedConnection);
}

//------------------------------------------------------------------------------
void Jobs::Finish(const std::shared_ptr<Job>& job)
{
  job->Runner.join();
  job->Stopped = true;
  job->Function = nullptr;
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
  emit this->progressed(line, share);
}
} // namespace explorer
