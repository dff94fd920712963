// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_deck_lines_h
#define conetact_base_deck_lines_h

#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace conetact
{
  // The text of decks of Abaqus and CalculiX: keywords, their parameters and
  // their lines of data.

  /** "NODE OUTPUT" of "* Node  Output". */
  std::string
  upper_case(const std::string_view &text);

  /** A line and where it stands. */
  struct DeckLine
  {
    std::string_view text;
    std::size_t      file, number;
  };

  /** A keyword and what stands below it until the next one. */
  struct DeckBlock
  {
    std::string                        keyword;    ///< upper case: "NODE"
    std::map<std::string, std::string> parameters; ///< names in upper case
    DeckLine                           head;
    std::vector<DeckLine>              lines;

    bool
    has(const std::string &name) const
    {
      return parameters.count(name) > 0;
    }
    /** Empty: it is not there. */
    std::string
    value(const std::string &name) const;
  };

  /** A deck with all files that it includes. */
  class DeckText
  {
  public:
    /** The contents of the file of this path. Throws FileFault. */
    DeckText(const std::string &contents, const std::filesystem::path &path);
    DeckText(const DeckText &) = delete;
    DeckText &
    operator=(const DeckText &) = delete;

    const std::vector<DeckBlock> &
    blocks() const
    {
      return all;
    }
    /** Throws FileFault: "line 7: why", with the name of an included file. */
    [[noreturn]] void
    fail(const DeckLine &line, const std::string &why) const;

    /** Parts between commas, trimmed; a comma at the end has none behind it. */
    static std::vector<std::string_view>
    fields(const DeckLine &line);
    /** Throws FileFault. Empty: 0. */
    double
    number(const std::string_view &field, const DeckLine &line) const;
    /** A number of a node or element. Throws FileFault. */
    unsigned int
    label(const std::string_view &field, const DeckLine &line) const;

  private:
    static std::string
    quoted(const std::string_view &field);
    void
    read(const std::size_t file);
    void
    include(const DeckBlock &block);
    void
    open_block(const DeckLine &head, const std::string &text);

    std::deque<std::string>            texts; ///< views stay valid
    std::vector<std::filesystem::path> paths;
    std::size_t                        depth = 0;
    std::vector<DeckBlock>             all;
  };
} // namespace conetact

#endif
