// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_child_process_h
#define conetact_base_child_process_h

#include <functional>
#include <optional>
#include <string>

namespace conetact
{
  /** What a child process may use beyond what its parent has. */
  struct ChildLimits
  {
    double cpu_seconds = 0;
    double bytes       = 0;
  };

  /** Thrown by work that finds its input wrong, with what is wrong. */
  struct ChildRefusal
  {
    std::string what;
  };

  /** What a child process handed back, or the end of a sentence that says why
   * it could not: "needs more memory than ..."; or what it refused. */
  struct ChildResult
  {
    std::string                bytes, why;
    std::optional<std::string> refused = {};
  };

  /**
   * Calls `work` in a copy of this process and hands back the bytes it returns:
   * a library that crashes, never ends or asks for any amount of memory on a
   * damaged file takes only the copy along. The copy prints nothing, leaves
   * nothing behind and ends with its parent. It has this thread alone and must
   * not use MPI. `work` must throw nothing but ChildRefusal and what is out of
   * memory.
   */
  ChildResult
  in_child_process(const ChildLimits                  &limits,
                   const std::function<std::string()> &work);
} // namespace conetact

#endif
