//! A light tree: a binary hierarchy of emissive triangles that chooses one of many lamps for a point.
//!
//! Each node bounds its lamps in space, in direction and in power. The descent chooses a child with a probability
//! proportional to its importance, an estimate of the light that the child may send to the point; the probability of a
//! lamp is the product of the probabilities along the path from the root to the lamp. A node is built by the split with
//! the smallest cost = power x directions x area, a surface area heuristic for lamps. A bake cuts every lamp into many
//! small triangles: below a node that is far away and whose lamps face the same way, only power decides.
//!
//! Source: Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".

use glam::Vec3;

use crate::raytrace::light::light_bounds::LightBounds;

/// Buckets along the axis of a split.
const NUM_BUCKETS: usize = 12;

/// Parent of the root.
const ROOT: u32 = u32::MAX;

/// A hierarchy of lamps, which are numbered as in the list that it is built from.
pub(crate) struct LightTree {
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
    /// Builds the tree over `lamps`.
    pub(crate) fn new(lamps: &[LightBounds]) -> Self {
        let mut tree = Self { nodes: Vec::with_capacity(2 * lamps.len()), leaf_of: vec![0; lamps.len()] };
        let mut numbers: Vec<u32> = (0..lamps.len() as u32).collect();
        if !lamps.is_empty() {
            tree.add(lamps, &mut numbers, ROOT);
        }
        tree
    }

    /// Adds a node over the lamps with these numbers and returns its index.
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

    /// Chooses a lamp that may light `point`, and returns its probability. `number` is uniform in 0..1.
    pub(crate) fn choose(&self, point: Vec3, normal: Vec3, mut number: f32) -> Option<(usize, f32)> {
        let mut node = self.nodes.first().filter(|root| root.bounds.importance(point, normal) > 0.0)?;
        let mut probability = 1.0;
        let mut are_alike = false;
        while let Below::Children(children) = node.below {
            are_alike |= node.bounds.are_alike(point);
            let [left, right] = children.map(|child| &self.nodes[child as usize]);
            let share = if are_alike { power_share(left, right) } else { left_share(left, right, point, normal)? };
            if number < share {
                (node, number, probability) = (left, number / share, probability * share);
            } else {
                let rest = 1.0 - share;
                (node, number, probability) = (right, (number - share) / rest, probability * rest);
            }
        }
        let Below::Lamp(lamp) = node.below else { unreachable!("the descent ends at a lamp") };
        Some((lamp as usize, probability))
    }

    /// Returns the probability with which [`Self::choose`] chooses `lamp`.
    pub(crate) fn probability(&self, lamp: usize, point: Vec3, normal: Vec3) -> f32 {
        if self.nodes[0].bounds.importance(point, normal) <= 0.0 {
            return 0.0;
        }
        let leaf = self.leaf_of[lamp];
        let above = |at: &u32| Some(self.nodes[*at as usize].parent).filter(|&parent| parent != ROOT);
        let way_up = || std::iter::successors(Some(leaf), above);
        // Only power decides below the topmost node whose lamps are alike.
        let alike = way_up().filter(|&at| self.nodes[at as usize].bounds.are_alike(point)).last().unwrap_or(leaf);
        let mut probability = self.nodes[leaf as usize].bounds.power / self.nodes[alike as usize].bounds.power;
        for at in way_up().skip_while(|&at| at != alike) {
            let Some(parent) = above(&at) else { break };
            let Below::Children(children) = self.nodes[parent as usize].below else { break };
            let [left, right] = children.map(|child| &self.nodes[child as usize]);
            let Some(share) = left_share(left, right, point, normal) else { return 0.0 };
            probability *= if children[0] == at { share } else { 1.0 - share };
        }
        probability
    }
}

/// Probability of the left of two nodes by importance. `None` if neither lights the point.
fn left_share(left: &Node, right: &Node, point: Vec3, normal: Vec3) -> Option<f32> {
    let [l, r] = [left, right].map(|node| node.bounds.importance(point, normal));
    (l + r > 0.0).then(|| l / (l + r))
}

/// Probability of the left of two nodes by power.
fn power_share(left: &Node, right: &Node) -> f32 {
    let [l, r] = [left, right].map(|node| node.bounds.power);
    l / (l + r)
}

/// Partitions the lamps at the split with the smallest cost, and returns the size of the first part.
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
    // The outermost buckets are never empty, so neither part is.
    let costs = |at: &usize| cost(&buckets[..*at]) + cost(&buckets[*at..]);
    let best = (1..NUM_BUCKETS).min_by(|a, b| costs(a).total_cmp(&costs(b))).expect("several buckets");
    numbers.sort_by_key(|&n| bucket(n) >= best);
    numbers.partition_point(|&n| bucket(n) < best)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::sampling::{hash, r2, unit_float};

    /// Triangles with random positions and directions.
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

    /// A lamp on the ceiling, cut into elements as by a bake.
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
    fn every_lamp_is_chosen_with_its_stated_probability() {
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
                // The bounds of several lamps may reach a point that no single lamp reaches.
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
    fn every_lamp_that_lights_the_point_has_a_probability() {
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
    fn without_lamps_in_front_nothing_is_chosen() {
        assert!(LightTree::new(&[]).choose(Vec3::ZERO, Vec3::Y, 0.5).is_none());
        let behind = LightBounds::of_triangle([Vec3::NEG_Y; 3], Vec3::Y, 1.0, false);
        assert!(LightTree::new(&[behind, behind]).choose(Vec3::ZERO, Vec3::Y, 0.5).is_none());
    }
}
