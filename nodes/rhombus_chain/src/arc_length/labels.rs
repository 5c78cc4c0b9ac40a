//! Arc lengths found so far, and a queue of those that have still to be carried on.

use super::shelves::{NONE, Shelves};

/// What is known of one vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Label {
    /// Arc length in metres, infinite when nothing is known.
    pub(super) arc_m: f64,
    /// Whether it has been carried on to the neighbours and not been shortened since.
    pub(super) is_settled: bool,
    /// The vertex behind this one in the queue.
    behind: u32,
}

/// Nothing is known.
const UNKNOWN: Label = Label { arc_m: f64::INFINITY, is_settled: false, behind: NONE };

/// Labels of all vertices, in memory of fixed size.
#[derive(Clone, Debug)]
pub(super) struct Labels {
    labels: Vec<Label>,
    /// Vertices with a label.
    known: Vec<u32>,
    queue: Shelves,
}

impl Labels {
    pub(super) fn new(vertices: usize, queue: Shelves) -> Self {
        Self { labels: vec![UNKNOWN; vertices], known: Vec::with_capacity(vertices), queue }
    }

    /// Forgets all labels. The queue has to be empty.
    pub(super) fn clear(&mut self) {
        for &vertex in &self.known {
            self.labels[vertex as usize] = UNKNOWN;
        }
        self.known.clear();
        self.queue.restart();
    }

    #[inline]
    pub(super) fn read(&self, vertex: u32) -> Label {
        self.labels[vertex as usize]
    }

    /// Vertices with a label.
    pub(super) fn known(&self) -> &[u32] {
        &self.known
    }

    /// Forgets the labels that are not below `limit_m`.
    pub(super) fn trim(&mut self, limit_m: f64) {
        let labels = &mut self.labels;
        self.known.retain(|&vertex| {
            let label = &mut labels[vertex as usize];
            let keeps = label.arc_m < limit_m;
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
        // One that waits already keeps its place: it comes a little late, and is carried on with its new
        // label.
        if !is_waiting {
            label.behind = self.queue.push(vertex, arc_m);
        }
    }

    /// Takes one of the nearest vertices from the queue.
    #[inline]
    pub(super) fn settle_next(&mut self) -> Option<(u32, f64)> {
        let labels = &mut self.labels;
        let vertex = self.queue.pop(|vertex| labels[vertex as usize].behind)?;
        let label = &mut labels[vertex as usize];
        label.is_settled = true;
        Some((vertex, label.arc_m))
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.labels.capacity() * size_of::<Label>() + self.known.capacity() * size_of::<u32>()
    }
}
