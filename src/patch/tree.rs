//! Bisection trees: they find the element that contains a point of an input triangle.

use glam::Vec3;

/// A node of a bisection tree in 32 bits.
///
/// A triangle with corners `a, f, s`, apex first, is halved at the midpoint `m` of `f` and `s` into `(m, a, f)` and
/// `(m, s, a)`: the newest corner comes first. In most triangles the newest corner is the apex after a level or two. If
/// it is the apex for all levels below, and all leaves have one depth, the tree is regular and a single node describes
/// it.
///
/// * `first element << 6 | depth << 2`: a regular tree of `2^depth` elements, a single element at depth 0;
/// * `index of two children << 2 | apex + 1`: halved at the edge opposite corner `apex`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub struct Node(u32);

impl Node {
    /// Returns a regular tree.
    pub(super) fn regular(first_element: u32, depth: u32) -> Self {
        Self(first_element << 6 | depth << 2)
    }

    /// Returns a triangle halved opposite corner `apex`, with the children `children` and `children + 1`.
    pub(super) fn split(apex: usize, children: u32) -> Self {
        Self(children << 2 | (apex as u32 + 1))
    }

    /// First element and depth of a regular tree. `None` for a node that is not regular.
    pub(crate) fn as_regular(self) -> Option<(u32, u32)> {
        (self.0 & 3 == 0).then_some((self.0 >> 6, self.0 >> 2 & 15))
    }

    /// Apex of a node that is not regular, and index of the first of its two children.
    pub(crate) fn as_split(self) -> Option<(usize, usize)> {
        (self.0 & 3 != 0).then(|| ((self.0 & 3) as usize - 1, (self.0 >> 2) as usize))
    }

    /// The bits, as shaders see them.
    #[must_use]
    pub fn bits(self) -> u32 {
        self.0
    }

    /// The element at barycentric position `weights` of the triangle of this node; `tree` holds the children.
    ///
    /// The fragment shader of the item buffer does the same.
    pub(super) fn element_at(mut self, tree: &[Self], weights: Vec3) -> u32 {
        let mut weights = weights.to_array();
        loop {
            if let Some((first_element, depth)) = self.as_regular() {
                let mut path = 0;
                for _ in 0..depth {
                    let is_second = halve(&mut weights);
                    path = path << 1 | u32::from(is_second);
                }
                return first_element + path;
            }
            weights.rotate_left((self.0 & 3) as usize - 1);
            let is_second = halve(&mut weights);
            self = tree[(self.0 >> 2) as usize + usize::from(is_second)];
        }
    }
}

/// Replaces weights of `(a, f, s)` by those of the half that contains the point. Returns true for the second half.
fn halve(weights: &mut [f32; 3]) -> bool {
    let [at_apex, first, second] = *weights;
    let is_second = second > first;
    let (at_midpoint, rest) = (2.0 * first.min(second), (first - second).abs());
    *weights = if is_second { [at_midpoint, rest, at_apex] } else { [at_midpoint, at_apex, rest] };
    is_second
}
