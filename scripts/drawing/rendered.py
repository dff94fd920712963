# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies, obstacles and reactions in space, drawn by VTK into axes of matplotlib, which has the scales and words."""
import numpy as np
from conetact.report.meshes import edges_of
from conetact.vtu import HEXAHEDRON, TETRAHEDRON
from matplotlib.colors import to_rgb

from drawing.colours import ARROWS, OBSTACLE
from drawing.screen import remember
from drawing.shapes import rectangle

FINE = 2  # pixels are means of so many squared
MAX_FACES_WITH_EDGES = 20000
SHARP = 30  # degrees between faces that have an edge between them
MARGIN = 1.04


def modules():
    """VTK is loaded where bodies in space are drawn; the first module makes windows."""
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    from vtkmodules import (vtkCommonCore, vtkCommonDataModel, vtkFiltersCore, vtkFiltersExtraction, vtkFiltersGeneral,
                            vtkFiltersGeometry, vtkFiltersSources, vtkRenderingCore)
    parts = (vtkCommonCore, vtkCommonDataModel, vtkFiltersCore, vtkFiltersExtraction, vtkFiltersGeneral,
             vtkFiltersGeometry, vtkFiltersSources, vtkRenderingCore)
    return {name: getattr(part, name) for part in parts for name in dir(part) if name.startswith("vtk")}


class Stage:
    """A renderer, what is added to it, and the picture of it."""

    def __init__(self):
        from vtkmodules.util import numpy_support
        self.vtk, self.numpy = modules(), numpy_support
        self.renderer = self.new("vtkRenderer")
        self.renderer.SetBackground(1, 1, 1)
        kit = self.new("vtkLightKit")
        kit.SetKeyLightIntensity(1.)
        kit.AddLightsToRenderer(self.renderer)

    def new(self, name):
        return self.vtk[name]()

    def points(self, x):
        points = self.new("vtkPoints")
        points.SetData(self.numpy.numpy_to_vtk(np.ascontiguousarray(x, float), deep=True))
        return points

    def cells(self, groups):
        """Groups of cells, each of one number of corners."""
        cells = self.new("vtkCellArray")
        counts = np.concatenate([np.full(len(corners), corners.shape[1]) for corners in groups])
        corners = np.concatenate([corners.ravel() for corners in groups])
        cells.SetData(*(self.numpy.numpy_to_vtkIdTypeArray(np.ascontiguousarray(a, np.int64), deep=True)
                        for a in (np.concatenate(([0], np.cumsum(counts))), corners)))
        return cells

    def mesh(self, x, faces, values=None):
        """Polygons, also several groups; of two corners lines."""
        groups, mesh = faces if isinstance(faces, list) else [faces], self.new("vtkPolyData")
        mesh.SetPoints(self.points(x))
        (mesh.SetLines if groups[0].shape[1] == 2 else mesh.SetPolys)(self.cells(groups))
        self.set_values(mesh, values)
        return mesh

    def set_values(self, mesh, values):
        if values is not None:
            mesh.GetPointData().SetScalars(self.numpy.numpy_to_vtk(np.ascontiguousarray(values, float), deep=True))

    def after(self, name, mesh, **settings):
        """What a filter makes of a mesh."""
        work = self.new(name)
        work.SetInputData(mesh)
        for setting, value in settings.items():
            getattr(work, f"Set{setting}")(value)
        work.Update()
        return work.GetOutput()

    def table(self, scale):
        """Colours of a scale for VTK."""
        table = self.new("vtkLookupTable")
        colours = (np.array(scale.map(np.linspace(0, 1, 256))) * 255).astype(np.uint8)
        table.SetTable(self.numpy.numpy_to_vtk(np.ascontiguousarray(colours), deep=True))
        table.SetRange(scale.norm.vmin, scale.norm.vmax)
        return table

    def add(self, mesh, colour=None, scale=None, opacity=1., width=None, shine=True):
        """In one colour, or in those of a scale."""
        mapper, actor = self.new("vtkPolyDataMapper"), self.new("vtkActor")
        mapper.SetInputData(mesh)
        mapper.SetScalarVisibility(scale is not None)
        if scale is not None:
            mapper.SetLookupTable(self.table(scale))
            mapper.UseLookupTableScalarRangeOn()
            mapper.InterpolateScalarsBeforeMappingOn()
        actor.SetMapper(mapper)
        self.dress(actor.GetProperty(), colour, opacity, width, shine)
        self.renderer.AddActor(actor)
        return mapper

    @staticmethod
    def dress(look, colour, opacity, width, shine):
        look.SetColor(to_rgb(colour or "white"))
        look.SetOpacity(opacity)
        look.SetAmbient(.3)
        look.SetDiffuse(.8)
        look.SetInterpolationToFlat()
        if not shine:
            look.LightingOff()
        if width:
            look.SetLineWidth(width)

    def picture(self, width, height):
        """Numbers from 0 to 255 by height, width and colour."""
        window = self.new("vtkRenderWindow")
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(0)
        window.SetSize(FINE * width, FINE * height)
        window.AddRenderer(self.renderer)
        remember(window)
        window.Render()
        pixels = self.new("vtkUnsignedCharArray")
        window.GetRGBACharPixelData(0, 0, FINE * width - 1, FINE * height - 1, 1, pixels)
        found = self.numpy.vtk_to_numpy(pixels)[:, :3].reshape(height, FINE, width, FINE, 3)
        return (found.sum(axis=(1, 3), dtype=np.uint16)[::-1] // FINE**2).astype(np.uint8)


def directions(view):
    """To the right, up and to the eye."""
    e, a = np.radians(view)
    eye = np.array((np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)))
    right = np.array((-np.sin(a), np.cos(a), 0))
    return right, np.cross(eye, right), eye


def set_camera(stage, limits, view, aspect):
    """All of a box is seen; returns the height of the picture in lengths."""
    right, up, eye = directions(view)
    corners = np.array([[limits[i][0], limits[j][1], limits[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    across, along = corners @ right, corners @ up
    middle = (np.ptp(across) / 2 + across.min()) * right + (np.ptp(along) / 2 + along.min()) * up
    middle = middle + (corners.mean(axis=0) @ eye) * eye
    half = MARGIN / 2 * max(np.ptp(along), np.ptp(across) / aspect)
    camera = stage.renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(half)
    camera.SetFocalPoint(middle)
    camera.SetPosition(middle + 4 * half * eye)
    camera.SetViewUp(up)
    stage.renderer.ResetCameraClippingRange()
    return 2 * half


def left_by(clips, limits, eye):
    """The part of a box behind planes."""
    low, high = np.array(limits)
    for axis, place in clips:
        if low[axis] < place < high[axis]:
            (high if eye[axis] >= 0 else low)[axis] = place
    return low, high


def clipped(stage, body, values, clips, eye):
    """Surface of what is left of a body behind planes: the side towards the eye goes."""
    grid = stage.new("vtkUnstructuredGrid")
    grid.SetPoints(stage.points(body.x))
    for kind, corners in body.cells.items():
        grid.SetCells(kind, stage.cells([corners]))
    stage.set_values(grid, values)
    for axis, place in clips:
        plane = stage.new("vtkPlane")
        plane.SetOrigin(place * np.eye(3)[axis])
        plane.SetNormal(-np.eye(3)[axis] * (1 if eye[axis] >= 0 else -1))
        grid = stage.after("vtkTableBasedClipDataSet", grid, ClipFunction=plane)
    return stage.after("vtkGeometryFilter", grid)


def surface_of(stage, body, values, clips, eye):
    if clips and {TETRAHEDRON, HEXAHEDRON} & set(body.cells):
        return clipped(stage, body, values, clips, eye)
    return stage.mesh(body.x, triangles_and_others(body.faces), values)


def triangles_and_others(faces):
    """Two groups; faces of tetrahedra repeat a corner."""
    is_triangle = faces[:, 2] == faces[:, 3]
    return [faces[is_triangle][:, :3], faces[~is_triangle]]


def sharp_edges(stage, body, surface, is_clipped):
    """Faces of meshes are oriented anyhow; those of sections are made alike first."""
    if not is_clipped:
        return stage.mesh(body.x, edges_of(body.points, triangles_and_others(body.faces))[1])
    alike = stage.after("vtkPolyDataNormals", surface, Splitting=0, Consistency=1)
    return stage.after("vtkFeatureEdges", alike, FeatureAngle=SHARP, BoundaryEdges=0, NonManifoldEdges=0, Coloring=0)


def add_body(stage, body, scale, n_faces, clips, eye):
    surface = surface_of(stage, body, scale.values(body), clips, eye)
    mapper = stage.add(surface, scale=scale)
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    if n_faces <= MAX_FACES_WITH_EDGES:
        stage.add(stage.after("vtkExtractEdges", surface), "black", opacity=.22, width=1, shine=False)
    stage.add(sharp_edges(stage, body, surface, bool(clips)), "black", opacity=.8, width=1.4 * FINE, shine=False)


def add_frame(stage, body, scale, size):
    stage.add(stage.mesh(body.points, body.faces), "0.7", width=FINE, shine=False)
    members = stage.mesh(body.x, body.faces, scale.values(body))
    stage.add(stage.after("vtkTubeFilter", members, Radius=.004 * size, NumberOfSides=12), scale=scale)


def add_obstacle(stage, contact, size):
    """A rectangle, or the surface opposite to the faces of the contact."""
    if contact.is_flat:
        sheet = stage.mesh(rectangle(contact, size), np.array([[0, 1, 2, 3]]))
        stage.add(sheet, OBSTACLE, opacity=.6)
    else:
        near = np.abs(contact.feet - contact.points).max(axis=1) < .5 * size
        faces = contact.faces[near[contact.faces].all(axis=1)]
        if not len(faces):
            return
        sheet = stage.mesh(contact.feet, faces)
        stage.add(sheet, OBSTACLE, opacity=.4)
    stage.add(stage.after("vtkFeatureEdges", sheet, FeatureAngle=SHARP, Coloring=0), "0.5", width=FINE, shine=False)


def add_reactions(stage, contact, largest, length):
    """Arrows that end at their nodes, thick enough to be seen."""
    arrows = contact.arrows(largest, length)
    sizes = np.linalg.norm(arrows, axis=1)
    for state, colour in ARROWS.items():
        rows = (contact.rows["state"] == state) & (sizes > 1e-3 * sizes.max(initial=0))
        if rows.any():
            tails = stage.mesh(contact.x[rows] - arrows[rows], np.arange(rows.sum())[:, None].repeat(2, axis=1))
            tails.GetPointData().SetVectors(stage.numpy.numpy_to_vtk(np.ascontiguousarray(arrows[rows]), deep=True))
            stage.add(arrows_at(stage, tails), colour)


def arrows_at(stage, tails):
    shape, glyphs = stage.new("vtkArrowSource"), stage.new("vtkGlyph3D")
    shape.SetTipLength(.3)
    shape.SetTipRadius(.08)
    shape.SetShaftRadius(.028)
    shape.SetTipResolution(12)
    shape.SetShaftResolution(8)
    glyphs.SetSourceConnection(shape.GetOutputPort())
    glyphs.SetInputData(tails)
    glyphs.SetVectorModeToUseVector()
    glyphs.SetScaleModeToScaleByVector()
    glyphs.OrientOn()
    glyphs.Update()
    return glyphs.GetOutput()


def add_shapes(stage, shapes, scales, arrows, size, clips, eye):
    n_faces = sum(len(body.faces) for body in shapes.bodies if not body.is_frame)
    for body in shapes.bodies:
        if body.is_frame:
            add_frame(stage, body, scales[True], size)
        else:
            add_body(stage, body, scales[False], n_faces, clips, eye)
    for contact in shapes.contacts:
        if not contact.is_pair:
            add_obstacle(stage, contact, size)
        add_reactions(stage, contact, *arrows)


def pixels_of(axes, dpi):
    """Width and height that a picture has in these axes, once the figure is laid out."""
    axes.figure.get_layout_engine().execute(axes.figure)
    axes.figure.set_layout_engine("none")  # it would be laid out again for the file
    box = axes.get_window_extent()
    return [max(int(round(x * dpi / axes.figure.dpi)), 16) for x in (box.width, box.height)]


def draw(axes, shapes, scales, arrows, units, limits, view, clips, dpi):
    """The last thing that is drawn in a figure: its place must be known."""
    axes.axis("off")
    width, height = pixels_of(axes, dpi)
    stage, eye = Stage(), directions(view)[2]
    add_shapes(stage, shapes, scales, arrows, float(np.linalg.norm(limits[1] - limits[0])), clips, eye)
    tall = set_camera(stage, left_by(clips, limits, eye), view, width / height)
    axes.imshow(stage.picture(width, height), extent=(0, width, 0, height), aspect="auto", interpolation="antialiased")
    draw_axes(axes, view, .07 * min(width, height))
    draw_length(axes, tall / height, width, height, units)


def draw_axes(axes, view, length):
    """Where x, y and z point to, in the lower left corner."""
    right, up, _ = directions(view)
    for name, a, b in zip("xyz", right, up):
        start = np.array((1.6, 1.6)) * length
        end = start + length * np.array((a, b))
        axes.annotate("", end, start, arrowprops={"arrowstyle": "->", "shrinkA": 0, "shrinkB": 0})
        axes.text(*(start + 1.3 * (end - start)), name, ha="center", va="center", fontsize="small")


def draw_length(axes, length_of_pixel, width, height, units):
    """A bar of a round length, in the lower right corner."""
    wanted = .2 * width * length_of_pixel
    power = 10.0 ** np.floor(np.log10(wanted))
    length = power * max(k for k in (1, 2, 5) if k * power <= wanted)
    end, y = .97 * width, .04 * height
    start = end - length / length_of_pixel
    axes.plot((start, end), (y, y), color="black", linewidth=2, solid_capstyle="butt")
    axes.text((start + end) / 2, y + .012 * height, f"{length:g} {units.names.get('length', '')}".strip(), ha="center",
              va="bottom", fontsize="small")
    axes.set(xlim=(0, width), ylim=(0, height))
