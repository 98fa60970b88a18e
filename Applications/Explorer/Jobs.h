// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Background jobs: long work beside the window, the newest of its kind, with progress and a stop.
 */

#ifndef Jobs_h
#define Jobs_h

#include <QObject>
#include <QString>

#include <atomic>
#include <functional>
#include <list>
#include <memory>
#include <thread>

namespace explorer
{
/// What runs on a job's thread may use.
class JobThread
{
public:
  virtual ~JobThread() = default;

  /// Have something done on the window's thread, unless the job was stopped meanwhile.
  virtual void Post(std::function<void()> what) = 0;
};

/**
 * Every job has a key, such as "reference": a new one of that key stops the one before, whose
 * results no longer arrive. The destructor stops all jobs and waits for their threads.
 */
class Jobs : public QObject
{
  Q_OBJECT

public:
  explicit Jobs(QObject* parent = nullptr);
  ~Jobs() override;

  /// Runs on the thread, under a tool::BackgroundWork.
  using Work = std::function<void(JobThread&)>;
  /// Gets the message of an exception of the work, on the window's thread.
  using Failed = std::function<void(const QString&)>;

  void Start(const QString& key, const QString& label, Work work, Failed failed);

  /// Stop the job of that key, if there is one. Does not wait.
  void Stop(const QString& key);

  bool IsRunning(const QString& key) const;
  bool IsIdle() const;

signals:
  /// What runs has changed, or how far it is: one line, "" where nothing runs; share in [0, 1].
  void progressed(const QString& line, double share);
  /// A job said something about its input, such as what a reader corrected.
  void noted(const QString& text);

private:
  struct Job;
  class Thread;
  void Run(const std::shared_ptr<Job>& job);
  void Finish(const std::shared_ptr<Job>& job);
  void Report();

  std::list<std::shared_ptr<Job>> All; // those that were stopped, too, until their threads end
};
} // namespace explorer

#endif
