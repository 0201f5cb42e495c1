"""YADE, ViscElMat: spheres far apart that each meet a wall at z = 0 or a partner.

    yade -n -x -j1 yade_impacts.py JOBS.json        each job names the file for its bodies after the run

Parameters of two materials are joined in series, so each has twice those of the contact. Velocities are half a step behind positions; where a force acts at
the end (jobs with `synchronise`), the mean of two steps is taken.
"""

import json
import math
import sys


def run(job):
    O.reset()
    material = O.materials.append(
        ViscElMat(
            kn=2 * job["stiffness"],
            ks=2 * job["tangential_stiffness"],
            cn=2 * job["normal_dashpot"],
            cs=2 * job["tangential_dashpot"],
            frictionAngle=math.atan(job["friction"]),
            density=job["density"],
        )
    )
    for body in job["bodies"]:
        number = O.bodies.append(sphere(body[1:4], body[0], material=material))
        O.bodies[number].state.vel, O.bodies[number].state.angVel = body[4:7], body[7:10]
    balls = list(range(len(job["bodies"])))
    if job["wall"]:
        O.bodies.append(utils.wall(0.0, axis=2, sense=1, material=material))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.5e-3),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
            [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
            [Law2_ScGeom_ViscElPhys_Basic()],
        ),
        NewtonIntegrator(damping=0.0, gravity=job["gravity"]),
    ]
    O.dt = job["step"]
    if job["steps"] > 0:  # zero steps would be without end
        O.run(job["steps"], True)
    states = [O.bodies[number].state for number in balls]
    positions = [list(state.pos) for state in states]
    motions = [list(state.vel) + list(state.angVel) for state in states]
    if job["synchronise"]:
        O.run(1, True)
        later = [list(state.vel) + list(state.angVel) for state in (O.bodies[number].state for number in balls)]
        motions = [[0.5 * (one + other) for one, other in zip(*pair)] for pair in zip(motions, later)]
    with open(job["out"], "w") as out:
        for number, (position, motion) in enumerate(zip(positions, motions), 1):
            out.write(" ".join([str(number)] + ["%.17g" % value for value in position + motion]) + "\n")


for job in json.load(open(sys.argv[1])):
    run(job)
