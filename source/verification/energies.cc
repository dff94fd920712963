// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/verification/energies.h"

namespace conetact::verification
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** Mean of both forces times the change of the displacement. */
    double
    trapezoid(const VectorXd &f0,
              const VectorXd &f1,
              const VectorXd &u0,
              const VectorXd &u1)
    {
      return .5 * (f0 + f1).dot(u1 - u0);
    }

    /** Of names in checkpoints. */
    const std::string foundation = "energies/foundation ";

    void
    fill(VectorXd &x, const Index n)
    {
      if (x.size() == 0)
        x.setZero(n);
    }
  } // namespace

  void
  Energies::add(const contact::ContactPoints &points,
                const Claim                  &claim,
                const Finding                &finding,
                output::IncrementRecord      &record)
  {
    State now;
    now.u           = finding.u;
    now.forces      = finding.acting;
    now.foundations = finding.foundations;
    now.r           = claim.r;
    fill(last.u, now.u.size());
    fill(last.forces, now.forces.size());
    fill(last.r, now.r.size());
    now.t               = claim.t;
    const bool is_first = last.reactions.empty();
    last.reactions.resize(points.all().size());
    last.foundations.resize(now.foundations.size());

    // Of w alone: a rigid motion has no energy.
    record.strain_energy = .5 * claim.w.dot(finding.internal);
    record.external_work = trapezoid(last.forces, now.forces, last.u, now.u);
    for (std::size_t s = 0; s < now.foundations.size(); ++s)
      if (contact::Foundation &f = now.foundations[s]; f.forces.size() > 0)
        {
          fill(last.foundations[s].forces, f.forces.size());
          fill(last.foundations[s].ground, f.forces.size());
          // Springs between body and ground. On the whole they are inside: only
          // the ground that moves does work from outside.
          record.strain_energy += .5 * f.forces.dot(f.ground - now.u);
          record.external_work += trapezoid(last.foundations[s].forces,
                                            f.forces,
                                            last.foundations[s].ground,
                                            f.ground);
        }
    record.dissipation = record.contact_work_normal = 0;
    for (std::size_t i = 0; i < points.all().size(); ++i)
      {
        const contact::ContactPoint &point = points.all()[i];
        now.reactions.push_back(contact::force_of(point, claim.r));
        now.nodes.push_back(*point.node);
        // A reaction acts on the body; an obstacle that moves with it does
        // work, and so does an interference that grows. Where nodes slide each
        // of both reactions goes with the point that it met.
        const auto moved = [&](const pairing::ContactNode &node) {
          Tensor<1, 3> d = node.opponent_displacement(now.t);
          if (!is_first)
            d -= node.opponent_displacement(last.t);
          return d;
        };
        const pairing::ContactNode &before =
          last.nodes.empty() ? *point.node : last.nodes[i];
        record.external_work += .5 * (last.reactions[i] * moved(before) +
                                      now.reactions[i] * moved(*point.node));
        const auto nt   = static_cast<Index>(point.dual.size()) - 1;
        const auto work = [&](const Index first, const Index size) {
          // Friction opposes the slip: its work on the bodies is negative, and
          // what is lost positive.
          return -.5 * (last.r.segment(first, size)
                          .dot(finding.change_as_before.segment(first, size)) +
                        now.r.segment(first, size)
                          .dot(finding.change.segment(first, size)));
        };
        record.dissipation += work(point.first, nt);
        record.contact_work_normal += work(point.first + nt, 1);
      }
    last = std::move(now);
  }

  void
  Energies::save(Archive                        &archive,
                 const std::vector<std::string> &supports) const
  {
    archive.put("energies/u", last.u);
    archive.put("energies/forces", last.forces);
    archive.put("energies/t", last.t);
    archive.put("energies/r", last.r);
    archive.put("energies/reactions", last.reactions);
    archive.put("energies/points", static_cast<double>(last.reactions.size()));
    for (std::size_t s = 0; s < last.foundations.size(); ++s)
      if (last.foundations[s].forces.size() > 0)
        {
          const std::string name = foundation + supports[s];
          archive.put(name + "/forces", last.foundations[s].forces);
          archive.put(name + "/ground", last.foundations[s].ground);
        }
  }

  void
  Energies::restore(const Archive                  &archive,
                    const std::vector<std::string> &supports)
  {
    const auto number = [&](const std::string &name) {
      double value = 0;
      archive.fill(name, value);
      return static_cast<std::size_t>(value);
    };
    archive.fill_any("energies/u", last.u);
    archive.fill_any("energies/forces", last.forces);
    archive.fill("energies/t", last.t);
    archive.fill_any("energies/r", last.r);
    last.reactions.resize(number("energies/points"));
    archive.fill("energies/reactions", last.reactions);
    last.foundations.resize(supports.size());
    for (std::size_t s = 0; s < supports.size(); ++s)
      if (const std::string name = foundation + supports[s];
          archive.has(name + "/forces"))
        {
          archive.fill_any(name + "/forces", last.foundations[s].forces);
          archive.fill_any(name + "/ground", last.foundations[s].ground);
        }
  }
} // namespace conetact::verification
