// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/scene_run.h"
#include "conetact/application/batch.h"
#include "conetact/application/command_line.h"
#include "conetact/application/compare_runs.h"
#include "conetact/application/entry_texts.h"
#include "conetact/application/located.h"
#include "conetact/application/manual.h"
#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/base/interruption.h"
#include "conetact/base/log.h"
#include "conetact/base/process.h"
#include "conetact/base/team.h"
#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace
{
  using namespace conetact;

  /* Sentences quote files, whatever is in them: a terminal must not obey it. */
  int
  say(std::string sentence, const int code)
  {
    std::replace_if(
      sentence.begin(),
      sentence.end(),
      [](const unsigned char c) { return c < ' ' && c != '\n'; },
      '?');
    std::cerr << "conetact: " << sentence << std::endl;
    return code;
  }

  /** The same by the first of processes that may not see each other. */
  int
  say_as_first(const std::string &sentence, const int code)
  {
    return ranks_of_mpirun().rank == 0 ? say(sentence, code) : code;
  }

  /** How a process has ended its part of a run. */
  struct Ending
  {
    int         code = 0;
    std::string sentence;
  };

  /** One of many processes says why a run has failed. One that has failed by
   * itself ends the others, which wait for something that it has not sent. */
  int
  end_together(const Ending &own)
  {
    const auto say_here = [&] {
      if (own.sentence.empty()) // a code says all
        return;
      const bool is_first = ProcessSession::speaks();
      say(is_first ? own.sentence :
                     "Process " + std::to_string(ProcessSession::rank() + 1) +
                       " of " + std::to_string(ProcessSession::n_processes()) +
                       ": " + own.sentence,
          own.code);
    };
    std::cout << std::flush;
    const std::vector<int> codes = meet(own.code);
    if (codes.empty())
      {
        say_here();
        ProcessSession::end_all(own.code);
      }
    for (std::size_t p = 0; p < codes.size(); ++p)
      if (codes[p] > 0)
        {
          if (p == ProcessSession::rank())
            say_here();
          return codes[p];
        }
    return 0;
  }

  /** As many processes as the user wants: now, or in a run that takes the place
   * of this one. */
  void
  start_processes(const application::CommandLine &line, char *const argv[])
  {
    const unsigned int n = ProcessSession::n_processes();
    if (n == 1 && line.processes > 1)
      conetact::start_processes(line.processes, argv);
    if (n > 1 && line.processes > 0 && line.processes != n)
      throw InputError("mpirun has started " + std::to_string(n) +
                       " processes, and Option --processes wants " +
                       std::to_string(line.processes) +
                       ". Leave one of them out.");
  }

  /** Whether two runs have the same results: 0, else 2. */
  int
  compare(const application::CommandLine &line)
  {
    const application::RunComparison found = application::compare_runs(line);
    print(found.text);
    return found.are_equal ? 0 : 2;
  }

  bool
  runs_scene(const application::CommandLine &line)
  {
    return line.answer.empty() && line.compared.empty() &&
           line.entry_text.empty() && line.batch.empty() &&
           line.new_scene.empty() &&
           !(line.print_parameters && line.scene.empty());
  }

  /** Answers what is asked for, which no other process is needed for. Returns
   * the exit code. */
  int
  answer(const application::CommandLine &line)
  {
    if (!line.answer.empty())
      print(line.answer);
    else if (!line.compared.empty())
      return compare(line);
    else if (!line.entry_text.empty())
      print(application::entry_text(line));
    else if (!line.batch.empty())
      throw InputError(ProcessSession::n_processes() == 1 ?
                         "A batch is no run of another one." :
                         "A batch is no run of several processes. Leave "
                         "mpirun out, and write --processes into its lines.");
    else if (!line.new_scene.empty())
      print(application::write_starter_scene(line.new_scene));
    else
      print(application::manual());
    return 0;
  }

  /** Does what the line says. Returns the exit code. */
  int
  do_as_told(const application::CommandLine &line, char *const argv[])
  {
    if (runs_scene(line))
      {
        start_processes(line, argv);
        analysis::run_scene(line);
        return 0;
      }
    return ProcessSession::speaks() ? answer(line) : 0;
  }

  Ending
  run_program(int argc, char *const argv[])
  {
    application::CommandLine line;
    try
      {
        line = application::parse_command_line(argc, argv);
        return {do_as_told(line, argv), ""};
      }
    catch (const InputError &error)
      {
        return {1, application::located(error.what(), line)};
      }
    catch (const AnalysisError &error)
      {
        return {2, error.what()};
      }
    catch (const Interrupted &stop)
      {
        return {Interrupted::exit_code, stop.what()};
      }
    catch (const WriteError &error)
      {
        return {3, error.what()};
      }
    catch (const dealii::ExceptionBase &error)
      {
        std::ostringstream text;
        error.print_info(text);
        return {1, "deal.II refuses the scene: " + one_line(text.str())};
      }
  }

  /** A run, from its first line to its exit code. */
  int
  run_process(int argc, char *const argv[])
  {
    take_size_limits_as_errors();
    dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
    dealii::deal_II_exceptions::disable_abort_on_exception();
    try
      {
        ProcessSession::join();
        return end_together(run_program(argc, argv));
      }
    catch (const InputError &error) // processes do not see each other
      {
        return say_as_first(error.what(), 1);
      }
    catch (const EndedByOther &error)
      {
        return error.code;
      }
    catch (const std::exception &error)
      {
        return end_together({1, error.what()});
      }
  }

  /** The batch that is asked for, if this is one; all else is told by the run
   * that it is. */
  application::CommandLine
  batch_of(int argc, char *const argv[])
  {
    try
      {
        return application::parse_command_line(argc, argv);
      }
    catch (const InputError &)
      {
        return {};
      }
  }

  int
  run_batch(const application::CommandLine &line)
  {
    try
      {
        return application::run_batch(line, [](int argc, char *const argv[]) {
          static const ProcessSession process; // for the runs that follow, too
          return run_process(argc, argv);
        });
      }
    catch (const InputError &error)
      {
        return say_as_first(error.what(), 1);
      }
    catch (const WriteError &error)
      {
        return say_as_first(error.what(), 3);
      }
  }
} // namespace

/* Nothing is started before it is known that there will be no copies of this
   process. Processes of mpirun make none: one refuses a batch for all. */
int
main(int argc, char *argv[])
{
  const application::CommandLine line = batch_of(argc, argv);
  if (!line.batch.empty() && ranks_of_mpirun().size == 1)
    return run_batch(line);
  int code = 0;
  {
    const ProcessSession process;
    code = run_process(argc, argv);
  }
  if (code == Interrupted::exit_code)
    Interruption::end_process();
  return code;
}
