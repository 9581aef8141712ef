#!/usr/bin/env python3
"""How true a spline for the whole drawing is (docs/results/smoothing.md): places of the true way in the drawing, taken
back to metres by spline.json, by one affine map and by one similarity, against where they truly are. Every map is aligned
rigidly by the keyframes first; affine map and similarity take the odometry's poses to the smoothed ones. Needs numpy and
scipy.

    docs/results/drawing_spline.py DATA_SET RUN [DATA_SET RUN ...]

DATA_SET: a folder of `sketchloc generate`; RUN: what `sketchloc localize --smooth` made of it.
"""
import csv
import json
import struct
import sys

import numpy as np
from scipy.interpolate import RBFInterpolator


def at_times(times, table):
    return np.c_[np.interp(times, table[:, 0], table[:, 1]), np.interp(times, table[:, 0], table[:, 2])]


def png_height(path):
    with open(path, "rb") as file:
        return struct.unpack(">I", file.read(24)[20:])[0]


def rigid(points, targets):
    mean, target_mean = points.mean(0), targets.mean(0)
    u, _, vt = np.linalg.svd((points - mean).T @ (targets - target_mean))
    rotation = u @ np.diag([1, np.sign(np.linalg.det(u @ vt))]) @ vt
    return lambda p: (p - mean) @ rotation + target_mean


def metric_by_affine(metric, sketch):
    a = np.linalg.lstsq(np.c_[np.ones(len(metric)), metric], sketch, rcond=None)[0]
    return lambda place: (place - a[0]) @ np.linalg.inv(a[1:])


def metric_by_similarity(metric, sketch):
    z = np.c_[np.ones(len(metric)), metric[:, 0] + 1j * metric[:, 1]]
    c = np.linalg.lstsq(z, sketch[:, 0] + 1j * sketch[:, 1], rcond=None)[0]

    def back(place):
        p = (place[:, 0] + 1j * place[:, 1] - c[0]) / c[1]
        return np.c_[p.real, p.imag]
    return back


def metric_by_spline(spline, begin, sketch):
    """Newton from the affine map's answer, at most 2 m a step; the best of all steps."""
    controls = np.array([c["metric"] for c in spline["controls"]])
    f = RBFInterpolator(controls, np.array([c["sketch"] for c in spline["controls"]]),
                        kernel="thin_plate_spline", degree=1)
    p, h = begin.copy(), 1e-4
    best, least = p.copy(), np.full(len(p), np.inf)
    for _ in range(25):
        off = f(p) - sketch
        nearer = np.linalg.norm(off, axis=1) < least
        best[nearer], least[nearer] = p[nearer], np.linalg.norm(off, axis=1)[nearer]
        jacobian = np.stack([(f(p + d) - f(p - d)) / (2 * h) for d in ([h, 0], [0, h])], 2)
        step = np.linalg.solve(jacobian, off[..., None])[..., 0]
        p = p - step * np.minimum(1, 2 / np.maximum(np.linalg.norm(step, axis=1, keepdims=True), 1e-9))
    return best


def main():
    for data, run in zip(sys.argv[1::2], sys.argv[2::2]):
        spline = json.load(open(f"{run}/spline.json"))
        keyframes = [json.loads(line) for line in open(f"{run}/keyframes.jsonl")]
        odometry = np.array([k["odom_from_robot"][:2] for k in keyframes if "odom_from_robot" in k])
        times = np.array([p["time_s"] for p in spline["poses"]])
        metric = np.array([p["metric_from_robot"][:2] for p in spline["poses"]])
        rows = list(csv.DictReader(open(f"{run}/trajectory.csv")))
        smoothed = at_times(times, np.array([[float(r["time_s"]), float(r["x_px"]), float(r["y_px"])]
                                             for r in rows]))
        truth = np.loadtxt(f"{data}/truth.tum")
        reference = list(csv.DictReader(open(f"{data}/reference.csv")))
        height = png_height(f"{data}/drawing.png")
        sketch = np.array([[float(r["sketch_x_px"]) + 0.5, height - 0.5 - float(r["sketch_y_px"])]
                           for r in reference])
        world = at_times(np.array([float(r["t"]) for r in reference]), truth)
        of_keyframes = at_times(times, truth)
        by_odometry, by_spline = rigid(odometry, of_keyframes), rigid(metric, of_keyframes)
        begin = metric_by_affine(metric, smoothed)(sketch)
        print(data, *(f"{name} {np.sqrt(((found - world) ** 2).sum(1).mean()):.2f} m" for name, found in (
            ("similarity", by_odometry(metric_by_similarity(odometry, smoothed)(sketch))),
            ("affine", by_odometry(metric_by_affine(odometry, smoothed)(sketch))),
            ("spline", by_spline(metric_by_spline(spline, begin, sketch))))))


if __name__ == "__main__":
    main()
