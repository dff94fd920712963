# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where VTK draws: Debian's VTK wants an X server even for pictures in memory, so one without a screen is started.

Xvfb is preferred to the screen of the user: it is always of the same kind, and nothing flickers.
"""
import atexit
import ctypes
import os
import select
import shutil
import signal
import socket
import subprocess
import sys
from pathlib import Path

SECONDS = 60  # a server that has said nothing until then will not
_found = []  # whether there is a screen, once it is known
_open = []  # windows, which must go before their screen


def remember(window):
    _open.append(window)


def end_with_parent():
    """Linux ends the server when this process is gone, whatever ends it."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)


def start_xvfb():
    """The X server chooses a free number, tells it when it is ready, and waits: large files take longer to read than -terminate lets it
    live without a window."""
    told, tell = os.pipe()
    words = ["-screen", "0", "64x64x24", "-nolisten", "tcp"]
    server = subprocess.Popen(["Xvfb", "-displayfd", str(tell), *words],
                              pass_fds=[tell], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, preexec_fn=end_with_parent)
    os.close(tell)
    with os.fdopen(told) as stream:
        number = stream.readline().strip() if select.select([stream], [], [], SECONDS)[0] else ""
    if not number:
        server.kill()
        server.wait()
        return False
    os.environ["DISPLAY"] = f":{number}"
    atexit.register(stop, server)
    return True


def stop(server):
    while _open:
        _open.pop().Finalize()
    server.terminate()
    server.wait()


def answers(display):
    """Whether a screen of this machine is there; VTK would end the program if it were not."""
    place = Path("/tmp/.X11-unix") / f"X{display.lstrip(':').split('.')[0]}"
    try:
        with socket.socket(socket.AF_UNIX) as line:
            line.connect(str(place))
        return display.startswith(":")
    except OSError:
        return False


def why_not():
    """"" if VTK can draw here."""
    try:
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    except ImportError:
        return "VTK is not installed (Debian: python3-vtk9)"
    if (shutil.which("Xvfb") and start_xvfb()) or answers(os.environ.get("DISPLAY", "")):
        return ""
    return "VTK finds no X server (Debian: xvfb)"


def is_there():
    """Says once what is missing."""
    if not _found:
        reason = why_not()
        _found.append(not reason)
        if reason:
            print(f"picture.py: bodies in space are drawn by matplotlib: {reason}.", file=sys.stderr)
    return _found[0]
