//! How the whole surface moves: the displacements of all contacts, added up.

use glam::DVec3;

use crate::arc_length::ArcLengths;
use crate::body::Body;
use crate::contact_shape::{ContactShape, Displacement};
use crate::expansion::Expansion;
use crate::interaction::Impression;
use crate::mesh::{SurfacePoint, length};
use crate::parameters::Spread;
use crate::response::{DirectionalField, Response};
use crate::rings::Rings;
use crate::tissue::Tissue;

/// Behind a thin lobe, where the way along the surface turns back under the contact, "away from the contact"
/// loses its meaning. It fades where the way in the tangent plane is less than this part of the distance.
const AWAY_FADES_BELOW: f64 = 0.2;

/// Displacements of the vertices that move, with the scratch memory to compute them.
///
/// Made once for a body and a tissue. The cost of an update follows the vertices that move. Memory is set
/// aside at construction, one more list when more impressions come together than ever before.
#[derive(Clone, Debug)]
pub struct SurfaceField {
    tissue: Tissue,
    shape: ContactShape,
    spreading: Spreading,
    expansion: Option<Expansion>,
    /// One for each impression, kept while the impression stays where it is.
    neighbourhoods: Vec<Neighbourhood>,
    moved: Moved,
    /// The impression at work, and the sum with it.
    own: Moved,
    merged: Moved,
}

/// Vertices in ascending order and their displacements.
#[derive(Clone, Debug)]
struct Moved {
    vertices: Vec<u32>,
    displacements: Vec<DVec3>,
}

/// How far the vertices are from a contact.
#[derive(Clone, Debug)]
enum Spreading {
    Geodesic(Box<ArcLengths>),
    Rings(Rings),
    /// On a calibrated body.
    Directional(Box<DirectionalField>),
}

/// Vertices around one contact, in ascending order, with their arc lengths or ring numbers.
#[derive(Clone, Debug)]
struct Neighbourhood {
    /// Where and how far it was computed.
    key: Option<(SurfacePoint, f64)>,
    vertices: Vec<(u32, f64)>,
}

impl SurfaceField {
    /// Sets the memory for `body` aside: only for what `tissue` asks for.
    ///
    /// On a calibrated body of up to 4000 vertices the arc lengths between all vertices are worked out here, four bytes each:
    /// 39 MB and about 0.6 s for 3116 vertices on one core of a present-day computer, longer where arcs are exact.
    #[must_use]
    pub fn new(body: &Body, tissue: &Tissue) -> Self {
        let vertices = body.mesh().vertices().len();
        Self {
            tissue: tissue.clone(),
            shape: tissue.shape(),
            spreading: Spreading::new(body, tissue),
            expansion: Expansion::new(tissue.surface().expansion, vertices),
            neighbourhoods: vec![Neighbourhood::new(vertices)],
            moved: Moved::new(vertices),
            own: Moved::new(vertices),
            merged: Moved::new(vertices),
        }
    }

    /// Computes the field of `impressions`. `body` is the one this was made for; another `tissue` than the
    /// last one is taken over first, which allocates.
    ///
    /// Where an impression has not moved since the last update, its arc lengths are used again; the result is
    /// the same in every bit. Impressions whose depth is not finite are left out.
    pub fn update(
        &mut self,
        body: &Body,
        tissue: &Tissue,
        impressions: impl IntoIterator<Item = Impression>,
    ) {
        if self.tissue != *tissue {
            self.retune(body, tissue);
        }
        let mut is_first = true;
        for (place, impression) in impressions.into_iter().enumerate() {
            if self.shape.set_depth(tissue.law(), impression.depth_m).is_err() {
                continue;
            }
            match calibrated(body, tissue) {
                Some(response) => self.displace_calibrated(body, response, &impression),
                None => {
                    self.explore(body, place, impression.at);
                    self.displace(body, place, &impression);
                }
            }
            if is_first {
                std::mem::swap(&mut self.moved, &mut self.own);
                is_first = false;
            } else {
                self.merged.set_sum(&self.moved, &self.own);
                std::mem::swap(&mut self.moved, &mut self.merged);
            }
        }
        if is_first {
            self.moved.clear();
        }
    }

    /// The vertices that move, ascending.
    #[must_use]
    pub fn vertices(&self) -> &[u32] {
        &self.moved.vertices
    }

    /// Their displacements from rest in metres, body frame, in the order of [`vertices`](Self::vertices).
    #[must_use]
    pub fn displacements(&self) -> &[DVec3] {
        &self.moved.displacements
    }

    /// Bytes of memory set aside. The operating system hands out untouched parts of it only on paper.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let spreading = match &self.spreading {
            Spreading::Geodesic(arcs) => arcs.memory_bytes(),
            Spreading::Rings(rings) => rings.memory_bytes(),
            Spreading::Directional(field) => field.memory_bytes(),
        };
        let moved = [&self.moved, &self.own, &self.merged].map(Moved::memory_bytes).iter().sum::<usize>();
        let pair = size_of::<(u32, f64)>();
        let neighbourhoods =
            self.neighbourhoods.iter().map(|near| near.vertices.capacity() * pair).sum::<usize>();
        spreading + moved + neighbourhoods + self.expansion.as_ref().map_or(0, Expansion::memory_bytes)
    }

    fn retune(&mut self, body: &Body, tissue: &Tissue) {
        match &mut self.spreading {
            Spreading::Directional(field) if calibrated(body, tissue).is_some() => {
                field.retune(&tissue.shape())
            }
            Spreading::Geodesic(_) | Spreading::Rings(_)
                if self.tissue.surface().spread == tissue.surface().spread
                    && calibrated(body, tissue).is_none() => {}
            _ => {
                self.spreading = Spreading::new(body, tissue);
                self.neighbourhoods.iter_mut().for_each(|near| near.key = None);
            }
        }
        self.expansion = Expansion::new(tissue.surface().expansion, body.mesh().vertices().len());
        self.shape = tissue.shape();
        self.tissue = tissue.clone();
    }

    /// Makes `neighbourhoods[place]` that of `at`, as far as the present shape reaches.
    fn explore(&mut self, body: &Body, place: usize, at: SurfacePoint) {
        if place == self.neighbourhoods.len() {
            self.neighbourhoods.push(Neighbourhood::new(body.mesh().vertices().len()));
        }
        let limit = match self.spreading {
            Spreading::Geodesic(_) | Spreading::Directional(_) => rounded_up(self.shape.reach_m()),
            Spreading::Rings(_) => rounded_up(self.shape.reach_rings()),
        };
        let key = Some((at, limit));
        if let Some(known) = (place..self.neighbourhoods.len()).find(|&k| self.neighbourhoods[k].key == key) {
            self.neighbourhoods.swap(place, known);
            return;
        }
        let near = &mut self.neighbourhoods[place];
        near.key = key;
        near.vertices.clear();
        match &mut self.spreading {
            Spreading::Geodesic(arcs) => {
                arcs.solve(body.mesh(), at, limit);
                near.vertices.extend(arcs.iter());
            }
            Spreading::Rings(rings) => rings.solve(body.mesh(), at, limit, &mut near.vertices),
            Spreading::Directional(_) => {} // has its own
        }
        near.vertices.sort_unstable_by_key(|&(vertex, _)| vertex);
    }

    /// Writes the displacements of one impression to `own`.
    fn displace(&mut self, body: &Body, place: usize, impression: &Impression) {
        let mesh = body.mesh();
        let spread = self.tissue.surface().spread;
        let reach = match spread {
            Spread::Geodesic => self.shape.reach_m(),
            Spread::Rings => self.shape.reach_rings(),
        };
        let lateral = impression.lateral_m;
        self.own.clear();
        if let Some(expansion) = &mut self.expansion {
            expansion.begin();
        }
        for &(vertex, far) in self.neighbourhoods[place].vertices.iter().filter(|near| near.1 < reach) {
            let s = match spread {
                Spread::Geodesic => self.shape.s_m(far),
                Spread::Rings => far,
            };
            let Displacement { normal_m, tangential_m } = match spread {
                Spread::Geodesic => self.shape.displacement(s, far),
                Spread::Rings => self.shape.displacement_at_ring(s),
            };
            let away = away(mesh.vertices()[vertex as usize] - impression.position, impression.normal);
            let mut displacement = impression.normal * normal_m + away * tangential_m;
            if lateral != DVec3::ZERO {
                displacement += lateral
                    * match spread {
                        Spread::Geodesic => self.shape.share(s),
                        Spread::Rings => self.shape.share_at_ring(s),
                    };
            }
            if let Some(expansion) = &mut self.expansion {
                expansion.note(&self.shape, spread, s, normal_m, mesh.vertex_areas()[vertex as usize]);
            }
            self.own.vertices.push(vertex);
            self.own.displacements.push(displacement);
        }
        if let Some(expansion) = &self.expansion {
            expansion.add(mesh, &self.own.vertices, &mut self.own.displacements);
        }
    }

    /// As [`displace`](Self::displace), on a calibrated body.
    fn displace_calibrated(&mut self, body: &Body, response: &Response, impression: &Impression) {
        let Spreading::Directional(field) = &mut self.spreading else { return };
        let (mesh, shape, own) = (body.mesh(), &self.shape, &mut self.own);
        let Moved { vertices, displacements } = own;
        field.solve(mesh, response, shape, impression, vertices, displacements);
        if let Some(expansion) = &mut self.expansion {
            expansion.begin();
            for (&vertex, displacement) in vertices.iter().zip(displacements.iter()) {
                let normal_m = displacement.dot(impression.normal);
                let area_m2 = mesh.vertex_areas()[vertex as usize];
                expansion.note(shape, Spread::Geodesic, field.s_m(vertex), normal_m, area_m2);
            }
            expansion.add(mesh, vertices, displacements);
        }
    }
}

/// The response that decides the field: one that was made for as many chains.
fn calibrated<'a>(body: &'a Body, tissue: &Tissue) -> Option<&'a Response> {
    body.response().filter(|response| response.chains() == tissue.law().chains().len())
}

/// Direction away from the contact in its tangent plane, for a vertex at `offset` from it: a unit vector,
/// shorter behind a thin lobe, zero at the contact.
fn away(offset: DVec3, normal: DVec3) -> DVec3 {
    let in_plane = offset - normal * offset.dot(normal);
    let scale = length(in_plane).max(AWAY_FADES_BELOW * length(offset));
    if scale > 0.0 { in_plane / scale } else { DVec3::ZERO }
}

/// The next number above with five binary digits behind the first. While a contact stays where it is, its
/// depth changes; so its neighbourhood is computed anew only when the reach passes one of these steps, and
/// depends on nothing but the present reach.
fn rounded_up(reach: f64) -> f64 {
    const DROPPED: u64 = (1 << 47) - 1;
    let bits = reach.to_bits();
    // The bits of positive numbers are ordered as the numbers are.
    if reach.is_finite() && reach > 0.0 { f64::from_bits((bits + DROPPED) & !DROPPED) } else { reach }
}

impl Spreading {
    fn new(body: &Body, tissue: &Tissue) -> Self {
        if let Some(response) = calibrated(body, tissue) {
            return Self::Directional(Box::new(DirectionalField::new(
                body.mesh(),
                response,
                &tissue.shape(),
            )));
        }
        match tissue.surface().spread {
            Spread::Geodesic => Self::Geodesic(Box::new(ArcLengths::new(body.mesh()))),
            Spread::Rings => Self::Rings(Rings::new(body.mesh())),
        }
    }
}

impl Neighbourhood {
    fn new(vertices: usize) -> Self {
        Self { key: None, vertices: Vec::with_capacity(vertices) }
    }
}

impl Moved {
    fn new(vertices: usize) -> Self {
        Self { vertices: Vec::with_capacity(vertices), displacements: Vec::with_capacity(vertices) }
    }

    fn clear(&mut self) {
        self.vertices.clear();
        self.displacements.clear();
    }

    fn push(&mut self, vertex: u32, displacement: DVec3) {
        self.vertices.push(vertex);
        self.displacements.push(displacement);
    }

    /// Becomes the sum of two fields.
    fn set_sum(&mut self, a: &Self, b: &Self) {
        self.clear();
        let (mut i, mut j) = (0, 0);
        loop {
            match (a.vertices.get(i), b.vertices.get(j)) {
                (None, None) => break,
                (Some(&u), Some(&v)) if u == v => {
                    self.push(u, a.displacements[i] + b.displacements[j]);
                    (i, j) = (i + 1, j + 1);
                }
                (Some(&u), other) if other.is_none_or(|&v| u < v) => {
                    self.push(u, a.displacements[i]);
                    i += 1;
                }
                (_, Some(&v)) => {
                    self.push(v, b.displacements[j]);
                    j += 1;
                }
                (Some(_), None) => break,
            }
        }
    }

    fn memory_bytes(&self) -> usize {
        self.vertices.capacity() * size_of::<u32>() + self.displacements.capacity() * size_of::<DVec3>()
    }
}
