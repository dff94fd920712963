// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>

namespace conetact
{
  namespace
  {
    /** Exit codes of the copy. */
    constexpr int no_memory = 10, has_failed = 11;

    /** A copy that waits for something gets no time on a processor. */
    constexpr double real_seconds_per_cpu_second = 10;

    /** Of this process, as RLIMIT_AS counts it. */
    double
    bytes_of_address_space()
    {
      std::ifstream file("/proc/self/statm");
      double        pages = 0;
      file >> pages;
      return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
    }

    /** Never above what was allowed before. */
    void
    allow(const decltype(RLIMIT_AS) resource, const double amount)
    {
      rlimit limit;
      getrlimit(resource, &limit);
      limit.rlim_cur = std::min(limit.rlim_cur, static_cast<rlim_t>(amount));
      setrlimit(resource, &limit);
    }

    void
    limit_copy(const ChildLimits &limits)
    {
      const double before = bytes_of_address_space();
      if (before > 0)
        allow(RLIMIT_AS, before + limits.bytes);
      allow(RLIMIT_CPU, std::ceil(limits.cpu_seconds));
      allow(RLIMIT_CORE, 0);
      alarm(static_cast<unsigned int>(
        std::ceil(real_seconds_per_cpu_second * limits.cpu_seconds)));
    }

    /** MPI and sanitizers would report what ends the copy. */
    void
    take_signals_as_they_are()
    {
      for (const int signal : {SIGSEGV,
                               SIGBUS,
                               SIGFPE,
                               SIGILL,
                               SIGABRT,
                               SIGALRM,
                               SIGXCPU,
                               SIGPIPE,
                               SIGINT,
                               SIGTERM})
        std::signal(signal, SIG_DFL);
    }

    void
    be_silent()
    {
      const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
      dup2(nowhere, STDOUT_FILENO);
      dup2(nowhere, STDERR_FILENO);
    }

    void
    write_all(const int fd, const char *data, std::size_t size)
    {
      while (size > 0)
        {
          const ssize_t n = ::write(fd, data, size);
          if (n < 0 && errno != EINTR)
            _exit(has_failed);
          data += std::max<ssize_t>(n, 0);
          size -= static_cast<std::size_t>(std::max<ssize_t>(n, 0));
        }
    }

    /** First letters of answers. */
    constexpr char has_bytes = 'b', has_refusal = 'r';

    std::string
    answer_of(const std::function<std::string()> &work)
    {
      try
        {
          return has_bytes + work();
        }
      catch (const ChildRefusal &refusal)
        {
          return has_refusal + refusal.what;
        }
    }

    /** Its length first, so that a part is not taken for the whole. */
    [[noreturn]] void
    be_copy(const int                           to_parent,
            const ChildLimits                  &limits,
            const std::function<std::string()> &work)
    {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      take_signals_as_they_are();
      be_silent();
      limit_copy(limits);
      try
        {
          const std::string result = answer_of(work);
          const std::size_t size   = result.size();
          write_all(to_parent,
                    reinterpret_cast<const char *>(&size),
                    sizeof(size));
          write_all(to_parent, result.data(), size);
        }
      catch (const std::bad_alloc &)
        {
          _exit(no_memory);
        }
      catch (...)
        {
          _exit(has_failed);
        }
      _exit(0);
    }

    std::string
    read_all(const int fd)
    {
      std::string bytes;
      char        buffer[65536];
      for (ssize_t n; (n = ::read(fd, buffer, sizeof(buffer))) != 0;)
        if (n > 0)
          bytes.append(buffer, static_cast<std::size_t>(n));
        else if (errno != EINTR)
          break;
      return bytes;
    }

    std::string
    reason(const int status)
    {
      if (WIFEXITED(status) && WEXITSTATUS(status) == no_memory)
        return "needs more memory than any file of that size";
      if (WIFSIGNALED(status) &&
          (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM ||
           WTERMSIG(status) == SIGKILL))
        return "does not come to an end";
      return "fails in the middle of it";
    }
  } // namespace



  ChildResult
  in_child_process(const ChildLimits                  &limits,
                   const std::function<std::string()> &work)
  {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw std::bad_alloc();
    const pid_t child = fork();
    if (child == 0)
      be_copy(ends[1], limits, work);
    ::close(ends[1]);
    const std::string answer = child > 0 ? read_all(ends[0]) : "";
    ::close(ends[0]);
    if (child < 0)
      throw std::bad_alloc();
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
      ;
    std::size_t size = 0;
    if (answer.size() >= sizeof(size))
      {
        std::memcpy(&size, answer.data(), sizeof(size));
        const std::string content = answer.substr(sizeof(size));
        if (size == content.size() && content[0] == has_refusal)
          return {"", "", content.substr(1)};
        if (size == content.size())
          return {content.substr(1), ""};
      }
    return {"", reason(status)};
  }
} // namespace conetact
