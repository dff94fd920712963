// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/condensation.h"

namespace conetact
{
  Condensation::Condensation(const ElasticSystem   &e,
                             const Coordinates     &c,
                             const Eigen::MatrixXd &null_space)
    : elastic(e)
    , coordinates(c)
    , solver(std::make_unique<SchurSolver>(assemble(elastic, coordinates),
                                           coordinates.n_contact_unknowns(),
                                           coordinates.node_of_unknowns()))
  {
    auto system        = std::make_shared<ContactSystem>(coordinates.layout());
    system->matrix     = solver->take_schur_complement();
    system->null_space = null_space;
    contact_system     = system;
  }

  Condensation::Load
  Condensation::reduce(const Eigen::VectorXd &forces,
                       const Eigen::VectorXd &prescribed) const
  {
    Load load;
    load.prescribed = prescribed;
    load.b          = prescribed.isZero(0) ?
                        coordinates.restrict(forces) :
                        coordinates.restrict(
                 forces - elastic.internal_forces(prescribed));
    load.f          = solver->reduce(load.b);
    return load;
  }

  Eigen::VectorXd
  Condensation::expand(const Load &load, const Eigen::VectorXd &contact) const
  {
    return coordinates.expand(solver->expand(load.b, contact)) +
           load.prescribed;
  }
} // namespace conetact
