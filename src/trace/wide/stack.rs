//! The nodes that a ray still has to visit, without heap memory as long as they are few.

/// Number of entries that fit without heap memory.
const SHALLOW: usize = 48;

/// Nodes to visit, with the distances to their boxes.
pub(super) struct Stack {
    shallow: [(f32, u32); SHALLOW],
    length: usize,
    deep: Vec<(f32, u32)>,
}

impl Stack {
    #[inline]
    pub(super) fn new() -> Self {
        Self { shallow: [(0.0, 0); SHALLOW], length: 0, deep: Vec::new() }
    }

    #[inline]
    pub(super) fn push(&mut self, entry: (f32, u32)) {
        match self.shallow.get_mut(self.length) {
            Some(place) => {
                *place = entry;
                self.length += 1;
            }
            None => self.deep.push(entry),
        }
    }

    /// Removes the last entry whose box is within reach and returns its node. `None` if there is none.
    #[inline]
    pub(super) fn pop(&mut self, reach: f32) -> Option<u32> {
        while let Some((distance, child)) = self.deep.pop() {
            if distance <= reach {
                return Some(child);
            }
        }
        while self.length > 0 {
            self.length -= 1;
            let (distance, child) = self.shallow[self.length];
            if distance <= reach {
                return Some(child);
            }
        }
        None
    }
}
