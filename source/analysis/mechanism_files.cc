// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/mechanism_files.h"

#include "conetact/base/atomic_file.h"
#include "conetact/output/csv.h"
#include "conetact/output/graphics.h"

namespace conetact::analysis
{
  MechanismFiles::MechanismFiles(contact::ContactModel       &m,
                                 const std::filesystem::path &f)
    : model(m)
    , folder(f)
  {}



  /* A mechanism moves bodies without force: by their free motions where these
     are known by themselves, and strains them nowhere. */
  Eigen::VectorXd
  MechanismFiles::displacements(const Eigen::VectorXd &velocity) const
  {
    if (model.condensed_form() == solvers::Form::stiffness)
      return model.elasticity().correction(
        model.elasticity().reduce_unbalanced(
          {Eigen::VectorXd::Zero(model.coordinates.n_dofs()), {}, {}, {}, {}}),
        velocity);
    const Eigen::VectorXd a =
      model.motions.seen().completeOrthogonalDecomposition().solve(velocity);
    return model.motions.field(model.motions.of_free(a));
  }



  void
  MechanismFiles::write(const Eigen::VectorXd &velocity, const double t) const
  {
    Eigen::VectorXd u = displacements(velocity);
    if (const double size = solvers::largest(u); size > 0)
      u /= size;
    std::vector<std::pair<std::string, std::string>> blocks;
    for (std::size_t b = 0; b < model.bodies.names.size(); ++b)
      {
        blocks.emplace_back(output::safe_names(model.bodies.names)[b], name(b));
        bodies::write_graphics(*model.bodies.structures[b],
                               u.segment(model.coordinates.offset(b),
                                         model.bodies.structures[b]->n_dofs()),
                               t,
                               folder / blocks.back().second);
      }
    output::PvdFile(folder / "mechanism.pvd").add(t, blocks);
  }



  void
  MechanismFiles::remove() const
  {
    remove_file(folder / "mechanism.pvd");
    for (std::size_t b = 0; b < model.bodies.names.size(); ++b)
      remove_file(folder / name(b));
  }



  std::string
  MechanismFiles::name(const std::size_t body) const
  {
    return model.bodies.names.size() == 1 ?
             "mechanism.vtu" :
             "mechanism-" + output::safe_names(model.bodies.names)[body] +
               ".vtu";
  }
} // namespace conetact::analysis
