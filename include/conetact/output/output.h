// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_output_h
#define conetact_output_output_h

#include "conetact/bodies/structure.h"
#include "conetact/model/increment_record.h"
#include "conetact/output/units.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace conetact::output
{
  /** What the outputs need to know before the first increment. */
  struct RunDescription
  {
    std::filesystem::path    folder;   ///< exists and is writable
    std::vector<std::string> contacts; ///< names, then those of masters' sides
    /** The body that each of them is on, an index into `bodies`. */
    std::vector<unsigned int> contact_bodies;
    std::vector<std::string>  supports;  ///< names
    std::vector<std::string>  loads;     ///< names
    std::vector<std::string>  bodies;    ///< names
    std::vector<std::string>  obstacles; ///< names of those that are free
    std::vector<std::string>  preloads;  ///< names of contacts that have one
    std::vector<unsigned int> wearing;   ///< indices of contacts that wear
    std::vector<unsigned int> breaking;  ///< of those whose bonds may be lost
    bool                      judges_uniqueness = false;
    bool                      follows_branches  = false;
    bool                      has_moments       = false; ///< among its loads
    std::vector<std::string>  probes; ///< names of chosen points
    std::vector<const bodies::Structure *> structures;
    unsigned int                           dim = 2;
    unsigned int n_increments                  = 0; ///< 0: not known yet
    double       end                           = 0; ///< time of the last one
    unsigned int vtu_every                     = 1; ///< 0: never
    Units        units;

    /** The folder of a run that is continued, and how many increments of it. */
    std::filesystem::path former;
    unsigned int          n_former = 0;
    /** Whether its files are in the way: it is continued where it is. */
    bool
    goes_on_in_place() const
    {
      std::error_code error;
      return n_former > 0 && std::filesystem::equivalent(former, folder, error);
    }

    /** Increments whose condensed problem is written. */
    std::set<unsigned int> fclib_increments, text_increments;

    bool
    is_drawn(const unsigned int increment) const
    {
      return vtu_every > 0 && increment % vtu_every == 0;
    }
  };

  /** What an output has done so far. */
  struct OutputWork
  {
    unsigned int  drawings    = 0; ///< increments drawn
    std::uint64_t table_bytes = 0; ///< of all versions of its tables
  };

  /** Something that writes finished increments; throws WriteError. */
  class Output
  {
  public:
    virtual ~Output() = default;
    /** The undeformed bodies at t = 0, before anything acts: increment 0. */
    virtual void
    begin(const model::IncrementRecord & /*undeformed*/)
    {}
    /**
     * Increments that were finished together, in their order. Every file is
     * whole at every moment: temporary name, then rename.
     */
    virtual void
    write(const std::vector<model::IncrementRecord> &finished) = 0;

    /** Whether all processes of a run write, each a part; otherwise the first
     * one has it alone. */
    virtual bool
    is_shared() const
    {
      return false;
    }

    virtual OutputWork
    work() const
    {
      return {};
    }
  };
} // namespace conetact::output

#endif
