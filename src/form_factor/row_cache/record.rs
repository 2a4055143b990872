//! The bytes of a row cache: a header, then one record per row. Numbers are little-endian.
//!
//! | record | bytes |
//! |---|---|
//! | fingerprint | 16 |
//! | number of entries and of backs | 4 and 4 |
//! | sky share | 4 |
//! | element and factor of each entry, then of each back | 4 and 4 |

use std::io::{self, Read};

use crate::base::ids::ElementId;
use crate::form_factor::{Entry, Row};

/// First bytes of a file; the digit is the version of the format.
pub(super) const HEADER: &[u8; 16] = b"hemicube rows 2\n";

/// Size of a record before its entries, bytes.
const HEAD_BYTES: usize = 28;
const ENTRY_BYTES: usize = 8;

/// The part of a record before its entries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RecordHead {
    /// Fingerprint of the row's inputs.
    pub name: u128,
    num_entries: u32,
    num_backs: u32,
    sky: f32,
}

impl RecordHead {
    /// Reads the next head. Returns `None` if the remaining `num_left` bytes hold no whole record.
    pub(super) fn read(from: &mut impl Read, num_left: u64) -> io::Result<Option<Self>> {
        if num_left < HEAD_BYTES as u64 {
            return Ok(None);
        }
        let mut bytes = [0; HEAD_BYTES];
        from.read_exact(&mut bytes)?;
        let (name, numbers) = bytes.split_at(16);
        let number = |i: usize| <[u8; 4]>::try_from(&numbers[4 * i..4 * i + 4]).unwrap_or_default();
        let head = Self {
            name: u128::from_le_bytes(name.try_into().unwrap_or_default()),
            num_entries: u32::from_le_bytes(number(0)),
            num_backs: u32::from_le_bytes(number(1)),
            sky: f32::from_le_bytes(number(2)),
        };
        Ok((head.num_bytes() <= num_left).then_some(head))
    }

    /// Size of the entries and the backs, bytes.
    pub(super) fn num_entry_bytes(&self) -> u64 {
        (u64::from(self.num_entries) + u64::from(self.num_backs)) * ENTRY_BYTES as u64
    }

    /// Size of the whole record, bytes.
    pub(super) fn num_bytes(&self) -> u64 {
        HEAD_BYTES as u64 + self.num_entry_bytes()
    }
}

/// Reads the row whose head has been read.
pub(super) fn read_row(from: &mut impl Read, head: &RecordHead) -> io::Result<Row> {
    let mut bytes = vec![0; head.num_entry_bytes() as usize];
    from.read_exact(&mut bytes)?;
    let entry = |&[a, b, c, d, e, f, g, h]: &[u8; ENTRY_BYTES]| Entry {
        element: ElementId(u32::from_le_bytes([a, b, c, d])),
        factor: f32::from_le_bytes([e, f, g, h]),
    };
    let mut entries: Vec<Entry> = bytes.as_chunks::<ENTRY_BYTES>().0.iter().map(entry).collect();
    let backs = entries.split_off(head.num_entries as usize);
    Ok(Row { entries, backs, sky: head.sky })
}

/// Appends the record of a row.
pub(super) fn write_record(name: u128, row: &Row, bytes: &mut Vec<u8>) {
    bytes.extend(name.to_le_bytes());
    bytes.extend((row.entries.len() as u32).to_le_bytes());
    bytes.extend((row.backs.len() as u32).to_le_bytes());
    bytes.extend(row.sky.to_le_bytes());
    for entry in row.entries.iter().chain(&row.backs) {
        bytes.extend(entry.element.0.to_le_bytes());
        bytes.extend(entry.factor.to_le_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_read_as_written_and_a_truncated_one_is_refused() {
        let entries = vec![Entry { element: ElementId(7), factor: 0.25 }, Entry { element: ElementId(9), factor: 0.5 }];
        let backs = vec![Entry { element: ElementId(3), factor: 0.125 }];
        let row = Row { entries, backs, sky: 0.125 };
        let mut bytes = Vec::new();
        write_record(42 << 100, &row, &mut bytes);
        let mut reader = &bytes[..];
        let head = RecordHead::read(&mut reader, bytes.len() as u64).expect("read").expect("whole");
        assert_eq!((head.name, head.num_bytes()), (42 << 100, bytes.len() as u64));
        assert_eq!(read_row(&mut reader, &head).expect("read"), row);
        for length in 0..bytes.len() {
            assert_eq!(RecordHead::read(&mut &bytes[..length], length as u64).expect("read"), None);
        }
    }
}
