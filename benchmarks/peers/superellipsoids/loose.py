"""Commands of LIGGGHTS that place superellipsoids on a loose grid with random orientations.

    python3 loose.py COUNT BLOCKINESS > loose.include

Half axes 4:1:1 of the volume of a sphere of 3 mm; blockiness 2 is an ellipsoid, larger ones are boxier (exponents of LIGGGHTS: |x/a|^n).
"""

import math
import random
import sys

count, blockiness = int(sys.argv[1]), float(sys.argv[2])
side, per_side, layer = 0.024, 3, 0.0085
half_axes = [1.5e-3 * 4 ** (2 / 3), 1.5e-3 * 4 ** (-1 / 3), 1.5e-3 * 4 ** (-1 / 3)]
generator = random.Random(11)
for index in range(count):
    height, place = divmod(index, per_side * per_side)
    x, y = ((number + 0.5) * side / per_side for number in divmod(place, per_side))
    axis = [generator.gauss(0, 1) for _ in range(3)]
    length = math.sqrt(sum(component * component for component in axis))
    turn = [component / length for component in axis] + [generator.uniform(0, 360)]
    speed = [generator.uniform(-0.2, 0.2) for _ in range(2)]
    print(f"create_atoms 1 single {x:.9g} {y:.9g} {(height + 0.6) * layer:.9g} units box")
    print(f"set atom {index + 1} shape {half_axes[0]:.12g} {half_axes[1]:.12g} {half_axes[2]:.12g} blockiness {blockiness} {blockiness} density 2500")
    print(f"set atom {index + 1} vx {speed[0]:.4g} vy {speed[1]:.4g} vz -3 quat {' '.join('%.9g' % number for number in turn)}")
