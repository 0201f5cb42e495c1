"""YADE: steps of the settled packing.

    yade -n -x -jN yade.py STATE LAW STEPS      STATE as state.py text writes it; LAW: history, viscous or frictionless

Linear spring and dashpot of ViscElMat (no attraction), tangential spring with memory under Coulomb's cap. YADE joins the parameters of two materials in
series, so each has twice those of the contact; its dashpots are constants, here those of the effective mass of two spheres. A flat floor does not act in a
periodic cell, so the spheres that lie on it are held fixed.
"""

import math
import sys
import time

state, law, steps = sys.argv[1], sys.argv[2], int(sys.argv[3])
side, stiffness, density, rate = 0.036, 1e5, 2500.0, 13719.66
friction = {"history": 0.5, "viscous": 0.5, "frictionless": 0.0}[law]
shear_stiffness = 2 / 7 * stiffness if law == "history" else 0.0
shear_share = 0.0 if law == "frictionless" else 0.5

O.periodic = True
O.cell.setBox(side, side, 0.6)
rows = [list(map(float, line.split())) for line in open(state)]
radius = rows[0][9]
dashpot = rate * 0.5 * density * 4 / 3 * math.pi * radius**3
material = O.materials.append(
    ViscElMat(
        kn=2 * stiffness,
        ks=2 * shear_stiffness,
        cn=2 * dashpot,
        cs=2 * shear_share * dashpot,
        frictionAngle=math.atan(friction),
        density=density,
    )
)
for row in rows:
    body = sphere(row[:3], radius, material=material, fixed=row[2] < 1.02 * radius)
    if not body.state.blockedDOFs:
        body.state.vel, body.state.angVel = row[3:6], row[6:9]
    O.bodies.append(body)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], allowBiggerThanPeriod=True, verletDist=0.15e-3),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_ViscElMat_ViscElMat_ViscElPhys()], [Law2_ScGeom_ViscElPhys_Basic()]),
    NewtonIntegrator(damping=0.0, gravity=(0, 0, -9.81)),
]
O.dt = 2e-6
O.run(1, True)  # finds the neighbours
cpu, wall = time.process_time(), time.perf_counter()
O.run(steps, True)
print("stepping %.6f %.6f" % (time.process_time() - cpu, time.perf_counter() - wall))
contacts = sum(1 for interaction in O.interactions if interaction.isReal)
print("coordination %.4f" % (2 * contacts / len(rows)))
