// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/mpi_libraries.h"

#include <dlfcn.h>
#include <mpi.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace conetact::application
{
  /* Whatever cannot be loaded now is loaded, or missed, by MPI itself. */
  void
  load_mpi_libraries()
  {
    Dl_info library;
    if (dladdr(reinterpret_cast<void *>(&MPI_Init), &library) == 0)
      return;
    std::error_code             error;
    const std::filesystem::path file =
      std::filesystem::canonical(library.dli_fname, error);
    for (const char *const component :
         {"allocator_basic", "allocator_bucket",   "bml_r2",
          "btl_self",        "coll_basic",         "coll_libnbc",
          "coll_self",       "errmgr_default_app", "ess_singleton",
          "mpool_hugepage",  "pmix_isolated",      "pml_ob1",
          "rcache_grdma",    "reachable_weighted", "schizo_flux",
          "schizo_jsm",      "schizo_ompi",        "schizo_orte",
          "schizo_slurm",    "shmem_mmap",         "state_app"})
      {
        const std::string name =
          std::string("openmpi/lib/openmpi3/mca_") + component;
        dlopen((file.parent_path() / (name + ".so")).c_str(), RTLD_NOW);
      }
  }
} // namespace conetact::application
