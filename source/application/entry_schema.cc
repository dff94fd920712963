// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/entry_list.h"
#include "conetact/application/entry_texts.h"
#include "conetact/application/json_text.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cctype>

namespace conetact::application
{
  namespace
  {
    /** A subsection with what is in it. */
    struct SchemaSection
    {
      std::string                   name;
      std::vector<EntryDescription> entries;
      std::vector<SchemaSection>    sections;
    };

    SchemaSection &
    section_in(SchemaSection &outer, const std::string &name)
    {
      const auto found =
        std::find_if(outer.sections.begin(),
                     outer.sections.end(),
                     [&](const SchemaSection &s) { return s.name == name; });
      if (found != outer.sections.end())
        return *found;
      outer.sections.push_back({name, {}, {}});
      return outer.sections.back();
    }

    /** What is a number in JSON as well, as it stands. */
    bool
    is_json_number(const std::string &text)
    {
      return !text.empty() &&
             (text[0] == '-' ||
              std::isdigit(static_cast<unsigned char>(text[0])) != 0) &&
             text.find_first_not_of("0123456789+-.eE") == text.npos &&
             text.back() != '.';
    }

    std::string
    type_of(const ValueKind &kind)
    {
      switch (kind.type)
        {
          case ValueKind::Type::integer:
            return "integer";
          case ValueKind::Type::number:
            return "number";
          case ValueKind::Type::boolean:
            return "boolean";
          case ValueKind::Type::text:
          case ValueKind::Type::word:
            break;
        }
      return "string";
    }

    std::string
    schema_of(const EntryDescription &entry, const std::string &indent)
    {
      const std::string  type  = type_of(entry.kind);
      const std::string  next  = ",\n" + indent;
      std::string        text  = "{\n" + indent + "\"type\": \"" + type + "\"";
      const std::string &value = entry.default_value;
      if (type == "boolean" || (type != "string" && is_json_number(value)))
        text += next + "\"default\": " + value;
      else if (type == "string")
        text += next + "\"default\": " + json_string(value);
      if (!entry.kind.words.empty())
        {
          std::vector<std::string> words;
          for (const std::string &word : entry.kind.words)
            words.push_back(json_string(word));
          text += next + "\"enum\": [" + join(words) + "]";
        }
      if (is_json_number(entry.kind.least))
        text += next + "\"minimum\": " + entry.kind.least;
      if (is_json_number(entry.kind.most))
        text += next + "\"maximum\": " + entry.kind.most;
      return text + next +
             "\"description\": " + json_string(one_line(entry.documentation)) +
             "}";
    }

    /** "properties": {...}; empty: there are none. */
    std::string
    members(const std::string              &what,
            const std::vector<std::string> &parts,
            const std::string              &indent)
    {
      return parts.empty() ? "" :
                             ",\n" + indent + "\"" + what + "\": {\n" + indent +
                               "  " + join(parts, ",\n" + indent + "  ") + "}";
    }

    /** Sections of the user's names are matched by what they begin with. */
    std::string
    schema_of(const SchemaSection &section, const std::string &indent)
    {
      const std::string        name   = std::string(" ") + any_name;
      const std::string        deeper = indent + "    ";
      std::vector<std::string> fixed, named;
      for (const EntryDescription &entry : section.entries)
        fixed.push_back(json_string(entry.name) + ": " +
                        schema_of(entry, deeper));
      for (const SchemaSection &inner : section.sections)
        if (const auto at = inner.name.find(name); at != inner.name.npos)
          named.push_back(json_string("^" + inner.name.substr(0, at) + " .+$") +
                          ": " + schema_of(inner, deeper));
        else
          fixed.push_back(json_string(inner.name) + ": " +
                          schema_of(inner, deeper));
      return "{\n" + indent + "\"type\": \"object\",\n" + indent +
             "\"additionalProperties\": false" +
             members("properties", fixed, indent) +
             members("patternProperties", named, indent) + "}";
    }
  } // namespace



  std::string
  json_schema()
  {
    dealii::ParameterHandler prm;
    declare_any_scene(prm);
    SchemaSection scene;
    for (const EntryDescription &entry : list_entries(prm))
      {
        SchemaSection *at = &scene;
        for (const std::string &name : entry.path)
          at = &section_in(*at, name);
        at->entries.push_back(entry);
      }
    const std::string indent = "  ";
    std::string       text   = schema_of(scene, indent);
    const std::string head =
      "{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
      "  \"title\": \"Scene of Conetact " CONETACT_VERSION "\",\n";
    return head + text.substr(2, text.size() - 3) + "\n}\n";
  }
} // namespace conetact::application
