#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""scripts/picture.py, scripts/curve.py and the Python package on small scenes.

usage: check_python.py PROGRAM CASE

  pictures  plane, space, frames and two bodies are drawn, with content and nothing cut off; wrong calls get a sentence
  curves    columns of all tables against each other; wrong calls get a sentence
  runs      entries, tables, log, how runs ended; an exception for each exit code
  sweeps    products and zipped lists; runs without equilibrium; kept folders
  shapes    surfaces of meshes with cells of two levels, factors, files of VTU
  unrolled  maps of bores and tapers: arc length against the coordinate along the axis
"""
import contextlib
import io
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

TOP = Path(__file__).resolve().parent.parent
sys.path += [str(TOP / "python"), str(TOP / "scripts")]
import conetact  # noqa: E402
from support.checks import run_families  # noqa: E402
from support.scenes import merge, press_and_shear, pushed_block, stack, with_element, write_scene  # noqa: E402

GRID = TOP / "parameter-files" / "double-layer-grid-04.prm"
BLOCK = TOP / "parameter-files" / "floating-block.prm"
MU, DRAWN = "Contact bottom/Friction coefficient", {"Output": {"VTU": 1}}


def script(laws, name, *arguments):
    """What a script says and its exit code, without a process of its own."""
    module, out, err = __import__(name.removesuffix(".py")), io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            module.main([str(word) for word in arguments])
            code = 0
        except SystemExit as end:  # its sentence is the code
            code = end.code if isinstance(end.code, int) else 1
            err.write(f"{end.code}\n" if code else "")
    return subprocess.CompletedProcess(name, code, out.getvalue(), err.getvalue())


def demand_process(laws, name, folder):
    done = subprocess.run([TOP / "scripts" / name, "nowhere"], cwd=folder, capture_output=True, text=True)
    demand_sentence(laws, done, "no folder")
    bare = subprocess.run([sys.executable, "-S", "-E", TOP / "scripts" / name, "nowhere"], cwd=folder, capture_output=True, text=True)
    demand_sentence(laws, bare, "This Python", "python3-numpy")


def demand_picture(laws, what, done, file):
    """Large enough, of many colours, and white around."""
    laws.demand(f"{what}: drawn {done.stderr.strip()}", done.returncode == 0 and file.exists())
    if done.returncode:
        return
    import drawing  # noqa: F401 (chooses how matplotlib draws)
    import matplotlib.pyplot as plt
    pixels = (255 * plt.imread(file)[:, :, :3]).astype(np.uint8)
    height, width, _ = pixels.shape
    colours = len(np.unique(pixels.reshape(-1, 3), axis=0))
    inked = (pixels < 250).any(axis=2)
    laws.demand(f"{what}: {width} x {height}, {colours} colours, {inked.mean():.0%} drawn",
                width >= 800 and height >= 500 and colours > 100 and .02 < inked.mean() < .9)
    frame = inked.copy()
    frame[2:-2, 2:-2] = False
    laws.demand(f"{what}: nothing is cut off", not frame.any())


def demand_sentence(laws, done, *words):
    laws.demand(f"exit code 1 and one sentence: {done.stderr.strip()[-150:]}", done.returncode == 1 and "Traceback" not in
                done.stderr and len(done.stderr.splitlines()) == 1 and all(word in done.stderr for word in words))


def demand_exception(laws, kind, words, call):
    try:
        call()
    except kind as error:
        laws.demand(f"{kind.__name__}: {error}", words in str(error))
        return error
    laws.demand(f"{kind.__name__} is raised", False)


def folder_of(laws, scene, *arguments):
    done, folder = laws.start(scene, *arguments)
    if done.returncode:
        raise RuntimeError(done.stderr)
    return folder


def pictures(laws):
    plane = folder_of(laws, merge(press_and_shear(2, increments=2), DRAWN))
    runs = {"plane": plane, "space": folder_of(laws, merge(press_and_shear(3, increments=2), DRAWN)), "frame": folder_of(laws, GRID),
            "two bodies": folder_of(laws, merge(stack(2, [(6, 3), (5, 3)], (1.0, 1.0), .3, .3), DRAWN)),
            "blocks in space": folder_of(laws, merge(stack(3, [(3, 2, 2), (2, 2, 2)], (1.0, 1.0), .3, .3), DRAWN))}
    for name, folder in runs.items():
        file = laws.folder / f"{name}.png"
        demand_picture(laws, name, script(laws, "picture.py", folder, "-o", file), file)
    rendered(laws, runs)
    file = laws.folder / "other.png"
    demand_picture(laws, "pressure of increment 1", script(
        laws, "picture.py", plane, "-o", file, "--increment", 1, "--colour", "pressure", "--amplify", 3,
        "--units", "mm, N, MPa", "--contact", "bottom"), file)
    done = script(laws, "picture.py", plane, "--increment", "all", "-o", laws.folder / "film.png")
    demand_picture(laws, "film", done, laws.folder / "film-0002.png")
    laws.demand("a picture for each increment", len(list(laws.folder.glob("film-000?.png"))) == 2)

    demand_process(laws, "picture.py", laws.folder)
    demand_sentence(laws, script(laws, "picture.py", plane, "--increment", 7), "increment 7", "1 to 2")
    demand_sentence(laws, script(laws, "picture.py", plane, "--increment", "last"), "--increment")
    demand_sentence(laws, script(laws, "picture.py", plane, "--colour", "heat"), "'heat'", "von_mises")
    demand_sentence(laws, script(laws, "picture.py", plane, "--contact", "top"), "'top'", "bottom")
    demand_sentence(laws, script(laws, "picture.py", plane, "-o", plane / "none" / "x.png"), "cannot be written")
    demand_sentence(laws, script(laws, "picture.py", folder_of(laws, press_and_shear(2, increments=1))), "VTU")
    (plane / "reactions.csv").unlink()
    demand_sentence(laws, script(laws, "picture.py", plane), "reactions.csv")
    (runs["space"] / "solution-block-0002.vtu").write_text("<VTKFile>")
    demand_sentence(laws, script(laws, "picture.py", runs["space"]), "no VTU file")


def rendered(laws, runs):
    """Components, percentiles, films, sections, cells of second degree."""
    file, film = laws.folder / "component.png", laws.folder / "film.gif"
    demand_picture(laws, "a component without extremes", script(
        laws, "picture.py", runs["space"], "-o", file, "--field", "stress_zz", "--percentile", 98), file)
    second = folder_of(laws, merge(with_element(press_and_shear(3, increments=1), "Q2"), DRAWN))
    demand_picture(laws, "second degree", script(laws, "picture.py", second, "-o", file), file)
    done = script(laws, "picture.py", runs["plane"], "--film", film)
    laws.demand(f"a film {done.stderr.strip()}", done.returncode == 0 and film.read_bytes()[:4] == b"GIF8")
    demand_sentence(laws, script(laws, "picture.py", runs["plane"], "--film", "film.avi"), "film.avi", ".gif")
    demand_sentence(laws, script(laws, "picture.py", runs["plane"], "--clip", "x=0.5"), "--clip")
    from drawing import screen
    if screen.is_there():
        demand_picture(laws, "a section", script(laws, "picture.py", runs["space"], "-o", file, "--clip", "y=0.4"), file)
    else:
        demand_sentence(laws, script(laws, "picture.py", runs["space"], "--clip", "y=0.4"), "xvfb")


def curves(laws):
    block, path = folder_of(laws, merge(press_and_shear(2), {"Output": {"Probes": "tip: 1, 1"}})), folder_of(laws, pushed_block(2, .6, .5))
    file = laws.folder / "curve.png"
    for folder, *arguments in ((block, "strain_energy"), (block, "bottom_f_x", "u_t1"), (block, "pressure", "x", "--increment", 2),
                               (block, "r_t1", "r_n", "--near", "0,0"), (block, "r_n", "time", "--node", 0, "--log", "y"),
                               (block, "largest_displacement"), (block, "tip_u_y", "bottom_f_y"), (block, "r_n", "largest_pressure"),
                               (path, "time", "u_t1"), (path, "event", "parameter")):
        done = script(laws, "curve.py", folder, *arguments, "-o", file)
        laws.demand(f"{arguments}: drawn {done.stderr.strip()}", done.returncode == 0 and file.stat().st_size > 8000)
        file.unlink(missing_ok=True)
    laws.demand("all columns", "strain_energy" in script(laws, "curve.py", block).stdout)
    for words, *arguments in (("Did you mean 'bottom_f_x'", block, "botom_f_x"), ("no increment 9", block, "r_n", "x", "--increment", 9),
                              ("node 999", block, "r_n", "--node", 999), ("'side'", block, "r_n", "--contact", "side"),
                              ("Did you mean 'tip_u_x'", block, "tip_ux"), ("no increments", path, "event", "u_t1")):
        demand_sentence(laws, script(laws, "curve.py", *arguments), words)
    refused = laws.folder / "refused"
    conetact.run(BLOCK, {MU: .3}, folder=refused, check=False)
    demand_sentence(laws, script(laws, "curve.py", refused, "bottom_f_x"), "no increment that could be drawn")
    demand_process(laws, "curve.py", laws.folder)


def runs(laws):
    result = conetact.run(BLOCK, {MU: .6, "Output/VTU": 1})
    steps, rows = result.increments, result.reactions
    laws.check("push is carried", abs(steps["bottom_f_x"][-1] + .4), 1e-10)
    laws.check("nodal forces sum up", abs(rows["r_n"].sum() - 1), 1e-10)
    laws.demand("counts, texts, entries, log", rows["node"].dtype.kind == "i" and steps["slip"][-1] == (rows["state"] == "slip").sum()
                and result.entries[MU] == "0.6" and result.dimension == 2 and result.exit_code == 0
                and result.log.startswith("Conetact"))
    mesh = result.bodies(result.drawn_increments()[-1])["block"]
    laws.demand("bodies", mesh.points.shape == (231, 3) and np.isfinite(mesh.arrays["stress"]).all())
    folder = result.folder
    named = shutil.copytree(folder, laws.folder / "named")
    for drawing in named.glob("*-block-*.vtu"):
        drawing.rename(named / drawing.name.replace("block", "m__"))
    (named / "used.prm").write_text(re.sub(r"(?m)^(set Bodies *= *)block$", r"\1mü", (named / "used.prm").read_text(encoding="utf-8")),
                                    encoding="utf-8")
    laws.demand("bodies have their names in the scene", list(conetact.Result(named).bodies(1)) == ["mü"])
    del result
    laws.demand("a temporary folder goes with its result", not folder.exists())

    demand_exception(laws, conetact.InputError, "Did you mean", lambda: conetact.run(BLOCK, {MU + "s": 1}))
    error = demand_exception(laws, conetact.AnalysisError, "slides", lambda: conetact.run(BLOCK, {MU: .3}))
    laws.demand("tables of increments before", len(error.result.increments) == 0 and error.result.exit_code == 2)
    laws.demand("check=False", isinstance(conetact.run(BLOCK, {MU: .3}, check=False).error, conetact.AnalysisError))
    demand_exception(laws, conetact.WriteError, "/proc/none", lambda: conetact.run(BLOCK, folder="/proc/none"))
    demand_exception(laws, conetact.InputError, "cannot be read", lambda: conetact.run(laws.folder / "none.prm"))
    demand_exception(laws, conetact.ResultError, "events.csv", lambda: conetact.run(BLOCK).events)
    bare = laws.folder / "bare"
    bare.mkdir()
    for folder, words in ((bare, "is it a folder of results"), (laws.folder / "missing", "no folder")):
        demand_exception(laws, conetact.ResultError, words, lambda: conetact.Result(folder))
    os.environ["CONETACT"] = str(laws.folder / "none")
    demand_exception(laws, conetact.ConetactError, "CONETACT", lambda: conetact.run(BLOCK))
    os.environ["CONETACT"] = str(laws.program)

    endings(laws)
    file = laws.folder / "path.prm"
    write_scene(pushed_block(2, .6, .5), file)
    path = conetact.run(file)
    words, parameter = path.outcome
    laws.check("limit load", abs(parameter - .5), 1e-12)
    laws.demand("events", words.startswith("limit load") and len(path.events) > 5 and path.events["to"][0] in ("open", "slip+", "slip-"))


def endings(laws):
    """Folders of runs that were refused, stopped, killed tell so."""
    refused = conetact.run(BLOCK, {"Load push/Value": "0.4*t*t", "Time/End": 2, "Time/Increments": 8}, laws.folder / "refused", check=False)
    again = conetact.Result(refused.folder)
    laws.demand(f"refused: {again}", again.exit_code == 2 and len(again.increments) == 5 and isinstance(again.error, conetact.AnalysisError)
                and str(again.error) == str(refused.error) and again.error.result is again)
    log = refused.folder / "log.txt"
    for words, text in (("no end", log.read_text().partition("Increment 4 of 8")[0]), ("no log.txt", None)):
        log.unlink() if text is None else log.write_text(text)
        killed = conetact.Result(refused.folder)
        laws.demand(f"killed: {killed}", killed.exit_code is None and words in str(killed.error) and "unknown" in repr(killed)
                    and not isinstance(killed.error, conetact.AnalysisError))
    stopped = stopped_by_hand(laws, "-s", "Time/Increments=200000", "-s", "Output/VTU=0")
    laws.demand(f"stopped by Ctrl-C: {stopped}, {stopped.error}", stopped.exit_code is None and str(stopped.error).startswith(
                f"Interrupted after increment {len(stopped.increments)},"))
    path = laws.folder / "limit.prm"
    write_scene(pushed_block(2, .6, .5), path)
    whole = conetact.run(path, folder=laws.folder / "whole")
    laws.demand("whole, of increments and of a path", conetact.Result(whole.folder).exit_code == 0 == conetact.Result(
                conetact.run(BLOCK, folder=laws.folder / "all").folder).exit_code)


def stopped_by_hand(laws, *arguments):
    folder = laws.folder / "stopped"
    process = subprocess.Popen([laws.program, BLOCK, "-q", "-o", folder, *arguments], stderr=subprocess.DEVNULL,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    while process.poll() is None and "Increment 1 of" not in text_of(folder / "log.txt"):
        time.sleep(.02)
    process.send_signal(signal.SIGINT)
    process.wait()
    return conetact.Result(folder)


def text_of(file):
    return file.read_text() if file.exists() else ""


def sweeps(laws):
    quiet = {"Output/VTU": 0}
    lists = {MU: [.3, .5, np.float64(.7)], "Load push/Value": ["0.2*t", "0.4*t"]}
    results = conetact.sweep(BLOCK, lists, quiet, progress=False)
    laws.demand("products in order", [(r.changes[MU], r.changes["Load push/Value"]) for r in results] ==
                [(mu, push) for mu in lists[MU] for push in lists["Load push/Value"]])
    laws.demand("one without equilibrium", [r.exit_code for r in results] == [0, 2, 0, 0, 0, 0]
                and isinstance(results[1].error, conetact.AnalysisError))
    laws.check("each has its load", max(abs(r.increments["bottom_f_x"][-1] + float(r.changes["Load push/Value"][:3]))
                                        for r in results if not r.error), 1e-10)
    single = conetact.sweep(BLOCK, {MU: .5, "Load push/Value": "0.2*t"}, quiet, progress=False)
    laws.demand("a text and a number are one value each", [r.changes for r in single] ==
                [{**quiet, MU: .5, "Load push/Value": "0.2*t"}])
    folder = laws.folder / "sweep"
    zipped = conetact.sweep(BLOCK, {MU: [.5, .7], "Load push/Value": ["0.2*t", "0.4*t"]}, quiet, zipped=True, folder=folder,
                            processes=2)
    laws.demand("zipped, in folders that stay", len(zipped) == 2 and zipped[1].folder == folder / "0002"
                and conetact.Result(folder / "0002").entries[MU] == "0.7")
    demand_exception(laws, conetact.InputError, "one length", lambda: conetact.sweep(BLOCK, {"a": [1], "b": [1, 2]}, zipped=True))
    demand_exception(laws, conetact.InputError, "Did you mean", lambda: conetact.sweep(BLOCK, {MU + "s": [1, 2]}, progress=False))


def shapes(laws):
    """What pictures stand on."""
    import drawing.shapes as shapes
    from drawing.colours import Scale
    from conetact.units import Units
    for dim, expected in ((2, 6.0), (3, 2 * (1.5 + 1.5 + 1.0))):
        scene = merge(press_and_shear(dim, (4, 4, 4)[:dim]), DRAWN)
        mesh = scene["Body block"]["Mesh"]
        mesh["Refinement boxes"] = "0, 0 : 0.6, 0.6 : 1" if dim == 2 else "0, 0, 0 : 0.6, 0.6, 0.6 : 1"
        result = conetact.Result(folder_of(laws, scene))
        body = shapes.shapes_of(result, 1, 1.0).bodies[0]
        corners = body.points[body.faces]
        first, last = corners[:, 1] - corners[:, 0], corners[:, -1] - corners[:, 0]
        sizes = np.linalg.norm(first if dim == 2 else np.cross(first, last), axis=1)
        laws.check(f"cells of two levels, {dim}D: the surface is closed, nothing inside", abs(sizes.sum() - expected), 1e-5)
    laws.demand("factors", [shapes.nice(x) for x in (.3, 1.7, 2, 4.99, 73, 2e4, np.inf)] == [1, 1, 2, 2, 50, 2e4, 1])
    import matplotlib.pyplot as plt
    for low, high in ((4.358, 4.358 + 1e-10), (-7e20, -7e20), (0, 0)):
        scale, (figure, axes) = Scale("von_mises", low, high), plt.subplots()
        bar = scale.draw_bar(figure, axes, Units(""))
        laws.demand(f"rounding of {low:g} has one colour and one number", len({scale.map(scale.norm(x)) for x in (low, high)}) == 1
                    and [text.get_text() for text in bar.ax.get_xticklabels()] == [f"{low:.6g}"])
    figure, axes = plt.subplots()
    bar = Scale("von_mises", 4.358, 4.35801).draw_bar(figure, axes, Units(""))
    figure.canvas.draw()
    laws.demand("numbers of bars have no offset", bar.formatter.get_offset() == "")
    plt.close("all")
    units = Units("N, mm, MPa (any consistent ones)")
    laws.demand("units", [units.label(name) for name in ("r_n", "x", "pressure", "bottom_m_z", "slip")] ==
                ["r_n [N]", "x [mm]", "pressure [MPa]", "bottom_m_z [N mm]", "slip"])
    laws.demand("stresses by force and length", [Units(words).label("pressure") for words in ("N, mm, s, K", "kip, ft")]
                == ["pressure [MPa]", "pressure [kip/ft²]"])
    laws.demand("odd units, none", Units("m and 205.8 MN").label("r_n") == "r_n [205.8 MN]" and Units("").label("r_n") == "r_n")


def unrolled(laws):
    """Places, arrows and labels of cylinders and cones; what is neither is seen from one side."""
    from drawing.unrolled import sheet_of

    def ring(turn, slope=0., axis=2, radius=10., n=40):
        angles, z = (a.ravel() for a in np.meshgrid(np.linspace(-turn / 2, turn / 2, n, endpoint=turn < 6.2), np.linspace(3, 9, 5)))
        r, fall = radius + slope * (z - 6), np.hypot(1, slope)
        points = np.column_stack((r * np.cos(angles), r * np.sin(angles), z))
        normals = np.column_stack((-np.cos(angles), -np.sin(angles), np.full(len(z), slope))) / fall
        return angles, z, np.roll(points + (5, -3, 0), axis - 2, axis=1), np.roll(normals, axis - 2, axis=1)
    for words, turn, slope, axis in (("half a bore", np.pi, 0, 2), ("a bore", 2 * np.pi, 0, 2), ("a taper", 2 * np.pi, .1, 2),
                                     ("a steep cone about x", 4, 1, 0), ("a bore about y", 2 * np.pi, 0, 1)):
        angles, z, points, normals = ring(turn, slope, axis)
        sheet = sheet_of(points, normals)
        arc, along = sheet.at.T
        laws.check(f"{words}: along the axis", np.abs(along - z).max(), 1e-9)
        span = np.mod(arc / 10 - angles, 2 * np.pi)  # angles begin at one of the axes
        laws.check(f"{words}: arc length", np.abs(np.exp(1j * span) - np.exp(1j * span[0])).max(), 1e-9)
        laws.demand(f"{words}: {sheet.labels}", sheet.labels[1] == "xyz"[axis] and sheet.labels[0].startswith("arc length at the mean radius 10"))
        laws.demand(f"{words}: closed or not", (sheet.period > 0) == (turn > 6))
        hoop = np.roll(np.column_stack((-np.sin(angles), np.cos(angles), 0 * z)), axis - 2, axis=1)
        laws.check(f"{words}: arrows", max(np.abs(sheet.parts(hoop)[0] - 1).max(), np.abs(sheet.parts(hoop)[1]).max()), 1e-9)
    angles, z, points, normals = ring(2 * np.pi)
    sheet = sheet_of(points, normals)
    n = 40
    faces = np.array([(n * j + i, n * j + (i + 1) % n, n * (j + 1) + i) for j in range(4) for i in range(n)])
    places, number, drawn = sheet.triangles(faces)
    laws.demand("no triangle reaches across, those of the cut are at both ends", len(drawn) == len(faces) + 4 and len(places) == len(number)
                and np.ptp(places[drawn][:, :, 0], axis=1).max() < 2 * 2 * np.pi * 10 / n)
    flat = np.tile((0., 0., 1.), (25, 1))
    grid = np.column_stack([a.ravel() for a in np.meshgrid(range(5), range(5))] + [np.zeros(25)]).astype(float)
    laws.demand("a plane", sheet_of(grid, flat).labels == ("x", "y"))
    _, _, points, normals = ring(1.5)
    laws.demand("a part of a bore", sheet_of(points, normals).labels == ("y", "z"))
    ball = np.random.default_rng(1).normal(size=(200, 3))
    ball /= np.linalg.norm(ball, axis=1)[:, None]
    laws.demand("a ball", "arc" not in sheet_of(ball, ball).labels[0])
    sides = np.repeat(np.eye(3)[[0, 0, 1, 1]] * [[1], [-1], [1], [-1]], 9, axis=0)
    box = 3 * sides + np.tile(np.column_stack([a.ravel() for a in np.meshgrid((-1, 0, 1), (0, 1, 2))]), (4, 1))[:, [0, 0, 1]] * (1 - np.abs(sides))
    laws.demand("four sides of a box", "arc" not in sheet_of(box, sides).labels[0])


CASES = {"pictures": pictures, "curves": curves, "runs": runs, "sweeps": sweeps, "shapes": shapes, "unrolled": unrolled}

if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[2] not in CASES:
        sys.exit(__doc__)
    os.environ["CONETACT"] = str(Path(sys.argv[1]).resolve())
    sys.exit(run_families(CASES, sys.argv[1], sys.argv[2]))
