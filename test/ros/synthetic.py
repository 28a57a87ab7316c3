# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of known geometry: solids before a camera at the origin that looks along +z."""
import numpy as np

BOX, ELLIPSOID = "box", "ellipsoid"

# kind, centre [m], half extents [m]; about 0.2 m, alike from no two sides
THING = [
    (BOX, (0.01, 0, 0), (0.07, 0.045, 0.03)),
    (ELLIPSOID, (0.06, 0.03, 0.035), (0.035, 0.025, 0.03)),
    (BOX, (-0.04, -0.015, 0.05), (0.015, 0.02, 0.035)),
    (ELLIPSOID, (0.02, -0.05, 0), (0.02, 0.025, 0.015)),
    (BOX, (0.04, 0, -0.04), (0.02, 0.03, 0.02)),
    (ELLIPSOID, (-0.065, 0.02, -0.01), (0.02, 0.02, 0.03)),
]
ROUND = [
    (ELLIPSOID, (0, 0, 0), (0.06, 0.06, 0.05)),
    (ELLIPSOID, (0.06, 0, 0.02), (0.03, 0.015, 0.03)),
    (ELLIPSOID, (0, 0.05, -0.03), (0.02, 0.04, 0.02)),
    (BOX, (-0.03, -0.03, -0.04), (0.02, 0.015, 0.02)),
]
SHAPES = {"thing": THING, "round": ROUND}


def pose(degrees, axis, translation):
    """T: a rotation about an axis, then a translation [m]."""
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    T = np.eye(4)
    T[:3, :3] = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    T[:3, 3] = translation
    return T


def apply(T, points):
    return points @ T[:3, :3].T + T[:3, 3]


def _distance(solid, origin, directions):
    """Along each ray to where it enters the solid; infinite where it misses."""
    kind, center, half = solid
    o = (origin - np.array(center)) / np.array(half)
    d = directions / np.array(half)
    with np.errstate(divide="ignore", invalid="ignore"):
        if kind == ELLIPSOID:
            a, b, c = np.sum(d * d, -1), d @ o, o @ o - 1
            hit = (-b - np.sqrt(b * b - a * c)) / a
        else:
            s, t = (-1 - o) / d, (1 - o) / d
            enter, leave = np.minimum(s, t).max(-1), np.maximum(s, t).min(-1)
            hit = np.where(enter < leave, enter, np.inf)
    return np.where(hit > 0, hit, np.inf)


def view(placed, width=160, height=120, pixel=0.0025):
    """What the camera sees of (shape, T_camera_shape) pairs: height x width x 3 [m], NaN where nothing is hit."""
    u, v = np.meshgrid(np.arange(width) - width / 2, np.arange(height) - height / 2)
    rays = np.stack([u * pixel, v * pixel, np.ones_like(u)], -1)
    depth = np.full((height, width), np.inf)
    for shape, T in placed:
        inverse = np.linalg.inv(T)
        for solid in shape:
            depth = np.minimum(depth, _distance(solid, inverse[:3, 3], rays @ inverse[:3, :3].T))
    depth[np.isinf(depth)] = np.nan
    return (depth[..., None] * rays).astype(np.float32)


TRAINED = {"thing": pose(35, (1, 2, 0.5), (0, 0, 0.8)), "round": pose(35, (1, 2, 0.5), (0, 0, 0.8))}
PLACED = {"thing": pose(50, (1, 2, 0.4), (-0.1, 0.02, 0.85)), "round": pose(40, (1, 2, 0.6), (0.1, 0, 0.75))}


def training_view(name):
    """The points of one view of an object, in the camera's frame."""
    points = view([(SHAPES[name], TRAINED[name])]).reshape(-1, 3)
    return points[np.isfinite(points).all(1)]


def scene(names=("thing", "round"), wall=True, shift=(0, 0, 0)):
    """Objects where PLACED has them, moved by `shift` [m], before a wall; an organised cloud."""
    placed = [(SHAPES[name], pose(0, (0, 0, 1), shift) @ PLACED[name]) for name in names]
    if wall:
        placed.append(([(BOX, (0, 0, 0), (1, 1, 0.02))], pose(10, (0, 1, 0), (0, 0, 1.1))))
    return view(placed)


def model_pose(name, shift=(0, 0, 0)):
    """T_scene_model of an object in scene(): its model's frame is that of the training view."""
    return pose(0, (0, 0, 1), shift) @ PLACED[name] @ np.linalg.inv(TRAINED[name])


def position(name, shift=(0, 0, 0)):
    """The centre of an object's box in scene() [m]."""
    points = training_view(name)
    return apply(model_pose(name, shift), 0.5 * (points.min(0) + points.max(0))[None])[0]
