//! JSON objects that several parts of a file need.

use std::collections::BTreeSet;

use serde_json::{Value, json};

/// Extensions that the written parts use.
pub(super) type Extensions = BTreeSet<&'static str>;

/// Returns an object with a name, or an empty object if the name is empty.
pub(super) fn named(name: &str) -> Value {
    if name.is_empty() { json!({}) } else { json!({ "name": name }) }
}
