"""Unit presses at many sites, in batches. python fem_sites.py OUT COUNT"""
import sys, time
sys.path.insert(0, "../tests/reference")
import numpy as np
import liver, sites
from pathlib import Path
out, count = Path(sys.argv[1]), int(sys.argv[2])
cells = float(sys.argv[3]) if len(sys.argv) > 3 else 4.0
out.mkdir(exist_ok=True)
body = liver.make_liver("../target/release/rhombus")
ref = sites.choose(body, sites.COUNT)
held = ref[sites.held_out(sites.COUNT)]
allv = [v for v in sites.choose(body, count + len(held)) if v not in set(held)][:count]
# batches: sites at least 32 mm apart
batches = []
for v in allv:
    for b in batches:
        if len(b) < 8 and all(np.linalg.norm(body.vertices[v] - body.vertices[w]) > 0.032 for w in b):
            b.append(v); break
    else:
        batches.append([v])
print(len(allv), "sites", [len(b) for b in batches], flush=True)
np.savez(out / "body.npz", vertices=body.vertices, faces=body.faces, normals=body.vertex_normals(), base=body.base(), held=held, order=np.array(allv))
for k, b in enumerate(batches):
    p = out / f"batch{k}.npz"
    if p.exists(): continue
    t = time.perf_counter()
    mesh = liver.Mesh(body, b, (0.005,), cells=cells, growth=0.6, ratio=1.4)
    t1 = time.perf_counter()
    patches = mesh.assemble(liver.YOUNG, liver.POISSON)
    t2 = time.perf_counter()
    U, K = [], []
    start = 0
    for i, touched in enumerate(mesh.touched):
        a = patches.press(touched[0])
        U.append(a.displacement[: len(body.vertices)].astype("f4")); K.append(a.stiffness[i])
    patches.close()
    np.savez(p, vertex=np.array(b), displacement=np.array(U), stiffness=np.array(K))
    print(k, b, mesh.size, f"mesh {t1-t:.1f} factor {t2-t1:.1f} press {time.perf_counter()-t2:.1f} s", flush=True)
