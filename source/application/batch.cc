// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/batch.h"

#include "conetact/application/batch_file.h"
#include "conetact/base/errors.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <deque>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>

namespace conetact::application
{
  namespace
  {
    constexpr int cannot_write = 3, wrong_line = 1, of_signal = 128;


    /** The exit code of a process, as shells tell it. */
    int
    code_of(const int status)
    {
      return WIFSIGNALED(status) ? of_signal + WTERMSIG(status) :
                                   WEXITSTATUS(status);
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

    /**
     * Where a run prints to. What it says on standard error is read again, for
     * the table.
     */
    class Streams
    {
    public:
      explicit Streams(const BatchRun &run)
        : out(open_file(run.out.empty() ? "/dev/null" : run.out, O_WRONLY))
        , err(run.err.empty() ? memfd_create("stderr", MFD_CLOEXEC) :
                                open_file(run.err, O_RDWR))
      {}

      ~Streams()
      {
        ::close(out);
        ::close(err);
      }

      Streams(const Streams &) = delete;
      Streams &
      operator=(const Streams &) = delete;

      /** Makes them those of this process. */
      void
      take() const
      {
        const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
        dup2(nothing, STDIN_FILENO);
        dup2(out, STDOUT_FILENO);
        dup2(err, STDERR_FILENO);
      }

      std::string
      said() const
      {
        return last_line(err);
      }

    private:
      static int
      open_file(const std::string &file, const int flags)
      {
        const int opened =
          open(file.c_str(), flags | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (opened < 0)
          throw WriteError("The file " + file +
                           " cannot be written: " + std::strerror(errno) + ".");
        return opened;
      }

      int out, err;
    };

    /**
     * Signals that are waited for together with lines, while an object lives.
     * Copies take them as they were before.
     */
    class Signals
    {
    public:
      Signals()
      {
        sigset_t taken;
        sigemptyset(&taken);
        for (const int signal : {SIGCHLD, SIGINT, SIGTERM, SIGHUP})
          sigaddset(&taken, signal);
        sigprocmask(SIG_BLOCK, &taken, &before);
        fd = signalfd(-1, &taken, SFD_CLOEXEC);
      }

      ~Signals()
      {
        ::close(fd);
        give_back();
      }

      Signals(const Signals &) = delete;
      Signals &
      operator=(const Signals &) = delete;

      void
      give_back() const
      {
        sigprocmask(SIG_SETMASK, &before, nullptr);
      }

      /** The one that has come. */
      int
      take() const
      {
        signalfd_siginfo info;
        return ::read(fd, &info, sizeof(info)) == sizeof(info) ?
                 static_cast<int>(info.ssi_signo) :
                 0;
      }

      int fd = -1;

    private:
      sigset_t before;
    };

    /** The lines of a file, or those of standard input as they arrive. */
    class Lines
    {
    public:
      explicit Lines(const std::string &file)
        : is_open(file == "-")
      {
        if (!is_open)
          for (BatchRun &run : read_batch_file(file))
            runs.push_back(std::move(run));
      }

      /** Reads what standard input has now. A wrong line is a run that has
       * failed. */
      void
      read(const std::function<void(const BatchRun &, const std::string &)>
             &refuse)
      {
        char          part[4096];
        const ssize_t n = ::read(STDIN_FILENO, part, sizeof(part));
        if (n < 0 && errno == EINTR)
          return;
        is_open = n > 0;
        text.append(part, static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
        if (!is_open && !text.empty())
          text += '\n'; // behind the last one there may be none
        for (std::size_t end; (end = text.find('\n')) != std::string::npos;)
          {
            add(text.substr(0, end), refuse);
            text.erase(0, end + 1);
          }
      }

      std::deque<BatchRun> runs; ///< not begun yet
      bool                 is_open;

    private:
      void
      add(const std::string &line,
          const std::function<void(const BatchRun &, const std::string &)>
            &refuse)
      {
        ++number;
        try
          {
            if (const auto run = parse_batch_line(line, number))
              runs.push_back(*run);
          }
        catch (const InputError &error)
          {
            BatchRun wrong;
            wrong.number = number;
            wrong.name   = "-";
            refuse(wrong, error.what());
            return;
          }
        try
          {
            if (!runs.empty() && runs.back().number == number)
              check_batch_run(runs.back());
          }
        catch (const InputError &)
          {} // the run says so itself
      }

      std::string  text;
      unsigned int number = 0;
    };

    /** Rows in the order of the lines. */
    class Table
    {
    public:
      Table()
      {
        print(" line  code  results\n");
      }

      /** Of a run that begins now; others that end before it wait. */
      void
      begin(const unsigned int number)
      {
        rows.emplace(number, "");
      }

      void
      end(const BatchRun &run, const int code, const std::string &said)
      {
        largest = std::max(largest, code);
        ++(code == 0 ? n_good : n_bad);
        std::ostringstream row;
        row << std::setw(5) << run.number << std::setw(6) << code << "  "
            << run.name << (said.empty() ? "" : ": ") << said << '\n';
        rows[run.number] = row.str();
        while (!rows.empty() && !rows.begin()->second.empty())
          {
            print(rows.begin()->second);
            rows.erase(rows.begin());
          }
      }

      /** The last line. Returns the largest exit code. */
      int
      close()
      {
        print(std::to_string(n_good + n_bad) + " runs, " +
              std::to_string(n_bad) + " with another exit code than 0\n");
        return largest;
      }

    private:
      static void
      print(const std::string &text)
      {
        if (!(std::cout << text << std::flush))
          throw WriteError("Standard output cannot be written: is the disk "
                           "full?");
      }

      std::map<unsigned int, std::string> rows; ///< not printed yet
      int                                 largest = 0;
      unsigned int                        n_good = 0, n_bad = 0;
    };

    class Batch
    {
    public:
      Batch(const CommandLine                            &line,
            const std::function<int(int, char *const[])> &main_of_run)
        : lines(line.batch.string())
        , n_jobs(std::max(1U, line.jobs))
        , program(main_of_run)
      {}

      /** None of the runs goes on alone. */
      ~Batch()
      {
        for (const auto &[child, run] : running)
          kill(child, SIGTERM);
        for (const auto &[child, run] : running)
          waitpid(child, nullptr, 0);
      }

      Batch(const Batch &) = delete;
      Batch &
      operator=(const Batch &) = delete;

      int
      run()
      {
        while (lines.is_open || !lines.runs.empty() || !running.empty())
          {
            while (!lines.runs.empty() && running.size() < n_jobs)
              {
                start(lines.runs.front());
                lines.runs.pop_front();
              }
            if (lines.is_open || !running.empty())
              wait();
            if (ended_by != 0)
              return of_signal + ended_by;
          }
        return table.close();
      }

      /** The signal that ends the batch, or 0. */
      int ended_by = 0;

    private:
      struct Running
      {
        BatchRun                 run;
        std::unique_ptr<Streams> streams;
      };

      void
      start(const BatchRun &run)
      {
        table.begin(run.number);
        try
          {
            auto        streams = std::make_unique<Streams>(run);
            const pid_t child   = fork();
            if (child == 0)
              be_run(run, *streams);
            if (child < 0)
              throw WriteError("No process can be started: " +
                               std::string(std::strerror(errno)) + ".");
            running.emplace(child, Running{run, std::move(streams)});
          }
        catch (const WriteError &error)
          {
            table.end(run, cannot_write, error.what());
          }
      }

      /* To leave without the destructors of two hundred libraries saves a third
         of what a copy costs. */
      [[noreturn]] void
      be_run(const BatchRun &run, const Streams &streams) const
      {
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        signals.give_back();
        streams.take();
        std::vector<std::string> words = {"conetact"};
        words.insert(words.end(), run.words.begin(), run.words.end());
        std::vector<char *> arguments;
        for (std::string &word : words)
          arguments.push_back(word.data());
        arguments.push_back(nullptr);
        const int code =
          program(static_cast<int>(words.size()), arguments.data());
        std::cout << std::flush;
        std::fflush(nullptr);
        _exit(code);
      }

      void
      wait()
      {
        const bool listens = lines.is_open && lines.runs.empty();
        pollfd events[] = {{signals.fd, POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}};
        const int n     = poll(events, listens ? 2 : 1, -1);
        if (n < 0)
          return; // interrupted
        if (events[0].revents != 0)
          take_signal();
        if (listens && events[1].revents != 0)
          lines.read([this](const BatchRun &run, const std::string &why) {
            table.begin(run.number);
            table.end(run, wrong_line, why);
          });
      }

      void
      take_signal()
      {
        const int signal = signals.take();
        if (signal != SIGCHLD)
          {
            ended_by = signal;
            return;
          }
        int status = 0;
        for (pid_t child; (child = waitpid(-1, &status, WNOHANG)) > 0;)
          end(child, status);
      }

      void
      end(const pid_t child, const int status)
      {
        const auto    found = running.find(child);
        const Running ended = std::move(found->second);
        running.erase(found);
        // MPI, which catches signals, has said much, but nothing of the scene
        const std::string said = WIFSIGNALED(status) ?
                                   "The run was ended by signal " +
                                     std::to_string(WTERMSIG(status)) + " (" +
                                     strsignal(WTERMSIG(status)) + ")." :
                                   ended.streams->said();
        table.end(ended.run, code_of(status), said);
      }

      Lines                                         lines;
      const Signals                                 signals;
      Table                                         table;
      const unsigned int                            n_jobs;
      const std::function<int(int, char *const[])> &program;
      std::map<pid_t, Running>                      running;
    };
  } // namespace



  int
  run_batch(const CommandLine                            &line,
            const std::function<int(int, char *const[])> &program)
  {
    int ended_by = 0, code = 0;
    {
      Batch batch(line, program);
      code     = batch.run();
      ended_by = batch.ended_by;
    }
    if (ended_by != 0)
      {
        std::signal(ended_by, SIG_DFL);
        raise(ended_by);
      }
    return code;
  }
} // namespace conetact::application
