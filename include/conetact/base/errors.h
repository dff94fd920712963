// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_errors_h
#define conetact_base_errors_h

#include <stdexcept>

namespace conetact
{
  /**
   * Wrong input: a sentence to the user that names the entry, the fault and
   * the remedy. Exit code 1, nothing written.
   */
  struct InputError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** No equilibrium, or not converged. Exit code 2. */
  struct AnalysisError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** A file or folder that cannot be written. Exit code 3. */
  struct WriteError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };
} // namespace conetact

#endif
