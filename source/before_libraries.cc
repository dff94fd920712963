// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What must be settled before the libraries of the program start: deal.II ends
// the process when a variable of the environment is not what it expects, and
// OpenBLAS waits for ever for memory that a limit does not leave to its
// threads. And METIS takes SIGTERM for an error of its own while it orders
// nodes: it jumps out of whatever it is at, which may be malloc, and who asks
// the program to end is not heard, or waits for ever.

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>

namespace
{
  /** The libraries alone take most of it. */
  constexpr rlim_t least_memory = rlim_t(680) << 20;

  constexpr char too_little[] =
    "conetact: The limit of memory (ulimit -v) is below 680 MB, which the "
    "program and its libraries need to start. Raise it.\n";

  /** The value of a variable, if this is it. */
  const char *
  value_of(const char *const variable, const char *const name)
  {
    const std::size_t length = std::strlen(name);
    return std::strncmp(variable, name, length) == 0 &&
               variable[length] == '=' ?
             variable + length + 1 :
             nullptr;
  }

  bool
  is_a_number_of_threads(const char *const text)
  {
    char      *end    = nullptr;
    const long number = std::strtol(text, &end, 10);
    return end != text && *end == 0 && number > 0;
  }

  /** Whether there will be many copies of this process. */
  bool
  is_batch(const char *const *argument)
  {
    for (; *argument != nullptr; ++argument)
      if (std::strcmp(*argument, "--batch") == 0 ||
          value_of(*argument, "--batch") != nullptr)
        return true;
    return false;
  }

  /**
   * The C library does not know the environment yet and would not take changes:
   * the program begins once more with another one, if it must.
   */
  void
  begin_again(char **const arguments,
              char **const environment,
              const bool   one_thread)
  {
    constexpr std::size_t most  = 4096;
    static char           one[] = "OPENBLAS_NUM_THREADS=1";
    static char           now[] = "LD_BIND_NOW=1";
    static char          *changed[most + 3];
    std::size_t           n = 0, n_before = 0;
    bool                  has_threads = false, has_now = false;
    for (; environment[n_before] != nullptr; ++n_before)
      {
        char *const       variable = environment[n_before];
        const char *const threads  = value_of(variable, "DEAL_II_NUM_THREADS");
        has_threads |= value_of(variable, "OPENBLAS_NUM_THREADS") != nullptr;
        has_now |= value_of(variable, "LD_BIND_NOW") != nullptr;
        if (threads != nullptr && !is_a_number_of_threads(threads))
          continue;
        if (n == most)
          return;
        changed[n++] = variable;
      }
    const bool changes = n < n_before;
    if (one_thread && !has_threads)
      changed[n++] = one;
    // else each copy would look the symbols up again that it calls
    if (!has_now && is_batch(arguments))
      changed[n++] = now;
    if (!changes && n == n_before)
      return;
    execve("/proc/self/exe", arguments, changed);
  }

  void
  settle(int, char **arguments, char **environment)
  {
    rlimit     limit;
    const bool is_limited =
      getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    if (is_limited && limit.rlim_cur < least_memory)
      {
        const ssize_t told =
          ::write(STDERR_FILENO, too_little, sizeof(too_little) - 1);
        _exit(told < 0 ? 3 : 1);
      }
    // Threads are given to OpenBLAS later, where they are of use.
    begin_again(arguments, environment, is_limited);
  }

  // The loader calls what stands in this section before it starts libraries.
  __attribute__((section(".preinit_array"),
                 used)) void (*const first)(int, char **, char **) = settle;
} // namespace

/** In place of that of the C library: SIGTERM ends the program, whatever a
 * library would like to do instead. The program itself uses sigaction(). */
extern "C" sighandler_t
signal(const int number, const sighandler_t handler) noexcept
{
  if (number == SIGTERM && handler != SIG_DFL && handler != SIG_IGN)
    return SIG_DFL;
  struct sigaction now = {}, before = {};
  now.sa_handler = handler;
  now.sa_flags   = SA_RESTART;
  sigemptyset(&now.sa_mask);
  return sigaction(number, &now, &before) == 0 ? before.sa_handler : SIG_ERR;
}
