# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Films of pictures: GIF by what matplotlib needs anyway, MP4 by ffmpeg."""
import contextlib
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from conetact import ConetactError

SECONDS = 6  # of a film of many pictures
LONGEST, SHORTEST = .6, .08  # of one picture


def check(file):
    """Before anything is drawn."""
    if file.suffix.lower() not in (".gif", ".mp4"):
        raise ConetactError(f"--film is '{file}'; it must end in .gif or .mp4.")
    if file.suffix.lower() == ".mp4" and not shutil.which("ffmpeg"):
        raise ConetactError("ffmpeg, which makes .mp4, is not installed (Debian: ffmpeg); a .gif needs nothing more.")
    if not file.absolute().parent.is_dir():
        raise ConetactError(f"{file} cannot be written: there is no folder {file.parent}.")


def seconds_each(n):
    return min(max(SECONDS / n, SHORTEST), LONGEST)


def make_gif(files, file):
    from PIL import Image
    pictures = [Image.open(name).convert("RGB") for name in files]
    first = pictures[-1].quantize(256)  # the colours of all, by the picture that has most of them
    frames = [picture.quantize(palette=first, dither=Image.Dither.NONE) for picture in pictures]
    frames[0].save(file, save_all=True, append_images=frames[1:], loop=0, duration=int(1000 * seconds_each(len(files))))


def make_mp4(files, file):
    """Widths and heights have to be even numbers."""
    rate = 1 / seconds_each(len(files))
    listed = Path(files[0]).parent / "list.txt"
    listed.write_text("".join(f"file '{name}'\nduration {1 / rate}\n" for name in files))
    done = subprocess.run(["ffmpeg", "-y", "-loglevel", "error", "-f", "concat", "-safe", "0", "-i", listed, "-vf",
                           "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-r", "25", "-pix_fmt", "yuv420p", file],
                          capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if done.returncode:
        raise ConetactError(f"{file} cannot be made by ffmpeg: {done.stderr.strip().splitlines()[-1:]}.")


def make(file, draw_all):
    """`draw_all` draws pictures beside a file and returns theirs."""
    with tempfile.TemporaryDirectory(prefix="conetact-film-") as folder:
        with open(os.devnull, "w") as nowhere, contextlib.redirect_stdout(nowhere):
            files = draw_all(Path(folder) / "picture.png")
        try:
            (make_gif if file.suffix.lower() == ".gif" else make_mp4)(files, file)
        except OSError as error:
            raise ConetactError(f"{file} cannot be written: {error.strerror}.") from None
    print(file)
