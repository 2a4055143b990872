//! A small cache that drops the least recently used value.

/// Values by key, in the order of their last use.
pub struct RecentlyUsed<K, V> {
    /// Keys and values, the least recently used first.
    entries: Vec<(K, V)>,
    capacity: usize,
}

impl<K: PartialEq, V> RecentlyUsed<K, V> {
    /// Creates an empty cache for at most `capacity` values.
    pub fn new(capacity: usize) -> Self {
        Self { entries: Vec::new(), capacity }
    }

    /// Returns the value of a key, which becomes the most recently used one.
    pub fn get(&mut self, key: &K) -> Option<&V> {
        let at = self.entries.iter().position(|(known, _)| known == key)?;
        let entry = self.entries.remove(at);
        self.entries.push(entry);
        self.entries.last().map(|(_, value)| value)
    }

    /// Adds a value for a key that has none. If the cache is full, the least recently used value is dropped.
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
