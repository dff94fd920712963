// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/mortar.h"

#include "conetact/pairing/corner_parts.h"
#include "conetact/pairing/dual_functions.h"
#include "conetact/pairing/face_integrals.h"
#include "conetact/pairing/master_normals.h"
#include "conetact/pairing/mortar_rows.h"
#include "conetact/pairing/node_to_face.h"
#include "conetact/pairing/steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace conetact::pairing
{
  namespace
  {
    using Eigen::Index;

    /**
     * A slave face sees nothing where its shape functions integrate to less
     * than this part of its size squared (in the plane: of its size), times the
     * radius round an axis: clipping leaves such parts by rounding.
     */
    constexpr double least_covered = 1e-12;
    /** A node up to this far beyond a rim, in sizes of its face, still faces
     * the master: coordinates of mesh files have six to eight digits. */
    constexpr double face_overhang = 1e-2;
    /** A node that faced the master where bodies stood last does so up to this
     * overhang, in sizes of its face. Without the difference, contacts that
     * slide would be found with the node and without it in turn. */
    constexpr double face_overhang_of_faced = .1;
    /** Where nodes have faced the master, faces are opposed up to so many times
     * the angle: those that turn by just this angle would be found by turns. */
    constexpr double turn_of_faced = 2;
    /**
     * Dual functions change their sign: where little of a face is seen, the
     * mean gap that they weigh may be below all gaps there. This part of the
     * size of the master's faces is what it may be below them.
     */
    constexpr double beyond_seen = .01;

    Tensor<1, 3>
    to_tensor(const Eigen::RowVector3d &v)
    {
      return Tensor<1, 3>({v[0], v[1], v[2]});
    }

    /**
     * The mean cosine c = -n . int psi_j n_s / D_j of the normals n_s of a bent
     * slave with that of the row, which points the other way. A uniform
     * pressure p does the work p D_j w in a way w along all of these normals,
     * of which the row sees c w: so its reaction is p D_j / c, as that of a
     * flat area D_j / c.
     */
    double
    mean_cosine(const MortarRow &row, const Tensor<1, 3> &n)
    {
      if (row.slave_normals.norm() == 0)
        return 1;
      return bounded_cosine(-(row.slave_normals * n) / row.area);
    }

    /**
     * Sums the integrals of all slave faces up to D_j and M_jl of the nodes'
     * rows (mortar.h). Faces with nodes beyond a rim come last: which of these
     * nodes have functions is known only when all faces around them were
     * integrated.
     */
    class Mortar
    {
    public:
      Mortar(const Contact                                &c,
             const std::vector<const bodies::Structure *> &s,
             const std::set<unsigned int>                 &last)
        : contact(c)
        , structures(s)
        , faced(last)
        , one_by_one(contact, structures)
        , slave(*structures[contact.body], one_by_one.slave_surface())
        , facing(one_by_one.master_surface())
        , normals(structures[contact.master]->surface(contact.master_ids),
                  slave.all(),
                  facing.faces(),
                  contact.sharp_edge)
        , axisymmetric(structures[contact.body]->is_axisymmetric())
        , rows(slave.all(), contact.sharp_edge, axisymmetric)
        , thickness(
            thickness_of(one_by_one.slave_surface(), slave.all(), axisymmetric))
      {
        SeenParts parts = look_around();
        for (std::size_t f = 0; f < slave.all().size(); ++f)
          meet(f, std::exchange(parts[f], {}));
        if (!at_rims.empty())
          rows.keep_upright(*structures[contact.body]);
        for (const auto &[f, sums] : at_rims)
          add(f, sums);
        note_seen();
        // Hanging nodes first: what they give may be next to nothing.
        rows.give_up(structures[contact.body]->hanging_nodes());
        rows.give_up_beyond_rims();
      }

      PairedNodes
      nodes()
      {
        std::multimap<unsigned int, const MortarRow *> rows_of;
        // Finite sliding finds the rows of a node again by their order: there
        // must be as many wherever it is, so those without area stay, apart.
        for (const MortarRow &row : rows.all())
          if (row.area > 0 || contact.slides)
            rows_of.emplace(row.node, &row);
        PairedNodes found;
        for (const bodies::SurfaceNode &s : one_by_one.slave_surface().nodes)
          {
            if (one_by_one.is_joined(s.node) || !rows.has(s.node))
              continue;
            const auto [begin, end]  = rows_of.equal_range(s.node);
            const std::size_t before = found.nodes.size();
            for (auto row = begin; row != end; ++row)
              found.nodes.push_back(
                row->second->area > 0 ?
                  mean(s, *row->second) :
                  one_by_one.apart(s,
                                   row->second->normal /
                                     row->second->normal.norm()));
            // Edges and corners that meet a face are seen by no face.
            std::optional<ContactNode> edge;
            if (seen.count(s.node) == 0)
              edge = one_by_one.find(s);
            ++found.n_nodes;
            found.n_paired += edge || seen.count(s.node) > 0;
            if (edge && contact.slides) // as many rows wherever it slides
              found.nodes[before] = std::move(*edge);
            else if (edge)
              found.nodes.push_back(std::move(*edge));
          }
        found.deepest = one_by_one.deepest_node();
        return found;
      }

    private:
      /**
       * Facets of a smooth surface turn by up to the angle of a sharp edge:
       * those of two surfaces that touch differ by half of it. Normals at just
       * this angle may meet, whatever their rounding.
       */
      MasterSurface::Limits
      limits(const double face_size) const
      {
        const double opposed =
          .5 * contact.sharp_edge * (faced.empty() ? 1. : turn_of_faced);
        return {contact.reach,
                std::cos(std::min(contact.largest_angle, opposed)) - 1e-12,
                interference_allowed(contact, face_size),
                contact.body != contact.master};
      }

      /** What slave faces see of the master, but for steps behind it. */
      SeenParts
      look_around() const
      {
        SeenParts parts;
        for (const FaceNet::Face &face : slave.all())
          {
            const ProjectionPlane plane = plane_of(face);
            parts.push_back(facing.seen_from(
              face, plane, ProjectedFace(face, plane), limits(face.size)));
          }
        leave_out_steps(slave.all(), facing.faces(), parts);
        return parts;
      }

      /** Which nodes of a face are over a part of it that is seen. */
      std::vector<bool>
      facing_nodes(const FaceNet::Face                  &face,
                   const std::vector<FacingParts::Part> &parts) const
      {
        const ProjectionPlane plane = plane_of(face);
        std::vector<bool>     are;
        for (std::size_t c = 0; c < face.n_functions; ++c)
          {
            const double beyond = face.size * (faced.count(face.nodes[c]) > 0 ?
                                                 face_overhang_of_faced :
                                                 face_overhang);
            const Point<2> place =
              plane.project(structures[contact.body]->position(face.nodes[c]));
            are.push_back(std::any_of(
              parts.begin(), parts.end(), [&](const FacingParts::Part &part) {
                return distance(part.where, place) <= beyond;
              }));
          }
        return are;
      }

      /** Faces that reach beyond a rim wait until it is known which of their
       * nodes face the master. */
      void
      meet(const std::size_t f, const std::vector<FacingParts::Part> &parts)
      {
        const FaceNet::Face &face = slave.all()[f];
        FaceIntegrals        sums =
          integrate(face, parts, facing.faces(), axisymmetric);
        sums.facing         = facing_nodes(face, parts);
        const double around = axisymmetric ? face.centre[0] : 1;
        if (!(sums.areas.sum() >
              around * least_covered *
                std::pow(face.size, face.corners.size() == 2 ? 1 : 2)))
          return;
        rows.join(f);
        const Eigen::VectorXd covered = sums.linear * sums.areas;
        for (std::size_t c = 0; c < face.n_functions; ++c)
          {
            MortarRow &row = rows.at(f, c);
            if (one_by_one.is_joined(face.nodes[c])) // none of the contact
              {
                sums.facing[c] = false;
                continue;
              }
            row.covered += covered[static_cast<Index>(c)];
            row.kept = row.kept || sums.facing[c];
          }
        if (std::all_of(sums.facing.begin(),
                        sums.facing.end(),
                        [](const bool is_facing) { return is_facing; }))
          add(f, sums);
        else
          at_rims.emplace_back(f, std::move(sums));
      }

      /** Nodes of a face that have functions of their own; if none is kept, the
       * one that sees most of the master. */
      std::vector<Index>
      kept(const std::size_t f, const Eigen::VectorXd &areas)
      {
        // The first of equals is taken, whatever the rounding of their areas.
        constexpr double   rounding = 1e-9;
        std::vector<Index> own;
        Index              most = 0;
        for (Index j = 0; j < areas.size(); ++j)
          {
            if (rows.at(f, static_cast<std::size_t>(j)).kept)
              own.push_back(j);
            if (areas[j] > (1 + rounding) * areas[most])
              most = j;
          }
        return own.empty() ? std::vector<Index>{most} : own;
      }

      /**
       * The functions psi_j of a face, rows in terms of its N_k, dual on the
       * part that is covered. Those that are dual on the whole face would leave
       * D with entries beside its diagonal where a face is covered in part:
       * reactions would no longer have one node each.
       */
      static Eigen::MatrixXd
      dual_to(const FaceIntegrals &sums, const std::vector<Index> &own)
      {
        const Eigen::MatrixXd &linear = sums.linear;
        // On less of a face the functions of second degree are much alike, and
        // what corner_functions() solves with, their mass, is nearly singular.
        constexpr double enough = .5;
        if (linear.rows() < linear.cols() && sums.part > enough &&
            static_cast<Index>(own.size()) == linear.rows())
          return corner_functions(sums.mass, linear);
        return dual_functions(linear * sums.mass * linear.transpose(),
                              linear * sums.areas,
                              own) *
               linear;
      }

      /**
       * Adds a face to the rows of its kept nodes: psi_j = sum_k A_jk N_k, so
       * D, M and the means of normals are A (`dual`) times integrals of the
       * N_k.
       */
      void
      add(const std::size_t f, const FaceIntegrals &sums)
      {
        const FaceNet::Face     &face   = slave.all()[f];
        const std::vector<Index> own    = kept(f, sums.linear * sums.areas);
        const Eigen::MatrixXd    dual   = dual_to(sums, own);
        const Eigen::MatrixXd    slaves = dual * sums.mass;
        for (const Index j : own)
          {
            MortarRow &row = rows.at(f, static_cast<std::size_t>(j));
            row.area += dual.row(j) * sums.areas;
            row.size   = std::max(row.size, sums.size);
            row.lowest = std::min(row.lowest, sums.lowest);
            for (std::size_t k = 0; k < face.nodes.size(); ++k)
              row.slaves[face.nodes[k]] += slaves(j, static_cast<Index>(k));
            for (const auto &[node, integrals] : sums.masters)
              row.masters[node] += dual.row(j) * integrals;
            row.slave_normals += to_tensor(dual.row(j) * sums.slave_normals);
            row.master_normals += to_tensor(dual.row(j) * sums.master_normals);
          }
      }

      /** Nodes of faces that see the master. */
      void
      note_seen()
      {
        for (const MortarRow &row : rows.all())
          if (!row.neighbours.empty())
            seen.insert(row.node);
      }

      /** Makes a contact node of a row, with the weights of v_j = D_j^-1 (sum_k
       * int psi_j N_k u_k - sum_l M_jl u_l). */
      ContactNode
      mean(const bodies::SurfaceNode &s, const MortarRow &row)
      {
        ContactNode node = one_by_one.free_node(s);
        node.is_mean     = true;
        node.master      = contact.master;
        node.masters     = weights_of(row.masters, row.area);
        node.n           = normal(row, node.masters);
        node.mean_cosine = mean_cosine(row, node.n);
        node.area        = thickness * row.area / node.mean_cosine;
        node.slaves      = weights_of(row.slaves, row.area);
        // Biorthogonal functions leave a node its own displacement alone,
        // unless it took over what others gave up.
        if (node.slaves.size() == 1)
          node.slaves.clear();
        // A prescribed gap is a way along all normals of a bent face.
        node.gap = contact.gap ?
                     node.mean_cosine * one_by_one.prescribed_gap(node) :
                     undeformed_distance(node, structures) * node.n;
        if (contact.kind == ContactKind::contact && !contact.gap)
          node.gap = std::max(node.gap, row.lowest - beyond_seen * row.size);
        if (structures[contact.body]->meets_at_corners())
          node.least_gap = row.lowest;
        if (!contact.gap)
          one_by_one.judge(node, std::max(node.spacing, row.size));
        return node;
      }

      /**
       * The normal of a row, between those of both sides. That of a bent side
       * is the mean over the row's own functions, at rims as well; that of
       * another one the sum over the slave's faces, or the mean over the
       * master's nodes.
       */
      Tensor<1, 3>
      normal(const MortarRow                                    &row,
             const std::vector<std::pair<unsigned int, double>> &masters) const
      {
        const Tensor<1, 3> &own =
          row.slave_normals.norm() > 0 ? row.slave_normals : row.normal;
        return normals.between(row.node,
                               own / own.norm(),
                               masters,
                               row.master_normals);
      }

      const Contact                                &contact;
      const std::vector<const bodies::Structure *> &structures;
      const std::set<unsigned int>                 &faced;
      NodeToFace                                    one_by_one;
      FaceNet                                       slave;
      FacingParts                                   facing;
      MasterNormals                                 normals; ///< if it slides
      bool                                          axisymmetric;
      MortarRows                                    rows;
      double                                        thickness;
      std::set<unsigned int>                        seen;
      std::vector<std::pair<std::size_t, FaceIntegrals>> at_rims; ///< of faces
    };
  } // namespace

  PairedNodes
  pair_by_mortar(const Contact                                &contact,
                 const std::vector<const bodies::Structure *> &structures)
  {
    return pair_by_mortar(contact, structures, {});
  }

  PairedNodes
  pair_by_mortar(const Contact                                &contact,
                 const std::vector<const bodies::Structure *> &structures,
                 const std::set<unsigned int>                 &faced)
  {
    return Mortar(contact, structures, faced).nodes();
  }
} // namespace conetact::pairing
