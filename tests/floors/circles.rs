//! Cycles in the dependencies between files.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use super::imports::Uses;

/// A cycle of files: each uses the next, and the last uses the first.
pub type Circle = Vec<String>;

/// Returns a shortest cycle through each file that is on one. A cycle is left out if shorter ones contain all its
/// files.
pub fn circles(uses: &Uses) -> Vec<Circle> {
    let mut all: Vec<Circle> = uses.keys().filter_map(|file| shortest_circle(uses, file)).collect();
    all.sort_by_key(Vec::len);
    let mut covered = BTreeSet::new();
    all.retain(|circle| {
        let num_before = covered.len();
        covered.extend(circle.iter().cloned());
        covered.len() > num_before
    });
    all
}

/// Returns the shortest cycle from `start` back to itself, by breadth-first search.
fn shortest_circle(uses: &Uses, start: &str) -> Option<Circle> {
    let mut reached_from: BTreeMap<&str, &str> = BTreeMap::new();
    let mut waiting = VecDeque::from([start]);
    while let Some(file) = waiting.pop_front() {
        for next in uses.get(file).into_iter().flat_map(BTreeMap::keys) {
            if next == start {
                let mut circle: Circle =
                    std::iter::successors(Some(file), |&at| reached_from.get(at).copied()).map(str::to_owned).collect();
                circle.reverse();
                return Some(circle);
            }
            if !reached_from.contains_key(next.as_str()) {
                reached_from.insert(next, file);
                waiting.push_back(next);
            }
        }
    }
    None
}

/// Formats the cycle as a chain, with the names through which each file uses the next.
pub fn describe(circle: &Circle, uses: &Uses) -> String {
    let next = |at: usize| &circle[(at + 1) % circle.len()];
    let steps = circle.iter().enumerate().map(|(at, file)| {
        let names: Vec<&str> = uses[file][next(at)].iter().map(String::as_str).collect();
        format!("{file} -[{}]-> ", names.join(", "))
    });
    format!("circle: {}{}", steps.collect::<String>(), circle[0])
}
