// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_mpi_libraries_h
#define conetact_application_mpi_libraries_h

namespace conetact::application
{
  /**
   * Loads the libraries that MPI would load in each copy of this process, where
   * that takes longer than a small scene. Starts nothing.
   */
  void
  load_mpi_libraries();
} // namespace conetact::application

#endif
