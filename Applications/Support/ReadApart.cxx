// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReadApart.h"

#include "BackgroundWork.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkNew.h"
#include "vtkSMPTools.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#if !defined(_WIN32)
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#endif
#if defined(__linux__)
#include <sys/prctl.h>
#endif

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>

#if !defined(_WIN32)
namespace
{
// The first byte of a child's answer says what follows.
constexpr char IsMesh = 'M'; // the notes, a zero, the mesh as a .vtp file
constexpr char IsError = 'E';

constexpr int PollTime = 50; // milliseconds between looks at Ctrl-C

//------------------------------------------------------------------------------
std::string Serialize(vtkPolyData* mesh)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(mesh);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToNone();
  writer->WriteToOutputStringOn();
  if (!writer->Write())
  {
    throw tool::Error("the mesh could not be handed over");
  }
  return writer->GetOutputString();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Deserialize(const std::string& text)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(text);
  reader->Update();
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
std::string Answer(const std::function<vtkSmartPointer<vtkPolyData>()>& read)
{
  const std::atomic<bool> stop{ false }; // a signal stops the process
  tool::BackgroundWork work(stop, [](const std::string&, double) {});
  try
  {
    const vtkSmartPointer<vtkPolyData> mesh = read();
    const std::string text = Serialize(mesh);
    return IsMesh + work.Notes + '\0' + text;
  }
  catch (const std::bad_alloc&)
  {
    return std::string(1, IsError) + "out of memory";
  }
  catch (const std::exception& error)
  {
    return IsError + std::string(error.what());
  }
}

//------------------------------------------------------------------------------
[[noreturn]] void RunChild(int pipe, const std::function<vtkSmartPointer<vtkPolyData>()>& read)
{
  for (const int signal : { SIGTERM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT })
  {
    std::signal(signal, SIG_DFL);
  }
  std::signal(SIGINT, SIG_IGN); // the parent's to answer
  const rlimit none = { 0, 0 };
  setrlimit(RLIMIT_CORE, &none);
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  vtkSMPTools::SetBackend("Sequential"); // no thread of a pool has come along
  const std::string answer = Answer(read);
  std::size_t done = 0;
  while (done < answer.size())
  {
    const ssize_t count = write(pipe, answer.data() + done, answer.size() - done);
    if (count < 0 && errno != EINTR)
    {
      _exit(1);
    }
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  _exit(0); // what the parent's objects do at its end is not done twice
}

//------------------------------------------------------------------------------
/// A child process, which does not outlive this.
class Child
{
public:
  explicit Child(const std::function<vtkSmartPointer<vtkPolyData>()>& read)
  {
    int ends[2];
    if (pipe(ends) != 0)
    {
      throw tool::Error(std::string("no pipe could be made: ") + std::strerror(errno));
    }
    this->Id = fork();
    if (this->Id == 0)
    {
      close(ends[0]);
      RunChild(ends[1], read);
    }
    close(ends[1]);
    this->Pipe = ends[0];
    if (this->Id < 0)
    {
      const std::string reason = std::strerror(errno);
      close(this->Pipe);
      throw tool::Error("no process could be started: " + reason);
    }
  }
  ~Child()
  {
    close(this->Pipe);
    if (this->Id > 0)
    {
      kill(this->Id, SIGKILL);
      this->Wait();
    }
  }
  Child(const Child&) = delete;
  void operator=(const Child&) = delete;

  /// All that it has to say.
  std::string Read() const
  {
    std::string answer;
    std::string part(1 << 16, '\0');
    for (;;)
    {
      tool::Interruptible::Check();
      pollfd waited = { this->Pipe, POLLIN, 0 };
      if (poll(&waited, 1, PollTime) > 0)
      {
        const ssize_t count = read(this->Pipe, &part[0], part.size());
        if (count == 0 || (count < 0 && errno != EINTR))
        {
          return answer;
        }
        answer.append(part, 0, count > 0 ? static_cast<std::size_t>(count) : 0);
      }
    }
  }

  /// How it ended, as waitpid says.
  int Wait()
  {
    int status = 0;
    while (waitpid(this->Id, &status, 0) < 0 && errno == EINTR)
    {
    }
    this->Id = -1;
    return status;
  }

private:
  pid_t Id = -1;
  int Pipe = -1;
};
}

namespace tool
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> ReadApart(
  const std::string& path, const std::function<vtkSmartPointer<vtkPolyData>()>& read)
{
  Child child(read);
  const std::string answer = child.Read();
  const int status = child.Wait();
  if (!answer.empty() && answer[0] == IsError)
  {
    throw Error(answer.substr(1));
  }
  const std::size_t end = answer.find('\0');
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || end == std::string::npos)
  {
    throw Error(path + ": is damaged: VTK's reader ended " +
                (WIFSIGNALED(status) ? "by signal " + std::to_string(WTERMSIG(status)) + " (" +
                                         strsignal(WTERMSIG(status)) + ")"
                                     : "without an answer") +
                ", expected a file that is whole, whose counts and indices fit together");
  }
  PrintNote(answer.substr(1, end - 1));
  return Deserialize(answer.substr(end + 1));
}
} // namespace tool
#else
namespace tool
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> ReadApart(
  const std::string&, const std::function<vtkSmartPointer<vtkPolyData>()>& read)
{
  return read();
}
} // namespace tool
#endif
