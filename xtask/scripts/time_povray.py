"""POV-Ray's user time for the mesh and camera of `cargo xtask bench render`, and the ratio to ours.

    cargo xtask bench render --mesh knot.obj --json bench.json
    apt-get install povray
    python xtask/scripts/time_povray.py knot.obj bench.json [--soft]

One light with hard shadows and anti-aliasing +A0.3; `--soft` asks for the soft light that our picture has
(an area light of 5 x 5 points; no sky light).
"""

import json
import os
import resource
import subprocess
import sys
import tempfile


def read_obj(path):
    vertices, normals, faces = [], [], []
    for line in open(path):
        kind, *rest = line.split() or [""]
        if kind == "v":
            vertices.append([float(x) for x in rest])
        elif kind == "vn":
            normals.append([float(x) for x in rest])
        elif kind == "f":
            faces.append([int(c.split("/")[0]) - 1 for c in rest])
    return vertices, normals, faces


def vectors(items):
    return ",".join("<{},{},{}>".format(*item) for item in items)


def scene(obj, bench, soft):
    vertices, normals, faces = read_obj(obj)
    right, up, forward = bench["axes"]
    half = bench["half_height"]
    vector = lambda v, s=1.0: "<{},{},{}>".format(*(s * x for x in v))
    area = "area_light <6,0,0>, <0,6,0>, 5, 5 adaptive 1 jitter" if soft else ""
    low = min(v[2] for v in vertices)
    return f"""
#version 3.7;
global_settings {{ assumed_gamma 1 }}
camera {{ location {vector(bench["eye"])} direction {vector(forward)}
  right {vector(right, 2 * half * 4 / 3)} up {vector(up, 2 * half)} }}
light_source {{ <-12,-10,20> rgb 1 {area} }}
background {{ rgb 0.85 }}
plane {{ z, {low} pigment {{ rgb 0.85 }} finish {{ ambient 0.3 diffuse 0.7 }} }}
mesh2 {{
  vertex_vectors {{ {len(vertices)}, {vectors(vertices)} }}
  normal_vectors {{ {len(normals)}, {vectors(normals)} }}
  face_indices {{ {len(faces)}, {vectors(faces)} }}
  pigment {{ rgb <0, 0.17, 0.45> }} finish {{ ambient 0.3 diffuse 0.7 }}
}}
"""


def main():
    bench = json.load(open(sys.argv[2]))
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.pov")
        open(path, "w").write(scene(sys.argv[1], bench, "--soft" in sys.argv))
        command = ["povray", f"+I{path}", f"+O{folder}/out.png", "+W1280", "+H960", "+A0.3", "-D"]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
        povray = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    ours = bench["picture_cpu_seconds"]
    print(f"POV-Ray: {povray:.2f} s of user time; ours: {ours:.2f} s; ratio {ours / povray:.2f}")


main()
