// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/joined_warnings.h"

#include "conetact/base/text.h"

#include <algorithm>
#include <regex>

namespace conetact
{
  namespace
  {
    constexpr std::size_t many = 4;

    const std::regex quoted_name("'[^']*'");

    /** What it says, whatever it is said of and how much it is. */
    std::string
    kind_of(const std::string &sentence)
    {
      static const std::regex number(R"([-+]?\d[\d.]*(e[-+]?\d+)?)");
      return std::regex_replace(std::regex_replace(sentence, quoted_name, "'"),
                                number,
                                "0");
    }

    /** That of the first name, which is what a sentence is about. */
    std::string
    subject_of(const std::string &sentence)
    {
      std::smatch found;
      return std::regex_search(sentence, found, quoted_name) ? found.str() : "";
    }

    struct Alike
    {
      std::string              kind;
      std::vector<std::string> sentences;
    };

    void
    warn_together(const Alike &alike, Log &log)
    {
      std::vector<std::string> names;
      for (const std::string &sentence : alike.sentences)
        if (const std::string name = subject_of(sentence);
            std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
      for (const std::string &sentence : alike.sentences)
        log.note("  alike: " + sentence);
      log.say("warning: " + alike.sentences.front() + " The same holds for " +
              join(std::vector<std::string>(names.begin() + 1, names.end())) +
              ", with numbers of their own in log.txt.");
    }
  } // namespace



  void
  warn(const std::vector<std::string> &sentences, Log &log)
  {
    std::vector<Alike> kinds;
    for (const std::string &sentence : sentences)
      {
        const std::string kind = kind_of(sentence);
        const auto        known =
          std::find_if(kinds.begin(), kinds.end(), [&](const Alike &alike) {
            return alike.kind == kind;
          });
        if (known == kinds.end())
          kinds.push_back({kind, {sentence}});
        else
          known->sentences.push_back(sentence);
      }
    for (const Alike &alike : kinds)
      if (alike.sentences.size() < many)
        for (const std::string &sentence : alike.sentences)
          log.say("warning: " + sentence);
      else
        warn_together(alike, log);
  }
} // namespace conetact
