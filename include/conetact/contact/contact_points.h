// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_contact_points_h
#define conetact_contact_contact_points_h

#include "conetact/contact/node_rules.h"
#include "conetact/solvers/contact_problem.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace conetact::contact
{
  /**
   * A node and what it may touch. Its contact unknowns are the components of
   * their relative displacement in `directions`, tangents first, the normal
   * last: @f$v = \sum_k v_k d_k@f$, forces @f$r = \sum_k r_k d^k@f$ in the dual
   * basis. Where friction is elliptic tangents are scaled so that the cone is
   * circular: solvers see one coefficient ([K] remark 3.3).
   */
  struct ContactPoint
  {
    const pairing::ContactNode *node = nullptr;
    std::vector<Tensor<1, 3>>   directions;
    std::vector<Tensor<1, 3>>   dual; ///< dual[i] . directions[j] = (i == j)
    std::vector<Tensor<1, 3>>   frictionless; ///< tangents that nothing holds
    double                      mu    = 0;
    Eigen::Index                first = 0; ///< of its unknowns

    /** Index of the normal unknown, the last one. */
    Eigen::Index
    normal() const
    {
      return first + static_cast<Eigen::Index>(dual.size()) - 1;
    }
  };

  /** What contacts do at a point: its force in space, of all unknowns r. */
  Tensor<1, 3>
  force_of(const ContactPoint &point, const Eigen::VectorXd &r);

  /** The difference of the two sides of a contact node, of displacements
   * at(body, node). */
  template <typename DisplacementAt>
  Tensor<1, 3>
  difference_of_sides(const pairing::ContactNode &node,
                      const DisplacementAt       &at)
  {
    Tensor<1, 3> v;
    pairing::for_each_side(node,
                           [&](const unsigned int body,
                               const unsigned int i,
                               const double       weight) {
                             v += weight * at(body, i);
                           });
    return v;
  }

  /** Displacement of a contact node relative to what it may touch, at time t.
   * `at(body, node)` is that of a node. */
  template <typename DisplacementAt>
  Tensor<1, 3>
  relative_displacement(const pairing::ContactNode &node,
                        const DisplacementAt       &at,
                        const double                t)
  {
    return difference_of_sides(node, at) - node.opponent_displacement(t);
  }

  /**
   * All contacts of a scene as rows over the nodes of its bodies, contact by
   * contact. A node that stands in several contacts has a point in each. Those
   * that may open are candidates, the unknowns of contact solvers; those that
   * are bound (ties, bilateral contacts) are equations, v = 0 whatever the
   * reaction: their unknowns stand behind those of all candidates.
   */
  class ContactPoints
  {
  public:
    /**
     * Throws InputError where a contact node is held neither along its normal
     * nor in its tangent plane. Along the normal: it has no point. In the
     * tangent plane: it has an unknown there only if it slides that way at one
     * of `times`, against friction that the support takes.
     */
    ContactPoints(const model::Bodies       &bodies,
                  const NodeRules           &supports,
                  const std::vector<double> &times);

    /** Candidates: */
    std::vector<ContactPoint>::const_iterator
    begin() const
    {
      return points.begin();
    }
    std::vector<ContactPoint>::const_iterator
    end() const
    {
      return points.begin() + static_cast<std::ptrdiff_t>(n_candidates);
    }
    std::size_t
    size() const
    {
      return n_candidates;
    }
    const ContactPoint &
    operator[](const std::size_t i) const
    {
      return points[i];
    }
    const ContactPoint &
    operator[](const Eigen::Index i) const
    {
      return points[static_cast<std::size_t>(i)];
    }

    /** The nodes of all contacts, also those without a point. */
    const std::vector<pairing::ContactNode> &
    nodes() const
    {
      return found_again.empty() ? bodies.contact_nodes : found_again;
    }
    /**
     * Takes nodes that were found again (finite sliding), in the same order.
     * Points keep their unknowns; returns why supports do not allow for that.
     */
    std::string
    relink(std::vector<pairing::ContactNode> nodes,
           const std::vector<double>        &times);

    /** Coefficients of all candidates from here on. */
    void
    set_friction(const Eigen::VectorXd &mu);

    /** Offsets `first` and coefficients `mu` of all unknowns; no matrix. */
    const solvers::ContactSystem &
    layout() const
    {
      return contact_layout;
    }
    Eigen::Index
    n_unknowns() const
    {
      return contact_layout.n_unknowns();
    }

    /** Candidates, and behind them those that are bound. */
    const std::vector<ContactPoint> &
    all() const
    {
      return points;
    }
    std::size_t
    n_bound() const
    {
      return points.size() - n_candidates;
    }
    /** Unknowns of those that are bound. */
    Eigen::Index
    n_bound_unknowns() const
    {
      return n_all - n_unknowns();
    }
    Eigen::Index
    n_all_unknowns() const
    {
      return n_all;
    }

    /**
     * Displacements of all unknowns at time t, those of candidates first.
     */
    template <typename DisplacementAt>
    Eigen::VectorXd
    components(const DisplacementAt &at, const double t) const
    {
      Eigen::VectorXd q(n_all);
      Eigen::Index    k = 0;
      for (const ContactPoint &point : points)
        {
          const Tensor<1, 3> v = relative_displacement(*point.node, at, t);
          for (const Tensor<1, 3> &direction : point.dual)
            q[k++] = v * direction;
        }
      return q;
    }
    /** Gaps that what is bound closes, in its unknowns. */
    Eigen::VectorXd
    gaps_to_close() const;

    /** Whether contacts are found again on displaced bodies. */
    bool
    slide() const;

    /** What supports and other contacts do to contact nodes. */
    struct Traits
    {
      unsigned int n_held = 0; ///< nodes whose normal a support holds
      bool         has_prescribed_slip = false; ///< along what supports hold
      bool         shares_nodes        = false; ///< a node has several points
    };
    const Traits &
    traits() const
    {
      return found_traits;
    }

  private:
    bool
    slides_along_supports(const NodeRule             &rule,
                          const pairing::ContactNode &node,
                          const std::vector<double>  &times) const;
    /** Both return why a node cannot be taken, as supports hold it. */
    std::string
    add_all(const std::vector<double> &times);
    std::string
    add(const pairing::ContactNode &node, const std::vector<double> &times);
    void
    add_spring(const pairing::ContactNode &node);
    void
    add_bound(const pairing::ContactNode &node);
    void
    number();

    const model::Bodies              &bodies;
    const NodeRules                  &supports;
    std::vector<pairing::ContactNode> found_again;
    std::vector<ContactPoint>         points;
    std::size_t                       n_candidates = 0;
    Eigen::Index                      n_all        = 0;
    solvers::ContactSystem            contact_layout;
    Traits                            found_traits;
  };
} // namespace conetact::contact

#endif
