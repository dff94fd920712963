// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/restart.h"

#include "conetact/application/scene_text.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>

namespace conetact::application
{
  namespace
  {
    /** Entries of obstacles that are loads: the way they move. */
    bool
    is_motion(const std::string &entry)
    {
      static const std::set<std::string> motions = {"Displacement",
                                                    "Turn",
                                                    "Force",
                                                    "Moment"};
      return motions.count(entry) > 0;
    }

    /** What makes a state: bodies, what they touch and how. */
    bool
    must_stay(const std::string &path)
    {
      const auto begins = [&](const std::string &start) {
        return path.rfind(start, 0) == 0;
      };
      if (begins("Obstacle "))
        return !is_motion(path.substr(path.find('/') + 1));
      return begins("Body ") || begins("Contact ") ||
             begins("Automatic contact/") || path == "Dimension" ||
             path == "Bodies" || path == "Obstacles" || path == "Contacts";
    }

    std::string
    value_in(const Entries &entries, const std::string &path)
    {
      const auto found = entries.find(path);
      return found == entries.end() ? "" : found->second;
    }

    /** The text with each number as 2000, however it is written (2e3, 2000.0),
     * and one blank behind each word, number and sign. */
    std::string
    in_one_spelling(const std::string &text)
    {
      static const std::regex word(
        R"([A-Za-z_]\w*|((\d+\.?\d*|\.\d+)([eE][+-]?\d+)?)|\S)");
      std::ostringstream words;
      words.precision(17);
      for (std::sregex_iterator at(text.begin(), text.end(), word), end;
           at != end;
           ++at)
        if ((*at)[1].matched)
          words << std::strtod(at->str().c_str(), nullptr) << ' ';
        else
          words << at->str() << ' ';
      return words.str();
    }

    bool
    is_same(const std::string &entry, const Entries &then, const Entries &now)
    {
      const std::string before = value_in(then, entry),
                        after  = value_in(now, entry);
      const bool is_name       = entry.substr(entry.rfind('/') + 1) == "File";
      return before == after ||
             (!is_name && in_one_spelling(before) == in_one_spelling(after));
    }

    /** Of loads that are rigid: what makes their couplings. */
    bool
    must_stay(const std::string &path, const Entries &then, const Entries &now)
    {
      const auto        slash    = path.find('/');
      const std::string load     = path.substr(0, slash);
      const auto        is_rigid = [&](const Entries &entries) {
        return value_in(entries, load + "/Coupling") == "rigid";
      };
      return path.rfind("Load ", 0) == 0 && slash != path.npos &&
             std::set<std::string>{"/Coupling",
                                   "/Body",
                                   "/Boundary ids",
                                   "/Point"}
                 .count(path.substr(slash)) > 0 &&
             (is_rigid(then) || is_rigid(now));
    }

    /** Times of increments that are done: one at least, each behind the one
     * before. */
    void
    refuse_disorder(const std::vector<double>   &times,
                    const std::filesystem::path &file)
    {
      double before = 0;
      bool   grow   = !times.empty();
      for (const double t : times)
        {
          grow   = grow && t > before;
          before = t;
        }
      if (!grow)
        throw InputError("The checkpoint " + file.string() +
                         " is damaged: its times do not grow from 0. Run the "
                         "scene from its start.");
    }

    constexpr const char *what_may_differ =
      " Supports, loads, motions of obstacles, times, solver and output may "
      "differ from the run that is continued, nothing else.";

    void
    refuse_changes(const Restart &run, const std::string &values)
    {
      const Entries then = entries_of(run.state.get_text("scene"));
      const Entries now  = entries_of(values);
      Entries       both = then;
      both.insert(now.begin(), now.end());
      for (const auto &[entry, value] : both)
        if ((must_stay(entry) || must_stay(entry, then, now)) &&
            !is_same(entry, then, now))
          throw InputError(
            "Option --restart: " + entry + " was '" + value_in(then, entry) +
            "' in " + run.folder.string() + " and is '" + value_in(now, entry) +
            "' here." + what_may_differ +
            (must_stay(entry) ? "" :
                                " Of a load with Coupling = rigid "
                                "these are its Kind, its Value "
                                "and when it is Active."));
      for (const auto &[entry, value] : then)
        if (entry.rfind("Support ", 0) == 0 && !value.empty() &&
            entry.substr(entry.find('/')) == "/Stiffness" &&
            !is_same(entry, then, now))
          throw InputError(
            "Option --restart: " + entry + " was '" + value + "' in " +
            run.folder.string() +
            ". Springs hold energy of the run that is continued: "
            "keep that support as it was.");
    }
  } // namespace



  void
  refuse_checkpoints(const RunSettings &settings)
  {
    if (settings.checkpoint_every == 0)
      return;
    if (settings.path.follows)
      throw InputError("Output, Checkpoint: a load path cannot be continued, "
                       "for its follower keeps more than a state. Set it to 0, "
                       "or choose another Solver/Method.");
    if (settings.follows_branches)
      throw InputError("Output, Checkpoint: Solver/Method = all solutions "
                       "keeps more than one state. Set it to 0, or choose "
                       "another Solver/Method.");
    if (settings.adaptive.cycles > 0)
      throw InputError("Output, Checkpoint: a scene with Adaptive refinement "
                       "runs its history on several meshes and cannot be "
                       "continued. Set one of them to 0.");
  }



  Restart
  continue_from(const std::filesystem::path &folder,
                const std::string           &values,
                RunSettings                 &settings)
  {
    const std::filesystem::path kept = folder / "checkpoint.bin";
    if (settings.path.follows)
      throw InputError("Option --restart: a load path cannot be continued. "
                       "Run the scene from its start.");
    if (settings.adaptive.cycles > 0)
      throw InputError("Option --restart: a scene with Adaptive refinement "
                       "cannot be continued. Run it from its start.");
    std::error_code no_path;
    if (!std::filesystem::is_regular_file(kept, no_path))
      throw InputError("Option --restart: there is no checkpoint.bin in " +
                       folder.string() +
                       ". Give the folder of results of a run with "
                       "Output/Checkpoint = 1 or more.");
    Restart run{folder, Archive::read(kept)};
    refuse_changes(run, values);
    std::vector<double> all = run.state.get("times");
    refuse_disorder(all, kept);
    run.n_done           = static_cast<unsigned int>(all.size());
    const double reached = all.back();
    for (const double t : settings.times)
      if (t > reached * (1 + 1e-12))
        all.push_back(t);
    if (all.size() == run.n_done)
      throw InputError("Time: the run in " + folder.string() +
                       " has reached t = " + to_text(reached) +
                       ", and the scene has no increment after that. Choose a "
                       "larger End and more Increments, or Times beyond.");
    settings.times = std::move(all);
    return run;
  }
} // namespace conetact::application
