"""A settled packing in the forms that codes read.

    python3 state.py settled.csv data OUT        data file of LAMMPS and LIGGGHTS (atom styles sphere and granular), two types for a wall with laws of its own
    python3 state.py settled.csv text OUT        x y z vx vy vz wx wy wz r, one sphere a line, SI units
"""

import pathlib
import sys

RADIUS = 1.5e-3
DENSITY = 2500
SIDE = 0.036
HEIGHT = 0.4
# Division by a power of ten that a double holds exactly rounds once: the same double in every code.
SCALES = [1e12] * 3 + [1e9] * 3 + [1e6] * 3


def read(path):
    for line in pathlib.Path(path).read_text().splitlines()[1:]:
        yield [int(number) / scale for number, scale in zip(line.split(","), SCALES)]


def data(rows):
    head = ["settled packing", "", f"{len(rows)} atoms", "2 atom types", ""]
    head += [f"0 {SIDE!r} xlo xhi", f"0 {SIDE!r} ylo yhi", f"0 {HEIGHT!r} zlo zhi", "", "Atoms", ""]
    atoms = [f"{number} 1 {2 * RADIUS!r} {DENSITY} " + numbers(row[:3]) for number, row in enumerate(rows, 1)]
    velocities = [f"{number} " + numbers(row[3:]) for number, row in enumerate(rows, 1)]
    return head + atoms + ["", "Velocities", ""] + velocities


def text(rows):
    return [numbers(row + [RADIUS]) for row in rows]


def numbers(row):
    return " ".join(map(repr, row))


if __name__ == "__main__":
    path, form, out = sys.argv[1:]
    lines = {"data": data, "text": text}[form](list(read(path)))
    pathlib.Path(out).write_text("\n".join(lines) + "\n")
