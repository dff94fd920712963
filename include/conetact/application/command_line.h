// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_command_line_h
#define conetact_application_command_line_h

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace conetact::application
{
  /** What the user typed. */
  struct CommandLine
  {
    std::filesystem::path    scene;
    std::filesystem::path    folder;    ///< of results; empty: the default
    std::filesystem::path    restart;   ///< folder of the run to be continued
    std::vector<std::string> overrides; ///< "Section/Entry=value"
    bool                     print_parameters = false;
    bool                     dry_run          = false;
    bool                     quiet            = false;
    bool                     verify           = false;
    unsigned int             processes        = 0; ///< 0: not said
    std::filesystem::path    batch; ///< file of its lines, "-": standard input
    unsigned int             jobs = 0;  ///< runs of it at a time, 0: not said
    std::string              new_scene; ///< name of a scene to be written
    std::vector<std::filesystem::path> compared;  ///< folders of two runs
    std::optional<double>              tolerance; ///< of these
    std::string entry_text; ///< to be printed: bash, vim, schema, ...
    /** Text to print instead of doing anything: help, version. */
    std::string answer;
  };

  /** Throws InputError. */
  CommandLine
  parse_command_line(const int argc, char *const argv[]);

  /** The one that is named, or the one of the scene's name. Throws InputError
   * if that is no name of a folder. */
  std::filesystem::path
  results_folder(const CommandLine &line);
} // namespace conetact::application

#endif
