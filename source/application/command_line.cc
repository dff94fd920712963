// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/command_line.h"

#include "conetact/application/option_table.h"
#include "conetact/base/errors.h"
#include "conetact/base/nearest.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

#include <getopt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace conetact::application
{
  namespace
  {
    constexpr const char *usage =
      R"(usage: conetact SCENE.prm [OPTION]...
       conetact --batch FILE [--jobs N]      (FILE of runs; -: standard input)
       conetact compare FOLDER FOLDER [--tolerance REL]

Quasi-static frictional contact of linear elastic bodies with the exact
Coulomb cone.

)";

    constexpr const char *exit_codes = R"(
Exit codes: 0 done; 1 wrong input, nothing was written; 2 no equilibrium or not
converged, all increments before it are on disk; 3 cannot write. A batch has the
largest one of its runs. Runs that are compared: 0 equal, 2 different. Ctrl-C
lets the increment that is running end, and a second one ends all at once: 130.
)";

    /** The word in place of a scene that compares two runs. */
    constexpr const char *compare_word = "compare";

    constexpr const char *see_help = " See conetact --help.";

    unsigned int
    number_of(const std::string &things,
              const std::string &option,
              const std::string &text)
    {
      constexpr unsigned int most = 9999;
      unsigned int           n    = 0;
      const char *const      end  = text.data() + text.size();
      const auto [rest, error]    = std::from_chars(text.data(), end, n);
      if (error != std::errc() || rest != end || n < 1 || n > most)
        throw InputError("Option " + option + ": '" + text +
                         "' is no number of " + things + ", 1 to " +
                         std::to_string(most) + "." + see_help);
      return n;
    }

    /** Whether there is an option that runs or prints something. */
    bool
    says_more(const CommandLine &line)
    {
      return !line.folder.empty() || !line.restart.empty() ||
             !line.overrides.empty() || !line.new_scene.empty() ||
             !line.entry_text.empty() || line.tolerance ||
             line.print_parameters || line.dry_run || line.verify ||
             line.quiet || line.processes > 0;
    }

    /** Whether this is a batch; what its lines say cannot stand beside it. */
    bool
    is_batch(const CommandLine &line, const bool has_scene)
    {
      if (line.batch.empty() && line.jobs > 0)
        throw InputError(std::string("--jobs is for the runs of --batch.") +
                         see_help);
      if (line.batch.empty())
        return false;
      if (has_scene || says_more(line))
        throw InputError("--batch takes scenes and their options from the "
                         "lines of its file. Write them there; only --jobs "
                         "may stand beside it.");
      return true;
    }

    /** Options as getopt wants them, with an end. */
    std::vector<option>
    long_options()
    {
      std::vector<option> options;
      for (const OptionRow &row : option_table())
        options.push_back({row.name,
                           row.value == OptionRow::Value::none ?
                             no_argument :
                             required_argument,
                           nullptr,
                           row.letter});
      options.push_back({nullptr, 0, nullptr, 0});
      return options;
    }

    std::string
    short_options()
    {
      std::string letters = ":";
      for (const OptionRow &row : option_table())
        if (row.is_short)
          letters += std::string(1, row.letter) +
                     (row.value == OptionRow::Value::none ? "" : ":");
      return letters;
    }

    /** As help calls it. */
    std::string
    value_name(const int letter)
    {
      for (const OptionRow &row : option_table())
        if (row.letter == letter)
          return row.value_name;
      return "";
    }

    /** One of those that the table has for the option. */
    std::string
    word_of(const char letter, const std::string &value)
    {
      const auto row = std::find_if(option_table().begin(),
                                    option_table().end(),
                                    [letter](const OptionRow &r) {
                                      return r.letter == letter;
                                    });
      if (std::find(row->words.begin(), row->words.end(), value) ==
          row->words.end())
        throw InputError(std::string("Option --") + row->name + ": '" + value +
                         "' is not possible. Give one of: " + join(row->words) +
                         ".");
      return value;
    }

    double
    tolerance_of(const std::string &text)
    {
      const std::optional<double> tolerance = fortran_number(text);
      if (!tolerance || !std::isfinite(*tolerance))
        throw InputError("Option --tolerance: '" + text +
                         "' is not a number. Give 0 or more, as 1e-9.");
      if (*tolerance < 0)
        throw InputError("Option --tolerance: " + text +
                         " is negative. Give 0 or more, as 1e-9.");
      return *tolerance;
    }

    std::string
    not_empty(const char *const value, const std::string &what)
    {
      if (*value == 0)
        throw InputError(what + " is empty.");
      return value;
    }

    /** What an option says. Throws InputError. */
    void
    take_option(const int c, char *const argv[], CommandLine &line)
    {
      switch (c)
        {
          case 'o':
            line.folder = not_empty(optarg, "Option -o: the folder's name");
            break;
          case 'r':
            line.restart =
              not_empty(optarg, "Option --restart: the folder's name");
            break;
          case 'n':
            line.new_scene =
              not_empty(optarg, "Option --new: the scene's name");
            break;
          case 's':
            line.overrides.emplace_back(optarg);
            break;
          case 'p':
            line.print_parameters = true;
            break;
          case 'd':
            line.dry_run = true;
            break;
          case 'P':
            line.processes = number_of("processes", "--processes", optarg);
            break;
          case 'b':
            line.batch = not_empty(optarg, "Option --batch: the file's name");
            break;
          case 'j':
            line.jobs = number_of("runs", "--jobs", optarg);
            break;
          case 't':
            line.tolerance = tolerance_of(optarg);
            break;
          case 'c':
          case 'g':
            line.entry_text = word_of(static_cast<char>(c), optarg);
            break;
          case 'S':
            line.entry_text = "schema";
            break;
          case 'V':
            line.verify = true;
            break;
          case 'q':
            line.quiet = true;
            break;
          case 'v':
            line.answer = "conetact " CONETACT_VERSION "\n";
            break;
          case 'h':
            line.answer = usage + help_on_options() + exit_codes;
            break;
          case ':':
            throw InputError(std::string("Option ") + argv[optind - 1] +
                             " needs a value, " + value_name(optopt) + "." +
                             see_help);
          default:
            throw InputError(std::string("Option ") + argv[optind - 1] +
                             " is not known." + see_help);
        }
    }

    /** What is said beside the folders of two runs that are compared. */
    void
    take_folders(const int argc, char *const argv[], CommandLine &line)
    {
      if (argc - optind != 3)
        throw InputError(std::string("compare takes two folders of results") +
                         (argc - optind < 3 ? ", and there are fewer." :
                                              ", and there are more.") +
                         see_help);
      CommandLine others = line; // which may stand beside it
      others.quiet       = false;
      others.tolerance.reset();
      if (says_more(others))
        throw InputError(std::string("compare runs no scene. Only --tolerance "
                                     "and --quiet may stand beside it.") +
                         see_help);
      line.compared = {argv[optind + 1], argv[optind + 2]};
    }

    /** Texts of all entries have no scene, those of a scene have one. */
    void
    check_entry_text(const CommandLine &line, const bool has_scene)
    {
      const bool wants_scene = line.entry_text == "entries";
      if (wants_scene && !has_scene)
        throw InputError(std::string("Option --completion entries: it needs "
                                     "the scene whose entries are asked for.") +
                         see_help);
      if (!line.entry_text.empty() && !wants_scene && has_scene)
        throw InputError("Option --" +
                         (line.entry_text == "schema" ? "schema" :
                          line.entry_text == "bash"   ? "completion" :
                                                        std::string("grammar")) +
                         ": it is the same for all scenes. Leave the scene "
                         "out.");
    }

    /** The one scene that is left on the line. Throws InputError. */
    void
    take_scene(const int argc, char *const argv[], CommandLine &line)
    {
      if (!line.new_scene.empty())
        throw InputError(
          std::string("--new writes a scene of its own. Leave ") +
          argv[optind] + " out.");
      if (optind >= argc)
        throw InputError(std::string("No scene file is given.") + see_help);
      if (optind + 1 < argc)
        throw InputError(std::string("More than one scene file is given: ") +
                         argv[optind] + " and " + argv[optind + 1] +
                         ". Run them one after the other." +
                         (std::filesystem::exists(argv[optind]) ?
                            "" :
                            did_you_mean(argv[optind], {compare_word})));
      if (line.dry_run && line.verify)
        throw InputError("--verify condenses bodies, which --dry-run does not. "
                         "Leave one of them out.");
      line.scene = argv[optind];
      if (line.scene.empty())
        throw InputError(std::string("The scene file's name is empty.") +
                         see_help);
    }
  } // namespace

  CommandLine
  parse_command_line(const int argc, char *const argv[])
  {
    CommandLine               line;
    const std::vector<option> options = long_options();
    const std::string         letters = short_options();
    opterr = optind = 0; // another line may have been parsed before
    for (int c;
         (c = getopt_long(
            argc, argv, letters.c_str(), options.data(), nullptr)) != -1;)
      {
        take_option(c, argv, line);
        if (!line.answer.empty())
          return line;
      }
    if (is_batch(line, optind < argc))
      return line;
    if (optind < argc && argv[optind] == std::string(compare_word))
      {
        take_folders(argc, argv, line);
        return line;
      }
    if (line.tolerance)
      throw InputError(std::string("--tolerance is for runs that are compared, "
                                   "conetact compare FOLDER FOLDER.") +
                       see_help);
    check_entry_text(line, optind < argc);
    if (optind < argc || (!line.print_parameters && line.new_scene.empty() &&
                          line.entry_text.empty()))
      take_scene(argc, argv, line);
    return line;
  }



  std::filesystem::path
  results_folder(const CommandLine &line)
  {
    if (!line.folder.empty())
      return line.folder;
    const std::string name = line.scene.stem().string();
    if (name == "." || name == "..")
      throw InputError("The name of " + line.scene.string() +
                       " makes no folder for results. Name one with -o.");
    return std::filesystem::path("output") / name;
  }
} // namespace conetact::application
