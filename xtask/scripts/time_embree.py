"""Primary rays per second of Embree on the mesh and camera of `cargo xtask bench render`.

    cargo xtask bench render --mesh knot.obj --json bench.json
    pip install embreex numpy
    python xtask/scripts/time_embree.py knot.obj bench.json
"""

import json
import sys
import time

import numpy as np
from embreex import rtcore_scene as rtcs
from embreex.mesh_construction import TriangleMesh


def read_obj(path):
    vertices, faces = [], []
    for line in open(path):
        if line.startswith("v "):
            vertices.append([float(x) for x in line.split()[1:4]])
        elif line.startswith("f "):
            faces.append([int(c.split("/")[0]) - 1 for c in line.split()[1:4]])
    return np.array(vertices, np.float32), np.array(faces, np.int32)


def rays(bench, width=1280, height=960):
    right, up, forward = (np.array(axis) for axis in bench["axes"])
    step = 2.0 * bench["half_height"] / height
    x = (np.arange(width) + 0.5 - 0.5 * width) * step
    y = (np.arange(height) + 0.5 - 0.5 * height) * step
    directions = forward + x[None, :, None] * right - y[:, None, None] * up
    directions = directions.reshape(-1, 3)
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    origins = np.tile(np.array(bench["eye"]), (len(directions), 1))
    return origins.astype(np.float32), directions.astype(np.float32)


def main():
    vertices, faces = read_obj(sys.argv[1])
    bench = json.load(open(sys.argv[2]))
    scene = rtcs.EmbreeScene()
    mesh = TriangleMesh(scene, vertices, faces)
    origins, directions = rays(bench)
    scene.run(origins[:1000], directions[:1000])
    times = []
    for _ in range(7):
        start = time.thread_time()
        hits = scene.run(origins, directions)
        times.append(time.thread_time() - start)
    times.sort()
    rate = len(origins) / times[3] / 1e6
    print(f"Embree: {rate:.2f} M rays/s, {np.mean(hits >= 0):.4f} hit")
    print(f"ours:   {bench['primary_mrays_per_second']:.2f} M rays/s, {bench['hits_share']:.4f} hit")
    print(f"ratio:  {bench['primary_mrays_per_second'] / rate:.2f}")


main()
