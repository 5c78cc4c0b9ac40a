from run2 import *
for ells in ((0.0025,0.005,0.01,0.02,0.04,0.08),(0.003,0.006,0.012,0.025,0.05,0.1),(0.002,0.004,0.008,0.02,0.06)):
    d=Data(ells,2,0.25)
    for sig in (0.3,):
        fit,out=d.evaluate(kern,0.08,2.0,sig,0.3,(0,12,24),0.06,2.0,1e-3)
        print(ells,sig,f"fit {100*fit:.1f} | "+" | ".join(f"J{J} full {a:.1f} ({b:.0f}) near {c:.1f} ({e:.0f})" for J,a,b,c,e in out),flush=True)
