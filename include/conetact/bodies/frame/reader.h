// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_frame_reader_h
#define conetact_bodies_frame_reader_h

#include "conetact/bodies/frame/frame_model.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace conetact::bodies
{
  /**
   * Adds nodes and members that a user wrote to a frame whose dimension and
   * sections are known. Nodes must come before the members that name them.
   * Messages begin with the entry. Throws InputError.
   */
  class FrameReader
  {
  public:
    explicit FrameReader(FrameModel &frame);

    /** 'name: x, y[, z] [: id, id] ; ...' */
    void
    read_nodes(const std::string &text, const std::string &entry);
    /** 'a-b-c: section[, option] ; ...' */
    void
    read_members(const std::string &text, const std::string &entry);
    /**
     * A text file with comma separated lines 'node, name, x, y[, z][, id]' and
     * 'member, a, b, section[, option]'; '#' starts a comment.
     */
    void
    read_file(const std::filesystem::path &file, const std::string &entry);

  private:
    void
    add_node(const std::string &name,
             const std::string &coordinates,
             const std::string &ids,
             const std::string &entry);
    void
    add_chain(const std::vector<std::string> &names,
              const std::vector<std::string> &words,
              const std::string              &entry);
    void
    add_member(const FrameMember &member, const unsigned int n_elements);
    unsigned int
    find_node(const std::string &name, const std::string &entry) const;
    unsigned int
    find_section(const std::string &name, const std::string &entry) const;

    FrameModel                         &model;
    std::map<std::string, unsigned int> numbers; ///< of nodes by name
  };
} // namespace conetact::bodies

#endif
