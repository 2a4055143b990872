//! Hash of data that is the same on every machine and in every version of the program.
//!
//! Source: Fowler, Noll, Vo 1991, FNV-1a with 128 bits (draft-eastlake-fnv).

const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

/// Hash of the bytes added so far; not cryptographic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fingerprint(u128);

impl Default for Fingerprint {
    fn default() -> Self {
        Self(OFFSET)
    }
}

impl Fingerprint {
    /// Appends bytes to the hashed data.
    pub fn add(&mut self, bytes: &[u8]) {
        self.0 = bytes.iter().fold(self.0, |hash, &byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME));
    }

    /// Returns the hash.
    #[must_use]
    pub fn value(&self) -> u128 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_equal_the_published_test_vectors() {
        let name = |text: &str| {
            let mut name = Fingerprint::default();
            name.add(text.as_bytes());
            name.value()
        };
        assert_eq!(name(""), 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
        assert_eq!(name("a"), 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964);
        assert_eq!(name("foobar"), 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18);
    }
}
