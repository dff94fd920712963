// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/entry_texts.h"
#include "conetact/application/option_table.h"
#include "conetact/base/text.h"

namespace conetact::application
{
  namespace
  {
    /* Readline splits words at = and : as well, and leaves quotes in them:
       what was typed is taken apart anew. Single matches close a quote, so
       that an entry is offered together with its values. */
    constexpr const char *functions = R"(
# what has been typed, without quotes: words, and cur, the one to be completed;
# quote is the one that is still open
_conetact_split()
{
  local line=${COMP_LINE:0:COMP_POINT} i letter begun=
  words=() cur= quote=
  for ((i = 0; i < ${#line}; ++i)); do
    letter=${line:i:1}
    if [[ $quote == "'" && $letter != "'" ]]; then
      cur+=$letter
    elif [[ $letter == "$quote" ]]; then
      quote=
    elif [[ $letter == \\ ]]; then
      begun=1
      ((++i))
      cur+=${line:i:1}
    elif [[ -n $quote ]]; then
      cur+=$letter
    elif [[ $letter == [\'\"] ]]; then
      begun=1
      quote=$letter
    elif [[ $letter != [[:space:]] ]]; then
      begun=1
      cur+=$letter
    elif [[ -n $begun ]]; then
      words+=("$cur")
      begun= cur=
    fi
  done
}

# what -s may begin with, from entries of the scene, one subsection at a time
_conetact_match()
{
  local entry rest
  matches=()
  local -A seen=()
  for entry in "${entries[@]}"; do
    [[ $entry == "$cur"* ]] || continue
    rest=${entry:${#cur}}
    if [[ $cur != *=* ]]; then
      rest=${rest%%=*}=
      [[ $rest != */* ]] || rest=${rest%%/*}/
    fi
    [[ -n ${seen[x$rest]} ]] || matches+=("$cur$rest")
    seen[x$rest]=1
  done
}

_conetact_entries()
{
  local program=$1 entries matches match before=
  mapfile -t entries < <("$program" "$scene" --completion entries 2>/dev/null)
  _conetact_match
  while [[ ${#matches[@]} == 1 && ${matches[0]} == */ ]]; do
    cur=${matches[0]}
    _conetact_match
  done
  if [[ ${#matches[@]} == 1 && ${matches[0]} == *= && $cur != *=* ]]; then
    local name=${matches[0]} # with its values
    matches=("$name")
    for match in "${entries[@]}"; do
      [[ $match != "$name"?* ]] || matches+=("$match")
    done
    [[ ${#matches[@]} -gt 1 ]] || matches+=("$name...")
  fi
  if [[ -z $quote && $typed == *[=:]* ]]; then # readline replaces what is behind
    before=${typed%"${typed##*[=:]}"}
  fi
  for match in "${matches[@]}"; do
    match=${match#"$before"}
    [[ -n $quote ]] || printf -v match %q "$match"
    COMPREPLY+=("$match")
  done
  compopt -o nospace
}

_conetact_files() # compgen's actions
{
  compopt -o filenames
  mapfile -t COMPREPLY < <(compgen "$@" -- "$cur")
}

_conetact()
{
  local words cur quote typed previous scene= first= word value=
  COMPREPLY=()
  _conetact_split
  for word in "${words[@]:1}"; do
    if [[ -n $value ]]; then
      value=
    elif [[ " $_conetact_valued " == *" $word "* ]]; then
      value=1
    elif [[ $word != -* ]]; then
      : "${first:=$word}"
      [[ $word != *.prm ]] || scene=${word/#\~\//$HOME/}
    fi
  done
  previous=${words[${#words[@]} - 1]}
  if [[ $cur == --*=* ]]; then
    previous=${cur%%=*} cur=${cur#*=}
    value=1
  fi
  typed=$cur
  if [[ -n $value ]]; then
    case $previous in
)";

    constexpr const char *rest_of_function = R"(    esac
  elif [[ $cur == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$_conetact_options" -- "$cur")
  elif [[ $first == compare ]]; then
    _conetact_files -d
  elif [[ -z $first ]]; then
    _conetact_files -f -X '!*.prm'
    mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "$cur"; compgen -W compare -- "$cur")
  fi
}

complete -F _conetact conetact
)";

    /** "-o --output" */
    std::string
    names_of(const OptionRow &row, const std::string &separator)
    {
      const std::string name = std::string("--") + row.name;
      return row.is_short ?
               '-' + std::string(1, row.letter) + separator + name :
               name;
    }

    /** The commands that complete the value of an option; empty: none. */
    std::string
    completing(const OptionRow &row)
    {
      switch (row.value)
        {
          case OptionRow::Value::folder:
            return "_conetact_files -d";
          case OptionRow::Value::file:
            return "_conetact_files -f";
          case OptionRow::Value::entry:
            return "[[ -z $scene ]] || _conetact_entries \"${1/#\\~\\//$HOME/}\"";
          case OptionRow::Value::word:
            return "mapfile -t COMPREPLY < <(compgen -W '" +
                   join(row.words, " ") + "' -- \"$cur\")";
          case OptionRow::Value::none:
          case OptionRow::Value::free:
            break;
        }
      return "";
    }
  } // namespace



  std::string
  bash_completion()
  {
    std::vector<std::string> options, valued;
    std::string              cases;
    for (const OptionRow &row : option_table())
      {
        options.push_back(names_of(row, " "));
        if (row.value != OptionRow::Value::none)
          valued.push_back(names_of(row, " "));
        if (const std::string commands = completing(row); !commands.empty())
          cases += "      " + names_of(row, " | ") + ") " + commands + " ;;\n";
      }
    return "# Completes command lines of conetact in bash. Made by: conetact "
           "--completion bash\n\n_conetact_options=\"" +
           join(options, " ") + "\"\n_conetact_valued=\"" + join(valued, " ") +
           "\"\n" + functions + cases + rest_of_function;
  }
} // namespace conetact::application
