"""Runs cases of the suite in other codes, from what `touchstone export` writes, and makes the tables that `touchstone compare` reads.

    touchstone export oblique_impact --out DIR/oblique_impact      (also normal_contact, sphere_on_incline)
    python3 run.py DIR [--codes LAMMPS,LIGGGHTS,YADE] [--out FOLDER]

Tables go to reports/other_codes, from which every run of a case puts them on its page; errors of all phases to results.

A value is that of the run whose error is the median of all start phases, so that errors of opposite signs do not cancel. The cost is that of one body's
steps in a batch of 4000: CPU time of the whole process less that of the same process without steps.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import shutil
import string
import subprocess
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
# Directions of all three cases: normal and tangent, oblique to the axes. Codes get them as z and x, since their walls are level.
NORMAL, TANGENT = [2 / 7, 3 / 7, 6 / 7], [6 / 7, 2 / 7, -3 / 7]
EXCESSES, PHASES = 5, 40
KNOBS = [10, 20, 50, 100, 200, 400]
TIMED_BODIES, TIMED_ROUNDS = 4000, 3
APART = 0.06
SETUPS = {
    "normal_contact": [f"e={e}, {end}, lagged damping, sampled edges" for e in ("0.5", "0.85", "1") for end in ("until zero overlap", "no attraction")],
    "oblique_impact": [
        "spring, 17 degrees: sticks",
        "spring, 45 degrees: slips, sticks, slips",
        "spring, 72 degrees: slides",
        "spring, spin before",
        "spring, two spheres with spin",
        "spring, 45 degrees, e=0.9",
    ],
    "sphere_on_incline": [
        "slips: 40 degrees, friction 0.2",
        "rolls: 15 degrees, friction 0.5",
        "slides, then rolls: flat, friction 0.5, 0.1 m/s",
    ],
}


def dot(one, other):
    return sum(a * b for a, b in zip(one, other))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


class Setting:
    """One setup as exported, turned so that a wall is level: bodies, laws, steps."""

    def __init__(self, case, label, folder, parameters):
        scene = tomllib.loads((folder / "scene.toml").read_text())
        self.case, self.label = case, label
        # Impacts approach along the normal, so a wall looks back; an incline looks along it.
        self.outward = 1 if case == "sphere_on_incline" else -1
        up = [self.outward * component for component in NORMAL]
        self.frame = [TANGENT, cross(up, TANGENT), up]
        turned = lambda vector: [dot(axis, vector) for axis in self.frame]
        radius = {shape["name"]: shape["geometry"]["sphere"]["radius"] for shape in scene["shape"]}
        self.bodies = [
            (radius[body["shape"]], turned(body["position"]), turned(body["velocity"]), turned(body["angular_velocity"])) for body in scene["body"]
        ]
        self.gravity = turned(scene["scene"].get("gravity", [0, 0, 0]))
        self.wall = bool(scene.get("boundary"))
        self.density = scene["material"][0]["density"]
        number = lambda name: float(parameters.get(name, 0))
        self.mass, self.stiffness = number("effective_mass"), number("stiffness")
        self.normal_dashpot = number("damping_coefficient")
        # Where a case has no tangential law, friction is zero and the spring only has to be a number.
        self.tangential_stiffness = number("tangential_stiffness") or self.stiffness
        self.tangential_dashpot, self.friction = number("tangential_damping_coefficient"), number("friction")
        self.end_of_contact = parameters["end_of_contact"]
        self.duration = number("time_step") * number("steps_per_contact")
        self.end_time, self.half_period = number("end_time"), number("undamped_half_period")

    def time_to_touch(self):
        """When the exported bodies meet, in s from their start."""
        if self.wall:
            (radius, position, velocity, _), = self.bodies
            return (radius - position[2]) / velocity[2]
        (one_radius, one, one_velocity, _), (other_radius, other, other_velocity, _) = self.bodies
        between = [b - a for a, b in zip(one, other)]
        rate = [b - a for a, b in zip(one_velocity, other_velocity)]
        half, square = dot(between, rate), dot(rate, rate)
        return (-half - math.sqrt(half * half - square * (dot(between, between) - (one_radius + other_radius) ** 2))) / square

    def samples(self, knob):
        """Batches of (step, steps, start times before the touch): an impact begins at all phases of a step and lasts no whole number of steps."""
        if self.case == "sphere_on_incline":
            steps_to_end = lambda steps_per_contact: self.end_time / self.half_period * steps_per_contact
            for steps in range(math.ceil(steps_to_end(knob - 0.5)), math.floor(steps_to_end(knob + 0.5)) + 1):
                yield self.end_time / steps, steps, [None]
            return
        for excess in range(EXCESSES):
            step = self.duration / (knob + (excess + 0.5) / EXCESSES - 0.5)
            phases = [(phase + (excess + 0.5) / EXCESSES) / PHASES for phase in range(PHASES)]
            yield step, math.ceil(1.3 * knob) + 6, [(1 + phase) * step for phase in phases]

    def placed(self, before_touch):
        """Bodies of all samples of a batch, far apart: radius, position, velocity, spin in one list each."""
        per_side = math.ceil(math.sqrt(len(before_touch)))
        for index, before in enumerate(before_touch):
            shift = 0.0 if before is None else self.time_to_touch() - before
            origin = [APART * (index % per_side), APART * (index // per_side), 0.0]
            for radius, position, velocity, spin in self.bodies:
                yield [radius, *(o + p + shift * v for o, p, v in zip(origin, position, velocity)), *velocity, *spin]

    def observed(self, bodies):
        """Quantities of the case from the velocity and spin of one sample's bodies after the run."""
        velocity, spin, radius = bodies[0][3:6], bodies[0][6:9], self.bodies[0][0]
        if not self.wall:
            velocity = [a - b for a, b in zip(velocity, bodies[1][3:6])]
        if self.case == "normal_contact":
            return {"restitution": velocity[2]}
        if self.case == "sphere_on_incline":
            overlap = radius - self.bodies[0][1][2]
            return {"final velocity": velocity[0], "final spin x lever arm": spin[1] * (radius - 0.5 * overlap)}
        return {"tangential velocity after": velocity[0], "spin after x radius": -spin[1] * radius, "rebound velocity": velocity[2]}


class Lammps:
    """LAMMPS or LIGGGHTS: all batches of a setup in one input deck."""

    def __init__(self, name, command, deck):
        self.name, self.command, self.deck = name, command, deck

    def version(self):
        first = subprocess.run([self.command, "-h"], capture_output=True, text=True, stdin=subprocess.DEVNULL, cwd=tempfile.gettempdir()).stdout.strip().splitlines()[0]
        return first.split(" - ", 1)[1] if " - " in first else first.split("LIGGGHTS-PUBLIC ")[-1].split(",")[0]

    def can(self, setting):
        return setting.end_of_contact == "zero_overlap"

    def run(self, setting, batches, folder):
        """CPU seconds of the process; states are left in out.<n>."""
        text = [f"log none\n"]
        for number, (step, steps, bodies) in enumerate(batches):
            data = folder / f"data.{number}"
            data.write_text("\n".join(self.data(setting, bodies)) + "\n")
            text.append(string.Template((HERE / self.deck).read_text()).substitute(self.values(setting, step, steps, data, folder / f"out.{number}")))
        (folder / "deck.in").write_text("\n".join(text))
        return cpu_seconds([self.command, "-in", folder / "deck.in"], folder)

    def data(self, setting, bodies):
        low = [min(body[1 + axis] for body in bodies) - 0.03 for axis in range(3)]
        high = [max(body[1 + axis] for body in bodies) + 0.03 for axis in range(3)]
        # The wall lies at z = 0; nothing must leave the box through it.
        head = ["impacts", "", f"{len(bodies)} atoms", "1 atom types", ""]
        head += [f"{low[axis]!r} {high[axis]!r} {name}lo {name}hi" for axis, name in enumerate("xyz")]
        line = lambda number, values: " ".join([str(number), *map(repr, values)])
        atoms = [f"{number} 1 {2 * body[0]!r} {setting.density!r} " + " ".join(map(repr, body[1:4])) for number, body in enumerate(bodies, 1)]
        return head + ["", "Atoms", ""] + atoms + ["", "Velocities", ""] + [line(number, body[4:]) for number, body in enumerate(bodies, 1)]

    def values(self, setting, step, steps, data, out):
        normal_rate, tangential_rate = (dashpot / setting.mass for dashpot in (setting.normal_dashpot, setting.tangential_dashpot))
        size = math.sqrt(dot(setting.gravity, setting.gravity))
        direction = [component / size for component in setting.gravity] if size > 0 else [0, 0, -1]
        return {
            "data": data,
            "out": out,
            "step": repr(step),
            "steps": steps,
            "steps_or_one": max(steps, 1),
            "stiffness": repr(setting.stiffness),
            "tangential_stiffness": repr(setting.tangential_stiffness),
            "normal_rate": repr(normal_rate),
            "tangential_rate": repr(tangential_rate),
            "tangential_over_normal_rate": repr(tangential_rate / normal_rate if normal_rate > 0 else 0.0),
            "has_tangential_dashpot": int(tangential_rate > 0),
            "friction": repr(setting.friction),
            "gravity": repr(size),
            **{f"gravity_{name}": repr(component) for name, component in zip("xyz", direction)},
            "if_wall": "" if setting.wall else "# no wall: ",
        }


class Yade:
    name, deck = "YADE", "yade_impacts.py"

    def __init__(self, command):
        self.command = command

    def version(self):
        return subprocess.run([self.command, "--version"], capture_output=True, text=True).stdout.split()[-1]

    def can(self, setting):
        """It never lets a dashpot pull. Undamped, or under a steady weight, both ends of a contact are one."""
        return setting.end_of_contact == "no_attraction" or setting.normal_dashpot == 0 or setting.case == "sphere_on_incline"

    def run(self, setting, batches, folder):
        laws = ["stiffness", "tangential_stiffness", "normal_dashpot", "tangential_dashpot", "friction", "density", "gravity", "wall"]
        common = {name: getattr(setting, name) for name in laws}
        jobs = [
            {**common, "step": step, "steps": steps, "bodies": bodies, "out": str(folder / f"out.{number}"), "synchronise": any(setting.gravity)}
            for number, (step, steps, bodies) in enumerate(batches)
        ]
        (folder / "jobs.json").write_text(json.dumps(jobs))
        return cpu_seconds([self.command, "-n", "-x", "-j1", HERE / self.deck, folder / "jobs.json"], folder)


def cpu_seconds(command, folder):
    log = folder / "log"
    with open(log, "w") as out:
        child = subprocess.Popen(command, cwd=folder, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))} failed:\n{log.read_text()[-2000:]}")
    return usage.ru_utime + usage.ru_stime


def states(path, bodies):
    lines = path.read_text().splitlines()[-bodies:]
    return [list(map(float, line.split()[1:])) for line in sorted(lines, key=lambda line: int(line.split()[0]))]


def median(values):
    return sorted(values)[(len(values) - 1) // 2]


def read(folder, case):
    rows = list(csv.DictReader(open(folder / "parameters.csv")))
    expected = {(row["setup"], row["quantity"]): (float(row["expected"]), row["unit"]) for row in csv.DictReader(open(folder / "expected.csv")) if row["expected"]}
    for label in SETUPS[case]:
        parameters = {row["parameter"]: row["value"] for row in rows if row["setup"] == label}
        place = list(dict.fromkeys(row["setup"] for row in rows)).index(label)
        (subfolder,) = folder.glob(f"{place:02}_*")
        yield Setting(case, label, subfolder, parameters), {quantity: value for (setup, quantity), value in expected.items() if setup == label}


def cost_of_a_step(code, setting):
    """CPU seconds of one body's step, at the finest steps, where it can be told from the start of the process."""
    step, steps, before = list(setting.samples(KNOBS[-1]))[0]
    count = TIMED_BODIES // len(setting.bodies)
    bodies = list(setting.placed([before[0]] * count))
    with tempfile.TemporaryDirectory() as folder:
        seconds = lambda steps: code.run(setting, [(step, steps, bodies)], pathlib.Path(folder))
        return median([seconds(steps) - seconds(0) for _ in range(TIMED_ROUNDS)]) / (count * steps)


def measure(code, setting, expected):
    """Lines of the table of results and of that of errors."""
    batches = [(knob, *sample) for knob in KNOBS for sample in setting.samples(knob)]
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        placed = [(step, steps, list(setting.placed(before))) for _, step, steps, before in batches]
        code.run(setting, placed, folder)
        for number, ((knob, *_), (_, _, bodies)) in enumerate(zip(batches, placed)):
            after, size = states(folder / f"out.{number}", len(bodies)), len(setting.bodies)
            for start in range(0, len(after), size):
                for quantity, value in setting.observed(after[start : start + size]).items():
                    found.setdefault((knob, quantity), []).append(value)
    cost, version = cost_of_a_step(code, setting), code.version()
    for (knob, quantity), values in found.items():
        truth, unit = expected[quantity]
        ranked = sorted(values, key=lambda value: abs(value - truth))
        middle, worst = ranked[(len(ranked) - 1) // 2], ranked[-1]
        steps = next(steps for of, _, steps, _ in batches if of == knob)
        result = [setting.label, quantity, unit, "steps_per_contact", knob, repr(middle), f"{cost * steps:.3e}", code.name, version]
        yield result, [setting.case, setting.label, quantity, code.name, knob, len(values), f"{abs(middle - truth):.3e}", f"{abs(worst - truth):.3e}"]


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("exports", type=pathlib.Path)
    arguments.add_argument("--codes", default="LAMMPS,LAMMPS granular,LIGGGHTS,YADE")
    arguments.add_argument("--cases", default=",".join(SETUPS))
    arguments.add_argument("--out", type=pathlib.Path, default=HERE.parents[2] / "reports/other_codes", help="folder of the tables of results")
    given = arguments.parse_args()
    codes = [Lammps("LAMMPS", "lmp", "lammps.in"), Lammps("LAMMPS granular", "lmp", "lammps_granular.in"), Lammps("LIGGGHTS", "liggghts", "liggghts.in"), Yade("yade")]
    codes = [code for code in codes if code.name in given.codes.split(",")]
    given.out.mkdir(exist_ok=True)
    for case in given.cases.split(","):
        results, errors = [], []
        for code in codes:
            if shutil.which(code.command) is None:
                print(f"{code.name}: missing")
                continue
            for setting, expected in read(given.exports / case, case):
                if code.can(setting):
                    for result, error in measure(code, setting, expected):
                        results.append(result)
                        errors.append(error)
                        print(*error, sep=" | ", flush=True)
        write(given.out / f"{case}.csv", "setup,quantity,unit,knob_name,knob_value,value,cpu_s,code,version", results)
        write(HERE / "results" / f"{case}.errors.csv", "case,setup,quantity,code,steps_per_contact,samples,median_error,worst_error", errors)


def write(path, header, rows):
    with open(path, "w", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(header.split(","))
        writer.writerows(rows)


if __name__ == "__main__":
    main()
