"""The cases: closed forms of rigid contact, and what a run must return to be compared with them.

The scenes are those of tests/rigid_contact, and the closed forms those of its tests. A run returns the numbers that
`values` names at the end and, with `more`, the same so many seconds later.
"""

import json
import math
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

G = 9.81
RUNS = 4
STEPS = [1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4]
TOLERANCES = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10]


@dataclass
class Case:
    """A closed form."""

    title: str
    text: str
    # What the error is of, and its unit.
    of: str
    unit: str
    end: float
    # From the numbers of a run to its error.
    error: Callable[[list[float]], float]
    # Time behind the end in which the body should not move, s, and by how much it did.
    more: float = 0.0
    creep: Callable[[list[float]], float] | None = None
    # The longest step, s.
    longest: float = 1.0

    def steps(self, step):
        """Numbers of steps whose length is about this one: the error of a step is the largest of these runs, because
        impacts fall anywhere in a step."""
        return [round(self.end / step) + k for k in range(RUNS)]


# A ball that bounces.
HEIGHT, RESTITUTION, BALL_MASS, BALL_RADIUS = 0.5, 0.8, 0.65, 0.11
FIRST = math.sqrt(2 * HEIGHT / G)
SPEED = G * FIRST
FLIGHTS = RESTITUTION + RESTITUTION**2 + 0.5 * RESTITUTION**3
APEX = (RESTITUTION**3 * SPEED) ** 2 / (2 * G)

# A block on the slope 1/3.
BLOCK_MASS = 3.0
ROOT = math.sqrt(10.0)


def down_third(v):
    """Along the slope 1/3, downhill."""
    return -(3 * v[0] + v[2]) / ROOT


WAY = 10.0 / (2 * G * (0.5 * 3 + 1) / ROOT)


def curve(v):
    """Relative error of the constant s sin φ/tan(φ/2)^k with k = μ/tan α = 0.6; it is 2 m/s at the start."""
    down, side = down_third(v), v[1]
    angle = math.atan2(side, down)
    return abs(math.hypot(down, side) * math.sin(angle) / math.tan(angle / 2) ** 0.6 / 2 - 1)


# A ball that slides until it rolls.
BALL_FRICTION = 0.12
BALL_VELOCITY, BALL_SPIN = (3.0, 0.0), (9.0, -20.0, 7.0)
# ω × n for the normal n = z.
TURN = (BALL_SPIN[1], -BALL_SPIN[0])
ROLLS = [(5 * v + 2 * BALL_RADIUS * w) / 7 for v, w in zip(BALL_VELOCITY, TURN)]
SLIP = [v - BALL_RADIUS * w for v, w in zip(BALL_VELOCITY, TURN)]
SLIDES = 2 * math.hypot(*SLIP) / (7 * BALL_FRICTION * G)


def bowled():
    """Where the ball is after 1.5 times the time in which it slides."""
    force = [-BALL_FRICTION * G * s / math.hypot(*SLIP) for s in SLIP]
    terms = zip(BALL_VELOCITY, force, ROLLS)
    return [v * SLIDES + 0.5 * f * SLIDES**2 + e * 0.5 * SLIDES for v, f, e in terms]


# A disc on the slope 3/4.
DISC_MASS, DISC_RADIUS, DISC_INERTIA = 3.0, 0.2, 0.06


def down_three_quarters(v):
    return -(4 * v[0] + 3 * v[1]) / 5


def gap(x, z):
    """Height of the disc above the slope."""
    return (4 * z - 3 * x) / 5 - DISC_RADIUS


def lifted(gaps):
    """In which share of the steps the disc touches, and how high it rises, m."""
    return {"touches": sum(g < 0 for g in gaps) / len(gaps), "highest": max(gaps)}


# A block that rocks.
ROCKER_MASS, ROCKER_INERTIA, HALF_WIDTH, HALF_HEIGHT, TILT = 10.0, 0.5666666666666666666666666666667, 0.1, 0.4, 0.2
ALPHA, CORNER = math.atan2(HALF_WIDTH, HALF_HEIGHT), math.hypot(HALF_WIDTH, HALF_HEIGHT)
SQUARE = 3 * G / (4 * CORNER)
# Place of the centre and angle at the start.
TILTED = (HALF_WIDTH - CORNER * math.sin(ALPHA - TILT), CORNER * math.cos(ALPHA - TILT), -TILT)


def quarter(tilt):
    """Time from rest at a tilt to upright: ∫ dθ/√(2 p² (cos(α − θ₀) − cos(α − θ))) with θ = θ₀ (1 − s²), by Gauss."""

    def rate(s):
        theta = tilt * (1 - s * s)
        return 2 * tilt * s / math.sqrt(2 * SQUARE * (math.cos(ALPHA - tilt) - math.cos(ALPHA - theta)))

    pieces, node = 4000, 0.5 / math.sqrt(3)
    return sum(0.5 / pieces * (rate((k + 0.5 - node) / pieces) + rate((k + 0.5 + node) / pieces)) for k in range(pieces))


REACHED = math.sqrt(2 * SQUARE * (math.cos(ALPHA - TILT) - math.cos(ALPHA)))
AFTER = (1 - 1.5 * math.sin(ALPHA) ** 2) * REACHED
OTHER = ALPHA - math.acos(math.cos(ALPHA) + AFTER**2 / (2 * SQUARE))


# A ball that bounces on a spring k δ (1 + d δ̇).
STIFFNESS, DISSIPATION, COMPLIANT_END = 1e5, 0.09, 1.8


def compliant():
    """Height at the end: flights in closed form, contacts by RK4 with 1 µs, each located at its end."""

    def slope(z, v):
        depth = max(0.0, -z)
        return v, -G + STIFFNESS / BALL_MASS * depth * max(0.0, 1 - DISSIPATION * v)

    def step(z, v, h):
        a = slope(z, v)
        b = slope(z + h / 2 * a[0], v + h / 2 * a[1])
        c = slope(z + h / 2 * b[0], v + h / 2 * b[1])
        d = slope(z + h * c[0], v + h * c[1])
        return tuple(x + h / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip((z, v), a, b, c, d))

    t, z, v = 0.0, HEIGHT, 0.0
    while True:
        lands = t + (v + math.sqrt(v * v + 2 * G * z)) / G
        if lands > COMPLIANT_END:
            rest = COMPLIANT_END - t
            return z + v * rest - 0.5 * G * rest**2
        t, v, z, h = lands, -math.sqrt(v * v + 2 * G * z), 0.0, 1e-6
        while True:
            ahead = step(z, v, h)
            if ahead[0] > 0 and ahead[1] > 0:
                break
            t, (z, v) = t + h, ahead
        for _ in range(4):
            # On to z = 0, by Newton's method.
            h = -z / v
            t, (z, v) = t + h, step(z, v, h)
        z = 0.0


# A quadruped that falls on its feet.
STANDS = 0.5


def standing():
    """Its pose at the end, by bgdyn in steps of 5 µs."""
    program = str(Path(os.environ["PEERS_DIR"]) / "bin/contact")
    command = [program, "stands", repr(STANDS), "0", str(round(STANDS / 5e-6))]
    once = {**os.environ, "PEERS_PATIENCE": "0", "PEERS_REPEATS": "1"}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=once)
    return json.loads(done.stdout)["values"]


CASES = {
    "bounces": Case(
        "A ball bounces",
        "A ball with the restitution 0.8 falls by 0.5 m, without friction: its height in the middle of the third flight.",
        "height", "m", FIRST + 2 * SPEED / G * FLIGHTS, lambda v: abs(v[0] - BALL_RADIUS - APEX),
    ),
    "sticks": Case(
        "A block stops on an incline and sticks",
        "A block is pushed up the slope 1/3 with √10 m/s, μ = 0.5. It stops after v₀²/(2 g (μ cos α + sin α)): the error of "
        "this length after 1 s. Then it must not move: *creep* is how far it moves in 10 s more.",
        "length", "m", 1.0, lambda v: abs(-down_third(v[:3]) - WAY), more=10.0,
        creep=lambda v: abs(down_third(v[3:]) - down_third(v[:3])),
    ),
    "across": Case(
        "A block curves across an incline",
        "A block is pushed across the slope 1/3 with 2 m/s, μ = 0.2, and curves downhill. With the speed s and its angle φ to "
        "the downhill direction, s sin φ/tan(φ/2)^k is constant for k = μ/tan α, where the cone of friction is round: its "
        "relative error after 1.5 s.",
        "constant", "1", 1.5, curve,
    ),
    "bowls": Case(
        "A ball slides until it rolls",
        "A ball of 110 mm with 3 m/s and a spin (9, −20, 7) rad/s slides on a parabola, μ = 0.12, and then rolls straight on: "
        "the error of its place after 1.5 times the time in which it slides.",
        "place", "m", 1.5 * SLIDES, lambda v: math.dist(v[:2], bowled()),
    ),
    "rolls": Case(
        "A disc rolls down an incline",
        "A disc on the slope 3/4 with μ = 0.3 rolls with (2/3) g sin α: the error of its speed after 2 s.",
        "speed", "m/s", 2.0, lambda v: abs(down_three_quarters(v) - 2 / 3 * G * 0.6 * 2),
    ),
    "slips": Case(
        "A disc slips down an incline",
        "The same with μ = 0.1: it slips with g (sin α − μ cos α).",
        "speed", "m/s", 2.0, lambda v: abs(down_three_quarters(v) - G * (0.6 - 0.1 * 0.8) * 2),
    ),
    "rocks": Case(
        "A block rocks",
        "A block of 200 mm × 800 mm, tilted by 0.2 rad and let go, falls back on its base, loses the share of Housner, "
        "θ̇⁺ = (1 − (3/2) sin² α) θ̇⁻, and tilts to the other side: the error of the angle where it rests for an instant.",
        "angle", "rad", quarter(TILT) + quarter(OTHER), lambda v: abs(v[0] - OTHER),
    ),
    "compliant": Case(
        "A ball bounces on a spring",
        "The same ball on the force k δ (1 + d δ̇) of Hunt and Crossley with k = 10⁵ N/m and d = 0.09 s/m: its height after "
        "1.8 s. Contacts last 8 ms. There is no closed form of the contacts: the reference integrates them by RK4 in steps of "
        "1 µs, and the flights in closed form.",
        "height", "m", COMPLIANT_END, lambda v: abs(v[0] - BALL_RADIUS - _compliant()),
    ),
    "stands": Case(
        "A quadruped falls and stands",
        "The quadruped of [`specs/contact`](../specs/contact/quadruped_rigid.scene.yaml), twelve joints under PD control, falls "
        "by 25 cm onto its feet, a little tilted, μ = 0.7: the largest error of the place of its trunk and of its joints after "
        "0.5 s. There is no closed form: the reference is bgdyn in steps of 5 µs. It has the rigid law, so errors of soft "
        "contacts are those of their law, too.",
        "pose", "m or rad", STANDS, lambda v: max(abs(a - b) for a, b in zip(v, _standing())), longest=5e-3,
    ),
}

_known = {}


def _compliant():
    return _once("compliant", compliant)


def _standing():
    return _once("standing", standing)


def _once(name, compute):
    if name not in _known:
        _known[name] = compute()
    return _known[name]
