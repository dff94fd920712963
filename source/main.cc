// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/adaptive_refinement.h"
#include "conetact/analysis/cost.h"
#include "conetact/analysis/make_analysis.h"
#include "conetact/application/batch.h"
#include "conetact/application/command_line.h"
#include "conetact/application/compare_runs.h"
#include "conetact/application/entry_texts.h"
#include "conetact/application/located.h"
#include "conetact/application/manual.h"
#include "conetact/application/scene.h"
#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/base/folder_lock.h"
#include "conetact/base/interruption.h"
#include "conetact/base/log.h"
#include "conetact/base/process.h"
#include "conetact/base/results_folder.h"
#include "conetact/base/text.h"
#include "conetact/base/workers.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <new>
#include <sstream>
#include <utility>

namespace
{
  using namespace conetact;

  /** What was asked for, and nothing else is done. */
  void
  print(const std::string &text)
  {
    if (!(std::cout << text << std::flush))
      throw WriteError("Standard output cannot be written: is the disk full?");
  }

  /** The contacts of `Contacts = automatic`, to be included or pasted. */
  const char *const automatic_file = "contacts.prm";

  /** To a folder that exists from now on and is this run's as long as the lock
   * lives. */
  std::unique_ptr<FolderLock>
  start_writing(const std::filesystem::path &folder,
                const application::Scene    &scene,
                Log                         &log)
  {
    make_folder(folder);
    std::error_code ignored;
    const bool      goes_on =
      scene.restart &&
      std::filesystem::equivalent(scene.restart->folder, folder, ignored);
    auto lock = std::make_unique<FolderLock>(folder);
    log.open(folder, goes_on);
    // of an earlier run, which this one may not replace
    for (const char *table : {"events.csv", "refinement.csv"})
      std::filesystem::remove(folder / table, ignored);
    if (!goes_on)
      std::filesystem::remove(folder / "checkpoint.bin", ignored);
    write_atomically(folder / "used.prm", scene.values());
    if (!scene.automatic_text.empty())
      write_atomically(folder / automatic_file, scene.automatic_text);
    for (std::size_t b = 0; b < scene.bodies.n_elastic(); ++b)
      if (const std::string &mesh = scene.bodies.structures[b]->made_mesh();
          !mesh.empty())
        write_atomically(folder / ("mesh_" + scene.bodies.names[b] + ".msh"),
                         mesh);
    return lock;
  }

  void
  foretell(analysis::Analysis       &analysis,
           const application::Scene &scene,
           Log                      &log)
  {
    analysis.check_history();
    analysis.estimate();
    if (scene.adaptive.cycles > 0)
      log.say("estimates are those of the first of " +
              std::to_string(scene.adaptive.cycles + 1) + " meshes");
    log.note(describe(analysis.work()));
  }

  /** What is said of a run that ends before its time. */
  void
  end_early(const std::exception     &why,
            const analysis::Analysis &analysis,
            Log                      &log)
  {
    log.note(why.what());
    if (analysis.has_results())
      analysis.say_closing();
    analysis::note_work(analysis.work(), log);
  }

  /** Runs the history on the mesh at hand. mpirun ends many processes, whatever
   * they would like to do first. */
  void
  run_history(analysis::Analysis             &analysis,
              const std::filesystem::path    &folder,
              const application::CommandLine &line,
              Log                            &log)
  {
    try
      {
        if (line.verify)
          analysis.verify();
        std::optional<Interruption> interruption;
        if (ProcessSession::n_processes() == 1)
          interruption.emplace();
        analysis.run(folder, line.quiet);
      }
    catch (const AnalysisError &error)
      {
        end_early(error, analysis, log);
        throw;
      }
    catch (const Interrupted &stop)
      {
        end_early(stop, analysis, log);
        throw;
      }
  }

  /** What goes on from one run of the history to the next. */
  struct Progress
  {
    analysis::AdaptiveRefinement        adaptive;
    std::map<unsigned int, std::string> shown_to_slide; ///< contacts
    std::optional<pairing::NearPairs>   near_sides;
    std::unique_ptr<FolderLock>         lock; ///< there may be files on disk
    double reached = 0;                       ///< by stages of other supports
  };

  /** Contacts that slide far need all of their history so. */
  void
  note_slides(const analysis::Analysis &analysis,
              const application::Scene &scene,
              Progress                 &progress,
              Log                      &log)
  {
    for (const auto &[contact, why] : analysis.leaves_small())
      {
        log.note("contact " + scene.contact_names[contact] + ": " + why +
                 ". It takes finite sliding, and the run begins anew");
        progress.shown_to_slide.emplace(contact, why);
      }
  }

  /** Of the stages of its supports; whether it is the last one. */
  bool
  take_stage(const application::CommandLine &line,
             application::Scene             &scene,
             Progress                       &progress,
             Log                            &log)
  {
    const std::vector<double> ends = scene.stage_ends();
    const double done = scene.restart ? scene.times[scene.n_done() - 1] : 0.;
    const double from = std::max(done, progress.reached);
    const auto   end  = std::upper_bound(ends.begin(), ends.end(), from);
    if (ends.size() < 2 || end == ends.end())
      return true;
    if (line.dry_run)
      log.say("estimates are those of the first of " +
              std::to_string(ends.size()) + " stages with their own supports");
    else
      log.note("supports are the same until t = " + to_text(*end));
    const bool goes_on = progress.reached > done;
    scene.take_stage(*end, goes_on ? application::results_folder(line) : "");
    progress.reached = *end;
    return end + 1 == ends.end();
  }

  /** Whether the history is to be run again: on another mesh, or with contacts
   * that slide far. */
  bool
  run_mesh(const application::CommandLine &line, Log &log, Progress &progress)
  {
    analysis::AdaptiveRefinement &adaptive = progress.adaptive;
    application::Scene            scene(line);
    scene.shown_to_slide    = progress.shown_to_slide;
    scene.near_sides        = progress.near_sides;
    const double before     = progress.reached;
    const bool   last_stage = take_stage(line, scene, progress, log);
    if (line.print_parameters)
      {
        print(scene.documentation());
        return false;
      }
    const bool last = adaptive.n_meshes() == scene.adaptive.cycles;
    if (!last)
      scene.draw_nothing();
    ProcessSession::set_threads(scene.threads);
    if (!progress.lock)
      log.say("Conetact " CONETACT_VERSION ", scene " + line.scene.string());
    scene.build(adaptive.refinements());
    progress.near_sides = scene.near_sides;
    log.time("bodies, obstacles, contacts");
    const std::unique_ptr<analysis::Analysis> analysis =
      analysis::make_analysis(scene, log);
    log.time("contact nodes and supports");
    analysis->report();
    if (line.dry_run)
      {
        foretell(*analysis, scene, log);
        print("");
        return false;
      }

    const std::filesystem::path folder = application::results_folder(line);
    if (!progress.lock)
      check_folder(folder);
    analysis->prepare();
    if (!progress.lock)
      progress.lock = start_writing(folder, scene, log);
    run_history(*analysis, folder, line, log);
    if (!analysis->leaves_small().empty())
      {
        note_slides(*analysis, scene, progress, log);
        if (before > 0)
          throw AnalysisError(scene.why_not_anew(progress.shown_to_slide));
        progress.reached = 0;
        return true;
      }
    if (!last_stage)
      return true;
    if (scene.adaptive.cycles > 0)
      adaptive.advance(scene, analysis->last_increment(), folder, log);
    if (last)
      analysis->say_closing();
    analysis::note_work(analysis->work(), log);
    return !last;
  }

  void
  run(const application::CommandLine &line)
  {
    Log      log(line.quiet, line.dry_run);
    Progress progress;
    try
      {
        while (run_mesh(line, log, progress))
          {}
      }
    catch (const std::bad_alloc &)
      {
        const std::string why = "The scene needs more memory than there is. "
                                "Use a coarser mesh or fewer contact nodes.";
        if (progress.lock)
          throw AnalysisError(why);
        throw InputError(why);
      }
    catch (const InputError &error)
      {
        const unsigned int n_meshes = progress.adaptive.n_meshes();
        if (n_meshes == 0 && progress.shown_to_slide.empty())
          throw;
        // results of the run before are on disk
        const std::string why =
          (n_meshes == 0 ? std::string("With finite sliding: ") :
                           "Adaptive refinement, mesh " +
                             std::to_string(n_meshes + 1) + ": ") +
          error.what();
        log.note(why);
        throw AnalysisError(why);
      }
  }

  /* Sentences quote files, whatever is in them: a terminal must not obey it. */
  int
  say(std::string sentence, const int code)
  {
    std::replace_if(
      sentence.begin(),
      sentence.end(),
      [](const unsigned char c) { return c < ' ' && c != '\n'; },
      '?');
    if (ranks_of_mpirun().rank == 0) // of many processes one speaks for all
      std::cerr << "conetact: " << sentence << std::endl;
    return code;
  }

  /** What the other processes of a run do; no return if one fails. */
  int
  work_for_first()
  {
    std::string why;
    try
      {
        work();
        return 0;
      }
    catch (const std::bad_alloc &)
      {
        why = "The scene needs more memory than there is. Use a coarser mesh, "
              "or other machines.";
      }
    catch (const std::exception &error)
      {
        why = error.what();
      }
    std::cerr << "conetact: Process " << ProcessSession::rank() + 1 << " of "
              << ProcessSession::n_processes() << ": " << why << std::endl;
    ProcessSession::end_all(2);
  }

  /** Lets the other processes end, or ends them where they have been left in
   * the middle of something. */
  int
  end_work(const int code)
  {
    if (ProcessSession::n_processes() == 1)
      return code;
    std::cout << std::flush;
    if (!Together::is_possible())
      ProcessSession::end_all(code);
    Together({Command::end});
    return code;
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

  /** The exit code; only the first of many processes is here. */
  int
  run_program(int argc, char *const argv[])
  {
    application::CommandLine line;
    try
      {
        line = application::parse_command_line(argc, argv);
        if (!line.answer.empty())
          print(line.answer);
        else if (!line.compared.empty())
          return compare(line);
        else if (!line.entry_text.empty())
          print(application::entry_text(line));
        else if (!line.batch.empty())
          throw InputError("A batch is no run of another one.");
        else if (!line.new_scene.empty())
          print(application::write_starter_scene(line.new_scene));
        else if (line.print_parameters && line.scene.empty())
          print(application::manual());
        else
          {
            start_processes(line, argv);
            run(line);
          }
        return 0;
      }
    catch (const InputError &error)
      {
        return say(application::located(error.what(), line), 1);
      }
    catch (const AnalysisError &error)
      {
        return say(error.what(), 2);
      }
    catch (const Interrupted &stop)
      {
        return say(stop.what(), Interrupted::exit_code);
      }
    catch (const WriteError &error)
      {
        return say(error.what(), 3);
      }
    catch (const dealii::ExceptionBase &error)
      {
        std::ostringstream text;
        error.print_info(text);
        return say("deal.II refuses the scene: " + one_line(text.str()), 1);
      }
    catch (const std::exception &error)
      {
        return say(error.what(), 1);
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
      }
    catch (const InputError &error)
      {
        return say(error.what(), 1);
      }
    if (ProcessSession::rank() > 0)
      return work_for_first();
    return end_work(run_program(argc, argv));
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
        if (ranks_of_mpirun().size > 1)
          throw InputError("A batch is no run of several processes. Leave "
                           "mpirun out, and write --processes into its lines.");
        return application::run_batch(line, [](int argc, char *const argv[]) {
          static const ProcessSession process; // for the runs that follow, too
          return run_process(argc, argv);
        });
      }
    catch (const InputError &error)
      {
        return say(error.what(), 1);
      }
    catch (const WriteError &error)
      {
        return say(error.what(), 3);
      }
  }
} // namespace

/* Nothing is started before it is known that there will be no copies of this
   process. */
int
main(int argc, char *argv[])
{
  const application::CommandLine line = batch_of(argc, argv);
  if (!line.batch.empty())
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
