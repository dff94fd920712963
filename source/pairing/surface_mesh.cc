// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// A solid whose surface is the faces of a file.

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/placement.h"
#include "conetact/bodies/rigid_body.h"
#include "conetact/pairing/face_net.h"
#include "conetact/pairing/facets.h"
#include "conetact/pairing/obstacle_entries.h"
#include "conetact/pairing/obstacle_shapes.h"
#include "conetact/pairing/surface_files.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

namespace conetact::pairing
{
  namespace
  {
    using Handler = dealii::ParameterHandler;
    using Shape   = std::unique_ptr<ObstacleShape>;

    /** A point nearer to a face than this part of its size is on it. */
    constexpr double on_face = 1e-12;

    /** Faces whose normals differ by less are one. */
    constexpr double same_plane = 1e-9;

    /**
     * Twice the area as a vector along the outward normal, in 2D the length: a
     * x b of two edges, of a quadrilateral that of its diagonals, which is
     * right for warped ones as well.
     */
    Tensor<1, 3>
    normal_of(const SurfaceFaces &mesh, const std::vector<unsigned int> &face)
    {
      const auto at = [&](const std::size_t i) { return mesh.points[face[i]]; };
      if (face.size() == 2)
        {
          const Tensor<1, 3> along = at(1) - at(0);
          return Tensor<1, 3>({along[1], -along[0], 0.});
        }
      return face.size() == 3 ? cross_product_3d(at(1) - at(0), at(2) - at(0)) :
                                cross_product_3d(at(2) - at(0), at(3) - at(1));
    }

    using Ends = std::pair<unsigned int, unsigned int>;

    /**
     * Where the surface goes on from each face: an edge of a face that runs
     * from a to b must run from b to a in one other face; in the plane one line
     * must begin where another ends.
     */
    void
    check_closed(const SurfaceFaces &mesh, const std::string &in)
    {
      std::map<Ends, int> edges; // how many run that way
      for (const auto &face : mesh.faces)
        if (face.size() == 2)
          {
            // 0 stands for the line, points count from 1
            ++edges[{face[0] + 1, 0}];
            ++edges[{0, face[1] + 1}];
          }
        else
          for (std::size_t i = 0; i < face.size(); ++i)
            ++edges[{face[i], face[(i + 1) % face.size()]}];
      const bool plane = mesh.faces[0].size() == 2;
      for (const auto &[ends, n] : edges)
        {
          const auto back   = edges.find({ends.second, ends.first});
          const int  n_back = back == edges.end() ? 0 : back->second;
          if (n == 1 && n_back == 1)
            continue;
          const Point<3> &a =
            mesh.points[plane ? std::max(ends.first, ends.second) - 1 :
                                ends.first];
          throw InputError(
            in +
            (n + n_back == 1 ?
               "is open: it has a rim at " :
             n + n_back == 2 ?
               "has faces whose corners run in opposite senses at " :
               "has more than two faces that meet at ") +
            to_text(a) +
            ". Only a closed surface tells inside from outside: repair it in "
            "the program that wrote it.");
        }
    }

    /** The volume, in the plane the area, times 6 (2): sum of x . n over faces
     * (divergence theorem), positive with outward normals. */
    double
    volume(const SurfaceFaces &mesh)
    {
      // Arms are about a point of it, or digits would go with the distance.
      const Point<3> &about = mesh.points[mesh.faces[0][0]];
      double          sum   = 0;
      for (const auto &face : mesh.faces)
        for (std::size_t i = 2; i < std::max<std::size_t>(face.size(), 3); ++i)
          if (face.size() == 2)
            sum += (mesh.points[face[0]] - about) * normal_of(mesh, face);
          else
            sum += (mesh.points[face[0]] - about) *
                   normal_of(mesh, {face[0], face[i - 1], face[i]});
      return sum;
    }

    /**
     * A surface tells inside from outside if it is closed, has areas, and looks
     * outwards: each of these is refused with a place in it.
     */
    void
    check(const SurfaceFaces &mesh, const std::string &in)
    {
      for (const auto &face : mesh.faces)
        {
          const Tensor<1, 3> normal  = normal_of(mesh, face);
          double             longest = 0;
          for (const unsigned int i : face)
            longest =
              std::max(longest, mesh.points[i].distance(mesh.points[face[0]]));
          if (normal.norm() <=
              1e-10 * (face.size() == 2 ? longest : longest * longest))
            throw InputError(in + "has a face without area at " +
                             to_text(mesh.points[face[0]]) +
                             ". Repair it in the program that wrote it.");
        }
      check_closed(mesh, in);
      if (volume(mesh) <= 0)
        throw InputError(in +
                         "has its normals inside out: the corners of its faces "
                         "do not run counter-clockwise seen from outside. "
                         "Turn the faces round in the program that wrote it.");
    }



    class SurfaceMesh : public ObstacleShape
    {
    public:
      /** `of_file` is what a user must know of it, a sentence or nothing. */
      SurfaceMesh(const SurfaceFaces &mesh, std::string of_file)
        : caution(std::move(of_file))
        , net(bodies::RigidBody(3, Point<3>(), mesh.points), surface_of(mesh))
      {}

      const std::string caution;

      double
      sagitta_at(const Point<3> &p) const
      {
        if (!facets)
          facets.emplace(net.all());
        return facets->of_face(net.nearest(p).face);
      }

      /* On a face its normal, at edges and corners the direction to the node:
         gaps are then distances, and no node jumps where faces meet. */
      Closest
      closest(const Point<3> &p, const double) const override
      {
        const FaceNet::Closest at      = net.nearest(p);
        const auto             feature = net.feature(at, p);
        const Tensor<1, 3>     arm     = p - at.point;
        if (feature.size() <= 1)
          return {arm * at.normal, at.normal};
        // At an edge or a corner the direction to the node is the normal, and
        // the faces together tell the side.
        const Tensor<1, 3> mean = net.sum_of_normals(feature);
        if ((mean / mean.norm() - at.normal).norm() < same_plane)
          return {arm * at.normal, at.normal};
        if (at.distance <= on_face * (net.all()[at.face].size + p.norm()))
          return {0, mean / mean.norm()};
        const double side = arm * mean < 0 ? -1 : 1;
        return {side * at.distance, side / at.distance * arm};
      }
      static void
      declare(Handler &prm)
      {
        declare_shape_placement(prm);
        prm.declare_entry("File",
                          "",
                          dealii::Patterns::Anything(),
                          "surface mesh: file of its faces, relative to the "
                          "scene's folder: STL (.stl), Wavefront (.obj), or "
                          "triangles and quadrilaterals, in 2D lines, of Gmsh "
                          "(.msh). The surface must be closed, with corners "
                          "counter-clockwise seen from outside.");
      }
      static Shape
      create(Handler &prm, const unsigned int dim, const std::string &in)
      {
        const std::string file = prm.get("File");
        if (file.empty())
          throw InputError(in + "File is empty. Give a file of faces, .stl, "
                                ".obj or .msh.");
        SurfaceFaces            mesh = read_surface(file, dim, in + "File");
        const bodies::Placement placement =
          bodies::parse_placement(prm, dim, in);
        for (Point<3> &p : mesh.points)
          {
            p = placement.to_scene(p);
            if (dim == 2 && p[2] != 0)
              throw InputError(in + "File: '" + file +
                               "' has points outside the plane z = 0. In 2D "
                               "give lines in it.");
          }
        check(mesh, in + "File: the surface of '" + file + "' ");
        return std::make_unique<SurfaceMesh>(
          mesh,
          to_sentence(mesh.bent,
                      std::filesystem::path(file).filename().string(),
                      placement.scale,
                      placement.to_scene(mesh.bent.place)));
      }

    private:
      static bodies::Surface
      surface_of(const SurfaceFaces &mesh)
      {
        bodies::Surface surface;
        for (const auto &corners : mesh.faces)
          {
            const Tensor<1, 3>  normal = normal_of(mesh, corners);
            bodies::SurfaceFace face{corners, normal / normal.norm()};
            if (face.nodes.size() == 4) // row by row, as deal.II counts
              std::swap(face.nodes[2], face.nodes[3]);
            for (unsigned int &node : face.nodes)
              ++node; // the first node of the body is its reference point
            surface.faces.push_back(std::move(face));
          }
        return surface;
      }

      FaceNet                       net;
      mutable std::optional<Facets> facets; ///< when they are asked for
    };
  } // namespace

  double
  sagitta_at(const ObstacleShape &shape, const Point<3> &p)
  {
    const auto *const mesh = dynamic_cast<const SurfaceMesh *>(&shape);
    return mesh == nullptr ? 0 : mesh->sagitta_at(p);
  }

  std::string
  caution_of(const ObstacleShape &shape)
  {
    const auto *const mesh = dynamic_cast<const SurfaceMesh *>(&shape);
    return mesh == nullptr ? "" : mesh->caution;
  }

  ObstacleRow
  surface_mesh_row()
  {
    return {"surface mesh",
            "what the closed surface of a file holds (File, Scale, Rotation, "
            "Translation)",
            SurfaceMesh::declare,
            SurfaceMesh::create,
            {"File", "Scale", "Rotation", "Translation"}};
  }
} // namespace conetact::pairing
