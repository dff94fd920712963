// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What must be settled before the libraries of the program start: deal.II ends
// the process when a variable of the environment is not what it expects, and
// OpenBLAS waits for ever for memory that a limit does not leave to its
// threads.

#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>

namespace
{
  /** The libraries alone take most of it. */
  constexpr rlim_t least_memory = rlim_t(680) << 20;

  constexpr char too_little[] =
    "conetact: The limit of memory (ulimit -v) is below 680 MB, which the "
    "program and its libraries need to start. Raise it.\n";

  void
  forget_unless_whole_number(const char *const variable)
  {
    const char *const text = std::getenv(variable);
    if (text == nullptr)
      return;
    char *end = nullptr;
    std::strtol(text, &end, 10);
    if (end == text || *end != 0)
      unsetenv(variable);
  }

  void
  settle(int, char **, char **)
  {
    forget_unless_whole_number("DEAL_II_NUM_THREADS");
    rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
      return;
    if (limit.rlim_cur < least_memory)
      {
        const ssize_t told =
          ::write(STDERR_FILENO, too_little, sizeof(too_little) - 1);
        _exit(told < 0 ? 3 : 1);
      }
    // Threads are given to OpenBLAS later, where they are of use.
    setenv("OPENBLAS_NUM_THREADS", "1", /*overwrite=*/0);
  }

  // The loader calls what stands in this section before it starts libraries.
  __attribute__((section(".preinit_array"),
                 used)) void (*const first)(int, char **, char **) = settle;
} // namespace
