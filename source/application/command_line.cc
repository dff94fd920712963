// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/command_line.h"

#include "conetact/base/errors.h"

#include <getopt.h>

#include <charconv>

namespace conetact::application
{
  namespace
  {
    constexpr const char *help = R"(usage: conetact SCENE.prm [OPTION]...
       conetact --batch FILE [--jobs N]

Quasi-static frictional contact of linear elastic bodies with the exact
Coulomb cone.

  -o, --output FOLDER           write there (default: output/SCENE)
  -s, --set SECTION/ENTRY=VALUE
                                replace an entry of the scene; may be repeated
      --restart FOLDER          go on from the last checkpoint in the FOLDER of
                                results (Output/Checkpoint) with what the scene
                                has beyond its time; loads, supports and times
                                may be others
      --parameters              print all entries of the scene with their
                                documentation; without a scene the whole manual
      --new NAME                write a commented scene to start from, NAME.prm
      --dry-run                 read, check and mesh the scene; report sizes,
                                memory, time and what will be skipped
      --verify                  condense all bodies once more by an independent
                                solver (Trilinos' Amesos), print by how much the
                                stiffness differs, stop beyond 1e-10
      --processes N             share the linear algebra of large scenes among N
                                processes (mpirun -n N)
      --batch FILE              run what each line of the FILE says, SCENE.prm
                                [OPTION]..., with the quotes and # of a shell
                                (> FILE and 2> FILE take what a run prints, which
                                is lost else; -: lines of standard input as they
                                arrive). Libraries are loaded once, and a table
                                tells exit codes and what was wrong
      --jobs N                  do N runs of a batch side by side (default: 1)
  -q, --quiet                   print errors only
      --version                 print the version
  -h, --help                    print this text

Exit codes: 0 done; 1 wrong input, nothing was written; 2 no equilibrium or not
converged, all increments before it are on disk; 3 cannot write. A batch has the
largest one of its runs.
)";

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

    /** Whether this is a batch; what its lines say cannot stand beside it. */
    bool
    is_batch(const CommandLine &line, const bool has_scene)
    {
      if (line.batch.empty() && line.jobs > 0)
        throw InputError(std::string("--jobs is for the runs of --batch.") +
                         see_help);
      if (line.batch.empty())
        return false;
      if (has_scene || !line.folder.empty() || !line.restart.empty() ||
          !line.overrides.empty() || !line.new_scene.empty() ||
          line.print_parameters || line.dry_run || line.verify || line.quiet ||
          line.processes > 0)
        throw InputError("--batch takes scenes and their options from the "
                         "lines of its file. Write them there; only --jobs "
                         "may stand beside it.");
      return true;
    }

    const option long_options[] = {
      {"output", required_argument, nullptr, 'o'},
      {"set", required_argument, nullptr, 's'},
      {"restart", required_argument, nullptr, 'r'},
      {"new", required_argument, nullptr, 'n'},
      {"parameters", no_argument, nullptr, 'p'},
      {"dry-run", no_argument, nullptr, 'd'},
      {"processes", required_argument, nullptr, 'P'},
      {"batch", required_argument, nullptr, 'b'},
      {"jobs", required_argument, nullptr, 'j'},
      {"verify", no_argument, nullptr, 'V'},
      {"quiet", no_argument, nullptr, 'q'},
      {"version", no_argument, nullptr, 'v'},
      {"help", no_argument, nullptr, 'h'},
      {nullptr, 0, nullptr, 0}};

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
            line.answer = help;
            break;
          case ':':
            throw InputError(std::string("Option ") + argv[optind - 1] +
                             " needs a value." + see_help);
          default:
            throw InputError(std::string("Option ") + argv[optind - 1] +
                             " is not known." + see_help);
        }
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
                         ". Run them one after the other.");
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
    CommandLine line;
    opterr = optind = 0; // another line may have been parsed before
    for (int c;
         (c = getopt_long(argc, argv, ":o:s:qh", long_options, nullptr)) != -1;)
      {
        take_option(c, argv, line);
        if (!line.answer.empty())
          return line;
      }
    if (is_batch(line, optind < argc))
      return line;
    if (optind < argc || (!line.print_parameters && line.new_scene.empty()))
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
