// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_structure_h
#define conetact_bodies_structure_h

#include "conetact/base/points.h"
#include "conetact/base/vtu_grid.h"
#include "conetact/bodies/elements.h"

#include <Eigen/Core>

#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace conetact::bodies
{
  /** Boundary ids as scenes write them. */
  using BoundaryIds = std::set<unsigned int>;

  /** A node of a surface, in the scene's coordinates. */
  struct SurfaceNode
  {
    unsigned int node; ///< its number in the body
    Point<3>     position;
    double       area; ///< integral of its shape function [length^2; 2D: times
                       ///< thickness or circumference]; on six-node triangles
                       ///< of the linear one of a corner
    Tensor<1, 3> normal; ///< outward, unit length, mean over its faces
    /**
     * One outward normal of unit length for each smooth patch of faces that
     * meet here: an edge of a block has two, a facet edge of a cylinder one.
     */
    std::vector<Tensor<1, 3>> normals;
  };

  /** Nodes in deal.II's order (segment, triangle, or 4: quadrilateral). */
  struct SurfaceFace
  {
    std::vector<unsigned int> nodes;
    Tensor<1, 3> normal; ///< outward, unit length, mean; two-sided: either
    /** Whether contacts stand at its corners only, with linear functions: on
     * six-node triangles forces of single nodes make no uniform pressure, on
     * bent faces of second degree they zigzag. */
    bool meets_at_corners = false;
  };

  /** Faces that turn by more than this are no smooth patch: ten facets round a
   * circle are one, a chamfer of 45 degrees is not [rad]. */
  constexpr double angle_of_patches = 40 * M_PI / 180;

  /**
   * The normals of the smooth patches that vectors (normals of faces, times
   * any weights) belong to: patches turn by more than 40 degrees where they
   * meet. A patch has the direction of the sum of its vectors.
   */
  std::vector<Tensor<1, 3>>
  smooth_patches(const std::vector<Tensor<1, 3>> &face_normals);

  /** Faces of some boundary ids and the nodes on them, sorted by number. */
  struct Surface
  {
    std::vector<SurfaceNode> nodes;
    std::vector<SurfaceFace> faces;
    bool two_sided = false; ///< a line or sheet that may be touched on both
  };

  /** A node that hangs on a coarser cell: u = sum of weight * u(node). */
  struct HangingNode
  {
    unsigned int                                 node;
    std::vector<std::pair<unsigned int, double>> masters;
  };

  /**
   * Elements that are refined in one mesh after the other, by their number in
   * it.
   */
  using Refinements = std::vector<std::set<unsigned int>>;

  /** A scalar field of position [units as its user says]. */
  using ScalarField = std::function<double(const Point<3> &)>;
  /** A vector field of position [units as its user says]. */
  using VectorField = std::function<Tensor<1, 3>(const Point<3> &)>;
  /** A vector field on a surface: of position and outward unit normal. */
  using SurfaceField =
    std::function<Tensor<1, 3>(const Point<3> &, const Tensor<1, 3> &)>;
  /** A second-order field on a surface, such as a stiffness per area. */
  using SurfaceTensorField =
    std::function<Tensor<2, 3>(const Point<3> &, const Tensor<1, 3> &)>;

  /**
   * How a body strains of itself where nothing resists: by a strain [-] and by
   * a change of temperature [K], which strains each material as it expands.
   * @f$\sigma = C (\varepsilon(u) - \varepsilon_0)@f$.
   */
  struct InitialStrain
  {
    Tensor<2, 3> strain;
    double       temperature = 0;

    /** Of a material with this expansion coefficient [1/K]. */
    Tensor<2, 3>
    of(const double expansion) const
    {
      Tensor<2, 3> whole = strain;
      for (unsigned int d = 0; d < 3; ++d)
        whole[d][d] += expansion * temperature;
      return whole;
    }
    InitialStrain &
    operator+=(const InitialStrain &more)
    {
      strain += more.strain;
      temperature += more.temperature;
      return *this;
    }
  };
  /** A function of position, in the axes of the undeformed body. */
  using InitialStrainField = std::function<InitialStrain(const Point<3> &)>;

  /**
   * What acts on a body at one time. Its stresses depend on more than its
   * displacements: on what acts between nodes, of which nodal forces do not
   * tell.
   */
  struct Action
  {
    enum class Kind
    {
      traction,
      body_force,
      line_load,
      point_force,
      initial_strain
    };
    Kind               kind;
    BoundaryIds        ids;    ///< traction, line load
    Point<3>           point;  ///< point force
    SurfaceField       force;  ///< all but initial strains
    InitialStrainField strain; ///< initial strain

    /** [force/area] */
    static Action
    traction(const BoundaryIds &ids, SurfaceField force)
    {
      return {Kind::traction, ids, {}, std::move(force), {}};
    }
    /** [force/volume] */
    static Action
    body_force(const VectorField &force)
    {
      return {Kind::body_force,
              {},
              {},
              [force](const Point<3> &p, const Tensor<1, 3> &) {
                return force(p);
              },
              {}};
    }
    /** [force/length] on the members of a frame with the ids */
    static Action
    line_load(const BoundaryIds &ids, SurfaceField force)
    {
      return {Kind::line_load, ids, {}, std::move(force), {}};
    }
    /** [force], distributed by the shape functions of the cell that holds the
     * point */
    static Action
    point_force(const Point<3> &point, const Tensor<1, 3> &force)
    {
      return {Kind::point_force,
              {},
              point,
              [force](const Point<3> &, const Tensor<1, 3> &) { return force; },
              {}};
    }
    /** Also a change of temperature: @f$\int B^T C \varepsilon_0\,dx@f$, which
     * balances by itself */
    static Action
    initial_strains(InitialStrainField strain)
    {
      return {Kind::initial_strain, {}, {}, {}, std::move(strain)};
    }
  };
  using Actions = std::vector<Action>;

  /**
   * A linear elastic body: sparse stiffness, load vectors, surfaces, its own
   * drawing. Displacement component c of node i is dof
   * `i * n_components() + c`; positions and vectors leave a body with three
   * components (z = 0 in 2D), forces are those on the body's given thickness or
   * whole circumference.
   * Neither supports nor hanging nodes are eliminated here: vectors and
   * elements are in all dofs of the body.
   */
  class Structure
  {
  public:
    virtual ~Structure() = default;

    virtual unsigned int
    n_nodes() const = 0;
    /** Dofs a node: the dimension, or more where nodes rotate. */
    virtual unsigned int
    n_components() const = 0;
    unsigned int
    n_dofs() const
    {
      return n_nodes() * n_components();
    }

    /** Undeformed position. */
    virtual Point<3>
    position(const unsigned int node) const = 0;

    virtual const std::vector<HangingNode> &
    hanging_nodes() const = 0;

    /**
     * False for a dof that no element touches, such as the rotation of a node
     * where only hinges meet: it takes no part in equilibrium and stays zero.
     */
    virtual bool
    has_dof(const unsigned int /*node*/, const unsigned int /*component*/) const
    {
      return true;
    }
    /** Whether it may have motions without strain other than rigid ones. */
    virtual bool
    may_be_mechanism() const
    {
      return false;
    }
    /** Whether contacts of its faces stand at their corners only, see
     * SurfaceFace: no surface has to be made to know it. */
    virtual bool
    meets_at_corners() const
    {
      return false;
    }
    /** Why a node may move freely, as a hint to the user; empty: no idea. */
    virtual std::string
    weakness(const unsigned int /*node*/) const
    {
      return {};
    }

    virtual const Elements &
    elements() const = 0;

    /** Whether single elements may be divided. */
    virtual bool
    can_be_refined() const
    {
      return false;
    }
    /**
     * Estimated errors of the displacements u (all dofs), one for each element
     * in their order: squares of their energy norms, up to a factor
     * [force*length]. Empty if there is no mesh to refine.
     */
    virtual std::vector<double>
    element_errors(const Eigen::VectorXd & /*u*/) const
    {
      return {};
    }

    /**
     * Gives back what nothing but element_errors() needs, which has no answer
     * then.
     */
    virtual void
    forget_mesh()
    {}

    /** Ids that some face has, for checks and messages. */
    virtual BoundaryIds
    boundary_ids() const = 0;
    virtual Surface
    surface(const BoundaryIds &ids) const = 0;

    /** Adds nodal forces. False if the action finds nothing to act on: the
     * point is in no cell, no member has the boundary ids, or nothing strains.
     */
    virtual bool
    add(const Action &action, Eigen::VectorXd &f) const = 0;
    /** Whether a change of temperature strains anything. */
    virtual bool
    expands() const
    {
      return false;
    }
    /**
     * Elements of a foundation on a surface: springs of stiffness
     * [force/length/area] between the body and fixed ground.
     */
    virtual void
    visit_springs(const BoundaryIds        &ids,
                  const SurfaceTensorField &stiffness,
                  const ElementVisitor     &visit) const = 0;

    /**
     * A picture of the undeformed body with `displacement` u (all dofs), the
     * stresses or section forces of the deformation w, with `actions` at work,
     * and ids of its cells. w is u without a rigid motion, which would cost
     * digits of the stresses.
     */
    virtual VtuGrid
    drawing(const Eigen::VectorXd &u,
            const Eigen::VectorXd &w,
            const Actions         &actions) const = 0;

    /**
     * Of its elasticity: how many times the strain that it resists most is
     * harder than the one it resists least. 3 at nu = 0.3, 75 at 0.49,
     * infinite where volumes stay.
     */
    virtual double
    contrast_of_strains() const
    {
      return 1;
    }

    /** What a user must know of its results, a sentence; empty: nothing. */
    virtual std::string
    caution() const
    {
      return {};
    }

    /** Its mesh as a file of Gmsh, if it was made of a drawing; else empty. */
    virtual const std::string &
    made_mesh() const
    {
      static const std::string none;
      return none;
    }

    /** For log and dry run: "2500 cells Q1, 2601 nodes". */
    virtual std::string
    description() const = 0;

    /**
     * Whether it is a body of revolution, cut along its axis: x is the radius,
     * y the axis, and forces and areas are those of the whole circumference.
     * Only translations along y are rigid motions of it, and radial forces
     * balance round the axis by themselves.
     */
    virtual bool
    is_axisymmetric() const
    {
      return false;
    }

    /**
     * Ids of the groups of faces that a mesh file names; several where groups
     * overlap. They stand for ids in all entries.
     */
    virtual const std::map<std::string, BoundaryIds> &
    boundary_groups() const
    {
      static const std::map<std::string, BoundaryIds> none;
      return none;
    }
  };

  /** Writes its drawing with w = u and nothing at work inside it to a VTU file.
   * Throws WriteError. */
  void
  write_graphics(const Structure             &body,
                 const Eigen::VectorXd       &u,
                 const double                 time,
                 const std::filesystem::path &file);

  /** Largest distance of a node from the origin [length]. */
  double
  reach(const Structure &body);
} // namespace conetact::bodies

#endif
