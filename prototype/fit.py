import sys
import numpy as np
from pathlib import Path
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra
out = Path("out")
B = np.load(out / "body.npz"); X, F, N, base = B["vertices"], B["faces"], B["normals"], B["base"]
V = len(X)
def steiner(n=4):
    edges = np.unique(np.sort(np.concatenate([F[:, [0,1]], F[:, [1,2]], F[:, [2,0]]]), axis=1), axis=0)
    t = (np.arange(n) + 1) / (n + 1)
    pts = (X[edges[:,0]][:,None] * (1 - t)[None,:,None] + X[edges[:,1]][:,None] * t[None,:,None])
    P = np.vstack([X, pts.reshape(-1, 3)])
    idx = {(a, b): V + i * n + np.arange(n) for i, (a, b) in enumerate(map(tuple, edges))}
    I, J = [], []
    for f in F:
        ids = list(f)
        for a, b in ((f[0], f[1]), (f[1], f[2]), (f[2], f[0])):
            ids += list(idx[min(a, b), max(a, b)])
        ids = np.array(ids)
        i, j = np.meshgrid(ids, ids); m = i < j
        I.append(i[m]); J.append(j[m])
    I, J = np.concatenate(I), np.concatenate(J)
    key = np.unique(I.astype(np.int64) * len(P) + J)
    I, J = key // len(P), key % len(P)
    return csr_matrix((np.linalg.norm(P[I] - P[J], axis=1), (I, J)), shape=(len(P), len(P)))
def arcs(vs):
    p = out / "arcs.npz"
    cache = dict(np.load(p)) if p.exists() else {}
    miss = [v for v in vs if str(v) not in cache]
    if miss:
        D = dijkstra(steiner(), directed=False, indices=miss)[:, :V].astype("f4")
        cache |= {str(v): d for v, d in zip(miss, D)}
        np.savez(p, **cache)
    return np.array([cache[str(v)] for v in vs])
def load():
    vs, U, K = [], [], []
    for p in sorted(out.glob("batch*.npz")):
        d = np.load(p); vs += list(d["vertex"]); U += list(d["displacement"]); K += list(d["stiffness"])
    return np.array(vs), np.array(U, dtype=float), np.array(K)
R = np.load("../tests/reference/results/liver_r5.npz")
hm = R["held_out"].astype(bool)
hv, hU, hK = R["site_vertex"][hm], R["displacement"][hm].astype(float), R["stiffness"][hm]
RC = 0.005
def frame(n):
    e = np.cross(n, np.eye(3)[np.abs(n).argmin()]); e /= np.linalg.norm(e)
    return e, np.cross(n, e)
def design(v, arc, ells, H, smax):
    """(V,3,C): field for unit coefficients in the frame of vertex v; sign: press, u = -(...)"""
    n = N[v]; e1, e2 = frame(n)
    d = X - X[v]; pl = d - (d @ n)[:, None] * n
    L = np.linalg.norm(pl, axis=1); L = np.maximum(L, 0.2 * np.linalg.norm(d, axis=1)); L[L == 0] = 1
    r = pl / L[:, None]; f = np.cross(n, r)
    c1, s1 = r @ e1, r @ e2
    rho2 = np.maximum(c1**2 + s1**2, 1e-30)
    trig = [c1, s1] if H >= 1 else []
    if H >= 2: trig += [c1**2 - s1**2, 2 * c1 * s1]
    s = np.maximum(arc - RC, 0)
    cols = []
    for p, l in enumerate(ells):
        g = (np.exp(-s / l) - np.exp(-smax / l)) / (1 - np.exp(-smax / l)); g[s > smax] = 0
        w = np.minimum(1, arc / max(0.004, RC))
        cols.append(g[:, None] * n)
        cols += [(w * g * t)[:, None] * n for t in trig]
        cols.append((w * g)[:, None] * r)
        cols += [(w * g * t)[:, None] * r for t in trig]
        cols += [(w * g * t)[:, None] * f for t in trig]
    return -np.stack(cols, axis=2)
