# SPDX-License-Identifier: BSD-3-Clause
"""What poses say of the velocity at which bodies go through the air, by "The law in formulas" of Documentation/RotationRefineFilter.md
alone, in plain numpy."""
import math

import numpy as np

GRAVITY = 9.80665  # m/s^2
FRICTION = 1.0 / 6.0  # along the surface, of the drag broadside
CREEPING = 2.0 / 3.0  # the same in creeping flow
VISCOSITY = 1.8e-5  # Pa s
FAST_REYNOLDS, FAST_DRAG = 133.0, 1.17  # from where on the drag of a disc is the same, and cd there
NODES = 7  # of the table of what is hidden, on each side of a face of the cube of directions
PIECES = 250  # of a mesh, at least
STEPS = 5  # of Runge and Kutta's, a frame


def disc_drag(reynolds):
    """cd of a disc broadside."""
    slow = np.maximum(reynolds, 1e-6)
    return np.maximum(FAST_DRAG, 64.0 / (math.pi * slow) * (1.0 + 0.138 * slow**0.792))


def cross_matrix(v):
    """[n, 3, 3] of vectors [n, 3]."""
    x, y, z = np.moveaxis(np.asarray(v), -1, 0)
    o = np.zeros_like(x)
    return np.stack([np.stack([o, -z, y], -1), np.stack([z, o, -x], -1), np.stack([-y, x, o], -1)], -2)


def turned(matrices, vectors):
    return np.einsum("...ij,...j->...i", matrices, vectors)


def matrices(quaternions):
    """Rotations [n, 3, 3] of w, x, y, z."""
    q = np.asarray(quaternions, float)
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    skew = cross_matrix(q[..., 1:])
    return np.eye(3) + 2.0 * (q[..., :1, None] * skew + skew @ skew)


def rotation_vectors(turns):
    """The shortest ones [n, 3] of rotations."""
    sine = 0.5 * np.stack([turns[..., 2, 1] - turns[..., 1, 2], turns[..., 0, 2] - turns[..., 2, 0],
                           turns[..., 1, 0] - turns[..., 0, 1]], -1)
    length = np.linalg.norm(sine, axis=-1)
    angle = np.arctan2(length, 0.5 * (np.trace(turns, axis1=-2, axis2=-1) - 1.0))
    return sine * np.where(length > 1e-9, angle / np.maximum(length, 1e-300), 1.0)[..., None]


def _angles(v):
    angle = np.maximum(np.linalg.norm(v, axis=-1), 1e-6)
    return angle[..., None, None], cross_matrix(v)


def rotations(v):
    """Of rotation vectors."""
    angle, skew = _angles(v)
    return np.eye(3) + np.sin(angle) / angle * skew + (1.0 - np.cos(angle)) / angle**2 * skew @ skew


def rates_of(v):
    """Matrices that take the derivative of a rotation vector to the angular velocity."""
    angle, skew = _angles(v)
    return np.eye(3) + (1.0 - np.cos(angle)) / angle**2 * skew + (angle - np.sin(angle)) / angle**3 * skew @ skew


class Turning:
    """Poses between two frames: the rotation vector from the first is the cubic that has both poses and angular velocities."""

    def __init__(self, before, after, rate_before, rate_after, step):
        self.before, self.step = before, step
        self.way = rotation_vectors(after @ np.swapaxes(before, -1, -2))
        self.start = step * rate_before
        self.end = step * turned(np.linalg.inv(rates_of(self.way)), rate_after)

    def at(self, part):
        """Rotations and angular velocities at this part of the step."""
        s = part
        v = (3 * s**2 - 2 * s**3) * self.way + (s - 2 * s**2 + s**3) * self.start + (s**3 - s**2) * self.end
        change = (6 * s - 6 * s**2) * self.way + (1 - 4 * s + 3 * s**2) * self.start + (3 * s**2 - 2 * s) * self.end
        return rotations(v) @ self.before, turned(rates_of(v), change) / self.step


class Plate:
    """A shape's mesh, in pieces, and what the air does to it."""

    def __init__(self, points, triangles):
        corners = np.asarray(points, float)[np.asarray(triangles, int)]
        vector = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = np.linalg.norm(vector, axis=1)
        corners, vector, area = corners[area > 0], vector[area > 0], area[area > 0]
        self.area = area.sum()
        total = corners.sum(axis=1)
        centre = (area[:, None] * total).sum(axis=0) / (3.0 * self.area)
        outer = np.einsum("tci,tcj->tij", corners, corners) + np.einsum("ti,tj->tij", total, total)
        self.spread = (area[:, None, None] / 12.0 * outer).sum(axis=0) / self.area - np.outer(centre, centre)
        values, vectors = np.linalg.eigh(np.einsum("ti,tj->ij", vector / area[:, None], vector) / self.area)
        self.normal = vectors[:, 2] * (1.0 if vectors[2, 2] >= 0 else -1.0)
        self.flatness = float(np.clip(values[2] - values[1], 0.0, 1.0))
        self.air_mass = self._air_mass()
        self._cut(corners, vector)
        self._look(corners)

    def _air_mass(self):
        """Of the air that moves along, per unit of its density [m^3]."""
        across = np.eye(3) - np.outer(self.normal, self.normal)
        values = np.linalg.eigvalsh(across @ self.spread @ across)
        a, b = 2.0 * math.sqrt(values[2]), 2.0 * math.sqrt(max(values[1], 0.0))
        volume = a * b**2 * (8.0 / 3.0 + (4.0 / 3.0 * math.pi - 8.0 / 3.0) * (1.0 - b / a))
        radius = math.sqrt(np.trace(self.spread))
        return (self.flatness * volume * np.outer(self.normal, self.normal)
                + (1.0 - self.flatness) * 2.0 / 3.0 * math.pi * radius**3 * np.eye(3))

    def _cut(self, corners, vector):
        cuts = max(1, math.ceil(math.sqrt(PIECES / len(corners))))
        u, v = (corners[:, 1] - corners[:, 0]) / cuts, (corners[:, 2] - corners[:, 0]) / cuts
        places = [corners[:, 0] + (i + third) * u + (j + third) * v for third in (1 / 3, 2 / 3) for i in range(cuts)
                  for j in range(cuts - i - (third > 0.5))]
        self.places = np.concatenate(places)
        vectors = np.concatenate([vector] * len(places)) / cuts**2
        self.areas = np.linalg.norm(vectors, axis=1)
        self.normals = vectors / self.areas[:, None]

    def _look(self, corners):
        """1 of each piece that is seen from each node of the cube, 0 of one behind another triangle; nothing in a plane is."""
        self.seen = None
        if self.flatness > 1.0 - 1e-9:
            return
        self.seen = np.ones((6, NODES, NODES, len(self.places)))
        u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        reach = 1e-6 * math.sqrt(self.area)
        start = self.places[:, None] - corners[None, :, 0]
        turn = np.cross(start, u[None])
        away = np.einsum("pti,ti->pt", turn, v)
        for face in range(6):
            for row in range(NODES):
                for column in range(NODES):
                    d = np.zeros(3)
                    d[face // 2] = 1.0 if face % 2 == 0 else -1.0
                    d[(face // 2 + 1) % 3] = 2.0 * column / (NODES - 1) - 1.0
                    d[(face // 2 + 2) % 3] = 2.0 * row / (NODES - 1) - 1.0
                    d /= np.linalg.norm(d)
                    across = np.cross(d, v)
                    base = np.einsum("ti,ti->t", u, across)
                    base = np.where(np.abs(base) < 1e-12 * self.area, np.inf, base)  # met edge-on
                    first = np.einsum("pti,ti->pt", start, across) / base
                    second = np.einsum("pti,i->pt", turn, d) / base
                    behind = (first >= 0) & (second >= 0) & (first + second <= 1) & (away / base > reach)
                    self.seen[face, row, column] = ~behind.any(axis=1)

    def _visible(self, directions):
        """Parts [n, piece] of pieces that are seen from directions [n, 3]: linear between the nodes of a face."""
        n = np.arange(len(directions))
        axis = np.argmax(np.abs(directions), axis=1)
        major = directions[n, axis]
        face = 2 * axis + (major < 0)
        corner, part = [], []
        for other in (1, 2):
            at = 0.5 * (directions[n, (axis + other) % 3] / np.maximum(np.abs(major), 1e-300) + 1.0) * (NODES - 1)
            corner.append(np.clip(at.astype(int), 0, NODES - 2))
            part.append(np.clip(at - corner[-1], 0.0, 1.0)[:, None])
        (column, row), (a, b) = corner, part
        return ((1 - b) * ((1 - a) * self.seen[face, row, column] + a * self.seen[face, row, column + 1])
                + b * ((1 - a) * self.seen[face, row + 1, column] + a * self.seen[face, row + 1, column + 1]))

    def reynolds(self, speed, density):
        """By the disc of its area."""
        return speed * 2.0 * math.sqrt(self.area / math.pi) * density / VISCOSITY

    def force(self, velocity, gradient, drag, lift, rotational_lift, settling, density):
        """In body axes [n, 3]. settling: the speed at which drag holds where the air, of this density, is sticky [m/s]."""
        at_rest = self.reynolds(settling, density)
        turning = 0.5 * np.sum(gradient**2, axis=(1, 2)) * np.trace(self.spread)
        now = disc_drag(self.reynolds(np.sqrt(np.sum(velocity**2, axis=1) + turning), density))
        is_sticky = at_rest < FAST_REYNOLDS
        fast = np.where(is_sticky, FAST_DRAG / now, 1.0)
        drag = drag * np.where(is_sticky, now / disc_drag(at_rest), 1.0)
        friction = (fast * FRICTION + (1.0 - fast) * CREEPING)[:, None]
        lift, rotational_lift = fast * lift, fast * rotational_lift
        w = velocity[:, None] + np.einsum("nij,pj->npi", gradient, self.places)
        speed = np.linalg.norm(w, axis=2) + 1e-12
        along = np.einsum("npi,pi->np", w, self.normals)
        across = w @ self.normal
        area = self.areas if self.seen is None else self.areas * self._visible(velocity)
        lift = (self.flatness * lift)[:, None]
        rub = friction * speed
        push = along * (speed * (1.0 + lift) - lift * across**2 / speed) - rub * along
        loads = np.einsum("np,pi->ni", area * push, self.normals) + np.einsum("np,npi->ni", area * rub, w)
        spin = 0.5 * np.stack([gradient[:, 2, 1] - gradient[:, 1, 2], gradient[:, 0, 2] - gradient[:, 2, 0],
                               gradient[:, 1, 0] - gradient[:, 0, 1]], -1)
        spin = spin - (spin @ self.normal)[:, None] * self.normal
        chordwise = np.cross(self.normal, spin / np.maximum(np.linalg.norm(spin, axis=1), 1e-12)[:, None])
        chord = 4.0 * np.sqrt(np.einsum("ni,ij,nj->n", chordwise, self.spread, chordwise))
        lifted = 0.5 * rotational_lift * self.flatness * self.area * chord
        return density * (lifted[:, None] * np.cross(spin, velocity) - 0.5 * drag[:, None] * loads)


def gradients_of(values, origin, spacing, places):
    """Of what is linear along each axis between the points of a lattice."""
    last = np.array(values.shape[2::-1]) - 1
    at = np.clip((places - origin) / spacing, 0.0, last)
    low = np.minimum(at.astype(int), last - 1)
    part = at - low
    result = np.zeros((len(places), 3, 3))
    for corner in range(8):
        bits = np.array([(corner >> axis) & 1 for axis in range(3)])
        i, j, k = (low + bits).T
        weights = np.where(bits, part, 1.0 - part)
        slopes = np.where(bits, 1.0, -1.0) / spacing
        for axis in range(3):
            one, other = (c for c in range(3) if c != axis)
            result[:, :, axis] += (slopes[axis] * weights[:, one] * weights[:, other])[:, None] * values[k, j, i]
    return result


FACTORS = ("DragCoefficient", "Lift", "RotationalLift", "SlippingMass", "BroadsideSpeed", "Follow", "Pace")


def slips_of(plate, of, density, step, poses, rates, gradients, given, still=None, steps=STEPS):
    """[body, frame, 3] from those that are given [body, frame, 3] at the first frame and wherever bodies hang or are held still (still: [body,
    frame]) on, by so many steps a frame."""
    count, frames = poses.shape[:2]
    mass = of["SlippingMass"][:, None, None] * np.eye(3) + density * plate.air_mass
    inverse = np.linalg.inv(mass)
    drawn = of["BroadsideSpeed"][:, None] * np.array([0.0, 0.0, -1.0])
    weight = of["SlippingMass"][:, None] * np.array([0.0, 0.0, -GRAVITY])
    pace, follow = of["Pace"][:, None], of["Follow"][:, None]
    coefficients = [of[name] for name in ("DragCoefficient", "Lift", "RotationalLift", "SettlingSpeed")]

    def velocity_of(pose, momentum):
        return turned(inverse, turned(np.swapaxes(pose, -1, -2), momentum))

    def change(pose, rate, gradient, momentum):
        back = np.swapaxes(pose, -1, -2)
        velocity = velocity_of(pose, momentum)
        local = cross_matrix(turned(back, rate) / pace) - back @ gradient @ pose
        force = turned(pose, plate.force(velocity, local, *coefficients, density))
        lost = turned(pose, turned(mass, velocity - turned(back, drawn)))
        return pace * (force + weight) - follow * lost

    def momentum_at(frame):
        return turned(poses[:, frame], turned(mass, turned(np.swapaxes(poses[:, frame], -1, -2), given[:, frame])))

    slips = np.empty((count, frames, 3))
    slips[:, 0] = given[:, 0]
    momentum = momentum_at(0)
    h = step / steps
    for k in range(frames - 1):
        before, after = gradients[:, k], gradients[:, k + 1]
        turning = Turning(poses[:, k], poses[:, k + 1], rates[:, k], rates[:, k + 1], step)

        def moment(part):
            return (*turning.at(part), before + part * (after - before))

        for i in range(steps):
            here, middle, there = moment(i / steps), moment((i + 0.5) / steps), moment((i + 1) / steps)
            one = change(*here, momentum)
            two = change(*middle, momentum + 0.5 * h * one)
            three = change(*middle, momentum + 0.5 * h * two)
            four = change(*there, momentum + h * three)
            momentum = momentum + h / 6.0 * (one + 2.0 * two + 2.0 * three + four)
        if still is not None and still[:, k + 1].any():
            momentum = np.where(still[:, k + 1, None], momentum_at(k + 1), momentum)
        slips[:, k + 1] = turned(poses[:, k + 1], velocity_of(poses[:, k + 1], momentum))
    return slips
