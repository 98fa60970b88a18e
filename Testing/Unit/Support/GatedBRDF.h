// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material that is evaluated only while a gate is open: a plan of it is in the making for as long
 * as a test wants it to be.
 */

#ifndef GatedBRDF_h
#define GatedBRDF_h

#include "vtkBlinnPhongBRDF.h"
#include "vtkObjectFactory.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

/// Shared by a material and its snapshots.
class Gate
{
public:
  void Close() { this->Open = false; }
  void OpenUp()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Open = true;
    this->Opened.notify_all();
  }
  void Pass()
  {
    ++this->Passes;
    if (!this->Open)
    {
      std::unique_lock<std::mutex> lock(this->Mutex);
      ++this->Waiting;
      this->Opened.wait(lock, [this]() { return this->Open.load(); });
      --this->Waiting;
    }
  }
  bool IsAwaited() const { return this->Waiting > 0; }
  long TakePasses() { return this->Passes.exchange(0); }

  /// Forget the passes so far. The threads of a loop come one after the other: it waits until none
  /// came for a while.
  void SettlePasses()
  {
    do
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    } while (this->TakePasses() > 0);
  }

private:
  std::mutex Mutex;
  std::condition_variable Opened;
  std::atomic<bool> Open{ true };
  std::atomic<int> Waiting{ 0 };
  std::atomic<long> Passes{ 0 };
};

class GatedBRDF : public vtkBlinnPhongBRDF
{
public:
  static GatedBRDF* New();
  vtkTypeMacro(GatedBRDF, vtkBlinnPhongBRDF);

  std::shared_ptr<Gate> Door = std::make_shared<Gate>();
  static std::atomic<int>& GetNumberOfObjects()
  {
    static std::atomic<int> count{ 0 };
    return count;
  }

protected:
  GatedBRDF() { ++GetNumberOfObjects(); }
  ~GatedBRDF() override { --GetNumberOfObjects(); }

  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    this->Door->Pass();
    this->Superclass::EvaluateAbove(i, o, f);
  }
  vtkBRDF* NewCopy() override
  {
    GatedBRDF* copy = GatedBRDF::New();
    copy->Door = this->Door;
    copy->SetExponent(this->GetExponent());
    copy->SetSpecular(this->GetSpecular());
    return copy;
  }
};
inline vtkStandardNewMacro(GatedBRDF);

/// Whether it comes true; a minute is a failure, not a measure.
template <typename Condition>
bool WaitUntil(Condition condition)
{
  for (int k = 0; k < 60000 && !condition(); ++k)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return condition();
}

#endif
