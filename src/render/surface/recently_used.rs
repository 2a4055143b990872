//! A small cache that drops what was used least recently.

/// Values by key, in the order of their last use.
pub struct RecentlyUsed<K, V> {
    /// The least recently used first.
    entries: Vec<(K, V)>,
    capacity: usize,
}

impl<K: PartialEq, V> RecentlyUsed<K, V> {
    /// An empty cache of at most `capacity` values.
    pub fn new(capacity: usize) -> Self {
        Self { entries: Vec::new(), capacity }
    }

    /// The value of a key, which becomes the most recently used one.
    pub fn get(&mut self, key: &K) -> Option<&V> {
        let at = self.entries.iter().position(|(known, _)| known == key)?;
        let entry = self.entries.remove(at);
        self.entries.push(entry);
        self.entries.last().map(|(_, value)| value)
    }

    /// Adds the value of a key that has none, and drops the least recently used one if the cache is full.
    pub fn insert(&mut self, key: K, value: V) {
        if self.entries.len() >= self.capacity {
            self.entries.remove(0);
        }
        self.entries.push((key, value));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_cache_drops_the_value_that_was_used_least_recently() {
        let mut cache = RecentlyUsed::new(3);
        for key in 0..3 {
            cache.insert(key, 10 * key);
        }
        assert_eq!(cache.get(&0), Some(&0));
        cache.insert(3, 30);
        assert_eq!([0, 1, 2, 3].map(|key| cache.get(&key).copied()), [Some(0), None, Some(20), Some(30)]);
    }
}
