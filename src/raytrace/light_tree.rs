//! Which of many lamps to ask: a hierarchy of emissive triangles, gone down towards those that may bring most light.
//!
//! Source: Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting"; the bounds are
//! those of Pharr, Jakob, Humphreys 2023, "Physically Based Rendering", section 12.6.3.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

/// Places where a node may be split, along one axis.
const NUM_BUCKETS: usize = 12;

/// No parent.
const ROOT: u32 = u32::MAX;

/// What is known of one lamp or of several together.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightBounds {
    low: Vec3,
    high: Vec3,
    /// Luminous power.
    power: f32,
    /// The emitting normals lie in a cone round this axis.
    axis: Vec3,
    /// Cosine of the half angle of that cone.
    cos_spread: f32,
    is_two_sided: bool,
}

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

impl LightBounds {
    /// Bounds of an emissive triangle of some power.
    pub(super) fn of_triangle(corners: [Vec3; 3], normal: Vec3, power: f32, is_two_sided: bool) -> Self {
        let [a, b, c] = corners;
        Self { low: a.min(b).min(c), high: a.max(b).max(c), power, axis: normal, cos_spread: 1.0, is_two_sided }
    }

    fn centre(&self) -> Vec3 {
        0.5 * (self.low + self.high)
    }

    fn union(self, other: Self) -> Self {
        let (axis, cos_spread) = cone_round((self.axis, self.cos_spread), (other.axis, other.cos_spread));
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            power: self.power + other.power,
            axis,
            cos_spread,
            is_two_sided: self.is_two_sided || other.is_two_sided,
        }
    }

    /// About how much light arrives at a point of a surface with this normal; 0 only where none can.
    fn importance(&self, point: Vec3, normal: Vec3) -> f32 {
        let offset = point - self.centre();
        let radius_squared = 0.25 * (self.high - self.low).length_squared();
        let distance_squared = offset.length_squared();
        let direction = offset / distance_squared.sqrt().max(f32::MIN_POSITIVE);
        // Half angle under which the point sees the box.
        let bound = Angle::from_cos(if distance_squared <= radius_squared {
            -1.0
        } else {
            (1.0 - radius_squared / distance_squared).sqrt()
        });
        let cos_out = self.axis.dot(direction);
        let out = Angle::from_cos(if self.is_two_sided { cos_out.abs() } else { cos_out });
        let cos_emitter = out.less(Angle::from_cos(self.cos_spread)).less(bound).cos;
        let cos_receiver = Angle::from_cos(-normal.dot(direction)).less(bound).cos;
        if cos_emitter <= 0.0 || cos_receiver <= 0.0 {
            return 0.0;
        }
        // Within the box a distance says nothing.
        self.power * cos_emitter * cos_receiver / distance_squared.max(radius_squared).max(f32::MIN_POSITIVE)
    }

    /// Cost of a node: power x directions x places (Conty Estevez and Kulla, section 4.4).
    fn cost(&self) -> f32 {
        let spread = self.cos_spread.clamp(-1.0, 1.0).acos();
        let end = (spread + 0.5 * PI).min(PI);
        let (sin, cos) = spread.sin_cos();
        let directions =
            TAU * (1.0 - cos) + 0.5 * PI * (2.0 * end * sin - (spread - 2.0 * end).cos() - 2.0 * spread * sin + cos);
        let size = self.high - self.low;
        let area = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
        // A flat or thin box has a size all the same.
        self.power * directions * (area + 1e-3 * size.length_squared())
    }
}

/// An angle in 0..pi.
#[derive(Clone, Copy)]
struct Angle {
    cos: f32,
    sin: f32,
}

impl Angle {
    fn from_cos(cos: f32) -> Self {
        let cos = cos.clamp(-1.0, 1.0);
        Self { cos, sin: (1.0 - cos * cos).sqrt() }
    }

    /// What is left after `other` is taken away, at least 0.
    fn less(self, other: Self) -> Self {
        if self.cos > other.cos {
            return Self { cos: 1.0, sin: 0.0 };
        }
        Self { cos: self.cos * other.cos + self.sin * other.sin, sin: self.sin * other.cos - self.cos * other.sin }
    }
}

/// The smallest cone (axis, cosine of the half angle) round two.
fn cone_round(a: (Vec3, f32), b: (Vec3, f32)) -> (Vec3, f32) {
    let (spread_a, spread_b) = (a.1.clamp(-1.0, 1.0).acos(), b.1.clamp(-1.0, 1.0).acos());
    let between = a.0.dot(b.0).clamp(-1.0, 1.0).acos();
    if between + spread_b <= spread_a {
        return a;
    }
    if between + spread_a <= spread_b {
        return b;
    }
    let spread = 0.5 * (spread_a + between + spread_b);
    let turn_axis = a.0.cross(b.0);
    if spread >= PI || turn_axis.length_squared() < 1e-12 {
        return (a.0, if between < 0.1 { spread.cos() } else { -1.0 });
    }
    let turned = glam::Quat::from_axis_angle(turn_axis.normalize(), spread - spread_a) * a.0;
    (turned.normalize(), spread.min(PI).cos())
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
        let mut node = self.nodes.first()?;
        let mut probability = 1.0;
        loop {
            match node.below {
                Below::Lamp(lamp) => return Some((lamp as usize, probability)),
                Below::Children(children) => {
                    let [left, right] = children.map(|child| &self.nodes[child as usize]);
                    let share = left_share(left, right, point, normal)?;
                    if number < share {
                        (node, number, probability) = (left, number / share, probability * share);
                    } else {
                        let rest = 1.0 - share;
                        (node, number, probability) = (right, (number - share) / rest, probability * rest);
                    }
                }
            }
        }
    }

    /// The probability with which [`Self::choose`] would choose `lamp`.
    pub(super) fn probability(&self, lamp: usize, point: Vec3, normal: Vec3) -> f32 {
        let mut at = self.leaf_of[lamp];
        let mut probability = 1.0;
        while self.nodes[at as usize].parent != ROOT {
            let parent = self.nodes[at as usize].parent;
            let Below::Children(children) = self.nodes[parent as usize].below else { break };
            let [left, right] = children.map(|child| &self.nodes[child as usize]);
            let Some(share) = left_share(left, right, point, normal) else { return 0.0 };
            probability *= if children[0] == at { share } else { 1.0 - share };
            at = parent;
        }
        probability
    }
}

/// Probability of the left of two nodes; none where neither lights the point.
fn left_share(left: &Node, right: &Node, point: Vec3, normal: Vec3) -> Option<f32> {
    let [l, r] = [left, right].map(|node| node.bounds.importance(point, normal));
    (l + r > 0.0).then(|| l / (l + r))
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

    #[test]
    fn every_lamp_is_chosen_as_often_as_its_probability_says() {
        let lamps = lamps(37);
        let tree = LightTree::new(&lamps);
        let (point, normal) = (Vec3::new(1.0, 2.0, 0.5), Vec3::new(0.6, 0.0, 0.8));
        let mut counts = vec![0u32; lamps.len()];
        const TRIES: u32 = 1 << 16;
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
