//! Which of many lamps to ask: a hierarchy of emissive triangles, gone down towards those that may bring most light.
//!
//! Among lamps that are as one, only power decides: a bake cuts every lamp into small triangles.
//!
//! Source: Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".

use glam::Vec3;

use super::light_bounds::LightBounds;

/// Places where a node may be split, along one axis.
const NUM_BUCKETS: usize = 12;

/// No parent.
const ROOT: u32 = u32::MAX;

/// A hierarchy of lamps; they are known by their number in the list it was built from.
pub(super) struct LightTree {
    nodes: Vec<Node>,
    /// Node of each lamp.
    leaf_of: Vec<u32>,
}

struct Node {
    bounds: LightBounds,
    parent: u32,
    below: Below,
}

enum Below {
    Lamp(u32),
    Children([u32; 2]),
}

impl LightTree {
    /// Builds the hierarchy of `lamps`.
    pub(super) fn new(lamps: &[LightBounds]) -> Self {
        let mut tree = Self { nodes: Vec::with_capacity(2 * lamps.len()), leaf_of: vec![0; lamps.len()] };
        let mut numbers: Vec<u32> = (0..lamps.len() as u32).collect();
        if !lamps.is_empty() {
            tree.add(lamps, &mut numbers, ROOT);
        }
        tree
    }

    /// Adds a node over the lamps with these numbers and hands back its place.
    fn add(&mut self, lamps: &[LightBounds], numbers: &mut [u32], parent: u32) -> u32 {
        let at = self.nodes.len() as u32;
        let all = numbers.iter().map(|&n| lamps[n as usize]).reduce(LightBounds::union).expect("a node has lamps");
        self.nodes.push(Node { bounds: all, parent, below: Below::Lamp(numbers[0]) });
        if let [lamp] = numbers {
            self.leaf_of[*lamp as usize] = at;
            return at;
        }
        let num_left = split(lamps, numbers);
        let (left, right) = numbers.split_at_mut(num_left);
        let children = [self.add(lamps, left, at), self.add(lamps, right, at)];
        self.nodes[at as usize].below = Below::Children(children);
        at
    }

    /// A lamp that may light `point`, and the probability of its choice; `number` is used up.
    pub(super) fn choose(&self, point: Vec3, normal: Vec3, mut number: f32) -> Option<(usize, f32)> {
        let mut node = self.nodes.first().filter(|root| root.bounds.importance(point, normal) > 0.0)?;
        let mut probability = 1.0;
        let mut are_as_one = false;
        while let Below::Children(children) = node.below {
            are_as_one |= node.bounds.are_as_one(point);
            let [left, right] = children.map(|child| &self.nodes[child as usize]);
            let share = if are_as_one { power_share(left, right) } else { left_share(left, right, point, normal)? };
            if number < share {
                (node, number, probability) = (left, number / share, probability * share);
            } else {
                let rest = 1.0 - share;
                (node, number, probability) = (right, (number - share) / rest, probability * rest);
            }
        }
        let Below::Lamp(lamp) = node.below else { unreachable!("the way ends at a lamp") };
        Some((lamp as usize, probability))
    }

    /// The probability with which [`Self::choose`] would choose `lamp`.
    pub(super) fn probability(&self, lamp: usize, point: Vec3, normal: Vec3) -> f32 {
        if self.nodes[0].bounds.importance(point, normal) <= 0.0 {
            return 0.0;
        }
        let leaf = self.leaf_of[lamp];
        let above = |at: &u32| Some(self.nodes[*at as usize].parent).filter(|&parent| parent != ROOT);
        let way_up = || std::iter::successors(Some(leaf), above);
        // Only power decides from the topmost node on whose lamps are as one.
        let as_one = way_up().filter(|&at| self.nodes[at as usize].bounds.are_as_one(point)).last().unwrap_or(leaf);
        let mut probability = self.nodes[leaf as usize].bounds.power / self.nodes[as_one as usize].bounds.power;
        for at in way_up().skip_while(|&at| at != as_one) {
            let Some(parent) = above(&at) else { break };
            let Below::Children(children) = self.nodes[parent as usize].below else { break };
            let [left, right] = children.map(|child| &self.nodes[child as usize]);
            let Some(share) = left_share(left, right, point, normal) else { return 0.0 };
            probability *= if children[0] == at { share } else { 1.0 - share };
        }
        probability
    }
}

/// Probability of the left of two nodes; none where neither lights the point.
fn left_share(left: &Node, right: &Node, point: Vec3, normal: Vec3) -> Option<f32> {
    let [l, r] = [left, right].map(|node| node.bounds.importance(point, normal));
    (l + r > 0.0).then(|| l / (l + r))
}

/// Probability of the left of two nodes by power alone.
fn power_share(left: &Node, right: &Node) -> f32 {
    let [l, r] = [left, right].map(|node| node.bounds.power);
    l / (l + r)
}

/// Sorts the lamps so that the first of two cheap halves comes first, and says how many it holds.
fn split(lamps: &[LightBounds], numbers: &mut [u32]) -> usize {
    let centre = |n: u32| lamps[n as usize].centre();
    let first = centre(numbers[0]);
    let (low, high) = numbers.iter().map(|&n| centre(n)).fold((first, first), |(l, h), c| (l.min(c), h.max(c)));
    let axis = (high - low).max_position();
    let extent = (high - low)[axis];
    if extent <= 0.0 {
        return numbers.len() / 2;
    }
    let bucket = |n: u32| (((centre(n) - low)[axis] / extent * NUM_BUCKETS as f32) as usize).min(NUM_BUCKETS - 1);
    let mut buckets = [None::<LightBounds>; NUM_BUCKETS];
    for &n in numbers.iter() {
        let lamp = lamps[n as usize];
        let sum = &mut buckets[bucket(n)];
        *sum = Some(sum.map_or(lamp, |sum| sum.union(lamp)));
    }
    let cost = |part: &[Option<LightBounds>]| {
        part.iter().flatten().copied().reduce(LightBounds::union).map_or(0.0, |bounds| bounds.cost())
    };
    // The outermost buckets are never empty, so neither is a half.
    let costs = |at: &usize| cost(&buckets[..*at]) + cost(&buckets[*at..]);
    let best = (1..NUM_BUCKETS).min_by(|a, b| costs(a).total_cmp(&costs(b))).expect("several buckets");
    numbers.sort_by_key(|&n| bucket(n) >= best);
    numbers.partition_point(|&n| bucket(n) < best)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::sampling::{hash, r2, unit_float};

    /// Triangles of all places and directions.
    fn lamps(count: u32) -> Vec<LightBounds> {
        let vector =
            |seed: u32| Vec3::new(unit_float(hash(seed)), unit_float(hash(seed + 1)), unit_float(hash(seed + 2)));
        let lamp = |i: u32| {
            let at = 4.0 * vector(100 * i);
            let corners = [at, at + 0.2 * vector(100 * i + 10), at + 0.2 * vector(100 * i + 20)];
            let normal = (vector(100 * i + 30) - 0.5).normalize();
            LightBounds::of_triangle(corners, normal, 0.1 + unit_float(hash(i)), i.is_multiple_of(3))
        };
        (0..count).map(lamp).collect()
    }

    /// A lamp on the ceiling as a bake cuts it up.
    fn cut_lamp() -> Vec<LightBounds> {
        let at = |x: u32, z: u32| Vec3::new(0.1 * x as f32, 3.0, 0.1 * z as f32);
        let square = |i: u32| {
            let (x, z) = (i % 6, i / 6);
            let corners = [at(x, z), at(x + 1, z), at(x + 1, z + 1)];
            LightBounds::of_triangle(corners, Vec3::NEG_Y, 0.5 + 0.1 * x as f32, false)
        };
        (0..36).map(square).collect()
    }

    #[test]
    fn every_lamp_is_chosen_as_often_as_its_probability_says() {
        const TRIES: u32 = 1 << 16;
        let normal = Vec3::new(0.6, 0.0, 0.8);
        let places = [
            (lamps(37), Vec3::new(1.0, 2.0, 0.5), normal),
            (cut_lamp(), Vec3::new(0.4, 2.5, 0.2), Vec3::Y),
            (cut_lamp(), Vec3::new(1.0, 1.0, 0.5), Vec3::Y),
            (cut_lamp(), Vec3::new(0.0, -4.0, 0.5), Vec3::Y),
        ];
        for (lamps, point, normal) in places {
            let tree = LightTree::new(&lamps);
            let mut counts = vec![0u32; lamps.len()];
            for i in 0..TRIES {
                // Lamps that bring light only together are none.
                let Some((lamp, probability)) = tree.choose(point, normal, r2(i, 5).x) else { continue };
                assert!((tree.probability(lamp, point, normal) / probability - 1.0).abs() < 1e-4);
                counts[lamp] += 1;
            }
            assert!(counts.iter().sum::<u32>() > TRIES / 2);
            for (lamp, &count) in counts.iter().enumerate() {
                let expected = tree.probability(lamp, point, normal) * TRIES as f32;
                assert!((count as f32 - expected).abs() < 0.02 * expected + 8.0, "{lamp}: {count} for {expected}");
            }
        }
    }

    #[test]
    fn a_lamp_that_can_be_seen_is_never_left_out() {
        let lamps = lamps(50);
        let tree = LightTree::new(&lamps);
        for i in 0..200 {
            let [a, b] = [r2(i, 1), r2(i, 2)];
            let (point, normal) = (5.0 * a.extend(b.x), (b.extend(a.y) - 0.5).normalize());
            for (number, lamp) in lamps.iter().enumerate() {
                let offset = point - lamp.centre();
                let cos_out = lamp.axis.dot(offset.normalize());
                let is_lit = (cos_out > 1e-3 || lamp.is_two_sided && cos_out < -1e-3) && normal.dot(-offset) > 1e-3;
                assert!(!is_lit || tree.probability(number, point, normal) > 0.0, "{number} from {point}");
            }
        }
    }

    #[test]
    fn no_lamp_is_no_choice() {
        assert!(LightTree::new(&[]).choose(Vec3::ZERO, Vec3::Y, 0.5).is_none());
        let behind = LightBounds::of_triangle([Vec3::NEG_Y; 3], Vec3::Y, 1.0, false);
        assert!(LightTree::new(&[behind, behind]).choose(Vec3::ZERO, Vec3::Y, 0.5).is_none());
    }
}
