// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/verification/energies.h"

#include <deal.II/base/exceptions.h>

namespace conetact::verification
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** The work .5 (f0 + f1) . (u1 - u0) [force x length]: exact where forces
     * are linear in displacements, as those of elastic bodies are. */
    template <typename Forces, typename Displacements>
    double
    trapezoid(const Forces        &f0,
              const Forces        &f1,
              const Displacements &u0,
              const Displacements &u1)
    {
      return .5 * (f0 + f1).dot(u1 - u0);
    }

    /** Names of foundations in checkpoints begin with this. */
    const std::string foundation = "energies/foundation ";

    /** Before the first increment nothing acts: forces are empty, and zeros
     * then. */
    void
    fill(VectorXd &x, const Index n)
    {
      if (x.size() == 0)
        x.setZero(n);
    }

    /**
     * Adds the energy .5 f . (g - u) of springs f = K_s (g - u) between a body
     * and its ground g. They are inside of what the energies balance: ground
     * that moves does work from outside, the body does not.
     */
    void
    add_foundations(const Finding                    &finding,
                    std::vector<contact::Foundation> &before,
                    model::IncrementRecord           &record)
    {
      for (std::size_t s = 0; s < finding.foundations.size(); ++s)
        if (const contact::Foundation &f = finding.foundations[s];
            f.forces.size() > 0)
          {
            fill(before[s].forces, f.forces.size());
            fill(before[s].ground, f.forces.size());
            record.strain_energy += .5 * f.forces.dot(f.ground - *finding.u);
            record.external_work +=
              trapezoid(before[s].forces, f.forces, before[s].ground, f.ground);
          }
    }
  } // namespace

  void
  Energies::add(const contact::DofShare      &share,
                const contact::ContactPoints &points,
                const VectorXd               &r,
                const double                  t,
                const contact::SharedVector  &u,
                const Finding                &finding,
                model::IncrementRecord       &record)
  {
    AssertDimension(r.size(), points.n_all_unknowns());
    AssertDimension(finding.acting.size(), share.size());
    AssertDimension(finding.change.size(), r.size());
    AssertDimension(finding.change_as_before.size(), r.size());
    Assert(last_nodes.empty() || last_nodes.size() == points.all().size(),
           dealii::ExcMessage("Contacts keep their order where they slide."));
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    fill(last_forces, finding.acting.size());
    // A checkpoint, and gather(), leave forces of all dofs.
    if (last_forces.size() != share.size())
      last_forces = share.of(last_forces).eval();
    fill(last_r, r.size());
    const bool is_first = last_reactions.empty();
    last_reactions.resize(points.all().size());
    last_foundations.resize(finding.foundations.size());

    record.strain_energy = finding.strain_energy;
    const auto now       = share.of(*finding.u);
    record.external_work =
      share.sum(u ? trapezoid(last_forces, finding.acting, share.of(*u), now) :
                    .5 * (last_forces + finding.acting).dot(now));
    add_foundations(finding, last_foundations, record);
    record.dissipation = record.contact_work_normal = 0;
    for (std::size_t i = 0; i < points.all().size(); ++i)
      {
        const contact::ContactPoint &point    = points.all()[i];
        const Tensor<1, 3>           reaction = contact::force_of(point, r);
        // A reaction acts on the body; an obstacle that moves with it does
        // work, and so does an interference that grows. Where nodes slide each
        // of both reactions goes with the point that it met. The first
        // increment starts from no displacement at all.
        const auto moved = [&](const pairing::ContactNode &node) {
          Tensor<1, 3> d = node.opponent_displacement(t);
          if (!is_first)
            d -= node.opponent_displacement(last_t);
          return d;
        };
        const pairing::ContactNode &before =
          last_nodes.empty() ? *point.node : last_nodes[i];
        record.external_work += .5 * (last_reactions[i] * moved(before) +
                                      reaction * moved(*point.node));
        const auto nt   = static_cast<Index>(point.dual.size()) - 1;
        const auto work = [&](const Index first, const Index size) {
          // Friction opposes the slip: its work on the bodies is negative, and
          // what is lost positive. Reactions of the start work along the
          // directions that contacts had then, those of the end along the
          // present ones.
          return -.5 * (last_r.segment(first, size)
                          .dot(finding.change_as_before.segment(first, size)) +
                        r.segment(first, size)
                          .dot(finding.change.segment(first, size)));
        };
        record.dissipation += work(point.first, nt);
        record.contact_work_normal += work(point.first + nt, 1);
        last_reactions[i] = reaction;
      }
    last_forces      = finding.acting;
    last_foundations = finding.foundations;
    last_r           = r;
    last_t           = t;
    remember_nodes(points);
  }

  void
  Energies::gather(const contact::DofShare &share)
  {
    if (last_forces.size() == share.size())
      last_forces = share.gather(last_forces);
  }

  void
  Energies::remember_nodes(const contact::ContactPoints &points)
  {
    last_nodes.clear();
    if (points.slide())
      for (const contact::ContactPoint &point : points.all())
        last_nodes.push_back(*point.node);
  }

  void
  Energies::save(Archive                        &archive,
                 const std::vector<std::string> &supports,
                 const contact::SharedVector    &u) const
  {
    archive.put("energies/u", contact::numbers(u));
    archive.put("energies/forces", last_forces);
    archive.put("energies/t", last_t);
    archive.put("energies/r", last_r);
    archive.put("energies/reactions", last_reactions);
    archive.put("energies/points", static_cast<double>(last_reactions.size()));
    for (std::size_t s = 0; s < last_foundations.size(); ++s)
      if (last_foundations[s].forces.size() > 0)
        {
          const std::string name = foundation + supports[s];
          archive.put(name + "/forces", last_foundations[s].forces);
          archive.put(name + "/ground", last_foundations[s].ground);
        }
  }

  void
  Energies::restore(const Archive                  &archive,
                    const std::vector<std::string> &supports,
                    const contact::ContactPoints   &points)
  {
    remember_nodes(points);
    const auto number = [&](const std::string &name) {
      double value = 0;
      archive.fill(name, value);
      return static_cast<std::size_t>(value);
    };
    archive.fill_any("energies/forces", last_forces);
    archive.fill("energies/t", last_t);
    archive.fill_any("energies/r", last_r);
    last_reactions.resize(number("energies/points"));
    archive.fill("energies/reactions", last_reactions);
    last_foundations.resize(supports.size());
    for (std::size_t s = 0; s < supports.size(); ++s)
      if (const std::string name = foundation + supports[s];
          archive.has(name + "/forces"))
        {
          archive.fill_any(name + "/forces", last_foundations[s].forces);
          archive.fill_any(name + "/ground", last_foundations[s].ground);
        }
  }
} // namespace conetact::verification
