// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/batch_process.h"

#include "conetact/base/errors.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>

namespace conetact::application
{
  namespace
  {
    /** What a process may have taken at most to be used again [kB]. */
    constexpr long much_memory = 512L << 10;
    /** Whatever grows from run to run stays small. */
    constexpr unsigned int most_runs = 100;

    int
    open_file(const std::string &file, const int flags)
    {
      const int opened =
        open(file.c_str(), flags | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
      if (opened < 0)
        throw WriteError("The file " + file +
                         " cannot be written: " + std::strerror(errno) + ".");
      return opened;
    }

    /** A message that passes on the standard output and error of a run. */
    struct Message
    {
      Message(void *const text, const std::size_t size)
        : part{text, size}
      {
        header.msg_iov        = &part;
        header.msg_iovlen     = 1;
        header.msg_control    = control;
        header.msg_controllen = sizeof(control);
      }

      void
      enclose(const BatchStreams &streams)
      {
        const int      files[] = {streams.out, streams.err};
        cmsghdr *const inside  = CMSG_FIRSTHDR(&header);
        inside->cmsg_level     = SOL_SOCKET;
        inside->cmsg_type      = SCM_RIGHTS;
        inside->cmsg_len       = CMSG_LEN(sizeof(files));
        std::memcpy(CMSG_DATA(inside), files, sizeof(files));
      }

      /** Makes the files that have come those of this process. */
      void
      take_files()
      {
        int files[2];
        std::memcpy(files, CMSG_DATA(CMSG_FIRSTHDR(&header)), sizeof(files));
        dup2(files[0], STDOUT_FILENO);
        dup2(files[1], STDERR_FILENO);
        ::close(files[0]);
        ::close(files[1]);
      }

      iovec  part;
      msghdr header                                              = {};
      alignas(cmsghdr) char control[CMSG_SPACE(2 * sizeof(int))] = {};
    };

    /** Words of a run, with a zero behind each. */
    std::string
    receive_run(const int channel)
    {
      const ssize_t size =
        recv(channel, nullptr, 0, MSG_PEEK | MSG_TRUNC); // of the next message
      if (size <= 0)
        _exit(0);
      std::string text(static_cast<std::size_t>(size), ' ');
      Message     message(text.data(), text.size());
      if (recvmsg(channel, &message.header, MSG_CMSG_CLOEXEC) != size)
        _exit(0);
      message.take_files();
      return text;
    }

    int
    run(const MainOfRun &program, std::string words)
    {
      std::string         name      = "conetact";
      std::vector<char *> arguments = {name.data()};
      for (std::size_t at = 0; at < words.size(); at = words.find('\0', at) + 1)
        arguments.push_back(words.data() + at);
      arguments.push_back(nullptr);
      const int code =
        program(static_cast<int>(arguments.size()) - 1, arguments.data());
      std::cout << std::flush;
      std::fflush(nullptr);
      return code;
    }

    /** The largest amount of memory is that of a run, not of those before. */
    void
    measure_memory_anew()
    {
      std::ofstream("/proc/self/clear_refs") << 5;
    }

    bool
    has_taken_much()
    {
      rusage usage;
      return getrusage(RUSAGE_SELF, &usage) != 0 ||
             usage.ru_maxrss > much_memory;
    }

    /* To leave without the destructors of two hundred libraries saves a third
       of what a copy costs. */
    [[noreturn]] void
    serve(const int channel, const MainOfRun &program)
    {
      const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
      dup2(nothing, STDIN_FILENO);
      for (unsigned int i = 1;; ++i)
        {
          const std::string words = receive_run(channel);
          measure_memory_anew();
          const int code = run(program, words);
          if (code != 0 || i == most_runs || has_taken_much() ||
              send(channel, "", 1, MSG_NOSIGNAL) != 1)
            _exit(code);
        }
    }

    /** The last line of a file, without the name of the program. */
    std::string
    last_line(const int file)
    {
      std::string text;
      char        part[4096];
      lseek(file, 0, SEEK_SET);
      for (ssize_t n; (n = ::read(file, part, sizeof(part))) > 0;)
        text.append(part, static_cast<std::size_t>(n));
      text.erase(text.find_last_not_of(" \n") + 1);
      text.erase(0, text.rfind('\n') + 1);
      constexpr char name[] = "conetact: ";
      return text.rfind(name, 0) == 0 ? text.substr(sizeof(name) - 1) : text;
    }
  } // namespace



  BatchStreams::BatchStreams(const BatchRun &run)
    : out(open_file(run.out.empty() ? "/dev/null" : run.out, O_WRONLY))
    , err(run.err.empty() ? memfd_create("stderr", MFD_CLOEXEC) :
                            open_file(run.err, O_RDWR))
  {}



  BatchStreams::~BatchStreams()
  {
    ::close(out);
    ::close(err);
  }



  std::string
  BatchStreams::said() const
  {
    return last_line(err);
  }



  BatchProcess::BatchProcess(const MainOfRun             &program,
                             const std::function<void()> &begin)
  {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) == 0)
      child = fork();
    if (child < 0)
      throw WriteError("No process can be started: " +
                       std::string(std::strerror(errno)) + ".");
    if (child == 0)
      {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        setpgid(0, 0); // a terminal's Ctrl-C is for the batch, which asks once
        begin();
        serve(ends[1], program);
      }
    ::close(ends[1]);
    ours = ends[0];
  }



  BatchProcess::~BatchProcess()
  {
    if (child > 0)
      {
        kill(child, SIGKILL); // what it has finished is on disk
        waitpid(child, nullptr, 0);
      }
    ::close(ours);
  }



  bool
  BatchProcess::start(const BatchRun &run, const BatchStreams &streams) const
  {
    std::string words;
    for (const std::string &word : run.words)
      words += word + '\0';
    Message message(words.data(), words.size());
    message.enclose(streams);
    return sendmsg(ours, &message.header, MSG_NOSIGNAL) > 0;
  }



  bool
  BatchProcess::is_ready() const
  {
    char answer;
    return recv(ours, &answer, 1, MSG_DONTWAIT) == 1;
  }



  void
  BatchProcess::send(const int signal) const
  {
    if (child > 0)
      kill(child, signal);
  }



  void
  BatchProcess::see_end()
  {
    child = -1;
  }



  pid_t
  BatchProcess::id() const
  {
    return child;
  }



  int
  BatchProcess::channel() const
  {
    return ours;
  }
} // namespace conetact::application
