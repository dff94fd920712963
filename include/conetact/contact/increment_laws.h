// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_increment_laws_h
#define conetact_contact_increment_laws_h

#include "conetact/contact/candidate_law.h"
#include "conetact/solvers/reach.h"

#include <deal.II/base/exceptions.h>

#include <memory>
#include <vector>

namespace conetact::contact
{
  /** Friction, layers and wear of an increment, by the laws of its contacts. */
  class IncrementLaws : public solvers::NodalLaws
  {
  public:
    /**
     * `known` of each candidate: pressure and speed are still 0. `r` are the
     * reactions at the start [force]; the increment lasts `duration`. `wet`:
     * candidates that a fluid has reached, or none. The points must outlive
     * the object.
     */
    IncrementLaws(const ContactPoints            &points,
                  std::vector<pairing::Situation> known,
                  const Eigen::VectorXd          &r,
                  const double                    duration,
                  const std::vector<bool>        &wet = {});

    /** The same with a part of what wears. */
    std::shared_ptr<const IncrementLaws>
    with_wear(const double part) const;

    const CandidateLaw &
    operator[](const std::size_t i) const
    {
      AssertIndexRange(i, all.size());
      return all[i];
    }

    solvers::FrictionLimit
    limit(const Index  i,
          const double s,
          const double slip,
          const double gap) const override
    {
      return at(i).limit(s, slip, gap);
    }
    solvers::Aspect
    aspect(const Index  i,
           const double s,
           const double slip,
           const double gap) const override
    {
      return at(i).aspect(s, slip, gap);
    }
    bool
    has_ellipses() const override
    {
      return elliptic;
    }
    solvers::Layer
    layer(const Index i, const double r_n, const double slip) const override
    {
      return at(i).layer(r_n, slip);
    }
    bool
    has_cones() const override;
    bool
    has_layers() const override
    {
      return soft;
    }
    solvers::Bond
    bond(const Index i, const double slip, const double gap) const override
    {
      return at(i).pull(slip, gap);
    }
    bool
    is_bonded(const Index i) const override
    {
      return at(i).bond().holds() || at(i).is_wet();
    }
    bool
    has_bonds() const override
    {
      return bonded;
    }
    bool
    is_apart(const Index i) const override
    {
      return !at(i).sees();
    }
    bool
    is_joined(const Index i) const override
    {
      return at(i).is_joined();
    }

    /** What candidates bear at most where these are their reactions, however
     * they slip or open. */
    solvers::Holding
    holding(const Eigen::VectorXd &r) const;
    /** No less than their coefficients, whatever happens; infinite: nothing is
     * known. */
    Eigen::VectorXd
    largest_coefficients() const;

    /** Of all candidates at the end of the increment: coefficients, slips,
     * without what layers give way by [length], and depths of wear [length]. */
    Eigen::VectorXd
    coefficients(const solvers::ContactState &end) const;
    Eigen::VectorXd
    slips(const solvers::ContactState &end) const;
    /** Slips that bonds see, also those of nodes that they let open
     * [length]. */
    Eigen::VectorXd
    shears(const solvers::ContactState &end) const;
    Eigen::VectorXd
    wear(const solvers::ContactState &end) const;
    /** On which candidates press [length^2]. */
    Eigen::VectorXd
    areas() const;
    /** Pressures of all candidates at the end; 0 without areas [stress]. */
    Eigen::VectorXd
    pressures(const solvers::ContactState &end) const;
    /** Of nodes that were bonded: openings at the end, without what a layer
     * stretches by, 0 if closed [length]. */
    Eigen::VectorXd
    openings(const solvers::ContactState &end) const;
    /** Work against bonds in the increment, from openings at its start [force x
     * length]. */
    Eigen::VectorXd
    fracture(const Eigen::VectorXd       &openings,
             const solvers::ContactState &end) const;

  private:
    const CandidateLaw &
    at(const Index i) const
    {
      return (*this)[static_cast<std::size_t>(i)];
    }
    /** A value of each candidate, by its number. */
    template <typename Value>
    Eigen::VectorXd
    of_each(const Value &value) const
    {
      Eigen::VectorXd values(static_cast<Index>(all.size()));
      for (Index i = 0; i < values.size(); ++i)
        values[i] = value(i);
      return values;
    }

    const ContactPoints      &points;
    std::vector<CandidateLaw> all;
    bool                      soft     = false; ///< something gives way
    bool                      bonded   = false; ///< or is wet or joined
    bool                      elliptic = false; ///< some limit is an ellipse
  };

  /** Whether any candidate has laws of its own: each of them, whatever it is,
   * comes with a law of friction. */
  bool
  has_nodal_laws(const ContactPoints &points);
} // namespace conetact::contact

#endif
