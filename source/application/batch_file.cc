// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/batch_file.h"

#include "conetact/application/command_line.h"
#include "conetact/base/errors.h"

#include <filesystem>
#include <fstream>
#include <map>

namespace conetact::application
{
  namespace
  {
    constexpr char blanks[] = " \t\r";

    struct BatchWord
    {
      std::string text;
      std::size_t plain = 0; ///< letters before the first quote
    };

    /** What stands in quotes from `at` on, which is behind them afterwards. */
    std::string
    quoted(const std::string &line, std::size_t &at)
    {
      const char  quote = line[at++];
      std::string text;
      for (; at < line.size() && line[at] != quote; ++at)
        {
          const bool escapes = quote == '"' && line[at] == '\\' &&
                               at + 1 < line.size() &&
                               (line[at + 1] == '"' || line[at + 1] == '\\');
          text += line[escapes ? ++at : at];
        }
      if (at++ >= line.size())
        throw InputError(std::string("The quotation mark ") + quote +
                         " has no partner.");
      return text;
    }

    BatchWord
    take_word(const std::string &line, std::size_t &at)
    {
      BatchWord word;
      bool      is_plain = true;
      while (at < line.size() &&
             std::string(blanks).find(line[at]) == std::string::npos)
        {
          const char letter = line[at];
          if (letter == '\'' || letter == '"')
            word.text += quoted(line, at);
          else if (letter == '\\' && at + 1 < line.size())
            word.text += line[at + 1], at += 2;
          else
            word.text += line[at++];
          is_plain =
            is_plain && letter != '\'' && letter != '"' && letter != '\\';
          if (is_plain)
            word.plain = word.text.size();
        }
      return word;
    }

    std::vector<BatchWord>
    words_of(const std::string &line)
    {
      std::vector<BatchWord> words;
      for (std::size_t at = line.find_first_not_of(blanks);
           at != std::string::npos && line[at] != '#';
           at = line.find_first_not_of(blanks, at))
        words.push_back(take_word(line, at));
      return words;
    }

    /** Length of the mark of a redirection that a word begins with, or 0. */
    std::size_t
    redirection(const BatchWord &word, const std::string &mark)
    {
      return word.plain >= mark.size() &&
                 word.text.compare(0, mark.size(), mark) == 0 ?
               mark.size() :
               0;
    }

    /** Words of the run stay, files of what it prints are set apart. */
    BatchRun
    run_of_words(const std::vector<BatchWord> &words)
    {
      BatchRun run;
      for (auto word = words.begin(); word != words.end(); ++word)
        {
          const std::size_t to_err = redirection(*word, "2>"),
                            mark   = to_err + redirection(*word, ">");
          if (mark == 0)
            {
              run.words.push_back(word->text);
              continue;
            }
          const std::string glued = word->text.substr(mark);
          if (glued.empty() && ++word == words.end())
            throw InputError("There is no file behind the last >.");
          (to_err > 0 ? run.err : run.out) = glued.empty() ? word->text : glued;
        }
      return run;
    }

    [[noreturn]] void
    refuse_all(const std::vector<std::string> &faults)
    {
      std::string text;
      for (const std::string &fault : faults)
        text += (text.empty() ? "" : "\n") + fault;
      throw InputError(text);
    }

    /** Runs that write over the results of another one. */
    void
    find_shared_folders(const std::vector<BatchRun> &runs,
                        std::vector<std::string>    &faults)
    {
      std::map<std::filesystem::path, unsigned int> owners;
      for (const BatchRun &run : runs)
        {
          if (!run.writes)
            continue;
          const auto folder =
            std::filesystem::absolute(run.name).lexically_normal();
          const auto [owner, is_new] = owners.emplace(folder, run.number);
          if (!is_new)
            faults.push_back("Line " + std::to_string(run.number) +
                             ": Its results would replace those of line " +
                             std::to_string(owner->second) + " in " + run.name +
                             ". Give each run a folder of its own with -o.");
        }
    }
  } // namespace



  std::optional<BatchRun>
  parse_batch_line(const std::string &text, const unsigned int number)
  {
    const std::vector<BatchWord> words = words_of(text);
    if (words.empty())
      return {};
    BatchRun run = run_of_words(words);
    run.number   = number;
    run.name     = run.words.empty() ? "-" : run.words.front();
    return run;
  }



  void
  check_batch_run(BatchRun &run)
  {
    std::string         program = "conetact";
    std::vector<char *> argv    = {program.data()};
    for (std::string &word : run.words)
      argv.push_back(word.data());
    argv.push_back(nullptr);
    std::error_code   ignored;
    const CommandLine line =
      parse_command_line(static_cast<int>(argv.size()) - 1, argv.data());
    if (line.scene.empty() || line.print_parameters || !line.entry_text.empty())
      throw InputError("A line of a batch runs a scene. Leave --batch, "
                       "--parameters, --new, --version and --help out.");
    run.writes = !line.dry_run;
    run.alone  = line.dry_run || line.processes > 0 ||
                !std::filesystem::is_regular_file(line.scene, ignored);
    run.name = (run.writes ? results_folder(line) : line.scene).string();
  }



  std::vector<BatchRun>
  read_batch_file(const std::string &file)
  {
    std::ifstream            stream(file);
    std::vector<BatchRun>    runs;
    std::vector<std::string> faults;
    unsigned int             number = 0;
    for (std::string text; std::getline(stream, text);)
      try
        {
          ++number;
          if (auto run = parse_batch_line(text, number))
            {
              check_batch_run(*run);
              runs.push_back(*run);
            }
        }
      catch (const InputError &error)
        {
          faults.push_back("Line " + std::to_string(number) + ": " +
                           error.what());
        }
    if (!stream.eof())
      throw InputError("Option --batch: " + file + " cannot be read.");
    find_shared_folders(runs, faults);
    if (runs.empty() && faults.empty())
      faults.push_back("No line holds a run.");
    for (std::string &fault : faults)
      fault.insert(0, file + ": ");
    if (!faults.empty())
      refuse_all(faults);
    return runs;
  }
} // namespace conetact::application
