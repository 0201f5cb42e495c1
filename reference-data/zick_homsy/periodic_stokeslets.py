"""Friction factors of cubic arrays of fixed spheres in creeping flow, by fundamental solutions.

Periodic Stokeslets (Hasimoto 1959), summed as Beenakker (1986) does, lie on a sphere inside each sphere; their strengths are those that let the
velocity vanish at points of the surface, in the least squares. The lattice has one sphere a cell, whatever its kind. The mean velocity is that of the
constant term: the velocity through a plane is the same for all planes, and none of it passes a sphere. Nothing here knows of grids.
"""
import argparse
import numpy as np
from scipy.special import erfc

CELLS = {
    "simple cubic": np.eye(3),
    "body-centred cubic": 0.5 * np.array([[-1, 1, 1], [1, -1, 1], [1, 1, -1]]),
    "face-centred cubic": 0.5 * np.array([[0, 1, 1], [1, 0, 1], [1, 1, 0]]),
}


def spread(number):
    """Points of a unit sphere, nearly evenly spread."""
    index = np.arange(number) + 0.5
    height, angle = 1 - 2 * index / number, np.pi * (1 + 5**0.5) * index
    ring = np.sqrt(1 - height**2)
    return np.stack([ring * np.cos(angle), ring * np.sin(angle), height], axis=1)


def lattice(vectors, reach):
    """Lattice points up to a distance from the origin."""
    count = int(np.ceil(reach * np.linalg.norm(np.linalg.inv(vectors), axis=0).max())) + 1
    numbers = np.stack(np.meshgrid(*[np.arange(-count, count + 1)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    points = numbers @ vectors
    return points[np.linalg.norm(points, axis=1) <= reach]


def velocities(targets, sources, cell, split, digits=16):
    """8 pi viscosity times the velocities at targets of unit forces at sources and their images: 3 targets x 3 sources."""
    volume = abs(np.linalg.det(cell))
    far = np.sqrt(digits * np.log(10)) / split
    matrix = np.zeros((len(targets), 3, len(sources), 3))
    between = targets[:, None, :] - sources[None, :, :]
    reach = far + np.linalg.norm(between, axis=2).max()
    identity = np.eye(3)
    for image in lattice(cell, reach):
        apart = between + image
        r = np.linalg.norm(apart, axis=2)
        if r.min() > far:
            continue
        bell = np.exp(-((split * r) ** 2)) * split / np.sqrt(np.pi)
        first = erfc(split * r) - 2 * r * bell
        second = bell * (4 * (split * r) ** 2 - 4)
        even, along = second + first / r, (first / r - second) / r**2
        matrix += np.einsum("ts,ij->tisj", even, identity) + np.einsum("ts,tsi,tsj->tisj", along, apart, apart)
    waves = 2 * np.pi * lattice(np.linalg.inv(cell).T, np.sqrt(digits * np.log(10)) * split / np.pi)
    waves = waves[np.linalg.norm(waves, axis=1) > 0]
    square = (waves**2).sum(axis=1)
    weight = 8 * np.pi / volume / square * (1 + square / (4 * split**2) + square**2 / (8 * split**4)) * np.exp(-square / (4 * split**2))
    phases = [points @ waves.T for points in (targets, sources)]
    parts = [(np.cos(phase), np.sin(phase)) for phase in phases]
    for i in range(3):
        for j in range(3):
            tensor = weight * (identity[i, j] - waves[:, i] * waves[:, j] / square)
            matrix[:, i, :, j] += sum((parts[0][k] * tensor) @ parts[1][k].T for k in range(2))
    return matrix.reshape(3 * len(targets), 3 * len(sources))


def friction_factor(kind, solid_fraction, forces, depth, points_a_force=2.0, split=None):
    """Drag over that of Stokes at the mean velocity, and the largest slip at other points of the surface."""
    cell = CELLS[kind]
    volume = abs(np.linalg.det(cell))
    radius = (3 * solid_fraction * volume / (4 * np.pi)) ** (1 / 3)
    split = split or 4 / volume ** (1 / 3)
    sources = depth * radius * spread(forces)
    targets = radius * spread(int(points_a_force * forces))
    matrix = velocities(targets, sources, cell, split)
    wind = np.tile([1.0, 0.0, 0.0], len(targets))
    strength, *_ = np.linalg.lstsq(matrix, -wind, rcond=1e-15)
    others = radius * spread(int(1.3 * points_a_force * forces) + 7)
    slip = velocities(others, sources, cell, split) @ strength + np.tile([1.0, 0.0, 0.0], len(others))
    total = strength.reshape(-1, 3).sum(axis=0)
    # Strengths are over 8 pi viscosity.
    return -total[0] * 8 * np.pi / (6 * np.pi * radius), np.abs(slip).max()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kind", choices=CELLS)
    parser.add_argument("solid_fraction", type=float)
    parser.add_argument("--forces", type=int, nargs="+", default=[100, 200, 400])
    parser.add_argument("--depth", type=float, nargs="+", default=[0.5, 0.6, 0.7])
    parser.add_argument("--split", type=float)
    arguments = parser.parse_args()
    for forces in arguments.forces:
        for depth in arguments.depth:
            factor, slip = friction_factor(arguments.kind, arguments.solid_fraction, forces, depth, split=arguments.split)
            print(f"{arguments.kind}, {arguments.solid_fraction}: {forces} forces at {depth} radii: {factor:.8f}, slip {slip:.1e}", flush=True)
