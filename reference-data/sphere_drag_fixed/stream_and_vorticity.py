"""Drag of a sphere held in a uniform stream: steady, axisymmetric, by stream function and vorticity.

Radii are 1 at the surface and e^xi elsewhere, angles from the downstream axis; second-order central differences in both, Newton's method from one
Reynolds number (on the diameter) to the next. Drag is the integral of the vorticity of the surface (friction) and of its slope (pressure).
"""
import argparse
import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu


class Sphere:
    def __init__(self, radii, angles, outermost):
        self.shape = (radii + 1, angles + 1)
        self.xi = np.linspace(0, np.log(outermost), radii + 1)
        self.theta = np.linspace(0, np.pi, angles + 1)
        self.h, self.k = self.xi[1], self.theta[1]
        self.r = np.exp(self.xi)[:, None] * np.ones(self.shape)
        self.sin = np.sin(self.theta)[None, :] * np.ones(self.shape)
        self.sin[:, [0, -1]] = 0.0
        inside = np.zeros(self.shape, bool)
        inside[1:-1, 1:-1] = True
        self.inside = inside.ravel()
        one_r, one_t = sparse.identity(radii + 1), sparse.identity(angles + 1)
        central = lambda n, d: sparse.diags([-1 / (2 * d), 1 / (2 * d)], [-1, 1], shape=(n, n))
        second = sparse.diags([1.0, -2.0, 1.0], [-1, 0, 1], shape=(radii + 1, radii + 1)) / self.h**2
        half = np.sin(self.theta[:-1] + 0.5 * self.k)
        middle = np.sin(self.theta)
        lower, upper = np.zeros(angles), np.zeros(angles)
        lower[:-1] = middle[1:-1] / half[:-1] / self.k**2
        upper[1:] = middle[1:-1] / half[1:] / self.k**2
        main = np.zeros(angles + 1)
        main[1:-1] = -(lower[:-1] + upper[1:])
        polar = sparse.diags([lower, main, upper], [-1, 0, 1])
        self.by_xi = sparse.kron(central(radii + 1, self.h), one_t).tocsr()
        self.by_theta = sparse.kron(one_r, central(angles + 1, self.k)).tocsr()
        self.operator = (sparse.kron(second - central(radii + 1, self.h), one_t) + sparse.kron(one_r, polar)).tocsr()
        self.psi = (0.5 * (self.r**2 - 1.5 * self.r + 0.5 / self.r) * self.sin**2).ravel()
        self.g = (-1.5 * self.sin**2 / self.r).ravel()

    def rows(self):
        """Numbers of the points."""
        return np.arange(self.shape[0] * self.shape[1]).reshape(self.shape)

    def solve(self, reynolds, steps=30):
        size, viscosity = self.psi.size, 2.0 / reynolds
        inner = sparse.diags(self.inside.astype(float))
        number = self.rows()
        wall, outer = number[0, 1:-1], number[-1, 1:-1]
        axes = np.concatenate([number[:, 0], number[:, -1]])
        r, sin = self.r.ravel(), self.sin.ravel()
        with np.errstate(divide="ignore"):
            share = np.where(sin > 0, 1 / np.maximum(r * sin, 1e-300) ** 2, 0.0)
        free = 0.5 * r**2 * sin**2
        to_f = sparse.diags(share) + self.axis_of_quotient(share)
        for step in range(steps):
            f = to_f @ self.g
            p_x, p_t, f_x, f_t = self.by_xi @ self.psi, self.by_theta @ self.psi, self.by_xi @ f, self.by_theta @ f
            weight = r * sin
            residual_psi = self.operator @ self.psi + r**2 * self.g
            residual_g = weight * (p_t * f_x - p_x * f_t) - viscosity * (self.operator @ self.g)
            d = sparse.diags
            a11, a12 = self.operator, d(r**2)
            a21 = d(weight * f_x) @ self.by_theta - d(weight * f_t) @ self.by_xi
            a22 = (d(weight * p_t) @ self.by_xi - d(weight * p_x) @ self.by_theta) @ to_f - viscosity * self.operator
            matrix = sparse.bmat([[inner @ a11, inner @ a12], [inner @ a21, inner @ a22]]).tolil()
            residual = np.concatenate([self.inside * residual_psi, self.inside * residual_g])
            for point in np.concatenate([axes, wall]):
                matrix[point, point] = 1.0
                residual[point] = self.psi[point]
            for point in outer:
                matrix[point, point] = 1.0
                residual[point] = self.psi[point] - free[point]
            for point in axes:
                matrix[size + point, size + point] = 1.0
                residual[size + point] = self.g[point]
            angles = self.shape[1]
            for point in wall:
                first, second = point + angles, point + 2 * angles
                matrix[size + point, size + point] = 1.0
                matrix[size + point, first] = 8 / (2 * self.h**2)
                matrix[size + point, second] = -1 / (2 * self.h**2)
                residual[size + point] = self.g[point] + (8 * self.psi[first] - self.psi[second]) / (2 * self.h**2)
            for point in outer:
                behind = self.theta[point % angles] < 0.5 * np.pi
                matrix[size + point, size + point] = 1.0
                residual[size + point] = self.g[point]
                if behind:
                    matrix[size + point, size + point - angles] = -2.0
                    matrix[size + point, size + point - 2 * angles] = 1.0
                    residual[size + point] -= 2 * self.g[point - angles] - self.g[point - 2 * angles]
            change = splu(matrix.tocsc()).solve(-residual)
            self.psi += change[:size]
            self.g += change[size:]
            if np.abs(change).max() < 1e-9 * np.abs(self.psi).max():
                return
        raise RuntimeError(f"Newton did not converge at {reynolds}: {np.abs(change).max()}")

    def axis_of_quotient(self, share):
        """Values of the quotient on the axes from those beside it, even in the angle: (4 f1 - f2) / 3."""
        number = self.rows()
        rows, columns, values = [], [], []
        for axis, first, second in [(0, 1, 2), (-1, -2, -3)]:
            for point, one, two in zip(number[:, axis], number[:, first], number[:, second]):
                rows += [point, point]
                columns += [one, two]
                values += [4 / 3 * share[one], -share[two] / 3]
        return sparse.csr_matrix((values, (rows, columns)), shape=(share.size, share.size))

    def drag(self, reynolds):
        g = -self.g.reshape(self.shape)
        slope = (-25 * g[0] + 48 * g[1] - 36 * g[2] + 16 * g[3] - 3 * g[4]) / (12 * self.h)
        sin = np.sin(self.theta)
        trapezoid = lambda values: self.k * values[1:-1].sum()
        friction = 8 / reynolds * trapezoid(g[0] * sin)
        pressure = -4 / reynolds * trapezoid(slope * sin)
        return friction + pressure, friction


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--reynolds", type=float, nargs="+", default=[10, 20, 40, 70, 100, 150])
    parser.add_argument("--radii", type=int, nargs="+", default=[80, 120, 160, 240])
    parser.add_argument("--outermost", type=float, default=67.0)
    arguments = parser.parse_args()
    found = {}
    for radii in arguments.radii:
        sphere = Sphere(radii, radii // 2, arguments.outermost)
        for reynolds in arguments.reynolds:
            sphere.solve(reynolds)
            found[radii, reynolds] = sphere.drag(reynolds)
            print(f"{radii} x {radii // 2}, to {arguments.outermost} radii: Re {reynolds}: drag {found[radii, reynolds][0]:.6f}, friction {found[radii, reynolds][1]:.6f}", flush=True)
    for reynolds in arguments.reynolds:
        coarse, fine = arguments.radii[-2:]
        share = 1 / ((fine / coarse) ** 2 - 1)
        limits = [f + share * (f - c) for f, c in zip(found[fine, reynolds], found[coarse, reynolds])]
        print(f"Re {reynolds}: on no grid {limits[0]:.4f}, friction {limits[1]:.4f}")
