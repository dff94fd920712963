# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures as files."""
import matplotlib.pyplot as plt

from conetact import ConetactError


def save(figure, file, dpi=130):
    """Writes a picture and says where it is; the figure is closed. `dpi`: dots an inch."""
    try:
        figure.savefig(file, dpi=dpi)
    except (OSError, ValueError) as error:
        raise ConetactError(f"{file} cannot be written: {error}") from None
    plt.close(figure)
    print(file)
