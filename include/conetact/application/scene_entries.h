// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_scene_entries_h
#define conetact_application_scene_entries_h

#include "conetact/application/command_line.h"
#include "conetact/application/scene_file.h"

#include <deal.II/base/parameter_handler.h>

#include <filesystem>
#include <string>
#include <vector>

namespace conetact::application
{
  /** The lists that a scene begins with: each name has its subsection. */
  struct SceneNames
  {
    std::vector<std::string> bodies, obstacles, contacts, supports, loads;
  };

  /** The lists alone, which are read before anything else. */
  void
  declare_lists(dealii::ParameterHandler &prm);

  /** Every entry of a scene with these names. */
  void
  declare_scene(dealii::ParameterHandler &prm, const SceneNames &names);

  /**
   * A scene file as it is written: names and values. The file is read twice:
   * first only its lists of names, then strictly with one subsection for each
   * name.
   */
  class SceneEntries
  {
  public:
    /**
     * Reads the file and the overrides of the command line. Throws InputError
     * with file and line.
     */
    explicit SceneEntries(const CommandLine &line);

    /** All entries with their documentation, or just their values. */
    std::string
    documentation() const;
    std::string
    values() const;
    /** The scene file's name without folder and ending. */
    std::string
    name() const;
    /** Where files that it names are. */
    std::filesystem::path
    folder() const;

    mutable dealii::ParameterHandler prm; ///< reading enters its subsections
    unsigned int                     dim = 2;
    SceneNames                       names;
    bool finds_contacts = false; ///< `Contacts = automatic`
    /** What of included files no list names any more, a sentence each. */
    std::vector<std::string> left_out;

  private:
    void
    parse_all(dealii::ParameterHandler &handler,
              const bool                skip_undefined) const;
    void
    read_names();
    void
    replace_times();

    std::filesystem::path    file;
    std::vector<std::string> overrides;
    SceneText                text; ///< of the file and what it includes
  };
} // namespace conetact::application

#endif
