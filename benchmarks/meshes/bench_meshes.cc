// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// mpirun -n N bench-meshes CELLS KIND makes a cube of CELLS^3 cells (a power of
// two) and numbers its dofs: KIND = made (all cells at once), refined (from 2^3
// cells) on each process; distributed (from 2^3 cells, p4est),
// fullydistributed (cut from one that the first process has made). Prints
// seconds, and what each process has more than at its start, as a row of a
// table.

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <string>

using namespace dealii;

namespace
{
  using Mesh    = Triangulation<3>;
  using MeshPtr = std::unique_ptr<Mesh>;

  /** The most that this process has had [MB]. */
  double
  peak()
  {
    Utilities::System::MemoryStats stats;
    Utilities::System::get_memory_stats(stats);
    return static_cast<double>(stats.VmHWM) / 1e3;
  }

  void
  make(Mesh &mesh, const unsigned int n)
  {
    GridGenerator::subdivided_hyper_cube(mesh, n);
  }

  void
  refine(Mesh &mesh, const unsigned int n)
  {
    make(mesh, 2);
    mesh.refine_global(static_cast<unsigned int>(std::lround(std::log2(n))) -
                       1);
  }

  MeshPtr
  made(const unsigned int n)
  {
    auto mesh = std::make_unique<Mesh>();
    make(*mesh, n);
    return mesh;
  }

  MeshPtr
  refined(const unsigned int n)
  {
    auto mesh = std::make_unique<Mesh>();
    refine(*mesh, n);
    return mesh;
  }

  MeshPtr
  distributed(const unsigned int n)
  {
    auto mesh =
      std::make_unique<parallel::distributed::Triangulation<3>>(MPI_COMM_WORLD);
    refine(*mesh, n);
    return mesh;
  }

  MeshPtr
  fully_distributed(const unsigned int n)
  {
    const auto n_processes = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const auto description = TriangulationDescription::Utilities::
      create_description_from_triangulation_in_groups<3, 3>(
        [n](Mesh &mesh) { make(mesh, n); },
        [](Mesh &mesh, const MPI_Comm group, const unsigned int) {
          GridTools::partition_triangulation_zorder(
            Utilities::MPI::n_mpi_processes(group), mesh);
        },
        MPI_COMM_WORLD,
        static_cast<int>(n_processes));
    auto mesh = std::make_unique<parallel::fullydistributed::Triangulation<3>>(
      MPI_COMM_WORLD);
    mesh->create_triangulation(description);
    return mesh;
  }
} // namespace

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize                 session(argc, argv, 1);
  const std::map<std::string, MeshPtr (*)(unsigned int)> kinds = {
    {"made", &made},
    {"refined", &refined},
    {"distributed", &distributed},
    {"fullydistributed", &fully_distributed}};
  const auto kind = argc == 3 ? kinds.find(argv[2]) : kinds.end();
  if (kind == kinds.end())
    {
      std::cerr << "usage: mpirun -n N " << argv[0] << " CELLS KIND\n";
      return 1;
    }
  const double before = peak();
  MPI_Barrier(MPI_COMM_WORLD);
  const auto    start = std::chrono::steady_clock::now();
  const MeshPtr mesh =
    kind->second(static_cast<unsigned int>(std::stoul(argv[1])));
  DoFHandler<3> dofs(*mesh);
  dofs.distribute_dofs(FESystem<3>(FE_Q<3>(1), 3));
  MPI_Barrier(MPI_COMM_WORLD);
  const std::chrono::duration<double> seconds =
    std::chrono::steady_clock::now() - start;
  const auto memory =
    Utilities::MPI::gather(MPI_COMM_WORLD, peak() - before, 0);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0)
    return 0;
  std::cout << "| " << kind->first << " | " << argv[1] << "^3 | "
            << std::round(100 * seconds.count()) / 100 << " |";
  for (const double megabytes : memory)
    std::cout << ' ' << std::round(megabytes);
  std::cout << " |" << std::endl;
  return 0;
}
