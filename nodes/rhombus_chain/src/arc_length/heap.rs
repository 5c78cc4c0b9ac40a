//! A priority queue of vertices whose keys may decrease, in memory of fixed size.

/// Children of a heap entry.
const WIDTH: usize = 4;

/// Place of a vertex that is not in the heap.
const ABSENT: u32 = u32::MAX;

/// Smallest key first, ties by vertex number: the order is always the same.
#[derive(Clone, Debug)]
pub(super) struct Heap {
    entries: Vec<(f64, u32)>,
    /// Where each vertex is in `entries`.
    places: Vec<u32>,
}

impl Heap {
    pub(super) fn new(vertices: usize) -> Self {
        Self { entries: Vec::with_capacity(vertices), places: vec![ABSENT; vertices] }
    }

    pub(super) fn clear(&mut self) {
        for &(_, vertex) in &self.entries {
            self.places[vertex as usize] = ABSENT;
        }
        self.entries.clear();
    }

    /// Adds a vertex that is not in the heap.
    pub(super) fn push(&mut self, vertex: u32, key: f64) {
        self.entries.push((key, vertex));
        self.rise(self.entries.len() - 1, (key, vertex));
    }

    /// Gives a vertex a smaller key; adds it if it has left the heap.
    pub(super) fn decrease(&mut self, vertex: u32, key: f64) {
        match self.places[vertex as usize] {
            ABSENT => self.push(vertex, key),
            place => self.rise(place as usize, (key, vertex)),
        }
    }

    /// Removes the vertex with the smallest key.
    pub(super) fn pop(&mut self) -> Option<(u32, f64)> {
        let last = self.entries.pop()?;
        let Some(&(key, vertex)) = self.entries.first() else {
            self.places[last.1 as usize] = ABSENT;
            return Some((last.1, last.0));
        };
        self.places[vertex as usize] = ABSENT;
        self.sink(last);
        Some((vertex, key))
    }

    fn rise(&mut self, mut place: usize, entry: (f64, u32)) {
        while place > 0 {
            let parent = (place - 1) / WIDTH;
            if !before(entry, self.entries[parent]) {
                break;
            }
            self.put(place, self.entries[parent]);
            place = parent;
        }
        self.put(place, entry);
    }

    /// Puts `entry` into the hole at the root.
    fn sink(&mut self, entry: (f64, u32)) {
        let mut place = 0;
        loop {
            let first = place * WIDTH + 1;
            let end = (first + WIDTH).min(self.entries.len());
            let mut smallest = None;
            let mut best = entry;
            for child in first..end {
                if before(self.entries[child], best) {
                    best = self.entries[child];
                    smallest = Some(child);
                }
            }
            let Some(child) = smallest else { break };
            self.put(place, best);
            place = child;
        }
        self.put(place, entry);
    }

    fn put(&mut self, place: usize, entry: (f64, u32)) {
        self.entries[place] = entry;
        self.places[entry.1 as usize] = place as u32;
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.entries.capacity() * size_of::<(f64, u32)>() + self.places.capacity() * size_of::<u32>()
    }
}

fn before(a: (f64, u32), b: (f64, u32)) -> bool {
    a.0 < b.0 || (a.0 == b.0 && a.1 < b.1)
}
