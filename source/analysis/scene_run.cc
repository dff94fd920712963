// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/scene_run.h"

#include "conetact/analysis/adaptive_refinement.h"
#include "conetact/analysis/cost.h"
#include "conetact/analysis/increment_analysis.h"
#include "conetact/analysis/path_analysis.h"
#include "conetact/analysis/scene_report.h"
#include "conetact/application/scene.h"
#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/base/folder_lock.h"
#include "conetact/base/interruption.h"
#include "conetact/base/log.h"
#include "conetact/base/process.h"
#include "conetact/base/results_folder.h"
#include "conetact/base/team.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <map>
#include <memory>
#include <new>
#include <optional>

namespace conetact::analysis
{
  namespace
  {
    /** The contacts of `Contacts = automatic`, to be included or pasted. */
    const char *const automatic_file = "contacts.prm";

    /** To a folder that exists from now on and is this run's as long as the
     * lock lives. */
    std::unique_ptr<FolderLock>
    start_writing(const std::filesystem::path &folder,
                  const application::Scene    &scene,
                  Log                         &log)
    {
      make_folder(folder);
      std::error_code none;
      const bool      goes_on =
        scene.restart &&
        std::filesystem::equivalent(scene.restart->folder, folder, none);
      auto lock = std::make_unique<FolderLock>(folder);
      log.open(folder, goes_on);
      // of an earlier run, which this one may not replace
      for (const char *table : {"events.csv", "refinement.csv"})
        remove_file(folder / table);
      if (!goes_on)
        remove_file(folder / "checkpoint.bin");
      write_atomically(folder / "used.prm", scene.entries.values());
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
    foretell(Analysis &analysis, const application::Scene &scene, Log &log)
    {
      analysis.check_history();
      report_boundaries(scene.bodies, log);
      analysis.estimate();
      if (scene.adaptive.cycles > 0)
        log.say("estimates are those of the first of " +
                std::to_string(scene.adaptive.cycles + 1) + " meshes");
      log.note(describe(analysis.work()));
    }

    /** There may be room for a line in the log though not for a picture. */
    void
    note_if_possible(const WriteError &error, Log &log)
    {
      try
        {
          log.note(error.what());
        }
      catch (const WriteError &) // then there is no room at all
        {}
    }

    /** What is said of a run that ends before its time. */
    void
    end_early(const std::exception &why, const Analysis &analysis, Log &log)
    {
      log.note(why.what());
      if (analysis.has_results())
        analysis.say_closing();
      note_work(analysis.work(), {}, log);
    }

    /** Runs the history on the mesh at hand. The first process is asked to
     * stop, and asks the others. */
    void
    run_history(Analysis                       &analysis,
                const std::filesystem::path    &folder,
                const application::CommandLine &line,
                Log                            &log)
    {
      try
        {
          if (line.verify)
            analysis.verify();
          std::optional<Interruption> interruption;
          if (ProcessSession::speaks())
            interruption.emplace(ProcessSession::n_processes() == 1);
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
      AdaptiveRefinement                  adaptive;
      std::map<unsigned int, std::string> shown_to_slide; ///< contacts
      std::optional<pairing::NearPairs>   near_sides;
      std::unique_ptr<FolderLock>         lock; ///< there may be files on disk
      double reached     = 0;                   ///< by stages of other supports
      bool   has_results = false; ///< increments of it are on disk
    };

    /** Contacts that slide far need all of their history so. */
    void
    note_slides(const Analysis           &analysis,
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
      const std::vector<double> ends = scene.stages.ends(scene.times);
      const double done = scene.restart ? scene.times[scene.n_done() - 1] : 0.;
      const double from = std::max(done, progress.reached);
      const auto   end  = std::upper_bound(ends.begin(), ends.end(), from);
      if (ends.size() < 2 || end == ends.end())
        return true;
      if (line.dry_run)
        log.say("estimates are those of the first of " +
                std::to_string(ends.size()) +
                " stages with their own supports");
      else
        log.note("supports are the same until t = " + to_text(*end));
      const bool goes_on = progress.reached > done;
      scene.take_stage(*end, goes_on ? application::results_folder(line) : "");
      progress.reached = *end;
      return end + 1 == ends.end();
    }

    /** A scene as its mesh says, and what solves it. */
    struct Built
    {
      std::unique_ptr<application::Scene> scene;
      std::unique_ptr<Analysis>           analysis;
      bool                                last_stage = true, last_mesh = true;
    };

    Built
    build(const application::CommandLine &line, Log &log, Progress &progress)
    {
      Built built;
      built.scene               = std::make_unique<application::Scene>(line);
      application::Scene &scene = *built.scene;
      scene.shown_to_slide      = progress.shown_to_slide;
      scene.near_sides          = progress.near_sides;
      built.last_stage          = take_stage(line, scene, progress, log);
      if (line.print_parameters)
        return built;
      const AdaptiveRefinement &adaptive = progress.adaptive;
      built.last_mesh = adaptive.n_meshes() == scene.adaptive.cycles;
      if (!built.last_mesh)
        scene.draw_nothing();
      ProcessSession::set_threads(scene.threads);
      if (!progress.lock)
        log.say("Conetact " CONETACT_VERSION ", scene " + line.scene.string());
      try
        {
          scene.build(adaptive.refinements());
          progress.near_sides = scene.near_sides;
          log.time("bodies, obstacles, contacts");
          if (scene.path.follows)
            built.analysis = std::make_unique<PathAnalysis>(scene, log);
          else
            built.analysis = std::make_unique<IncrementAnalysis>(scene, log);
        }
      catch (const InputError &) // often for want of what this lists
        {
          if (line.dry_run)
            report_meshes(scene.bodies, log);
          throw;
        }
      give_back_memory();
      log.time("contact nodes and supports");
      built.analysis->report();
      if (line.dry_run)
        foretell(*built.analysis, scene, log);
      else if (!progress.lock)
        check_folder(application::results_folder(line));
      return built;
    }

    /** Runs the history of what was built. Returns whether it is to be run
     * again: on another mesh, with contacts that slide far, with other
     * supports. */
    bool
    run_built(const Built                    &built,
              const application::CommandLine &line,
              Log                            &log,
              Progress                       &progress)
    {
      const application::Scene   &scene    = *built.scene;
      Analysis                   &analysis = *built.analysis;
      const std::filesystem::path folder   = application::results_folder(line);
      analysis.prepare();
      agree([&] {
        if (!progress.lock)
          progress.lock = start_writing(folder, scene, log);
      });
      try
        {
          run_history(analysis, folder, line, log);
        }
      catch (const InputError &) // of an expression at a later time
        {
          progress.has_results |= analysis.has_results();
          throw;
        }
      progress.has_results = true;
      if (!is_in_team())
        return true; // the first process knows
      if (!analysis.leaves_small().empty())
        {
          note_slides(analysis, scene, progress, log);
          agree([&] { remove_file(folder / "checkpoint.bin"); });
          progress.reached = 0;
          return true;
        }
      if (!built.last_stage)
        return true;
      agree([&] {
        if (scene.adaptive.cycles > 0)
          progress.adaptive.advance(scene,
                                    analysis.last_increment(),
                                    folder,
                                    log);
      });
      if (built.last_mesh)
        analysis.say_closing();
      return !built.last_mesh;
    }

    void
    broadcast(std::map<unsigned int, std::string> &sentences)
    {
      std::vector<unsigned int> numbers;
      std::vector<char>         letters; // each sentence ends with a zero
      for (const auto &[number, sentence] : sentences)
        {
          numbers.push_back(number);
          letters.insert(letters.end(),
                         sentence.c_str(),
                         sentence.c_str() + sentence.size() + 1);
        }
      team().broadcast(numbers);
      team().broadcast(letters);
      sentences.clear();
      const char *next = letters.data();
      for (const unsigned int number : numbers)
        next += sentences.emplace(number, next).first->second.size() + 1;
    }

    /** All processes come here when a history has been run, and know then what
     * the first one knows. Returns whether there is another one. */
    bool
    join_first(const Built &built,
               bool         is_run_again,
               Progress    &progress,
               Log         &log)
    {
      const std::vector<int> codes = meet(goes_on);
      for (const int code : codes)
        if (code != goes_on)
          throw EndedByOther(code);
      form_team(static_cast<int>(ProcessSession::n_processes()));
      const std::vector<Needs> needs =
        needs_of_processes(built.analysis->work().elements);
      if (built.last_stage && built.analysis->leaves_small().empty())
        note_work(built.analysis->work(), needs, log);
      std::vector<double> numbers = {is_run_again ? 1. : 0.,
                                     progress.reached,
                                     progress.has_results ? 1. : 0.};
      team().broadcast(numbers);
      progress.reached     = numbers[1];
      progress.has_results = numbers[2] > 0;
      broadcast(progress.shown_to_slide);
      progress.adaptive.share();
      return numbers[0] > 0;
    }

    /** Whether the history is to be run again. */
    bool
    run_mesh(const application::CommandLine &line, Log &log, Progress &progress)
    {
      Built built;
      agree([&] { built = build(line, log, progress); });
      if (line.print_parameters)
        print(built.scene->entries.documentation());
      if (line.print_parameters || line.dry_run)
        {
          print("");
          return false;
        }
      form_team(built.analysis->useful_processes());
      const bool again = is_in_team() && run_built(built, line, log, progress);
      return join_first(built, again, progress, log);
    }
  } // namespace

  void
  run_scene(const application::CommandLine &line)
  {
    Log      log(line.quiet, line.dry_run);
    Progress progress;
    try
      {
        while (run_mesh(line, log, progress))
          {}
      }
    catch (const WriteError &error)
      {
        note_if_possible(error, log);
        throw;
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
        const bool         anew     = !progress.shown_to_slide.empty();
        if (n_meshes == 0 && !anew && !progress.has_results)
          throw;
        // what was found before is on disk
        const std::string place =
          n_meshes > 0 ?
            "Adaptive refinement, mesh " + std::to_string(n_meshes + 1) + ": " :
          anew ? "With finite sliding: " :
                 "";
        const std::string why = place + error.what();
        log.note(why);
        throw AnalysisError(why);
      }
  }
} // namespace conetact::analysis
