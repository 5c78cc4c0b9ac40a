from fit import *
vs,U,K=load(); rv=R["site_vertex"]; 
e=[];k=[]
for v,u,kk in zip(vs,U,K):
    i=np.flatnonzero(rv==v)
    if len(i): q=R["displacement"][i[0]].astype(float); e.append(np.linalg.norm(u-q)/np.linalg.norm(q)); k.append(kk/R["stiffness"][i[0]]-1)
print(len(e), "shared sites: field", np.median(e), max(e), "stiffness", np.median(np.abs(k)), np.max(np.abs(k)))
