// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/option_table.h"

#include <sstream>

namespace conetact::application
{
  namespace
  {
    constexpr std::size_t help_column = 32;

    /** "  -o, --output FOLDER" */
    std::string
    called(const OptionRow &row)
    {
      std::string text = "      --";
      if (row.is_short)
        text = std::string("  -") + row.letter + ", --";
      text += row.name;
      if (row.value != OptionRow::Value::none)
        text += std::string(" ") + row.value_name;
      return text;
    }

    using Value                          = OptionRow::Value;
    const std::vector<OptionRow> options = {
      {'o',
       true,
       "output",
       Value::folder,
       "FOLDER",
       {},
       "write there (default: output/SCENE)"},
      {'s',
       true,
       "set",
       Value::entry,
       "SECTION/ENTRY=VALUE",
       {},
       "replace an entry of the scene; may be repeated"},
      {'r',
       false,
       "restart",
       Value::folder,
       "FOLDER",
       {},
       "go on from the last checkpoint in the FOLDER of\n"
       "results (Output/Checkpoint) with what the scene\n"
       "has beyond its time; loads, supports and times\n"
       "may be others"},
      {'p',
       false,
       "parameters",
       Value::none,
       "",
       {},
       "print all entries of the scene with their\n"
       "documentation; without a scene the whole manual"},
      {'n',
       false,
       "new",
       Value::free,
       "NAME",
       {},
       "write a commented scene to start from, NAME.prm"},
      {'d',
       false,
       "dry-run",
       Value::none,
       "",
       {},
       "read, check and mesh the scene; report sizes,\n"
       "memory, time and what will be skipped"},
      {'V',
       false,
       "verify",
       Value::none,
       "",
       {},
       "condense all bodies once more by an independent\n"
       "solver (Trilinos' Amesos), print by how much the\n"
       "stiffness differs, stop beyond 1e-10"},
      {'P',
       false,
       "processes",
       Value::free,
       "N",
       {},
       "share the linear algebra of large scenes among N\n"
       "processes (mpirun -n N)"},
      {'b',
       false,
       "batch",
       Value::file,
       "FILE",
       {},
       "run what each line of the FILE says, SCENE.prm\n"
       "[OPTION]..., with the quotes and # of a shell\n"
       "(> FILE and 2> FILE take what a run prints, which\n"
       "is lost else; -: lines of standard input as they\n"
       "arrive). Libraries are loaded once, and a table\n"
       "tells exit codes and what was wrong"},
      {'j',
       false,
       "jobs",
       Value::free,
       "N",
       {},
       "do N runs of a batch side by side (default: 1)"},
      {'t',
       false,
       "tolerance",
       Value::free,
       "REL",
       {},
       "by how much numbers of two runs may differ, over\n"
       "the largest of their column (default: 1e-9)"},
      {'c',
       false,
       "completion",
       Value::word,
       "WHAT",
       {"bash", "entries"},
       "print what completes command lines: a script for\n"
       "bash; entries: those of the scene with values"},
      {'g',
       false,
       "grammar",
       Value::word,
       "EDITOR",
       {"vim", "vscode"},
       "print a grammar that colours scenes: vim, vscode"},
      {'S',
       false,
       "schema",
       Value::none,
       "",
       {},
       "print a JSON schema of all entries: types,\n"
       "defaults, values that are allowed, documentation"},
      {'q', true, "quiet", Value::none, "", {}, "print errors only"},
      {'v', false, "version", Value::none, "", {}, "print the version"},
      {'h', true, "help", Value::none, "", {}, "print this text"}};
  } // namespace



  const std::vector<OptionRow> &
  option_table()
  {
    return options;
  }



  std::string
  help_on_options()
  {
    const std::string indent(help_column, ' ');
    std::string       text;
    for (const OptionRow &row : option_table())
      {
        std::string name = called(row);
        if (name.size() + 2 > help_column)
          name += '\n' + indent;
        else
          name.resize(help_column, ' ');
        std::istringstream lines(row.help);
        for (std::string line; std::getline(lines, line); name = indent)
          text += name + line + '\n';
      }
    return text;
  }
} // namespace conetact::application
