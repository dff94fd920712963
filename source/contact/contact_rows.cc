// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_rows.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace conetact::contact
{
  namespace
  {
    /** (n, t1, t2) components of a vector in space. */
    Tensor<1, 3>
    in_frame(const model::ContactRow &row, const Tensor<1, 3> &v)
    {
      return Tensor<1, 3>({v * row.normal, v * row.t1, v * row.t2});
    }

    /** The tangential displacement that contact unknowns span, sum_k v_k d_k
     * over the tangents. */
    Tensor<1, 3>
    tangential(const ContactPoint &point, const Eigen::VectorXd &v)
    {
      Tensor<1, 3> sum;
      for (std::size_t k = 0; k + 1 < point.directions.size(); ++k)
        sum +=
          v[point.first + static_cast<Eigen::Index>(k)] * point.directions[k];
      return sum;
    }

    /** The rest of a relative displacement, which solvers do not see: along
     * frictionless directions, and held ones without slip. */
    Tensor<1, 3>
    other_tangential(const ContactPoint &point, const Tensor<1, 3> &relative)
    {
      Tensor<1, 3> rest = relative;
      for (std::size_t k = 0; k < point.directions.size(); ++k)
        rest -= (relative * point.dual[k]) * point.directions[k];
      return rest;
    }

    /**
     * The point where the reaction acts on the other side, undeformed and not
     * moved. A node that was found again at `moved` meets an obstacle at node +
     * moved - (gap + n.moved) n. One that meets nothing stays where it is.
     */
    Point<3>
    foot_of(const model::Bodies &bodies, const pairing::ContactNode &node)
    {
      if (node.meets_nothing())
        return node.position;
      if (node.masters.empty())
        return node.position + node.moved -
               (node.gap + node.n * node.moved) * node.n;
      Point<3> p;
      for (const auto &[master, weight] : node.masters)
        p += weight *
             Tensor<1, 3>(bodies.structures[node.master]->position(master));
      return p;
    }

    /** Of itself: slips that are less of a displacement are what solvers leave.
     */
    constexpr double known_to = 1e-11;

    /** The point where it acts on its own side, a mean over slaves. */
    Point<3>
    acting_at(const model::Bodies &bodies, const pairing::ContactNode &node)
    {
      Tensor<1, 3> off;
      pairing::for_each_slave(
        node, [&](const unsigned int i, const double weight) {
          off += weight *
                 (bodies.structures[node.body]->position(i) - node.position);
        });
      return node.position + off;
    }
  } // namespace

  ContactRows::ContactRows(const ContactModel              &m,
                           const std::vector<unsigned int> &sides)
    : model(m)
    , master_side(sides)
    , other_before(m.points.all().size())
  {
    last.reserve(model.points.all().size());
    for (const ContactPoint &point : model.points.all())
      {
        model::ContactRow row;
        row.gap = point.node->gap;
        place(*point.node, row);
        last.push_back(row);
      }
  }

  void
  ContactRows::place(const pairing::ContactNode &node,
                     model::ContactRow          &row) const
  {
    row.contact  = node.contact;
    row.node     = node.node;
    row.position = node.position;
    row.normal   = node.n;
    row.area     = node.couples ? 0. : node.covered_area();
    row.faces    = !node.meets_nothing();
    row.couples  = node.couples;
    row.foot     = foot_of(model.bodies, node);
    row.acts     = acting_at(model.bodies, node);
    // Tables name the normal only: whoever reads them knows its tangents.
    std::tie(row.t1, row.t2) = pairing::tangents(node.n, model.bodies.dim);
  }

  /* Tables have changes in frames of contacts: what was moved so far is told in
     those of the nodes that were found again. */
  void
  ContactRows::relink()
  {
    AssertDimension(last.size(), model.points.all().size());
    const auto at = [&](const unsigned int body, const unsigned int node) {
      return model.displacement(*last_u, body, node);
    };
    for (std::size_t i = 0; i < last.size(); ++i)
      {
        const ContactPoint         &point = model.points.all()[i];
        const pairing::ContactNode &node  = *point.node;
        place(node, last[i]);
        if (!last_u)
          continue;
        // Increments of tables are differences: both ends must be told in one
        // frame, that of the increment.
        const Tensor<1, 3> v = relative_displacement(node, at, last_t);
        last[i].u            = in_frame(last[i], v);
        other_before[i]      = in_frame(last[i], other_tangential(point, v));
      }
  }

  std::vector<model::ContactRow>
  ContactRows::rows(const solvers::ContactState &state,
                    const Eigen::VectorXd       &q,
                    const Eigen::VectorXd       &r_bound,
                    const SharedVector          &u,
                    const double                 t,
                    const bool                   whole,
                    const KeptByLaws            &kept)
  {
    AssertDimension(state.r.size(), model.points.n_unknowns());
    AssertDimension(r_bound.size(), model.points.n_bound_unknowns());
    AssertDimension(state.node.size(), model.points.size());
    AssertDimension(u->size(), model.coordinates.n_dofs());
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    AssertDimension(q.size(), model.points.n_unknowns());
    const ContactPoints &points = model.points;
    Eigen::VectorXd      r(points.n_all_unknowns());
    r << state.r, r_bound;
    std::vector<model::ContactRow> rows = last;
    const auto at = [&](const unsigned int body, const unsigned int node) {
      return model.displacement(*u, body, node);
    };
    for (std::size_t i = 0; i < rows.size(); ++i)
      {
        const ContactPoint         &point = points.all()[i];
        const pairing::ContactNode &node  = *point.node;
        model::ContactRow          &row   = rows[i];
        const Tensor<1, 3>          other =
          in_frame(row,
                   other_tangential(point, relative_displacement(node, at, t)));
        if (i < points.size())
          {
            set_candidate(i, state, q, other, row);
            if (kept.wear != nullptr)
              set_kept(i, kept, row);
          }
        else
          set_bound(point, other, row);
        if (node.growth)
          row.u[0] -= node.growth(t); // a gap that grows moves nothing
        row.du[0]       = row.u[0] - last[i].u[0];
        row.reaction    = in_frame(row, force_of(point, r));
        other_before[i] = other;
        // Solvers see no slip of nodes without cone, and of parts only that of
        // the last: the sum of all parts tells, as far as it is no rounding of
        // positions.
        if ((point.dual.size() == 1 || (!whole && i < points.size())) &&
            row.state != solvers::NodeState::open)
          row.state = std::hypot(row.du[1], row.du[2]) >
                          solvers::position_rounding *
                              (row.position.norm() + node.spacing) +
                            known_to * at(node.body, node.node).norm() ?
                        solvers::NodeState::slip :
                        solvers::NodeState::stick;
        row.wet    = i < kept.wet.size() && kept.wet[i];
        row.bonded = i < kept.whole.size() && kept.whole[i] &&
                     row.state == solvers::NodeState::stick;
      }
    last   = rows;
    last_u = u;
    last_t = t;
    append_masters(rows, kept.wear);
    return rows;
  }

  /* Row 0 of a run, without displacements and forces: only gaps differ. */
  std::vector<model::ContactRow>
  ContactRows::undeformed() const
  {
    std::vector<model::ContactRow> rows = last;
    for (std::size_t i = model.points.size(); i < rows.size(); ++i)
      rows[i].state = solvers::NodeState::stick; // what equations bind
    append_masters(rows);
    return rows;
  }

  /* Places, normals and areas are made anew from the scene; what the next
     increment is a change from must come from the file. */
  void
  ContactRows::save(Archive &archive) const
  {
    std::vector<double>       gaps, states;
    std::vector<Tensor<1, 3>> u, du, reactions;
    for (const model::ContactRow &row : last)
      {
        gaps.push_back(row.gap);
        states.push_back(static_cast<double>(row.state));
        u.push_back(row.u);
        du.push_back(row.du);
        reactions.push_back(row.reaction);
      }
    archive.put("rows/gaps", gaps);
    archive.put("rows/states", states);
    archive.put("rows/u", u);
    archive.put("rows/du", du);
    archive.put("rows/reactions", reactions);
    archive.put("rows/other", other_before);
  }

  void
  ContactRows::restore(const Archive      &archive,
                       const SharedVector &displacements,
                       const double        t)
  {
    AssertDimension(displacements->size(), model.coordinates.n_dofs());
    last_u = displacements;
    last_t = t;
    std::vector<double>       gaps(last.size()), states(last.size());
    std::vector<Tensor<1, 3>> u(last.size()), du(u), reactions(u);
    archive.fill("rows/gaps", gaps);
    archive.fill("rows/states", states);
    archive.fill("rows/u", u);
    archive.fill("rows/du", du);
    archive.fill("rows/reactions", reactions);
    archive.fill("rows/other", other_before);
    for (std::size_t i = 0; i < last.size(); ++i)
      {
        place(*model.points.all()[i].node, last[i]);
        last[i].gap      = gaps[i];
        last[i].state    = static_cast<solvers::NodeState>(states[i]);
        last[i].u        = u[i];
        last[i].du       = du[i];
        last[i].reaction = reactions[i];
      }
  }

  void
  ContactRows::set_candidate(const std::size_t            i,
                             const solvers::ContactState &state,
                             const Eigen::VectorXd       &q,
                             const Tensor<1, 3>          &other,
                             model::ContactRow           &row) const
  {
    AssertIndexRange(i, state.node.size());
    AssertIndexRange(model.points[i].normal(), state.v.size());
    const ContactPoint &point = model.points[i];
    row.gap                   = state.v[point.normal()];
    row.u                     = in_frame(row, tangential(point, q)) + other;
    // The normal part is the solver's own: where the gap is closed, u_n is -g0
    // to the last digit.
    row.u[0] = q[point.normal()];
    row.du =
      in_frame(row, tangential(point, state.v)) + (other - other_before[i]);
    row.state = state.node[i];
  }

  void
  ContactRows::set_kept(const std::size_t  i,
                        const KeptByLaws  &kept,
                        model::ContactRow &row) const
  {
    AssertIndexRange(i, static_cast<std::size_t>(kept.wear->worn().size()));
    AssertDimension(kept.fracture.size(), kept.wear->worn().size());
    const auto  &layer = model.points[i].node->layer;
    const auto   k     = static_cast<Eigen::Index>(i);
    const double share = layer ? layer->share_of_slave() : 0.;
    row.wear           = share * kept.wear->worn()[k];
    row.removed        = kept.wear->removed()[k];
    row.fracture       = kept.fracture[k];
  }

  /* A closed gap and its displacement are exact, to the last digit, where
     equations bind: differences of displacements of bodies would not be. */
  void
  ContactRows::set_bound(const ContactPoint &point,
                         const Tensor<1, 3> &other,
                         model::ContactRow  &row)
  {
    const pairing::ContactNode &node   = *point.node;
    const Tensor<1, 3>          before = row.u;
    row.gap                            = node.closes ? 0. : node.gap;
    row.u                              = other;
    row.u[0]                           = node.closes ? -node.gap : 0.;
    row.du                             = row.u - before;
    row.state                          = solvers::NodeState::stick;
  }

  namespace
  {
    /** Means over slaves, in space. */
    struct Means
    {
      Tensor<1, 3> normal, u, du;
      double       gap = 0, weight = 0;

      void
      add(const double share, const model::ContactRow &row)
      {
        weight += share;
        gap += share * row.gap;
        // The normal of the master points to the slave, the other way, and so
        // do displacements: those of the master relative to the slave.
        normal -= share * row.normal;
        u -= share * row.in_space(row.u);
        du -= share * row.in_space(row.du);
      }
    };

    /** Weights below that are the rounding of feet that stand on another node.
     */
    constexpr double weight_rounding = 1e-6;

    /** What slaves hand on to a master node. */
    struct SumOfSlaves
    {
      model::ContactRow row;
      Tensor<1, 3>      reaction, pressing; // in space
      Means             weighed, plain;
      double            largest = 0, most_carried = 0;
      /** That of all slaves; none: they differ, or there is none yet. */
      std::optional<solvers::NodeState> common;
      bool                              any = false;

      /** A master meets several nodes: it has the state of the one that it
       * carries most of, the first of those that are alike but for rounding. */
      void
      judge(const double share, const model::ContactRow &slave)
      {
        constexpr double more    = 1 + 1e-9;
        const double     carried = share * slave.reaction.norm();
        if (carried > more * most_carried)
          {
            most_carried = carried;
            row.state    = slave.state;
          }
        if (share <= weight_rounding)
          return;
        if (!any)
          common = slave.state;
        else if (common != slave.state)
          common.reset();
        any = true;
      }

      /** A slave with this weight w on the master. */
      void
      add(const double weight, const model::ContactRow &slave)
      {
        judge(std::abs(weight), slave);
        if (weight > largest)
          row.normal = -slave.normal;
        largest = std::max(largest, weight);
        row.area += weight * slave.area;
        // Weights are a little below zero beside a face that is overhung.
        // Forces add up with their sign, or the body would not balance; means
        // need weights above zero.
        const double share = std::abs(weight);
        weighed.add(share, slave);
        plain.add(1, slave);
        reaction -= weight * slave.in_space(slave.reaction);
        pressing -= share * slave.in_space(slave.reaction);
        row.covered += share * slave.area;
      }

      /** `force`: the largest reaction of a slave of the contact. */
      model::ContactRow
      finished(const unsigned int dim, const double force)
      {
        // The rounding of weights says nothing of whose means these are, that
        // of forces nothing of who is carried.
        constexpr double rounding = 1e-10;
        const bool       is_met   = weighed.weight > weight_rounding;
        const Means     &means    = is_met ? weighed : plain;
        if (!is_met || most_carried <= rounding * force)
          row.state = common.value_or(solvers::NodeState::open);
        // Where slaves meet it from opposite sides their normals have no mean.
        if (means.normal.norm() > weight_rounding * means.weight)
          row.normal = means.normal / means.normal.norm();
        std::tie(row.t1, row.t2) = pairing::tangents(row.normal, dim);
        const auto in_row        = [&](const Tensor<1, 3> &v) {
          return Tensor<1, 3>({v * row.normal, v * row.t1, v * row.t2});
        };
        row.gap      = means.gap / means.weight;
        row.u        = in_row(means.u / means.weight);
        row.du       = in_row(means.du / means.weight);
        row.reaction = in_row(reaction);
        row.pressing = in_row(pressing);
        return row;
      }
    };
  } // namespace

  /* A row for each master node: its reaction and area are the sums of what its
     slaves hand on, by the weights w of their rows; its gap and displacements
     are means over |w|. Its depth of wear is its own. */
  void
  ContactRows::append_masters(std::vector<model::ContactRow> &rows,
                              const Wear *const               wear) const
  {
    AssertDimension(rows.size(), last.size());
    // Keys are contact and node: a master of two contacts has a row in each.
    std::map<std::pair<unsigned int, unsigned int>, SumOfSlaves> sums;
    std::map<unsigned int, double>                               forces;
    for (std::size_t i = 0; i < last.size(); ++i)
      {
        const pairing::ContactNode &node = *model.points.all()[i].node;
        if (node.obstacle != nullptr)
          continue; // a free one is no body with nodes to be told
        double &force = forces[last[i].contact];
        force         = std::max(force, last[i].reaction.norm());
        for (const auto &[master, weight] : node.masters)
          if (weight != 0) // a node that takes no part has no normal
            {
              SumOfSlaves &sum = sums[{last[i].contact, master}];
              sum.add(weight, last[i]);
              sum.row.node = master;
              sum.row.position =
                model.bodies.structures[node.master]->position(master);
            }
      }
    for (auto &[key, sum] : sums)
      {
        sum.row.contact = master_side[key.first];
        sum.row.master  = true;
        if (wear != nullptr && wear->sides() != nullptr)
          sum.row.wear =
            wear->sides()->depth(key.first, key.second, wear->of_sides());
        sum.row.foot = sum.row.acts = sum.row.position;
        rows.push_back(sum.finished(model.bodies.dim, forces[key.first]));
      }
  }
} // namespace conetact::contact
