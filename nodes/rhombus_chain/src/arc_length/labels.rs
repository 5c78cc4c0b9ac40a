//! Arc lengths found so far, and a queue of those that have still to be carried on.

/// "No vertex" in the links of the queue.
const NONE: u32 = u32::MAX;

/// Number of shelves in the queue.
const SHELVES: usize = 512;

/// What is known of one vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Label {
    /// Arc length in metres, infinite when nothing is known.
    pub(super) arc_m: f64,
    /// Whether it has been carried on to the neighbours and not been shortened since.
    pub(super) is_settled: bool,
    /// The vertex behind this one on the same shelf of the queue.
    next: u32,
}

/// Nothing is known.
const UNKNOWN: Label = Label { arc_m: f64::INFINITY, is_settled: false, next: NONE };

/// Labels of all vertices, in memory of fixed size.
///
/// The queue hands out vertices nearly in the order of their arcs: sorted to shelves of equal depth, last come first served
/// on a shelf. An exact order would cost more than the few vertices it saves from being carried on twice.
#[derive(Clone, Debug)]
pub(super) struct Labels {
    labels: Vec<Label>,
    /// Vertices with a label.
    known: Vec<u32>,
    /// First vertex of each shelf; arcs one round of shelves apart share one.
    shelves: [u32; SHELVES],
    shelves_per_m: f64,
    /// The shelf being served, counted through all rounds.
    present: u64,
    waiting: usize,
}

impl Labels {
    /// For a surface of so many vertices, whose edges have these lengths.
    pub(super) fn new(vertices: usize, mean_edge_m: f64, longest_edge_m: f64) -> Self {
        // A neighbour is at most an edge farther, so that less than one round of shelves is in use.
        let depth_m = (0.12 * mean_edge_m).max(longest_edge_m / (SHELVES - 2) as f64);
        Self {
            labels: vec![UNKNOWN; vertices],
            known: Vec::with_capacity(vertices),
            shelves: [NONE; SHELVES],
            shelves_per_m: 1.0 / depth_m,
            present: 0,
            waiting: 0,
        }
    }

    /// Forgets all labels.
    pub(super) fn clear(&mut self) {
        for &vertex in &self.known {
            self.labels[vertex as usize] = UNKNOWN;
        }
        self.known.clear();
        self.present = 0;
    }

    #[inline]
    pub(super) fn read(&self, vertex: u32) -> Label {
        self.labels[vertex as usize]
    }

    /// Vertices with a label.
    pub(super) fn known(&self) -> &[u32] {
        &self.known
    }

    /// Forgets labels that are not needed any more.
    pub(super) fn retain(&mut self, is_needed: impl Fn(f64) -> bool) {
        let labels = &mut self.labels;
        self.known.retain(|&vertex| {
            let label = &mut labels[vertex as usize];
            let keeps = is_needed(label.arc_m);
            if !keeps {
                *label = UNKNOWN;
            }
            keeps
        });
    }

    /// Gives a vertex a first or a shorter label and queues it.
    #[inline]
    pub(super) fn shorten(&mut self, vertex: u32, arc_m: f64) {
        let label = &mut self.labels[vertex as usize];
        let is_new = label.arc_m == f64::INFINITY;
        let is_waiting = !is_new && !label.is_settled;
        label.arc_m = arc_m;
        label.is_settled = false;
        if is_new {
            self.known.push(vertex);
        }
        // One that waits already keeps its place: it comes a little late, and is carried on with its new label.
        if !is_waiting {
            let shelf = ((arc_m * self.shelves_per_m) as u64).max(self.present);
            let first = &mut self.shelves[shelf as usize % SHELVES];
            label.next = *first;
            *first = vertex;
            self.waiting += 1;
        }
    }

    /// Takes one of the nearest vertices from the queue.
    #[inline]
    pub(super) fn settle_next(&mut self) -> Option<(u32, f64)> {
        if self.waiting == 0 {
            return None;
        }
        loop {
            let first = &mut self.shelves[self.present as usize % SHELVES];
            if *first != NONE {
                let vertex = *first;
                let label = &mut self.labels[vertex as usize];
                *first = label.next;
                label.is_settled = true;
                self.waiting -= 1;
                return Some((vertex, label.arc_m));
            }
            self.present += 1;
        }
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.labels.capacity() * size_of::<Label>() + self.known.capacity() * size_of::<u32>()
    }
}
