// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/batch.h"

#include "conetact/application/batch_file.h"
#include "conetact/base/errors.h"

#include <poll.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <iomanip>
#include <iostream>
#include <list>
#include <map>
#include <memory>
#include <sstream>
#include <vector>

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
        for (const int signal : {SIGCHLD, SIGINT, SIGTERM, SIGHUP, SIGTSTP})
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

      /** The last line, with what is to be said besides. Returns the largest
       * exit code. */
      int
      close(const std::string &more)
      {
        print(std::to_string(n_good + n_bad) + " runs, " +
              std::to_string(n_bad) + " with another exit code than 0" + more +
              '\n');
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

    /** A process, with the run that it is at if there is one. */
    struct Worker
    {
      Worker(const MainOfRun &program, const std::function<void()> &begin)
        : process(program, begin)
      {}

      bool
      is_idle() const
      {
        return streams == nullptr;
      }

      BatchProcess                  process;
      BatchRun                      run;
      std::unique_ptr<BatchStreams> streams; ///< none: it waits
    };

    class Batch
    {
    public:
      Batch(const CommandLine &line, const MainOfRun &main_of_run)
        : lines(line.batch.string())
        , n_jobs(std::max(1U, line.jobs))
        , program(main_of_run)
      {}

      int
      run()
      {
        while (lines.is_open || !lines.runs.empty() || n_running() > 0)
          {
            while (!lines.runs.empty() && n_running() < n_jobs)
              {
                start(lines.runs.front());
                lines.runs.pop_front();
              }
            if (lines.is_open || n_running() > 0)
              wait();
            if (ended_by != 0 && ended_by != SIGINT)
              return of_signal + ended_by;
          }
        return table.close(ended_by == 0 ?
                             "" :
                             ". Interrupted: " + std::to_string(n_left) +
                               " more were not begun; the rows above say what "
                               "is on disk");
      }

      /** The signal that ends the batch, or 0. */
      int ended_by = 0;

    private:
      using Workers = std::list<Worker>;

      std::size_t
      n_running() const
      {
        return static_cast<std::size_t>(std::count_if(
          workers.begin(), workers.end(), [](const Worker &worker) {
            return !worker.is_idle();
          }));
      }

      void
      start(const BatchRun &run)
      {
        table.begin(run.number);
        try
          {
            hand_over(run, std::make_unique<BatchStreams>(run));
          }
        catch (const WriteError &error)
          {
            table.end(run, cannot_write, error.what());
          }
      }

      /** To a process that waits, or to a new one. */
      void
      hand_over(const BatchRun &run, std::unique_ptr<BatchStreams> streams)
      {
        auto worker = std::find_if(workers.begin(),
                                   workers.end(),
                                   [&run](const Worker &waiting) {
                                     return waiting.is_idle() && !run.alone;
                                   });
        if (worker == workers.end() || !worker->process.start(run, *streams))
          {
            worker = workers.emplace(workers.end(), program, [this] {
              signals.give_back();
            });
            if (!worker->process.start(run, *streams))
              {
                workers.erase(worker);
                throw WriteError("The words of the line are too long for a "
                                 "process.");
              }
          }
        worker->run     = run;
        worker->streams = std::move(streams);
      }

      void
      wait()
      {
        const bool          listens = lines.is_open && lines.runs.empty();
        std::vector<pollfd> events  = {{signals.fd, POLLIN, 0},
                                       {listens ? STDIN_FILENO : -1, POLLIN, 0}};
        std::vector<Workers::iterator> asked;
        for (auto worker = workers.begin(); worker != workers.end(); ++worker)
          if (!worker->is_idle())
            {
              events.push_back({worker->process.channel(), POLLIN, 0});
              asked.push_back(worker);
            }
        if (poll(events.data(), events.size(), -1) < 0)
          return; // interrupted
        for (std::size_t i = 0; i < asked.size(); ++i)
          if ((events[i + 2].revents & POLLIN) != 0 &&
              asked[i]->process.is_ready())
            {
              end(*asked[i], 0, asked[i]->streams->said());
              if (asked[i]->run.alone)
                workers.erase(asked[i]);
            }
        if (events[0].revents != 0)
          take_signal();
        if (events[1].revents != 0 && ended_by == 0)
          lines.read([this](const BatchRun &run, const std::string &why) {
            table.begin(run.number);
            table.end(run, wrong_line, why);
          });
      }

      void
      take_signal()
      {
        const int signal = signals.take();
        if (signal == SIGTSTP)
          return sleep();
        if (signal == SIGINT)
          return ended_by == 0 ? ask_to_stop() : end_at_once();
        if (signal != SIGCHLD)
          {
            ended_by = signal;
            return;
          }
        int status = 0;
        for (pid_t child; (child = waitpid(-1, &status, WNOHANG)) > 0;)
          see_end(child, status);
      }

      void
      send_to_runs(const int signal) const
      {
        for (const Worker &worker : workers)
          if (!worker.is_idle())
            worker.process.send(signal);
      }

      /** Ctrl-Z, until the shell lets the batch go on. */
      void
      sleep() const
      {
        send_to_runs(SIGSTOP);
        raise(SIGSTOP);
        send_to_runs(SIGCONT);
      }

      /** No other run begins; those that run finish their increments. */
      void
      ask_to_stop()
      {
        ended_by = SIGINT;
        n_left   = lines.runs.size();
        lines.runs.clear();
        lines.is_open = false;
        std::cerr << "\nconetact: The increments that are running are finished "
                     "first, unless they are hard to find; Ctrl-C once more "
                     "ends the runs at once."
                  << std::endl;
        send_to_runs(SIGINT);
      }

      void
      end_at_once()
      {
        for (Worker &worker : workers)
          if (!worker.is_idle())
            end(worker,
                of_signal + SIGINT,
                "The run was ended at once; what it has finished is on "
                "disk.");
      }

      /** Of a process. MPI, which catches signals, has said much, but nothing
       * of the scene. */
      void
      see_end(const pid_t child, const int status)
      {
        const auto ended = std::find_if(workers.begin(),
                                        workers.end(),
                                        [child](const Worker &worker) {
                                          return worker.process.id() == child;
                                        });
        if (ended == workers.end())
          return;
        ended->process.see_end();
        if (!ended->is_idle())
          end(*ended,
              code_of(status),
              WIFSIGNALED(status) ? "The run was ended by signal " +
                                      std::to_string(WTERMSIG(status)) + " (" +
                                      strsignal(WTERMSIG(status)) + ")." :
                                    ended->streams->said());
        workers.erase(ended);
      }

      /** Of a run. */
      void
      end(Worker &worker, const int code, const std::string &said)
      {
        table.end(worker.run, code, said);
        worker.streams.reset();
      }

      Lines              lines;
      const Signals      signals;
      Table              table;
      const unsigned int n_jobs;
      const MainOfRun   &program;
      Workers            workers;
      std::size_t        n_left = 0; ///< runs that will not begin
    };
  } // namespace



  int
  run_batch(const CommandLine &line, const MainOfRun &program)
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
