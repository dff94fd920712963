// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/entry_list.h"
#include "conetact/application/entry_texts.h"
#include "conetact/application/json_text.h"
#include "conetact/base/text.h"

#include <set>

namespace conetact::application
{
  namespace
  {
    /** What a scene file may say, whatever its sections. */
    struct Vocabulary
    {
      std::set<std::string> entries;
      std::set<std::string> sections; ///< without names: "Solver"
      std::set<std::string> kinds;    ///< that names stand behind: "Body"
      std::set<std::string> words;    ///< values: "half space"
    };

    Vocabulary
    vocabulary()
    {
      dealii::ParameterHandler prm;
      declare_any_scene(prm);
      const std::string name = std::string(" ") + any_name;
      Vocabulary        all;
      for (const EntryDescription &entry : list_entries(prm))
        {
          all.entries.insert(entry.name);
          for (const std::string &word : entry.kind.words)
            if (word.find_first_not_of("0123456789") != word.npos)
              all.words.insert(word);
          for (const std::string &section : entry.path)
            if (const auto at = section.find(name); at != section.npos)
              all.kinds.insert(section.substr(0, at));
            else
              all.sections.insert(section);
        }
      return all;
    }

    /** "b|a", each before what begins it; blanks may be any white space. */
    std::string
    any_of(const std::set<std::string> &names,
           const std::string           &separator,
           const std::string           &blanks)
    {
      std::string text;
      for (auto name = names.rbegin(); name != names.rend(); ++name)
        {
          text += text.empty() ? "" : separator;
          for (const char letter : *name)
            text += letter == ' ' ? blanks : std::string(1, letter);
        }
      return text;
    }

    constexpr const char *vim_head =
      R"(" Vim syntax file: scenes of Conetact (*.prm). Made by: conetact --grammar vim
if exists("b:current_syntax")
  finish
endif
syn case match
syn match conetactError "\S.*" contained
syn match conetactComment "#.*$" contains=@Spell
syn match conetactInclude "^\s*include\>" nextgroup=conetactFile skipwhite
syn match conetactFile "[^#]*" contained
syn match conetactEnd "^\s*end\>\ze\s*\%(#.*\)\?$"
syn match conetactSubsection "^\s*subsection\>" nextgroup=conetactError,conetactSection,conetactKind skipwhite
syn match conetactName "[^# \t][^#]*" contained
syn match conetactSet "^\s*set\>" nextgroup=conetactError,conetactUnknown,conetactEntry skipwhite
syn match conetactUnknown "[^=# \t][^=#]*" contained nextgroup=conetactEquals
syn match conetactEquals "=" contained nextgroup=conetactValue skipwhite
syn region conetactValue start="[^# \t]" skip="\\\s*$" end="$" end="\ze#" contained keepend contains=conetactNumber,conetactWord,conetactComment,conetactGoesOn
syn match conetactNumber "\<\d\+\.\?\d*\%([eE][-+]\?\d\+\)\?\>\|\.\d\+\%([eE][-+]\?\d\+\)\?\>" contained
syn match conetactGoesOn "\\\ze\s*\%(#.*\)\?$" contained
)";

    constexpr const char *vim_links = R"(
hi def link conetactComment Comment
hi def link conetactInclude PreProc
hi def link conetactFile String
hi def link conetactSubsection Keyword
hi def link conetactEnd Keyword
hi def link conetactSet Keyword
hi def link conetactSection Type
hi def link conetactKind Type
hi def link conetactName Identifier
hi def link conetactEntry Statement
hi def link conetactUnknown Error
hi def link conetactError Error
hi def link conetactEquals Operator
hi def link conetactNumber Number
hi def link conetactWord Constant
hi def link conetactGoesOn Special
let b:current_syntax = "conetact"
)";

    /** A rule of TextMate that gives one expression one colour. */
    std::string
    coloured(const std::string &expression, const std::string &colour)
    {
      return "{\"match\": " + json_string(expression) +
             ", \"name\": " + json_string(colour + ".conetact") + "}";
    }

    /** Colours of the groups of an expression, from 1 on. */
    std::string
    captures(const std::vector<std::string> &colours)
    {
      std::vector<std::string> parts;
      for (std::size_t i = 0; i < colours.size(); ++i)
        parts.push_back("\"" + std::to_string(i + 1) + "\": {\"name\": " +
                        json_string(colours[i] + ".conetact") + "}");
      return "{" + join(parts) + "}";
    }
  } // namespace



  /* Of what begins at the same letter vim takes the rule that stands last. */
  std::string
  vim_syntax()
  {
    const Vocabulary  all   = vocabulary();
    const std::string blank = R"(\s\+)";
    const auto        match = [&](const std::string           &group,
                           const std::set<std::string> &names,
                           const std::string           &behind) {
      return "syn match " + group + " \"\\%(" + any_of(names, "\\|", blank) +
             "\\)" + behind + "\n";
    };
    return vim_head +
           match("conetactEntry",
                 all.entries,
                 R"(\ze\s*=" contained nextgroup=conetactEquals skipwhite)") +
           match("conetactSection",
                 all.sections,
                 R"(\ze\s*\%(#.*\)\?$" contained)") +
           match(
             "conetactKind",
             all.kinds,
             R"(\>\ze\s\+[^# \t]" contained nextgroup=conetactName skipwhite)") +
           match("conetactWord", all.words, R"(\ze\s*\%(#.*\)\?$" contained)") +
           vim_links;
  }



  std::string
  textmate_grammar()
  {
    const Vocabulary  all    = vocabulary();
    const std::string blank  = "\\s+";
    const auto        one_of = [&](const std::set<std::string> &names) {
      return "(" + any_of(names, "|", blank) + ")";
    };
    const std::string comment = coloured("#.*$", "comment.line.number-sign");
    const std::string end     = "\\s*(?=#|$)";
    return "{\n  \"name\": \"Scene of Conetact\",\n"
           "  \"scopeName\": \"source.conetact\",\n"
           "  \"fileTypes\": [\"prm\"],\n  \"patterns\": [\n    " +
           comment +
           ",\n    {\"match\": " + json_string("^\\s*(include)\\s+([^#]*)") +
           ", \"captures\": " +
           captures({"keyword.control", "string.unquoted"}) +
           "},\n    {\"match\": " +
           json_string("^\\s*(subsection)\\s+(?:" + one_of(all.sections) + end +
                       "|" + one_of(all.kinds) + "\\s+([^#]+)|([^#]*))") +
           ", \"captures\": " +
           captures({"keyword.control",
                     "entity.name.section",
                     "entity.name.section",
                     "variable.other",
                     "invalid.illegal"}) +
           "},\n    " + coloured("^\\s*end" + end, "keyword.control") +
           ",\n    {\"begin\": " +
           json_string("^\\s*(set)\\s+(?:" + one_of(all.entries) +
                       "|([^=#]+?))\\s*(=)") +
           ", \"end\": " + json_string("(?<!\\\\)$") + ", \"beginCaptures\": " +
           captures({"keyword.control",
                     "support.type.property-name",
                     "invalid.illegal",
                     "keyword.operator"}) +
           ", \"patterns\": [\n      " + comment + ",\n      " +
           coloured("\\\\" + end, "constant.character.escape") + ",\n      " +
           coloured("(?<=[=\\s])" + one_of(all.words) + "(?=" + end + ")",
                    "constant.language") +
           ",\n      " +
           coloured("\\b\\d+\\.?\\d*(?:[eE][-+]?\\d+)?|\\.\\d+",
                    "constant.numeric") +
           "\n    ]}\n  ]\n}\n";
  }
} // namespace conetact::application
