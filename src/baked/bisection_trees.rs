//! The bisection trees of a bake: which elements are halves of one triangle, and so on up to the triangles of the
//! input.
//!
//! A bake records them because they can only be guessed from its triangles. The nodes of the trees become triangles of
//! the coarse mesh for drawing ([`super::coarse`]).
//!
//! A triangle with corners `(a, f, s)`, apex first, is halved at the midpoint `m` of `f` and `s` into `(m, a, f)` and
//! `(m, s, a)` (`patch::subdivide`). The elements of a tree are its leaves, from the first half to the second. A tree
//! is therefore completely described by its shape, in preorder, and the corners of its leaves.

use std::fmt;
use std::ops::Range;

use crate::patch::{Node, PatchMesh};

/// Largest depth of a tree that is read. The shortest edge limits depths to far less.
const MAX_DEPTH: u32 = 128;

/// The trees of all input triangles, in the order of their elements. Each side of a double-sided triangle has its own
/// tree.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BisectionTrees {
    /// Tree after tree, each in preorder.
    nodes: Vec<TreeNode>,
}

/// A node of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TreeNode {
    /// A tree of `2^depth` elements, whose triangles are all halved opposite their first corner; a single element at
    /// depth 0.
    Regular {
        /// At most 15.
        depth: u8,
    },
    /// A triangle that is halved opposite corner `apex`. The nodes of the first and of the second half follow.
    Halved {
        /// 0, 1 or 2.
        apex: u8,
    },
}

/// A tree with the elements that are its leaves.
#[derive(Clone, Debug)]
pub(crate) struct Tree<'a> {
    pub elements: Range<usize>,
    pub nodes: &'a [TreeNode],
}

/// Two triangles that are the halves of a larger one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Halving {
    /// Vertices of the larger triangle, apex first, counter-clockwise as seen from its side.
    pub corners: [u32; 3],
    /// Vertex in the middle of the edge opposite the apex.
    pub middle: u32,
}

/// Error: the trees do not fit the elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Inconsistent;

impl BisectionTrees {
    /// Returns the trees of a mesh.
    #[must_use]
    pub fn of_mesh(mesh: &PatchMesh) -> Self {
        let mut trees = Self::default();
        for root in &mesh.roots {
            for _ in 0..if root.has_backs { 2 } else { 1 } {
                trees.add(root.node, &mesh.tree);
            }
        }
        trees
    }

    fn add(&mut self, root: Node, children: &[Node]) {
        let mut stack = vec![root];
        while let Some(node) = stack.pop() {
            self.nodes.push(match (node.as_regular(), node.as_split()) {
                (Some((_, depth)), _) => TreeNode::Regular { depth: depth as u8 },
                (None, Some((apex, first))) => {
                    stack.extend([children[first + 1], children[first]]);
                    TreeNode::Halved { apex: apex as u8 }
                }
                (None, None) => unreachable!("a node is either regular or split"),
            });
        }
    }

    /// Reads trees from their text, one character a node: `a` to `p` for regular trees of depth 0 to 15, `0` to `2` for
    /// the apex of a triangle that is halved. `None` if a character is none of these or the last tree is incomplete.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let node = |character: u8| match character {
            b'a'..=b'p' => Some(TreeNode::Regular { depth: character - b'a' }),
            b'0'..=b'2' => Some(TreeNode::Halved { apex: character - b'0' }),
            _ => None,
        };
        let trees = Self { nodes: text.bytes().map(node).collect::<Option<_>>()? };
        let num_nodes: usize = trees.iter().map(|tree| tree.nodes.len()).sum();
        (num_nodes == trees.nodes.len()).then_some(trees)
    }

    /// Adds further trees, whose elements follow those that are here.
    pub(crate) fn append(&mut self, mut others: Self) {
        self.nodes.append(&mut others.nodes);
    }

    /// Returns the number of elements of all trees.
    pub(crate) fn num_elements(&self) -> usize {
        self.iter().last().map_or(0, |tree| tree.elements.end)
    }

    /// Returns all complete trees.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Tree<'_>> {
        let (mut rest, mut num_elements) = (&self.nodes[..], 0usize);
        std::iter::from_fn(move || {
            let (mut num_open, first) = (1usize, num_elements);
            for (i, node) in rest.iter().enumerate() {
                match node {
                    TreeNode::Regular { depth } => {
                        (num_open, num_elements) = (num_open - 1, num_elements + (1 << depth))
                    }
                    TreeNode::Halved { .. } => num_open += 1,
                }
                if num_open == 0 {
                    let nodes = &rest[..=i];
                    rest = &rest[i + 1..];
                    return Some(Tree { elements: first..num_elements, nodes });
                }
            }
            None
        })
    }
}

impl<'a> FromIterator<Tree<'a>> for BisectionTrees {
    fn from_iter<T: IntoIterator<Item = Tree<'a>>>(trees: T) -> Self {
        Self { nodes: trees.into_iter().flat_map(|tree| tree.nodes.iter().copied()).collect() }
    }
}

impl fmt::Display for BisectionTrees {
    /// Writes the text that `parse` reads.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.nodes.iter().try_for_each(|node| match node {
            TreeNode::Regular { depth } => write!(f, "{}", char::from(b'a' + depth)),
            TreeNode::Halved { apex } => write!(f, "{apex}"),
        })
    }
}

impl Tree<'_> {
    /// Visits the triangles that are halved, halves before the triangles that contain them.
    ///
    /// `element` returns a number, of any type, for an element, and its vertices. `join` returns a number for the
    /// triangle whose halves are two numbered triangles. `is_back` is true if the elements have the winding of backs,
    /// `[a, c, b]`.
    ///
    /// # Errors
    /// Returns an error if two halves do not share the edge between them.
    pub fn visit<N: Copy>(
        &self,
        is_back: bool,
        element: impl Fn(usize) -> (N, [u32; 3]),
        join: impl FnMut([N; 2], Halving) -> N,
    ) -> Result<(), Inconsistent> {
        let mut visit = Visit { nodes: self.nodes.iter(), next: self.elements.start, is_back, element, join };
        visit.node(0).map(|_| ())
    }
}

/// State of a traversal of a tree.
struct Visit<'a, E, J> {
    nodes: std::slice::Iter<'a, TreeNode>,
    /// The next element.
    next: usize,
    is_back: bool,
    element: E,
    join: J,
}

/// A triangle of a traversal: its number, and its vertices in the winding of the front.
type Part<N> = (N, [u32; 3]);

impl<N: Copy, E: Fn(usize) -> (N, [u32; 3]), J: FnMut([N; 2], Halving) -> N> Visit<'_, E, J> {
    fn node(&mut self, level: u32) -> Result<Part<N>, Inconsistent> {
        match *self.nodes.next().ok_or(Inconsistent)? {
            TreeNode::Regular { depth } => self.regular(depth),
            TreeNode::Halved { .. } if level >= MAX_DEPTH => Err(Inconsistent),
            TreeNode::Halved { apex } => {
                let halves = [self.node(level + 1)?, self.node(level + 1)?];
                self.halved(halves, usize::from(apex))
            }
        }
    }

    fn regular(&mut self, depth: u8) -> Result<Part<N>, Inconsistent> {
        if depth > 0 {
            let halves = [self.regular(depth - 1)?, self.regular(depth - 1)?];
            return self.halved(halves, 0);
        }
        let (number, corners) = (self.element)(self.next);
        self.next += 1;
        Ok((number, self.turned(corners)))
    }

    fn halved(&mut self, halves: [Part<N>; 2], apex: usize) -> Result<Part<N>, Inconsistent> {
        let [[middle, at_apex, from], [other_middle, to, other_apex]] = halves.map(|(_, corners)| corners);
        if middle != other_middle || at_apex != other_apex || from == to {
            return Err(Inconsistent);
        }
        let whole = [at_apex, from, to];
        let halving = Halving { corners: self.turned(whole), middle };
        let number = (self.join)(halves.map(|(number, _)| number), halving);
        Ok((number, std::array::from_fn(|k| whole[(k + 3 - apex) % 3])))
    }

    /// Converts between the winding of the side and that of the front.
    fn turned(&self, [a, b, c]: [u32; 3]) -> [u32; 3] {
        if self.is_back { [a, c, b] } else { [a, b, c] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::patch::MeshSettings;
    use crate::scene::builtin;

    #[test]
    fn the_trees_of_a_mesh_come_back_from_their_text() {
        let scene = builtin::gallery();
        let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.2, patch_size: 0.5 }).expect("a mesh");
        let trees = BisectionTrees::of_mesh(&mesh);
        assert_eq!(trees.num_elements(), mesh.elements.len());
        let text = trees.to_string();
        assert!(text.len() < 2 * mesh.elements.len(), "{} characters for {} elements", text.len(), mesh.elements.len());
        assert_eq!(BisectionTrees::parse(&text), Some(trees));
    }

    #[test]
    fn trees_that_are_incomplete_or_no_trees_are_refused() {
        assert_eq!(BisectionTrees::parse("").map(|trees| trees.num_elements()), Some(0));
        assert_eq!(BisectionTrees::parse("a1ab").map(|trees| trees.num_elements()), Some(4));
        for text in ["0a", "a1", "q", "3aa", "a a", "ä", "0"] {
            assert_eq!(BisectionTrees::parse(text), None, "{text}");
        }
    }

    #[test]
    fn halves_that_share_no_edge_are_inconsistent_however_deep() {
        // Corners (apex, from, to) = (0, 1, 2) with the midpoint 3.
        let elements = [[3, 0, 1], [3, 2, 0]];
        let visit = |text: &str, elements: &[[u32; 3]]| {
            let trees = BisectionTrees::parse(text).expect("a tree");
            let tree = trees.iter().next().expect("a tree");
            let mut found = Vec::new();
            let element = |e: usize| (0, elements.get(e).copied().unwrap_or_default());
            tree.visit(false, element, |_, halving| {
                found.push(halving);
                0
            })
            .map(|()| found)
        };
        assert_eq!(visit("b", &elements), Ok(vec![Halving { corners: [0, 1, 2], middle: 3 }]));
        assert_eq!(visit("b", &[[3, 0, 1], [4, 2, 0]]), Err(Inconsistent));
        assert_eq!(visit("b", &[[3, 0, 1], [3, 1, 0]]), Err(Inconsistent));
        let deep = format!("{}{}", "0".repeat(100_000), "a".repeat(100_001));
        assert_eq!(visit(&deep, &elements), Err(Inconsistent));
    }
}
