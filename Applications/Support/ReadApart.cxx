// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReadApart.h"

#include "Progress.h"
#include "Tool.h"

#include "vtkNew.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#if defined(__linux__)
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#if defined(__linux__)
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
  const std::string errors = tool::TakeErrorText();
  if (!errors.empty())
  {
    throw tool::Error("the mesh could not be handed over: " + errors);
  }
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
std::string Answer(
  const std::string& path, const std::function<vtkSmartPointer<vtkPolyData>()>& read)
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
    return IsError + path + ": its data need more memory than there is";
  }
  catch (const std::exception& error)
  {
    return IsError + std::string(error.what());
  }
}

//------------------------------------------------------------------------------
// The tool, which answers ReadMeshOption, beside this program; empty where there is none.
std::string FindTool()
{
  std::error_code error;
  const auto own = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto beside = own.parent_path() / "measured-brdf";
  return !error && std::filesystem::exists(beside, error) ? beside.string() : "";
}

//------------------------------------------------------------------------------
/// A child process, which does not outlive this.
class Child
{
public:
  /// A program that begins anew: a copy of this one would have its locks, and not its threads.
  Child(std::string program, std::string path)
  {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) // no other child holds an end open
    {
      throw tool::Error(std::string("no pipe could be made: ") + std::strerror(errno));
    }
    this->Pipe = ends[0];
    std::string option = tool::ReadMeshOption;
    char* const words[] = { program.data(), option.data(), path.data(), nullptr };
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    const int error = posix_spawn(&this->Id, program.c_str(), &actions, nullptr, words, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (error != 0)
    {
      close(this->Pipe);
      throw tool::Error(std::string("no process could be started: ") + std::strerror(error));
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
  const std::string program = FindTool();
  if (program.empty())
  {
    return read();
  }
  Child child(program, path);
  std::string answer = child.Read();
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
  answer.erase(0, end + 1);
  return Deserialize(answer);
}

//------------------------------------------------------------------------------
int AnswerApart(const std::string& path, const std::function<vtkSmartPointer<vtkPolyData>()>& read)
{
  std::signal(SIGINT, SIG_IGN); // the parent's to answer
  const rlimit none = { 0, 0 };
  setrlimit(RLIMIT_CORE, &none);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int pipe = dup(STDOUT_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO); // what VTK's readers print is no part of the answer
  const std::string answer = Answer(path, read);
  std::size_t done = 0;
  while (done < answer.size())
  {
    const ssize_t count = write(pipe, answer.data() + done, answer.size() - done);
    if (count < 0 && errno != EINTR)
    {
      return 1;
    }
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  return 0;
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

//------------------------------------------------------------------------------
int AnswerApart(const std::string&, const std::function<vtkSmartPointer<vtkPolyData>()>&)
{
  return 1;
}
} // namespace tool
#endif
