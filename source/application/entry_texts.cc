// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/entry_texts.h"

#include "conetact/application/entry_list.h"
#include "conetact/application/scene.h"
#include "conetact/base/text.h"

#include <algorithm>

namespace conetact::application
{
  namespace
  {
    /** "Solver/Method=automatic": what -s may say of each entry, first what
     * the scene has. */
    std::string
    entries_of_scene(const CommandLine &line)
    {
      std::string text;
      for (const EntryDescription &entry :
           list_entries(Scene(line).entries.prm))
        {
          const std::string path = join(entry.path, "/") +
                                   (entry.path.empty() ? "" : "/") +
                                   entry.name + '=';
          text += path + one_line(entry.value) + '\n';
          std::vector<std::string> words = entry.kind.words;
          if (entry.kind.type == ValueKind::Type::boolean)
            words = {"false", "true"};
          for (const std::string &word : words)
            if (word != entry.value)
              text += path + word + '\n';
        }
      return text;
    }

    struct TextRow
    {
      const char *name;
      std::string (*make)(const CommandLine &line);
    };

    const TextRow entry_text_rows[] = {
      {"bash", [](const CommandLine &) { return bash_completion(); }},
      {"entries", entries_of_scene},
      {"vim", [](const CommandLine &) { return vim_syntax(); }},
      {"vscode", [](const CommandLine &) { return textmate_grammar(); }},
      {"schema", [](const CommandLine &) { return json_schema(); }}};
  } // namespace



  std::string
  entry_text(const CommandLine &line)
  {
    const auto *const row =
      std::find_if(std::begin(entry_text_rows),
                   std::end(entry_text_rows),
                   [&](const TextRow &r) { return r.name == line.entry_text; });
    return row->make(line);
  }
} // namespace conetact::application
