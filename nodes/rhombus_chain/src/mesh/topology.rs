//! Which triangles meet at an edge and around a vertex: half-edge pairing and what is wrong with it.
//!
//! Half-edge `3 t + k` runs from corner `k` of triangle `t` to its next corner.

/// "No half-edge" in [`Topology::twins`].
pub(crate) const NONE: u32 = u32::MAX;

/// Half-edges of a triangle list, sorted by where they start.
pub(crate) struct HalfEdges<'a> {
    triangles: &'a [[u32; 3]],
    /// Half-edges that leave vertex v: `leaving[starts[v]..starts[v + 1]]`, by destination, then by number.
    starts: Vec<u32>,
    leaving: Vec<u32>,
}

/// One kind of fault: the first place and how many there are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fault<T> {
    pub(crate) first: Option<T>,
    pub(crate) count: usize,
}

impl<T> Default for Fault<T> {
    fn default() -> Self {
        Self { first: None, count: 0 }
    }
}

impl<T> Fault<T> {
    pub(crate) fn note(&mut self, place: impl FnOnce() -> T) {
        self.first.get_or_insert_with(place);
        self.count += 1;
    }
}

/// An edge at which too many triangles meet, or two in the wrong sense.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EdgeFault {
    pub(crate) edge: [u32; 2],
    pub(crate) triangles: [usize; 2],
    pub(crate) uses: usize,
}

/// Pairing of all half-edges.
#[derive(Default)]
pub(crate) struct Topology {
    /// The half-edge on the other side, [`NONE`] where the edge is at fault.
    pub(crate) twins: Vec<u32>,
    pub(crate) open: Fault<EdgeFault>,
    pub(crate) crowded: Fault<EdgeFault>,
    pub(crate) misoriented: Fault<EdgeFault>,
}

/// Start vertex of half-edge `h`.
pub(crate) fn origin(triangles: &[[u32; 3]], h: u32) -> u32 {
    triangles[(h / 3) as usize][(h % 3) as usize]
}

/// End vertex of half-edge `h`.
pub(crate) fn destination(triangles: &[[u32; 3]], h: u32) -> u32 {
    triangles[(h / 3) as usize][((h + 1) % 3) as usize]
}

/// The half-edge after `h` in its triangle.
#[inline]
pub(crate) fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

/// The half-edge before `h` in its triangle.
#[inline]
pub(crate) fn previous(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

impl<'a> HalfEdges<'a> {
    /// Sorts the half-edges of triangles whose vertex numbers are below `vertices`; `skip` leaves triangles
    /// out.
    pub(crate) fn new(vertices: usize, triangles: &'a [[u32; 3]], skip: impl Fn(usize) -> bool) -> Self {
        let mut starts = vec![0u32; vertices + 1];
        for (_, triangle) in triangles.iter().enumerate().filter(|(t, _)| !skip(*t)) {
            for &v in triangle {
                starts[v as usize + 1] += 1;
            }
        }
        for v in 0..vertices {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut leaving = vec![0u32; starts[vertices] as usize];
        for (t, triangle) in triangles.iter().enumerate().filter(|(t, _)| !skip(*t)) {
            for (k, &v) in triangle.iter().enumerate() {
                leaving[next[v as usize] as usize] = (3 * t + k) as u32;
                next[v as usize] += 1;
            }
        }
        for v in 0..vertices {
            leaving[starts[v] as usize..starts[v + 1] as usize]
                .sort_unstable_by_key(|&h| (destination(triangles, h), h));
        }
        Self { triangles, starts, leaving }
    }

    /// Half-edges that leave vertex `v`.
    pub(crate) fn leaving(&self, v: usize) -> &[u32] {
        &self.leaving[self.starts[v] as usize..self.starts[v + 1] as usize]
    }

    /// Half-edges from `a` to `b`.
    fn between(&self, a: u32, b: u32) -> &[u32] {
        let leaving = self.leaving(a as usize);
        let first = leaving.partition_point(|&h| destination(self.triangles, h) < b);
        let count = leaving[first..].partition_point(|&h| destination(self.triangles, h) == b);
        &leaving[first..first + count]
    }

    /// Pairs every half-edge with the one on the other side and notes every edge where that fails.
    pub(crate) fn pair(&self) -> Topology {
        let mut topology = Topology { twins: vec![NONE; 3 * self.triangles.len()], ..Topology::default() };
        for a in 0..self.starts.len() as u32 - 1 {
            let mut rest = self.leaving(a as usize);
            while let Some(&h) = rest.first() {
                let b = destination(self.triangles, h);
                let there = self.between(a, b);
                rest = &rest[there.len()..];
                let back = self.between(b, a);
                // Every edge once: from its smaller vertex, or from the only vertex it is used from.
                if a < b || back.is_empty() {
                    topology.judge([a, b], there, back);
                }
            }
        }
        topology
    }
}

impl Topology {
    fn judge(&mut self, edge: [u32; 2], there: &[u32], back: &[u32]) {
        let uses = there.len() + back.len();
        let second = there.get(1).or(back.first()).unwrap_or(&there[0]);
        let fault = || EdgeFault { edge, triangles: [there[0] as usize / 3, *second as usize / 3], uses };
        match (there, back) {
            ([h], [twin]) => {
                self.twins[*h as usize] = *twin;
                self.twins[*twin as usize] = *h;
            }
            ([_], []) => self.open.note(fault),
            ([_, _], []) => self.misoriented.note(fault),
            _ => self.crowded.note(fault),
        }
    }
}

/// Number of separate fans of triangles around a vertex whose half-edges are all paired: 1 in a manifold.
/// `visited` has one entry for each half-edge and is shared between the vertices of a mesh.
pub(crate) fn fans(leaving: &[u32], twins: &[u32], visited: &mut [bool]) -> usize {
    let mut fans = 0;
    for &start in leaving {
        if visited[start as usize] {
            continue;
        }
        fans += 1;
        let mut h = start;
        while !visited[h as usize] {
            visited[h as usize] = true;
            h = twins[previous(h) as usize];
        }
    }
    fans
}
