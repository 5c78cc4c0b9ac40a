"""Joint estimate: coefficients are a Gaussian field over the surface, carried in the ambient space; each site weighs by what it says."""
import sys, time, itertools
from fit import *
vs, U, K = load(); S = len(vs)
A_arcs, H_arcs = arcs(vs), arcs(hv)
near = lambda v: np.linalg.norm(X - X[v], axis=1) < 0.030
def feats(v, H):
    """(D, C1) map from the local coefficients of one chain to ambient ones with orthonormal scaling."""
    e1, e2 = frame(N[v]); blocks = []
    one = np.ones((1, 1)); v1 = np.stack([e1, e2], 1)
    t2 = np.stack([(np.outer(e1, e1) - np.outer(e2, e2)).ravel(), (np.outer(e1, e2) + np.outer(e2, e1)).ravel()], 1) / np.sqrt(2)
    harm = [v1, t2][:H]
    seq = [one, *harm, one, *harm, *harm]
    D, C = sum(b.shape[0] for b in seq), sum(b.shape[1] for b in seq)
    M = np.zeros((D, C)); i = j = 0
    for b in seq: M[i:i+b.shape[0], j:j+b.shape[1]] = b; i += b.shape[0]; j += b.shape[1]
    return M
def kern(a, b, l, m):
    dx = ((X[a][:, None] - X[b][None])**2).sum(-1); dn = ((N[a][:, None] - N[b][None])**2).sum(-1)
    return np.exp(-dx/2/l**2 - dn/2/m**2)
def matern(a, b, l, m):
    d = np.sqrt(((X[a][:, None] - X[b][None])**2).sum(-1)/l**2 + ((N[a][:, None] - N[b][None])**2).sum(-1)/m**2)
    return (1 + np.sqrt(3)*d)*np.exp(-np.sqrt(3)*d)
def err(P, Q, v):
    k = near(v); return np.linalg.norm(P-Q)/np.linalg.norm(Q), np.linalg.norm((P-Q)[k])/np.linalg.norm(Q[k])
class Data:
    def __init__(self, ells, H, smax):
        self.P, self.H, self.C1 = len(ells), H, 2 + 6*H
        D = [design(v, a, ells, H, smax).reshape(3*V, -1) for v, a in zip(vs, A_arcs)]
        self.D = [d.astype("f4") for d in D]
        self.G = np.array([d.T@d for d in D]); self.g = np.array([d.T@u.ravel() for d, u in zip(D, U)])
        self.Hd = [design(v, a, ells, H, smax).reshape(3*V, -1) for v, a in zip(hv, H_arcs)]
        iso = np.zeros(self.C1, bool); iso[[0, 1+2*H]] = True; iso = np.tile(iso, self.P)
        Gs, gs = self.G.sum(0)[np.ix_(iso, iso)], self.g.sum(0)[iso]
        self.mean = np.zeros(self.P*self.C1); self.mean[iso] = np.linalg.solve(Gs + 1e-9*np.trace(Gs)*np.eye(iso.sum()), gs)
        self.F = np.array([feats(v, H) for v in vs]); self.Fh = np.array([feats(v, H) for v in hv])
        self.scale = np.mean([np.vdot(u, u) for u in U])
    def evaluate(self, kf, l, m, sig, var, Js, zl, zm, zn):
        n = self.P*self.C1
        def cov(a, b, Fa, Fb):
            k = kf(a, b, l, m); B = np.einsum("idc,jde->icje", Fa, Fb) * k[:, None, :, None]  # (i,C1,j,C1)
            out = np.zeros((len(a), self.P, self.C1, len(b), self.P, self.C1))
            for p in range(self.P): out[:, p, :, :, p, :] = B
            return var * out.reshape(len(a)*n, len(b)*n)
        s2 = sig**2 * self.scale / 50
        # posterior mean: mean + C (C + s2 G^-1)^-1 (theta_ls - mean) = mean + C W,  W = (G C + s2)^-1 (g - G mean)
        C = cov(vs, vs, self.F, self.F)
        GC = np.einsum("iab,ibx->iax", self.G, C.reshape(S, n, S*n)).reshape(S*n, S*n); GC[np.diag_indices(S*n)] += s2
        W = np.linalg.solve(GC, (self.g - self.G@self.mean).ravel())
        th = (C@W).reshape(S, n) + self.mean
        R = np.array([u.ravel() - d@t for u, d, t in zip(U, self.D, th)])
        fit = np.median([np.linalg.norm(r)/np.linalg.norm(u) for r, u in zip(R, U)])
        th_h = (cov(hv, vs, self.Fh, self.F)@W).reshape(len(hv), n) + self.mean
        Uu, sv, Vt = np.linalg.svd(R, full_matrices=False)
        out = []
        for J in Js:
            Z = Uu[:, :J]*sv[:J]
            Wz = np.linalg.solve(kern(vs, vs, zl, zm) + zn*np.eye(S), Z) if J else None
            es = []
            for i, (v, u) in enumerate(zip(hv, hU)):
                q = self.Hd[i]@th_h[i]
                if J: q = q + (kern([v], vs, zl, zm)[0]@Wz)@Vt[:J]
                es.append(err(q.reshape(V, 3), u, v))
            es = np.array(es)
            out.append((J, *(100*x for x in (np.median(es[:, 0]), es[:, 0].max(), np.median(es[:, 1]), es[:, 1].max()))))
        return fit, out
if __name__ == "__main__":
    ells = eval(sys.argv[1]) if len(sys.argv) > 1 else (0.004, 0.010, 0.025, 0.06); smax = 0.25
    for H in (2,):
        t = time.time(); data = Data(ells, H, smax); print(H, ells, f"{time.time()-t:.0f} s", flush=True)
        for l, m, sig in itertools.product((0.03, 0.05, 0.08), (1.0, 2.0), (0.01, 0.05)):
            t = time.time()
            fit, out = data.evaluate(kern, l, m, sig, 0.1, (0, 16, 32), 0.04, 1.5, 1e-2)
            print(f"l {l} m {m} sig {sig}: fit {100*fit:.1f} | " + " | ".join(f"J{J} full {a:.1f} ({b:.0f}) near {c:.1f} ({d:.0f})" for J, a, b, c, d in out), f"{time.time()-t:.0f} s", flush=True)
