//! Pairs of front and back triangles of double-sided surfaces.
//!
//! A double-sided triangle of a file is one triangle, which rays and shadows hit from both sides. A bake stores light
//! on each side, so it writes the back as a separate triangle with flipped normals and the opposite winding. Rays,
//! shadow casters and collision must hit a surface only once, so they use only the fronts.

use glam::Vec3;

use crate::base::ids::TriangleId;

/// The triangles of a scene that are backs of others.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sides {
    /// True if a triangle is a back `[t]`; triangles beyond the end are fronts.
    is_back: Vec<bool>,
    /// Fronts with their backs, sorted by front.
    pairs: Vec<(TriangleId, Back)>,
}

/// The back of a front triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Back {
    /// The back triangle.
    pub triangle: TriangleId,
    /// Corner of the front at which the first corner of the back lies. The others follow the opposite way: corner `i`
    /// of the back lies at corner `first - i` (modulo 3) of the front.
    pub first: usize,
}

impl Back {
    /// Returns the back with corners `[a, c, b]` of a front with corners `[a, b, c]`.
    #[must_use]
    pub fn flipped(triangle: TriangleId) -> Self {
        Self { triangle, first: 0 }
    }

    /// Returns the barycentric coordinates on the back of the point with these barycentric coordinates on the front.
    #[must_use]
    pub fn weights(&self, on_front: Vec3) -> Vec3 {
        Vec3::from_array(std::array::from_fn(|i| on_front[(self.first + 3 - i) % 3]))
    }
}

impl Sides {
    /// Marks a triangle as a back of an unknown front.
    pub fn add_back(&mut self, triangle: TriangleId) {
        let num_known = self.is_back.len().max(triangle.index() + 1);
        self.is_back.resize(num_known, false);
        self.is_back[triangle.index()] = true;
    }

    /// Adds pairs of a front and its back.
    pub fn add_pairs(&mut self, pairs: impl IntoIterator<Item = (TriangleId, Back)>) {
        for (front, back) in pairs {
            self.add_back(back.triangle);
            self.pairs.push((front, back));
        }
        self.pairs.sort_unstable_by_key(|(front, _)| *front);
    }

    /// Returns true if the triangle is the back of a double-sided surface.
    #[must_use]
    pub fn is_back(&self, triangle: TriangleId) -> bool {
        self.is_back.get(triangle.index()).is_some_and(|&is_back| is_back)
    }

    /// Returns true if the scene has any back.
    #[must_use]
    pub fn has_backs(&self) -> bool {
        self.is_back.contains(&true)
    }

    /// Returns the back of a front triangle; `None` if it has no known back.
    #[must_use]
    pub fn back_of(&self, front: TriangleId) -> Option<Back> {
        let found = self.pairs.binary_search_by_key(&front, |(front, _)| *front).ok()?;
        Some(self.pairs[found].1)
    }

    /// Returns the number of backs of unknown fronts.
    #[must_use]
    pub fn num_unpaired(&self) -> usize {
        self.is_back.iter().filter(|&&is_back| is_back).count() - self.pairs.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_are_fronts_unless_they_are_added_as_backs() {
        let mut sides = Sides::default();
        assert!(!sides.has_backs() && !sides.is_back(TriangleId(7)));
        sides.add_back(TriangleId(3));
        sides.add_pairs([(TriangleId(5), Back::flipped(TriangleId(6))), (TriangleId(1), Back::flipped(TriangleId(2)))]);
        let backs: Vec<u32> = (0..9).filter(|&t| sides.is_back(TriangleId(t))).collect();
        assert_eq!((backs, sides.num_unpaired()), (vec![2, 3, 6], 1));
        assert_eq!(sides.back_of(TriangleId(5)), Some(Back::flipped(TriangleId(6))));
        assert_eq!(sides.back_of(TriangleId(3)), None);
    }

    #[test]
    fn weights_follow_the_corners_of_the_back() {
        let weights = Vec3::new(0.1, 0.2, 0.7);
        assert_eq!(Back::flipped(TriangleId(0)).weights(weights), Vec3::new(0.1, 0.7, 0.2));
        assert_eq!(Back { triangle: TriangleId(0), first: 2 }.weights(weights), Vec3::new(0.7, 0.2, 0.1));
    }
}
