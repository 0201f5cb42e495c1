"""Makes the settled packings: 10,000 spheres of 3 mm in a periodic column of 12 x 12 diameters on a floor, from which every code starts, and a bed of 1000 that
copies side by side make as wide as one likes.

    python3 settle.py [lmp]          writes settled.csv, settled_frictionless.csv and settled_thousand.csv; about ten minutes of CPU time

A loose column at random velocities falls and comes to rest in LAMMPS with friction (settle.in); without friction, or with friction that has no memory, that
packing would fall apart within a millisecond, so it sinks once more into a denser one (settle_frictionless.in). A state is rounded to whole picometres, nanometres per second and
microradians per second, so that every code reads the same numbers whatever its parser: the overlap under the weight of one sphere is 3,500 pm.
"""

import itertools
import pathlib
import random
import subprocess
import sys
import tempfile

DIAMETER = 3e-3
SIDE = 12 * DIAMETER
SCALES = [1e12] * 3 + [1e9] * 3 + [1e6] * 3


def write_loose_column(path, spheres):
    generator = random.Random(7)
    per_side = 11
    spacing = SIDE / per_side
    lines = [f"loose column\n\n{spheres} atoms\n1 atom types\n\n0 {SIDE:g} xlo xhi\n0 {SIDE:g} ylo yhi\n0 0.4 zlo zhi\n\nAtoms\n"]
    velocities = ["\nVelocities\n"]
    for index in range(spheres):
        layer, place = divmod(index, per_side * per_side)
        column, row = divmod(place, per_side)
        shift = [generator.uniform(-0.02, 0.02) * DIAMETER for _ in range(3)]
        x, y = (column + 0.5) * spacing + shift[0], (row + 0.5) * spacing + shift[1]
        z = 0.55 * DIAMETER + layer * 1.06 * DIAMETER + abs(shift[2])
        lines.append(f"{index + 1} 1 {DIAMETER:g} 2500 {x:.9g} {y:.9g} {z:.9g}")
        across = [generator.uniform(-0.3, 0.3) for _ in range(2)]
        velocities.append(f"{index + 1} {across[0]:.4g} {across[1]:.4g} {generator.uniform(-0.1, 0):.4g} 0 0 0")
    path.write_text("\n".join(lines + velocities) + "\n")


def section(lines, name):
    start = next(index for index, line in enumerate(lines) if line.split("#")[0].strip() == name) + 2
    rows = (line.split() for line in itertools.takewhile(str.strip, lines[start:]))
    return {int(row[0]): [float(number) for number in row[1:]] for row in rows}


def settled_state(path):
    """Nine whole numbers a sphere, from a data file of LAMMPS, by the spheres' numbers."""
    lines = path.read_text().splitlines()
    atoms, velocities = section(lines, "Atoms"), section(lines, "Velocities")
    for number in sorted(atoms):
        position = [atoms[number][3] % SIDE, atoms[number][4] % SIDE, atoms[number][5]]
        yield [round(value * scale) for value, scale in zip(position + velocities[number], SCALES)]


def write_settled(path, out):
    header = "x/pm,y/pm,z/pm,vx/(nm/s),vy/(nm/s),vz/(nm/s),wx/(urad/s),wy/(urad/s),wz/(urad/s)"
    out.write_text("\n".join([header] + [",".join(map(str, row)) for row in settled_state(path)]) + "\n")


def main():
    here = pathlib.Path(__file__).resolve().parent
    for spheres, decks in [
        (10_000, [("settle.in", "settled_3.data", "settled.csv"), ("settle_frictionless.in", "frictionless.data", "settled_frictionless.csv")]),
        (1000, [("settle.in", "settled_3.data", "settled_thousand.csv")]),
    ]:
        with tempfile.TemporaryDirectory() as folder:
            write_loose_column(pathlib.Path(folder) / "loose.data", spheres)
            for deck, state, out in decks:
                subprocess.run([*(sys.argv[1:2] or ["lmp"]), "-in", here / deck, "-var", "folder", folder], check=True)
                write_settled(pathlib.Path(folder) / state, here / out)


if __name__ == "__main__":
    main()
