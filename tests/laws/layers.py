# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Laws of contact nodes in closed form: a clamped block on springs, with friction that varies, between layers, worn."""
import math
from pathlib import Path

from support.logs import log_of
from support.scenes import box, contact, floor, load, merge, press_and_shear, support

YOUNG, SPRINGS = 1000.0, 20.0


def clamped(dim, closing, force, increments=10, end=1.0, **law):
    """A unit cube between two plates that close by `closing`, pushed along x by a body force against springs."""
    down, up = (0, 1) if dim == 2 else (0, 0, 1), (0, -1) if dim == 2 else (0, 0, -1)
    sides = (2, 3) if dim == 2 else (4, 5)
    still = " ; 0" * (dim - 1)
    scene = {"Dimension": dim,
             "Body block": box((1,) * dim, (1.0,) * dim, young=YOUNG, poisson=0.0),
             "Obstacle below": {"Shape": "half space", "Normal": down},
             "Obstacle above": {"Shape": "half space", "Normal": up, "Point": (0,) * (dim - 1) + (1,),
                                "Displacement": ("0 ; " * (dim - 1)) + f"-({closing})"},
             "Contact below": contact(ids=sides[0], obstacle="below", **law),
             "Contact above": contact(ids=sides[1], obstacle="above", **law),
             "Support springs": support("0, 1", "x", Stiffness=SPRINGS / 2),
             "Load push": load("body force", f"{force}{still}"),
             "Time": {"End": end, "Increments": increments}, "Output": {"VTU": 0}}
    if dim == 3:
        scene["Support side"] = support("2, 3", "y")
    return scene


def moved(run):
    """Mean displacement along x, pressure, and friction below, of each increment."""
    result = []
    for record in run.increments:
        rows = [row for row in run.rows if row["increment"] == record["increment"]]
        result.append((abs(record["support_springs_f_x"]) / SPRINGS,
                       sum(row["pressure"] for row in rows) / len(rows)))
    return result


def sliding(laws, what, run, expected, bound=1e-9):
    """Displacements of a block that slides, against those expected at each time."""
    error = max(abs(found - right) for (found, _), right in zip(moved(run), expected))
    laws.check(what, error / max(map(abs, expected)), bound)


def friction(laws):
    closing, force = .01, 15.0  # p = 10
    p, n = YOUNG * closing, 10
    times = [(i + 1) / n for i in range(n)]
    for dim in (2, 3):
        def slides(mu_of_time):
            return [max(0.0, (force * t - 2 * mu_of_time(t) * p) / SPRINGS) for t in times]
        for text, mu in (("0.3 - 0.01*p", .2), ("min(0.4, 2/p)", .2), ("table(p; 0 : 0.4; 5 : 0.3; 15 : 0.1)", .2)):
            run = laws.run(clamped(dim, closing, f"{force}*t", mu=text))
            sliding(laws, f"{dim}D, limit load with mu = {text}", run, slides(lambda t: mu))
        run = laws.run(clamped(dim, closing, f"{force}*t", mu=5, **{"Shear limit": 3.0}))
        sliding(laws, f"{dim}D, Tresca: slides at tau A", run, [max(0.0, (force * t - 2 * 3) / SPRINGS) for t in times])
        run = laws.run(clamped(dim, closing, force, mu="0.5 - 0.4*t"))
        sliding(laws, f"{dim}D, mu that falls with time", run, slides_down(force, p, [.5 - .4 * t for t in times]))
        # static to kinetic: it starts at the static limit, and comes to rest by the kinetic one
        run = laws.run(clamped(dim, closing, f"min({force}*t, 9)", increments=40, end=4.0, mu="0.2 + 0.2*exp(-s/0.02)"))
        u, way, expected = 0.0, 0.0, []
        for i in range(40):
            limit = 2 * p * (.2 + .2 * math.exp(-way / .02))
            pushed = min(force * (i + 1) / 10, 9.0)
            if pushed - SPRINGS * u > limit:
                way, u = way + (pushed - limit) / SPRINGS - u, (pushed - limit) / SPRINGS
            expected.append(u)
        sliding(laws, f"{dim}D, from static to kinetic friction", run, expected)
        laws.check(f"{dim}D, rests by the kinetic one", abs(expected[-1] / ((9 - 4) / SPRINGS) - 1), 1e-3)
        # speed: k u + 2 mu(v) p = force
        run = laws.run(clamped(dim, closing, f"{force}*t", mu="0.2 + 0.1*v"))
        u, expected = 0.0, []
        for t in times:
            new = (force * t - 2 * p * .2 + 2 * p * .1 * n * u) / (SPRINGS + 2 * p * .1 * n)
            u = max(u, new)
            expected.append(u)
        sliding(laws, f"{dim}D, mu of the speed", run, expected)
    # friction that is switched on after a press fit without it
    scene = clamped(3, "0.01*min(t, 1)", "5*max(t - 1, 0)", increments=4, end=2.0, mu="if(t < 1.1, 0, 0.3)")
    run = laws.run(scene)
    laws.demand("switched on: no friction before, stick after",
                all((row["r_t1"] == row["r_t2"] == 0) == (row["time"] < 1.1) for row in run.rows)
                and all(row["state"] == "stick" for row in run.last()))


def slides_down(force, p, coefficients):
    """Friction that falls lets springs go; it never pushes back."""
    u, result = 0.0, []
    for mu in coefficients:
        u = max(u, (force - 2 * mu * p) / SPRINGS)
        result.append(u)
    return result


def soft(laws):
    closing = .01
    for dim in (2, 3):
        for backend in ("condensed", "iterative"):
            what = f"{dim}D, {backend}"
            scene = merge(clamped(dim, closing, 0, increments=2, mu=.3, Compliance=1e-3), {"Solver": {"Backend": backend}})
            p = closing / (1 / YOUNG + 2e-3)
            run = laws.run(scene)
            laws.check(f"{what}: a linear gasket", max(abs(row["pressure"] / p - 1) for row in run.rows), 1e-10)
            laws.check(f"{what}: its closing", max(abs(row["gap"] + 1e-3 * p) for row in run.rows) / closing, 1e-10)
            scene["Contact below"]["Compliance"] = scene["Contact above"]["Compliance"] = "table(p; 0 : 2e-3; 2 : 1.5e-3; 4 : 1.2e-3)"
            run = laws.run(scene)
            found = run.last()[0]["pressure"]
            C = 2e-3 - 2.5e-4 * found if found < 2 else 1.5e-3 - 1.5e-4 * (found - 2) if found < 4 else 1.2e-3
            laws.check(f"{what}: a table of a gasket", abs(found / YOUNG + 2 * C * found - closing) / closing, 1e-9)
            # stuck, the block gives way by the shear of both layers, and beyond friction it slides
            scene = merge(clamped(dim, closing, "10*t", mu=.2, **{"Shear compliance": .02}), {"Solver": {"Backend": backend}})
            run = laws.run(scene)
            p, u, slid, expected = YOUNG * closing, 0.0, 0.0, []
            for i in range(10):
                pushed = i + 1.0
                u = (pushed + 2 * slid / .02) / (SPRINGS + 2 / .02)
                if (u - slid) / .02 > .2 * p:
                    u = (pushed - 2 * .2 * p) / SPRINGS
                    slid = u - .02 * .2 * p
                expected.append(u)
            sliding(laws, f"{what}: elastic until it slips", run, expected)
            laws.demand(f"{what}: both states", {row["state"] for row in run.rows} == {"stick", "slip"})


def drawn(dim, k, **law):
    """A block without friction, pressed by 7 and drawn by t along x."""
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    scene = {"Dimension": dim, "Body block": box((3,) * dim, (1.0,) * dim, young=YOUNG, poisson=0.0),
             "Obstacle floor": floor(dim),
             "Contact bottom": contact(ids=bottom, mu=0, **{"Wear coefficient": k}, **law),
             "Support hand": support("0, 1", "x", "0.1*t"), "Load press": load("pressure", 7, ids=top),
             "Time": {"End": 10, "Increments": 10}, "Output": {"VTU": 0}}
    if dim == 3:
        scene["Support side"] = support("2, 3", "y")
    return scene


def wear(laws):
    k = 1e-4
    for dim in (2, 3):
        for way in ("explicit", "implicit"):
            run = laws.run(drawn(dim, k, **{"Wear integration": way}))
            laws.check(f"{dim}D, Archard, {way}: h = k p s", max(abs(row["wear"] / (k * 7 * .1 * row["time"]) - 1) for row in run.rows), 1e-12)
            laws.check(f"{dim}D, Archard, {way}: volume = k F s", abs(run.increments[-1]["bottom_worn"] / (k * 7 * 1.0) - 1), 1e-9)
            sunk = {row["increment"]: row["u_n"] for row in run.rows}
            before = 10 if way == "implicit" else 9
            laws.check(f"{dim}D, Archard, {way}: it sinks by the depth", abs(sunk[10] + k * 7 * .1 * before) / (k * 7), 1e-9)
        run = laws.run(drawn(dim, k, **{"Wear acceleration": 5, "Wear share": .25}))
        laws.check(f"{dim}D, five times, a quarter of it", max(abs(row["wear"] / (.25 * 5 * k * 7 * .1 * row["time"]) - 1) for row in run.rows), 1e-12)
        # between plates pressure falls as it wears: p (1/E + 2 k s) = closing; steps of either kind tend to that
        errors = {}
        for way in ("explicit", "implicit"):
            for n in (20, 40):
                scene = clamped(dim, .01, 0, increments=n, mu=0, **{"Wear coefficient": .01, "Wear integration": way})
                scene["Support springs"] = support("0, 1", "x", "0.1*t")
                run = laws.run(scene)
                p = YOUNG * .01
                for _ in range(n - 1 if way == "explicit" else n):
                    p = p - 2 * YOUNG * .01 * p * .1 / n if way == "explicit" else p / (1 + 2 * YOUNG * .01 * .1 / n)
                last, depth = run.last()[0]["pressure"], run.last()[0]["wear"]
                laws.check(f"{dim}D, between plates, {way}, {n} increments", abs(last / p - 1), 1e-9)
                errors[way, n] = depth / (.005 * (1 - math.exp(-2 * YOUNG * .01 * .1))) - 1
            laws.check(f"{dim}D, {way}: halved increments", abs(errors[way, 20] / errors[way, 40] - 2), .2)


def restarted(laws):
    scene = clamped(3, .01, "4*t", increments=4, mu="0.2 + 0.1*exp(-s/0.003)", Compliance="table(p; 0 : 2e-3; 4 : 1.2e-3)",
                    **{"Shear compliance": .01, "Wear coefficient": 1e-3, "Wear integration": "implicit"})
    scene["Output"]["Checkpoint"] = 1
    whole = laws.run(scene)
    half = laws.run(scene, "-s", "Time/End=0.5", "-s", "Time/Increments=2")
    laws.same("all of them, continued", whole, laws.run(scene, "--restart", half.folder), 1e-10)
    laws.same("all of them, iterative", whole, laws.run(scene, "-s", "Solver/Backend=iterative"), 1e-8)


def stages(laws):
    """A block that is pressed by a stamp, and then by a second one that comes to meet it while it stands there."""
    for dim, backend in ((2, "condensed"), (3, "condensed"), (3, "iterative")):
        scene = merge(clamped(dim, "0.01*min(t, 1)", 0, increments=4, end=4.0, mu=.3), {"Solver": {"Backend": backend}})
        scene["Contact above"]["Active"] = "(t < 1.5) + (t > 3.5)"
        run = laws.run(scene)
        for t, pressed in ((1, True), (2, False), (3, False), (4, True)):
            rows = [row for row in run.rows if row["time"] == t and row["contact"] == "above"]
            error = max(abs(row["pressure"] / 10 - pressed) for row in rows)
            laws.check(f"{dim}D, {backend}, t = {t}: pressure", error, 1e-10)
        laws.demand("  open in between", all(row["state"] == "open" for row in run.rows
                                             if row["contact"] == "above" and 1.5 < row["time"] < 3.5))


def fretting(laws):
    """Wear in partial slip ends where what sticks carries all, as a punch does (Goryacheva, Rajeev, Farris 2001)."""
    run = laws.run(Path(__file__).resolve().parents[2] / "parameter-files/fretting-wear.prm", "-s", "Output/VTU=0")
    rows = sorted((row for row in run.last() if row["contact"] == "joint" and row["r_n"] > 0), key=lambda row: row["x"])
    stuck = [row for row in rows if row["state"] == "stick"]
    force = run.increments[-1]["joint_f_y"]
    laws.check("fretting: what slips carries nothing", sum(row["r_n"] for row in rows if row["state"] == "slip") / force, 1e-9)
    c = max(row["x"] for row in stuck) + 1 / 32
    hertz = math.pi * (1000 / (2 * (1 - .3**2))) * c**2 / 400
    for row in stuck:
        if abs(row["x"]) < .8 * c:
            root = math.sqrt(c**2 - row["x"]**2)
            exact = 2 * hertz / (math.pi * c**2) * root + (force - hertz) / (math.pi * root)
            laws.check(f"  pressure at {row['x']}", abs(row["pressure"] / exact - 1), .05)
    worn = sum(1e-3 * 400 * row["pressure"] * abs(row["du_t1"]) * row["area"] for row in run.rows
               if row["contact"] == "joint" and row["state"] == "slip")
    laws.check("  volume = k F s", abs(run.increments[-1]["joint_worn"] / worn - 1), 1e-10)


def together(laws):
    """All at once in a block that is pressed and sheared: by each method and backend, and where contacts slide."""
    soft = {"Compliance": "table(p; 0 : 2e-4; 20 : 1e-4)", "Shear compliance": 2e-4, "Wear coefficient": 1e-3,
            "Wear integration": "implicit"}
    for dim in (2, 3):
        for mu in (.1, "0.25 + 0.1*v/(v + 1e-3)", "0.2 + 0.1*exp(-s/0.003)"):
            scene = press_and_shear(dim, mu=mu)
            scene["Contact bottom"].update(soft)
            run = laws.run(scene)
            laws.demand(f"{dim}D, mu = {mu}: some stick, some slip", {"stick", "slip"} <= {row["state"] for row in run.rows})
            laws.same(f"{dim}D, mu = {mu}: iterative", run, laws.run(scene, "-s", "Solver/Backend=iterative"), 1e-8)
            if dim == 2:
                laws.same(f"{dim}D, mu = {mu}: sliding on a plane", run,
                          laws.run(scene, "-s", "Contact bottom/Kinematics=finite sliding"), 1e-8)
    loose = clamped(2, "0.01*min(t, 1)", 0, increments=4, end=4.0, mu=.3)
    loose["Contact above"]["Active"] = "t < 1.5"
    loose["Load lift"] = load("body force", "0 ; max(t - 1, 0)")
    done, _ = laws.start(loose)
    laws.demand("loads on what only contacts hold that are not active", done.returncode == 2 and "contacts that are active" in done.stderr)


def worn_far(laws):
    """A slider on a long track: the volume is k times the work of normal forces on ways, whatever has been left behind. An obstacle
    keeps no depth: what it loses stays with nodes of Body, which is told."""
    k = 1e-5
    for body, other, ids, share in (("slider", "track", (2, 3), .5), ("track", "slider", (3, 2), .5), ("track", "slider", (3, 2), 1)):
        run = laws.run({"Dimension": 2, "Body slider": box((6, 2), (2.0, 1.0), poisson=0), "Body track": box((36, 2), (9.0, 1.0), (-1.0, -1.0), poisson=0),
                        "Contact face": {"Body": body, "Boundary ids": ids[0], "Master body": other, "Master boundary ids": ids[1],
                                         "Friction coefficient": .1, "Kinematics": "finite sliding", "Wear coefficient": k,
                                         "Wear share": share, "Wear integration": "implicit"},
                        "Support top": support(3, "x, y", "5*max(t - 1, 0) ; -0.01", "slider"), "Support bottom": support(2, "x, y", body="track"),
                        "Time": {"Stages": "1 : 1, 2 : 20"}, "Output": {"VTU": 0}})
        work = sum(row["r_n"] * abs(row["du_t1"]) for row in run.rows if row["contact"] == "face" and row["state"] == "slip")
        volumes = [row["face_worn"] for row in run.increments]
        laws.check(f"worn far, {body} as Body, share {share}: volume over k r_n |du|", abs(volumes[-1] / (k * work) - 1), 1e-12)
        laws.demand("  it never falls", all(a <= b for a, b in zip(volumes, volumes[1:])))
        laws.demand("  no warning of wear", "stays with the nodes" not in log_of(run) and "loses goes up" not in log_of(run))
    for share in (.5, 1):
        run = laws.run(drawn(2, k, **{"Wear share": share}))
        laws.demand(f"an obstacle, share {share}: what stays with Body is told", ("stays with the nodes" in log_of(run)) == (share < 1))


def stiff(laws):
    """A block that is all but rigid on a soft layer: closing = C p + h with h += k p s, the layer bears shear up to mu p, and a bond more."""
    C, shear, k, mu, closing = 2e-4, 2e-4, 1e-3, .3, .01
    for dim in (2, 3):
        for young in (1e9, 2e11):
            scene = press_and_shear(dim, mu=mu, increments=8, young=young)
            scene["Contact bottom"].update({"Compliance": C, "Shear compliance": shear, "Wear coefficient": k, "Wear integration": "implicit"})
            run = laws.run(scene)
            way = .004 * math.hypot(1, .3 if dim == 3 else 0)
            p, traction, depth, worst = 0.0, 0.0, 0.0, 0.0
            for i in range(8):
                step = way if i > 0 else 0.0
                p, traction, slip = (closing - depth) / C, traction + step / shear, 0.0
                if traction > mu * p:
                    before = traction - step / shear
                    b = C + k * (step + shear * before)
                    p = 2 * (closing - depth) / (b + math.sqrt(b * b - 4 * k * shear * mu * (closing - depth)))
                    traction = mu * p
                    slip = step - shear * (traction - before)
                depth += k * p * slip
                rows = [row for row in run.rows if row["increment"] == i + 1]
                worst = max(worst, *(abs(row["pressure"] / p - 1) for row in rows),
                            *(abs(math.hypot(row["traction_t1"], row["traction_t2"]) - traction) / p for row in rows),
                            *(abs(row["wear"] - depth) / closing for row in rows))
            laws.check(f"{dim}D, E = {young:g}, implicit wear and shear of a layer", worst, 1e-4 if young < 1e10 else 1e-6)
            laws.demand("  no increment is cut", all(row["substeps"] == 1 for row in run.increments))
            scene = press_and_shear(dim, mu=mu, increments=8, young=young, poisson=.3)
            scene["Contact bottom"].update({"Compliance": "table(p; 0 : 3e-4; 50 : 2e-4)", "Cohesion": .5, "Tensile strength": .5})
            run = laws.run(scene)
            worst = max(abs(row["pressure"] / 50 - 1) for row in run.rows)
            sliding = [math.hypot(row["traction_t1"], row["traction_t2"]) for row in run.last()]
            laws.check("  a bond beside a table", max(worst, *(abs(traction / (mu * 50 + .5) - 1) for traction in sliding)), 1e-4 if young < 1e10 else 1e-6)


def layers(laws):
    stiff(laws)
    stages(laws)
    together(laws)
    fretting(laws)
    friction(laws)
    soft(laws)
    wear(laws)
    worn_far(laws)
    restarted(laws)
