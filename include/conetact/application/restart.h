// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_restart_h
#define conetact_application_restart_h

#include "conetact/application/run_settings.h"
#include "conetact/base/archive.h"

#include <filesystem>
#include <string>

namespace conetact::application
{
  /** A run that is continued, from its last checkpoint on. */
  struct Restart
  {
    std::filesystem::path folder;
    Archive               state;
    unsigned int          n_done = 0; ///< increments
    /** It is an earlier stage of this run, which may begin anew. */
    bool is_of_this_run = false;
  };

  /** Throws InputError where a run writes checkpoints that cannot be continued.
   */
  void
  refuse_checkpoints(const RunSettings &settings);

  /**
   * The checkpoint in the folder. `values`: entries of the scene as it is now,
   * of which only loads, supports and motions may differ; times begin with
   * those that are done then. Throws InputError.
   */
  Restart
  continue_from(const std::filesystem::path &folder,
                const std::string           &values,
                RunSettings                 &settings);
} // namespace conetact::application

#endif
