# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures as files."""
import contextlib
from pathlib import Path

import matplotlib.pyplot as plt

from conetact import ConetactError


def save(figure, file, dpi=130):
    """Writes a picture and says where it is; the figure is closed. `dpi`: dots an inch. Nothing stays where it is not whole."""
    file = Path(file)
    part = file.with_name(f"{file.stem}.part{file.suffix or '.png'}")  # the ending tells the format
    try:
        figure.savefig(part, dpi=dpi)
        part.replace(file)
    except (OSError, ValueError) as error:
        with contextlib.suppress(OSError):
            part.unlink()
        raise ConetactError(f"{file} cannot be written: {error}") from None
    plt.close(figure)
    print(file)
