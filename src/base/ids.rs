//! Indices as distinct types, so that the compiler refuses the index of a patch where that of an element is required.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub u32);

        impl $name {
            /// Returns the id of the `index`-th item.
            ///
            /// # Panics
            /// Panics if `index` does not fit in 32 bits; the loader checks sizes, so no loaded scene is that large.
            #[must_use]
            pub fn new(index: usize) -> Self {
                Self(u32::try_from(index).expect("more than 2^32 items"))
            }

            /// Returns the index into the array of such items.
            #[must_use]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}

id!(
    /// A triangle of the input scene.
    TriangleId
);
id!(
    /// A material of the scene.
    MaterialId
);
id!(
    /// A texture (image and sampler) of the scene.
    TextureId
);
id!(
    /// A placed mesh primitive of the scene.
    InstanceId
);
id!(
    /// A light group: lights that are dimmed together after the bake.
    GroupId
);
id!(
    /// An element: the smallest receiver of light.
    ElementId
);
id!(
    /// A patch: a cluster of elements that shoots as one.
    PatchId
);
