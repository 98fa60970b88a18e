// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Long work beside the window, on threads: the newest of each kind, with progress and a stop.
 */

#ifndef Jobs_h
#define Jobs_h

#include <QObject>
#include <QString>

#include <functional>
#include <list>
#include <memory>
#include <type_traits>

namespace explorer
{
/**
 * Every job has a key, such as "reference": a new one of that key stops the one before, whose
 * results no longer arrive. The destructor stops all jobs and waits for their threads.
 */
class Jobs : public QObject
{
  Q_OBJECT

public:
  ~Jobs() override;

  /// Has something done on the window's thread, unless the job was stopped meanwhile.
  using Post = std::function<void(std::function<void()>)>;
  /// Gets the message of an exception, on the window's thread.
  using Failed = std::function<void(const QString&)>;

  /// Runs work on a thread, under a tool::BackgroundWork. Without failed, the signal tells.
  void Start(const QString& key, const QString& label, std::function<void(const Post&)> work,
    Failed failed = nullptr);

  /// Calls make on a thread, then take with what it has made on the window's.
  template <typename Make, typename Take>
  void Compute(
    const QString& key, const QString& label, Make make, Take take, Failed failed = nullptr)
  {
    this->Start(
      key, label,
      [make, take](const Post& post)
      {
        const auto made = std::make_shared<std::decay_t<decltype(make())>>(make());
        post([take, made]() { take(*made); });
      },
      std::move(failed));
  }

  /// Stop the job of that key, if there is one. Does not wait.
  void Stop(const QString& key);

  bool IsRunning(const QString& key) const;
  bool IsIdle() const;

Q_SIGNALS:
  /// What runs has changed, or how far it is: one line, "" where nothing runs; share in [0, 1].
  void progressed(const QString& line, double share);
  /// A job said something about its input, such as what a reader corrected.
  void noted(const QString& text);
  /// What a job threw that has no function of its own for that.
  void failed(const QString& text);

private:
  struct Job;
  void Run(const std::shared_ptr<Job>& job, const std::function<void(const Post&)>& work);
  void Report();

  std::list<std::shared_ptr<Job>> All; // those that were stopped, too, until their threads end
};
} // namespace explorer

#endif
